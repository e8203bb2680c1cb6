// The condensed elastic body against statics, rigid motions and handbook formulas.
#include "fpz/calibration/elastic_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "specimens.hpp"

namespace fpz::calibration {
namespace {

using test::beam;
using test::semicircular;

constexpr double nu = 0.24;

/// Half a beam or disc in equilibrium: no horizontal force on the ligament, and its moment balances P/2 times half the
/// span. Pressures on rollers act at their centre; on the load's half of the beam that is a quarter of the width.
void expect_statics(const NotchedSpecimen& s) {
  const Condensation c = condense(s, nu);
  const double sum = c.body.load.sum();
  const double moment = c.body.load.dot(c.height);
  EXPECT_NEAR(sum, 0.0, 1e-9 * c.body.load.cwiseAbs().sum());
  const double arm = 0.5 * s.arms() - (s.load_span > 0.0 ? 0.0 : 0.25 * s.roller_width);
  EXPECT_NEAR(moment, -0.5 * arm, 1e-8 * arm);
}

TEST(ElasticBody, BalancesTheLoad) {
  expect_statics(beam());
  NotchedSpecimen wide = beam();
  wide.roller_width = 10e-3;
  expect_statics(wide);
  expect_statics(semicircular());
  for (const double notch : {0.02, 0.0}) {
    wide.notch = notch;
    wide.load_span = wide.span / 3.0;
    expect_statics(wide);
  }
}

/// Between two loads a beam without a notch is in pure bending: Navier's straight line of stress, Euler's deflection
/// with what the shear between load and support adds (Timoshenko, 6/5 of the mean shear stress).
TEST(ElasticBody, FourPointBendingOfAnUnnotchedBeam) {
  NotchedSpecimen s = beam();
  s.notch = 0.0;
  s.span = 1.0;
  s.length = 1.05;
  s.load_span = 0.4;
  s.roller_width = 0.01;
  s.setting = Setting::plane_stress;
  const Condensation c = condense(s, nu);
  const Eigen::VectorXd stress = c.body.load.cwiseQuotient(c.area);
  const double largest = 1.5 * s.arms() / (s.thickness * s.depth * s.depth);
  for (Eigen::Index k = 0; k < stress.size(); ++k) {
    EXPECT_NEAR(stress[k], largest * (1.0 - 2.0 * c.height[k] / s.depth), 2e-3 * largest) << c.height[k];
  }
  const double inertia = s.thickness * std::pow(s.depth, 3) / 12.0;
  const double arm = 0.5 * s.arms();
  const double bending = arm * (3.0 * s.span * s.span - 4.0 * arm * arm) / (48.0 * inertia);
  const double shear = 0.5 * arm * 1.2 * 2.0 * (1.0 + nu) / (s.thickness * s.depth);
  const double deflection = c.body.gauge_load[static_cast<int>(Gauge::deflection_mid_depth)];
  EXPECT_NEAR(deflection / (bending + shear), 1.0, 2e-3);
}

/// w = 1 and w = 1 - y/y0 move both halves rigidly.
void expect_rigid_motions(const NotchedSpecimen& s) {
  const Condensation c = condense(s, nu);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(c.height.size());
  const double size = c.body.stiffness.cwiseAbs().maxCoeff();
  EXPECT_LE((c.body.stiffness * one).cwiseAbs().maxCoeff(), 1e-9 * size);
  EXPECT_LE((c.body.stiffness * c.height).cwiseAbs().maxCoeff(), 1e-9 * size * s.height());
  EXPECT_LE((c.body.stiffness - c.body.stiffness.transpose()).cwiseAbs().maxCoeff(), 1e-12 * size);

  const Eigen::VectorXd shift = c.body.gauge_jump * one;
  const Eigen::VectorXd turn = c.body.gauge_jump * c.height;
  EXPECT_NEAR(shift[0], 1.0, 1e-8);
  EXPECT_NEAR(turn[0], -s.clip_gauge_distance, 1e-8 * s.height());
  for (const Gauge deflection : {Gauge::deflection_mid_depth, Gauge::deflection_load_point}) {
    const int k = static_cast<int>(deflection);
    EXPECT_NEAR(shift[k], 0.0, 1e-8);
    EXPECT_NEAR(turn[k], -0.25 * s.span, 1e-8 * s.span);
  }
}

TEST(ElasticBody, RigidMotionsCostNothing) {
  NotchedSpecimen s = beam();
  s.clip_gauge_distance = 3e-3;
  expect_rigid_motions(s);
  s = semicircular();
  s.clip_gauge_distance = 2e-3;
  expect_rigid_motions(s);
}

TEST(ElasticBody, LoadPointDeflectionIsConjugateToTheLoad) {
  NotchedSpecimen s = beam();
  s.roller_width = 4e-3;
  const Condensation c = condense(s, nu);
  const auto row = c.body.gauge_jump.row(static_cast<int>(Gauge::deflection_load_point));
  EXPECT_LE((row.transpose() - c.body.load).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ElasticBody, AreasFillTheLigament) {
  const NotchedSpecimen s = beam();
  const Condensation c = condense(s, nu);
  EXPECT_NEAR(c.area.sum(), s.ligament() * s.thickness, 1e-12);
  EXPECT_NEAR(c.area.dot(c.height), s.ligament() * s.thickness * (s.notch + 0.5 * s.ligament()), 1e-14);
}

/// Relative error of the exact derivative with respect to Poisson's ratio against a central difference.
double nu_error(const Eigen::MatrixXd& exact, const Eigen::MatrixXd& above, const Eigen::MatrixXd& below, double step) {
  const Eigen::MatrixXd difference = (above - below) / (2.0 * step);
  return (exact - difference).cwiseAbs().maxCoeff() / difference.cwiseAbs().maxCoeff();
}

TEST(ElasticBody, DerivativeWithRespectToPoissonsRatio) {
  constexpr double step = 1e-4;
  for (const Setting setting : {Setting::plane_strain, Setting::plane_stress}) {
    for (NotchedSpecimen s : {beam(), semicircular()}) {
      s.setting = setting;
      s.mesh.ligament_fraction = 0.1;
      s.roller_width = 2e-3;
      const Condensation c = condense(s, nu, true);
      const CondensedBody a = condense(s, nu + step).body;
      const CondensedBody b = condense(s, nu - step).body;
      EXPECT_LE(nu_error(c.d_nu->stiffness, a.stiffness, b.stiffness, step), 1e-6);
      EXPECT_LE(nu_error(c.d_nu->load, a.load, b.load, step), 1e-6);
      EXPECT_LE(nu_error(c.d_nu->gauge_jump, a.gauge_jump, b.gauge_jump, step), 1e-6);
      EXPECT_LE(nu_error(c.d_nu->gauge_load, a.gauge_load, b.gauge_load, step), 1e-6);
    }
  }
}

/// E'/E.
double plane_modulus(const NotchedSpecimen& s) {
  return s.setting == Setting::plane_strain ? 1.0 / (1.0 - nu * nu) : 1.0;
}

/// K_I per load from the release of energy with growing notch, G = K^2/E' = 1/2 dC/da / thickness.
double stress_intensity(NotchedSpecimen s) {
  const int k = static_cast<int>(Gauge::deflection_load_point);
  const double notch = s.notch;
  const double step = 0.01 * s.height();
  s.notch = notch + step;
  const double longer = condense(s, nu).body.gauge_load[k];
  s.notch = notch - step;
  const double shorter = condense(s, nu).body.gauge_load[k];
  return std::sqrt(0.5 * (longer - shorter) / (2.0 * step) / s.thickness * plane_modulus(s));
}

/// Tada, Paris and Irwin, span = 4 depth; fits with stated accuracies of 1 % and 0.5 %.
double tada_cmod(const NotchedSpecimen& s) {
  const double a = s.notch / s.depth;
  const double stress = 1.5 * s.span / (s.thickness * s.depth * s.depth);
  const double v = 0.76 - 2.28 * a + 3.87 * a * a - 2.04 * a * a * a + 0.66 / ((1.0 - a) * (1.0 - a));
  return 4.0 * stress * s.notch * v / plane_modulus(s);
}

double tada_stress_intensity(const NotchedSpecimen& s) {
  const double a = s.notch / s.depth;
  const double f = 1.5 * std::sqrt(a) * (1.99 - a * (1.0 - a) * (2.15 - 3.93 * a + 2.7 * a * a)) /
                   ((1.0 + 2.0 * a) * std::pow(1.0 - a, 1.5));
  return s.span / (s.thickness * std::pow(s.depth, 1.5)) * f;
}

NotchedSpecimen tada_beam(double notch, Setting setting) {
  NotchedSpecimen s = beam();
  s.span = 4.0 * s.depth;
  s.length = 4.5 * s.depth;
  s.notch = notch * s.depth;
  s.setting = setting;
  return s;
}

// Differs by -0.7 to 1.6 %, the same on meshes of half the element size.
TEST(ElasticBody, CmodOfTheHandbook) {
  for (const Setting setting : {Setting::plane_strain, Setting::plane_stress}) {
    for (const double notch : {0.1, 0.2, 0.3, 0.5, 0.7}) {
      const NotchedSpecimen s = tada_beam(notch, setting);
      const double cmod = condense(s, nu).body.gauge_load[static_cast<int>(Gauge::cmod)];
      EXPECT_NEAR(cmod / tada_cmod(s), 1.0, 0.018) << notch;
    }
  }
}

TEST(ElasticBody, StressIntensityOfTheHandbook) {
  for (const double notch : {0.2, 0.4, 0.6}) {
    NotchedSpecimen s = tada_beam(notch, Setting::plane_strain);
    s.roller_width = 0.04 * s.depth;
    // The wide roller shortens the arm of each half by a quarter of its width.
    const double arm = 1.0 - 0.5 * s.roller_width / s.span;
    EXPECT_NEAR(stress_intensity(s) / tada_stress_intensity(s) / arm, 1.0, 0.01) << notch;
  }
}

/// K_I of the semicircular specimen after the ISRM suggested method (Kuruppu et al. 2014, doi
/// 10.1007/s00603-013-0422-7): a fit, which lies up to 3.7 % above the values here. Another published fit for
/// span = 0.8 diameters, Y = 4.782 - 1.219 a/R + 0.063 exp(7.045 a/R) (Lim et al. 1993), lies up to 3.4 % below.
TEST(ElasticBody, StressIntensityOfTheSemicircularSpecimen) {
  for (const double notch : {0.4, 0.5, 0.6}) {
    for (const double span : {0.5, 0.6, 0.8}) {
      NotchedSpecimen s = semicircular();
      s.notch = notch * s.radius;
      s.span = span * 2.0 * s.radius;
      s.roller_width = 0.01 * s.radius;
      const double y = -1.297 + 9.516 * span - (0.47 + 16.457 * span) * notch + (1.071 + 34.401 * span) * notch * notch;
      const double isrm = std::sqrt(std::numbers::pi * s.notch) * y / (2.0 * s.radius * s.thickness);
      const double k = stress_intensity(s);
      EXPECT_NEAR(k / isrm, 1.0, 0.04) << notch << ' ' << span;
      if (span == 0.8) {
        const double lim = 4.782 - 1.219 * notch + 0.063 * std::exp(7.045 * notch);
        EXPECT_NEAR(k / (isrm * lim / y), 1.0, 0.035) << notch;
      }
    }
  }
}

TEST(ElasticBody, ConvergesWithTheMesh) {
  // Singular notch tip: errors go with the size of the elements there.
  const auto cmod = [](double factor) {
    NotchedSpecimen s = beam();
    s.mesh.ligament_fraction *= factor;
    s.mesh.tip_fraction *= factor;
    s.mesh.support_fraction *= factor;
    s.mesh.growth *= std::sqrt(factor);
    return condense(s, nu).body.gauge_load[static_cast<int>(Gauge::cmod)];
  };
  const double coarse = cmod(2.0);
  const double standard = cmod(1.0);
  const double fine = cmod(0.5);
  EXPECT_LE(std::abs(fine - standard), 0.4 * std::abs(standard - coarse));
  EXPECT_LE(std::abs(fine - standard), 2e-3 * fine);
}

}  // namespace
}  // namespace fpz::calibration
