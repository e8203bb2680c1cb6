// Fracture of beams and semicircular specimens against a reference calculation, closed forms, balances and differences.
#include "fpz/calibration/notched_specimen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "fpz/calibration/mid_line.hpp"
#include "specimens.hpp"

namespace fpz::calibration {
namespace {

using test::beam;
using test::concrete;
using test::semicircular;

Eigen::VectorXd none(Gauge gauge) { return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nuisances(gauge).size())); }

NotchedSpecimenTest test_of(const NotchedSpecimen& s, Gauge gauge, const Eigen::VectorXd& readings) {
  NotchedSpecimenTest t;
  t.specimen = s;
  t.gauge = gauge;
  t.readings = readings;
  return t;
}

Prediction run(const NotchedSpecimen& s, const Parameters& p, Gauge gauge, const Eigen::VectorXd& readings) {
  return predict(test_of(s, gauge, readings), p, none(gauge), false);
}

// --- The reference curve -------------------------------------------------------------------------------------------

struct Reference {
  Eigen::VectorXd load, cmod, mid_depth;
};

Reference reference_curve() {
  std::ifstream file(FPZ_DATA_DIR "/reference/beam_3pb_straight_crack.csv");
  std::string line;
  std::getline(file, line);
  std::vector<std::array<double, 3>> rows;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream in(line);
    std::array<double, 3> row{};
    in >> row[0] >> row[1] >> row[2];
    rows.push_back(row);
  }
  Reference r;
  const auto n = static_cast<Eigen::Index>(rows.size());
  r.load.resize(n);
  r.cmod.resize(n);
  r.mid_depth.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& row = rows[static_cast<std::size_t>(k)];
    r.load[k] = row[0];
    r.cmod[k] = 1e-3 * row[1];
    r.mid_depth[k] = 1e-3 * row[2];
  }
  return r;
}

TEST(NotchedSpecimen, ReferenceCurveAgainstCmod) {
  const Reference r = reference_curve();
  ASSERT_EQ(r.load.size(), 161);
  const Prediction p = run(beam(), concrete(), Gauge::cmod, r.cmod);
  ASSERT_TRUE(p.ok()) << p.failure;
  const double peak = r.load.maxCoeff();
  EXPECT_NEAR(p.values.maxCoeff(), peak, 0.005 * peak);
  EXPECT_LE((p.values - r.load).cwiseAbs().maxCoeff(), 0.01 * peak);
}

TEST(NotchedSpecimen, ReferenceCurveAgainstMidDepthDeflection) {
  const Reference r = reference_curve();
  const Prediction p = run(beam(), concrete(), Gauge::deflection_mid_depth, r.mid_depth);
  ASSERT_TRUE(p.ok()) << p.failure;
  const double peak = r.load.maxCoeff();
  EXPECT_NEAR(p.values.maxCoeff(), peak, 0.005 * peak);
  EXPECT_LE((p.values - r.load).cwiseAbs().maxCoeff(), 0.01 * peak);
}

// --- Closed forms and balances ---------------------------------------------------------------------------------------

/// Error of the energy balance over the work of the load. The work is integrated with the trapezoidal rule, so that the
/// error falls with the square of the steps.
double balance_error(const NotchedSpecimen& s, double step) {
  const FractureCurve c = fracture_curve(s, concrete(), 0.02, step);
  EXPECT_EQ(c.failure, "");
  double work = 0.0;
  double worst = 0.0;
  for (std::size_t k = 1; k < c.load.size(); ++k) {
    work += 0.5 * (c.load[k] + c.load[k - 1]) * (c.deflection_load_point[k] - c.deflection_load_point[k - 1]);
    worst = std::max(worst, std::abs(work - c.elastic_energy[k] - c.fracture_work[k]));
  }
  return worst / work;
}

TEST(NotchedSpecimen, WorkOfTheLoadIsElasticEnergyPlusFractureWork) {
  NotchedSpecimen s = beam();
  s.roller_width = 4e-3;
  EXPECT_LE(balance_error(s, 0.04), 1e-3);
  EXPECT_LE(balance_error(s, 0.01), 1e-4);
  EXPECT_LE(balance_error(semicircular(), 0.02), 1e-3);
}

TEST(NotchedSpecimen, FullySeparatedLigamentHasCostTheFractureEnergy) {
  const Parameters p = concrete();
  const Condensation body = condense(beam(), p.poisson_ratio);
  MidLine path(body, p, {}, false);
  ASSERT_EQ(path.advance(2e-3), "");
  // Per node: sigma_t0 delta0 (1 - exp(-w/delta0)), whatever the steps were.
  const Eigen::ArrayXd open = 1.0 - (-path.jump().array() / p.delta0).exp();
  const double expected = (body.area.array() * open).sum() * p.tensile_strength * p.delta0;
  EXPECT_NEAR(path.fracture_work(), expected, 1e-9 * expected);
  EXPECT_NEAR(path.fracture_work() / (beam().ligament() * beam().thickness * p.tensile_strength * p.delta0), 1.0, 0.03);
}

TEST(NotchedSpecimen, TractionsBalanceTheLoad) {
  const Parameters p = concrete();
  const NotchedSpecimen s = beam();
  const Condensation body = condense(s, p.poisson_ratio);
  MidLine path(body, p, {}, false);
  for (const double cmod : {5e-6, 20e-6, 100e-6}) {
    ASSERT_EQ(path.advance(cmod), "");
    const Eigen::VectorXd force = path.traction().cwiseProduct(body.area);
    EXPECT_NEAR(force.sum(), 0.0, 1e-8 * force.cwiseAbs().sum());
    EXPECT_NEAR(force.dot(body.height), -0.25 * path.load() * s.span, 1e-8 * path.load() * s.span);
    // The law itself: exponential where cracked, sigma_t0 nowhere exceeded.
    for (Eigen::Index k = 0; k < path.jump().size(); ++k) {
      EXPECT_LE(path.traction()[k], p.tensile_strength * (1.0 + 1e-8));
      if (path.jump()[k] > 0.0) {
        EXPECT_NEAR(path.traction()[k], p.tensile_strength * std::exp(-path.jump()[k] / p.delta0),
                    1e-7 * p.tensile_strength);
      }
    }
  }
}

/// Petersson's two lines on the mid-line, and their fracture energy when the ligament is separated.
TEST(NotchedSpecimen, BilinearSoftening) {
  Parameters p = concrete();
  p.choices.softening = softening_kind<BilinearSoftening>;
  const Condensation body = condense(beam(), p.poisson_ratio);
  MidLine path(body, p, {}, false);
  int on_second_line = 0;
  for (const double cmod : {10e-6, 40e-6, 100e-6, 3e-4}) {
    ASSERT_EQ(path.advance(cmod), "");
    for (Eigen::Index k = 0; k < path.jump().size(); ++k) {
      const double x = path.jump()[k] / p.delta0;
      if (x <= 0.0) continue;
      const double w = x < 0.8 ? 1.0 - x / 1.2 : std::max(3.6 - x, 0.0) / 8.4;
      EXPECT_NEAR(path.traction()[k], p.tensile_strength * w, 1e-7 * p.tensile_strength) << x;
      on_second_line += x > 0.8 && x < 3.6;
    }
  }
  EXPECT_GT(on_second_line, 5);
  ASSERT_EQ(path.advance(2e-3), "");
  const double whole = beam().ligament() * beam().thickness * p.tensile_strength * p.delta0;
  EXPECT_NEAR(path.fracture_work() / whole, 1.0, 0.03);  // the last few nodes stay in compression
}

double peak_load(const NotchedSpecimen& s, const Parameters& p) {
  const FractureCurve c = fracture_curve(s, p, 0.98, 0.1);
  EXPECT_EQ(c.failure, "");
  return *std::max_element(c.load.begin(), c.load.end());
}

/// K_I per load of the beam with span = 4 depth (Tada, Paris and Irwin).
double handbook(const NotchedSpecimen& s, double notch) {
  const double a = notch / s.depth;
  const double f = 1.5 * std::sqrt(a) * (1.99 - a * (1.0 - a) * (2.15 - 3.93 * a + 2.7 * a * a)) /
                   ((1.0 + 2.0 * a) * std::pow(1.0 - a, 1.5));
  return s.span / (s.thickness * std::pow(s.depth, 1.5)) * f;
}

/// A process zone that is small against the specimen: K_I = K_Ic = sqrt(E' sigma_t0 delta0) at the peak. To next order
/// the crack acts as if it were longer by 2.48 E' delta0/sigma_t0 (asymptotics of Planas and Elices for exponential
/// softening), at finite sizes by less. The approach is slow because of the law's long tail.
TEST(NotchedSpecimen, BrittleLimitIsGriffith) {
  NotchedSpecimen s = beam();
  s.span = 4.0 * s.depth;
  s.length = 4.5 * s.depth;
  s.notch = 0.4 * s.depth;
  const auto error = [&](double zone) {  // E' delta0/sigma_t0 over the depth
    Parameters p = concrete();
    const double modulus = p.young_modulus / (1.0 - p.poisson_ratio * p.poisson_ratio);
    p.delta0 = zone * s.depth * p.tensile_strength / modulus;
    p.normal_stiffness = 1e3 * p.tensile_strength / p.delta0;
    s.mesh.ligament_fraction = 0.1 * zone * s.depth / s.ligament();
    EXPECT_EQ(mesh_warning(s, p), "");
    const double toughness = std::sqrt(modulus * p.tensile_strength * p.delta0);
    const double load = peak_load(s, p);
    EXPECT_LT(load, toughness / handbook(s, s.notch));
    EXPECT_GT(load, toughness / handbook(s, s.notch + 2.48 * zone * s.depth));
    return load * handbook(s, s.notch) / toughness - 1.0;
  };
  const double wide = error(0.1);
  const double middle = error(0.05);
  const double narrow = error(0.025);
  EXPECT_LT(wide, 1.3 * middle);
  EXPECT_LT(middle, 1.3 * narrow);
  EXPECT_GT(narrow, -0.1);
}

/// Hardly any softening: sigma_t0 over the whole ligament against a compressed point under the load,
/// P span/4 = sigma_t0 b lig^2/2.
TEST(NotchedSpecimen, DuctileLimitIsThePlasticHinge) {
  Parameters p = concrete();
  p.delta0 = 10.0;
  const NotchedSpecimen s = beam();
  const double hinge = 2.0 * p.tensile_strength * s.thickness * s.ligament() * s.ligament() / s.span;
  const Prediction r = run(s, p, Gauge::cmod, Eigen::Vector3d(1e-4, 1e-3, 1e-2));
  ASSERT_TRUE(r.ok()) << r.failure;
  EXPECT_LT(r.values[0], r.values[1]);
  EXPECT_LT(r.values[1], r.values[2]);
  EXPECT_LT(r.values[2], hinge);
  EXPECT_NEAR(r.values[2] / hinge, 1.0, 0.01);
}

/// The same under two loads: P (span - load_span)/4 = sigma_t0 b lig^2/2, and without a notch.
TEST(NotchedSpecimen, DuctileLimitUnderTwoLoads) {
  Parameters p = concrete();
  p.delta0 = 10.0;
  NotchedSpecimen s = beam();
  s.load_span = s.span / 3.0;
  for (const double notch : {s.notch, 0.0}) {
    s.notch = notch;
    const double hinge = 2.0 * p.tensile_strength * s.thickness * s.ligament() * s.ligament() / s.arms();
    const Prediction r = run(s, p, Gauge::deflection_mid_depth, Eigen::Vector2d(1e-3, 1e-2));
    ASSERT_TRUE(r.ok()) << r.failure;
    EXPECT_NEAR(r.values[1] / hinge, 1.0, 0.01);
  }
}

/// Without a notch a short process zone lets the beam fail when Navier's stress reaches sigma_t0; a long one lets it
/// carry more.
TEST(NotchedSpecimen, ModulusOfRuptureOfAnUnnotchedBeam) {
  NotchedSpecimen s = beam();
  s.notch = 0.0;
  s.load_span = s.span / 3.0;
  Parameters p = concrete();
  p.delta0 = 60e-6;  // stable under deflection control
  const Prediction r = run(s, p, Gauge::deflection_mid_depth, Eigen::VectorXd::LinSpaced(200, 1e-6, 2e-4));
  ASSERT_TRUE(r.ok()) << r.failure;
  const double rupture = 1.5 * s.arms() / (s.thickness * s.depth * s.depth) * r.values.maxCoeff();
  EXPECT_GT(rupture, 1.3 * p.tensile_strength);
  EXPECT_LT(rupture, 3.0 * p.tensile_strength);  // the plastic hinge
  EXPECT_NE(run(s, p, Gauge::cmod, Eigen::VectorXd::Constant(1, 1e-5)).failure.find("unnotched"), std::string::npos);
}

TEST(NotchedSpecimen, ScalesWithStressAndWithLength) {
  const Eigen::VectorXd cmod = Eigen::VectorXd::LinSpaced(6, 5e-6, 1e-4);
  const Parameters p = concrete();
  const Prediction base = run(beam(), p, Gauge::cmod, cmod);
  Parameters stiff = p;
  for (double Parameters::*m : {&Parameters::young_modulus, &Parameters::tensile_strength, &Parameters::cohesion,
                                &Parameters::normal_stiffness, &Parameters::shear_stiffness})
    stiff.*m *= 3.0;
  const Prediction stress = run(beam(), stiff, Gauge::cmod, cmod);
  ASSERT_TRUE(base.ok() && stress.ok());
  EXPECT_LE((stress.values - 3.0 * base.values).cwiseAbs().maxCoeff(), 1e-8 * base.values.maxCoeff());

  Parameters large = p;
  large.delta0 *= 2.0;
  large.normal_stiffness *= 0.5;
  large.shear_stiffness *= 0.5;
  NotchedSpecimen s = beam();
  for (double NotchedSpecimen::*m : {&NotchedSpecimen::length, &NotchedSpecimen::depth, &NotchedSpecimen::thickness,
                                     &NotchedSpecimen::span, &NotchedSpecimen::notch})
    s.*m *= 2.0;
  const Prediction length = run(s, large, Gauge::cmod, 2.0 * cmod);
  ASSERT_TRUE(length.ok());
  EXPECT_LE((length.values - 4.0 * base.values).cwiseAbs().maxCoeff(), 1e-7 * length.values.maxCoeff());
}

TEST(NotchedSpecimen, FinerMeshChangesTheCurveByLessThanAThousandthOfThePeak) {
  for (const NotchedSpecimen& s : {beam(), semicircular()}) {
    NotchedSpecimen fine = s;
    fine.mesh.ligament_fraction *= 0.5;
    fine.mesh.tip_fraction *= 0.5;
    const Eigen::VectorXd cmod = Eigen::VectorXd::LinSpaced(25, 4e-6, 1e-4);
    const Prediction a = run(s, concrete(), Gauge::cmod, cmod);
    const Prediction b = run(fine, concrete(), Gauge::cmod, cmod);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_LE((a.values - b.values).cwiseAbs().maxCoeff(), 1e-3 * b.values.maxCoeff());
  }
}

TEST(NotchedSpecimen, LoadDoesNotDependOnTheSteps) {
  const Parameters p = concrete();
  const Eigen::VectorXd few = Eigen::Vector3d(1e-5, 4e-5, 1e-4);
  const Eigen::VectorXd many = Eigen::VectorXd::LinSpaced(100, 1e-6, 1e-4);
  const Prediction a = run(beam(), p, Gauge::cmod, few);
  const Prediction b = run(beam(), p, Gauge::cmod, many);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_NEAR(a.values[0], b.values[9], 1e-8 * a.values[0]);
  EXPECT_NEAR(a.values[1], b.values[39], 1e-8 * a.values[1]);
  EXPECT_NEAR(a.values[2], b.values[99], 1e-8 * a.values[2]);
}

TEST(NotchedSpecimen, UnloadingAndReloadingReturnsToTheSamePoint) {
  Parameters p = concrete();
  p.normal_stiffness = 2.0 * p.tensile_strength / p.delta0;  // springs so soft that every cracked node unloads
  const Eigen::VectorXd cmod = (Eigen::VectorXd(7) << 1e-5, 3e-5, 2.9e-5, 2.7e-5, 2.9e-5, 3e-5, 5e-5).finished();
  const Prediction cycle = run(beam(), p, Gauge::cmod, cmod);
  ASSERT_TRUE(cycle.ok()) << cycle.failure;
  const double tolerance = 1e-8 * cycle.values[1];
  EXPECT_LT(cycle.values[3], 0.9 * cycle.values[1]);
  EXPECT_NEAR(cycle.values[4], cycle.values[2], tolerance);
  EXPECT_NEAR(cycle.values[5], cycle.values[1], tolerance);
  const Condensation body = condense(beam(), p.poisson_ratio);
  MidLine direct(body, p, {}, false);
  ASSERT_EQ(direct.advance(5e-5), "");
  EXPECT_NEAR(cycle.values[6], direct.load(), tolerance);
}

/// With stiff springs the jumps stay (eq 45) and wedge the crack: unloading compresses its tail, and its front, still
/// in tension, opens further. Reloading then does not return to the same point, but the energy still balances.
TEST(NotchedSpecimen, EnergyBalancesThroughUnloading) {
  const Parameters p = concrete();
  const Condensation body = condense(beam(), p.poisson_ratio);
  MidLine path(body, p, {}, false);
  double work = 0.0;
  double load = 0.0;
  double deflection = 0.0;
  const auto go = [&](double to, int steps) {
    const double from = path.reading();
    for (int k = 1; k <= steps; ++k) {
      ASSERT_EQ(path.advance(from + (to - from) * k / steps), "");
      const double next = path.gauge(Gauge::deflection_load_point);
      work += 0.5 * (path.load() + load) * (next - deflection);
      load = path.load();
      deflection = next;
    }
  };
  go(3e-5, 400);
  go(2.8e-5, 100);
  go(6e-5, 400);
  EXPECT_NEAR(path.elastic_energy() + path.fracture_work(), work, 1e-4 * work);
}

// --- Derivatives -----------------------------------------------------------------------------------------------------

/// Every entry of the Jacobian against central differences, to 1e-6 of the largest one of its column.
void expect_derivatives(const NotchedSpecimenTest& t, const Eigen::VectorXd& nuisance) {
  const Parameters p = concrete();
  const Prediction exact = predict(t, p, nuisance, true);
  ASSERT_TRUE(exact.ok()) << exact.failure;
  ASSERT_EQ(exact.jacobian.cols(), parameter_count + nuisance.size());
  // Differences of two steps, extrapolated: an error of fourth order.
  const auto compare = [&](Eigen::Index column, double step, const std::function<Prediction(double)>& at) {
    const auto difference = [&](double h) -> Eigen::VectorXd {
      const Prediction above = at(h);
      const Prediction below = at(-h);
      EXPECT_TRUE(above.ok() && below.ok()) << above.failure << below.failure;
      return (above.values - below.values) / (2.0 * h);
    };
    const Eigen::VectorXd expected = (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
    const double error = (exact.jacobian.col(column) - expected).cwiseAbs().maxCoeff();
    const double rounding = 1e-12 * exact.values.maxCoeff() / step;  // of the differences: loads have 12 digits
    EXPECT_LE(error, 1e-6 * expected.cwiseAbs().maxCoeff() + rounding) << "column " << column;
  };
  for (int k = 0; k < parameter_count; ++k) {
    const auto member = parameter_info[static_cast<std::size_t>(k)].member;
    // The rounding of the condensation asks for a longer step in Poisson's ratio.
    const double relative = k == static_cast<int>(Parameter::poisson_ratio) ? 5e-3 : 2e-4;
    compare(k, relative * p.*member, [&](double h) {
      Parameters q = p;
      q.*member += h;
      return predict(t, q, nuisance, false);
    });
  }
  for (Eigen::Index k = 0; k < nuisance.size(); ++k) {
    const std::string_view unit = nuisances(t.gauge)[static_cast<std::size_t>(k)].unit;
    compare(parameter_count + k,
            unit == "m"   ? 2e-10
            : unit == "N" ? 0.05
                          : 1e-12,
            [&](double h) {
              Eigen::VectorXd moved = nuisance;
              moved[k] += h;
              return predict(t, p, moved, false);
            });
  }
}

NotchedSpecimen coarse(NotchedSpecimen s) {
  s.mesh.ligament_fraction = 0.05;
  s.mesh.tip_fraction = 0.25;
  return s;
}

TEST(NotchedSpecimen, DerivativesAgainstCmod) {
  const Eigen::VectorXd cmod = (Eigen::VectorXd(8) << -1e-7, 2e-7, 1e-6, 5e-6, 1.2e-5, 3e-5, 8e-5, 2e-4).finished();
  expect_derivatives(test_of(coarse(beam()), Gauge::cmod, cmod), Eigen::VectorXd::Constant(1, 1.3e-7));
  expect_derivatives(test_of(coarse(semicircular()), Gauge::cmod, cmod), Eigen::VectorXd::Constant(1, -2e-7));
}

TEST(NotchedSpecimen, DerivativesAgainstDeflections) {
  const Eigen::VectorXd deflection = (Eigen::VectorXd(7) << 1e-6, 1e-5, 1.8e-5, 2.5e-5, 3.5e-5, 6e-5, 2e-4).finished();
  const Eigen::VectorXd nuisance = Eigen::Vector4d(1.5e-9, 4e-7, 3e-6, 300.0);
  NotchedSpecimen s = coarse(beam());
  s.roller_width = 4e-3;
  for (const Gauge gauge : {Gauge::deflection_mid_depth, Gauge::deflection_load_point})
    expect_derivatives(test_of(s, gauge, deflection), nuisance);
  s = coarse(semicircular());
  s.roller_width = 2e-3;
  expect_derivatives(test_of(s, Gauge::deflection_load_point, deflection), nuisance);
  s = coarse(beam());
  s.roller_width = 4e-3;
  s.load_span = s.span / 3.0;
  expect_derivatives(test_of(s, Gauge::deflection_load_point, deflection), nuisance);
}

TEST(NotchedSpecimen, DerivativesThroughUnloading) {
  const Eigen::VectorXd cmod = (Eigen::VectorXd(7) << 1e-5, 3e-5, 2.93e-5, 2.85e-5, 2.95e-5, 3.3e-5, 6e-5).finished();
  expect_derivatives(test_of(coarse(beam()), Gauge::cmod, cmod), Eigen::VectorXd::Constant(1, 1e-7));
}

// --- Nuisances, conversions, failures --------------------------------------------------------------------------------

TEST(NotchedSpecimen, NuisancesShiftTheReading) {
  const Parameters p = concrete();
  const Eigen::VectorXd gauge = Eigen::VectorXd::LinSpaced(8, 1e-5, 1e-4);
  const Prediction base = run(beam(), p, Gauge::deflection_mid_depth, gauge);
  ASSERT_TRUE(base.ok()) << base.failure;
  const Eigen::VectorXd readings = (gauge + 2e-9 * base.values).array() + 3e-6;
  const Prediction moved =
      predict(test_of(beam(), Gauge::deflection_mid_depth, readings), p, Eigen::Vector4d(2e-9, 3e-6, 0.0, 0.0), false);
  ASSERT_TRUE(moved.ok()) << moved.failure;
  EXPECT_LE((moved.values - base.values).cwiseAbs().maxCoeff(), 1e-8 * base.values.maxCoeff());
}

TEST(NotchedSpecimen, ElasticLineGoesOnBelowZero) {
  const Prediction p = run(beam(), concrete(), Gauge::cmod, Eigen::Vector3d(-1e-9, 0.0, 1e-9));
  ASSERT_TRUE(p.ok());
  EXPECT_EQ(p.values[1], 0.0);
  EXPECT_DOUBLE_EQ(p.values[0], -p.values[2]);
  EXPECT_NEAR(p.values[2], 1e-9 * 45e9 * initial_stiffness(beam(), 0.24), 1e-9 * p.values[2]);
}

TEST(NotchedSpecimen, ModulusFromTheInitialSlope) {
  const double modulus = 37e9;
  const Eigen::VectorXd cmod = Eigen::VectorXd::LinSpaced(41, 0.0, 4e-6);
  Eigen::VectorXd load = modulus * initial_stiffness(beam(), 0.2) * (cmod.array() - 2e-7);
  const InitialModulus exact = initial_modulus(beam(), 0.2, cmod, load, 0.1, 0.4);
  EXPECT_NEAR(exact.value, modulus, 1e-6 * modulus);
  EXPECT_NEAR(exact.offset, 2e-7, 1e-12);
  EXPECT_LE(exact.standard_error, 1e-8 * modulus);
  for (Eigen::Index k = 0; k < load.size(); k += 2) load[k] += 1.0;
  EXPECT_GT(initial_modulus(beam(), 0.2, cmod, load, 0.1, 0.4).standard_error, 1e-5 * modulus);
  EXPECT_THROW((void)initial_modulus(beam(), 0.2, cmod, load, 0.1, 0.12), std::invalid_argument);
}

Parameters brittle() {
  Parameters p = concrete();
  p.delta0 = 4e-7;
  p.normal_stiffness = 1e3 * p.tensile_strength / p.delta0;
  return p;
}

NotchedSpecimen fine_beam() {
  NotchedSpecimen s = beam();
  s.mesh.ligament_fraction = 1.0 / 100.0;
  return s;
}

TEST(NotchedSpecimen, SnapBackUnderDeflectionControlIsAFailure) {
  // Under growing CMOD the deflection does turn back.
  const FractureCurve curve = fracture_curve(fine_beam(), brittle());
  const auto& d = curve.deflection_mid_depth;
  const auto top = std::max_element(d.begin(), d.begin() + static_cast<std::ptrdiff_t>(d.size() / 2));
  ASSERT_LT(*std::min_element(top, d.end()), 0.97 * *top);

  const Eigen::VectorXd gauge = Eigen::VectorXd::LinSpaced(60, 1e-6, 6e-5);
  const Prediction deflection = run(fine_beam(), brittle(), Gauge::deflection_mid_depth, gauge);
  ASSERT_FALSE(deflection.ok());
  EXPECT_NE(deflection.failure.find("snap-back"), std::string::npos) << deflection.failure;
  EXPECT_NE(deflection.failure.find("CMOD"), std::string::npos) << deflection.failure;
  const Prediction cmod = run(fine_beam(), brittle(), Gauge::cmod, gauge);
  EXPECT_TRUE(cmod.ok()) << cmod.failure;
}

/// A curve that falls steeply, but does not turn back, is none.
TEST(NotchedSpecimen, SteepFallUnderDeflectionControlIsNoSnapBack) {
  Parameters p = concrete();
  p.delta0 = 1e-6;
  const FractureCurve curve = fracture_curve(fine_beam(), p);
  EXPECT_TRUE(std::is_sorted(curve.deflection_mid_depth.begin(), curve.deflection_mid_depth.end()));
  for (const NotchedSpecimen& s : {fine_beam(), beam()}) {  // on the coarser mesh the path by steps stops here
    const Prediction r = run(s, p, Gauge::deflection_mid_depth, Eigen::VectorXd::LinSpaced(60, 1e-6, 2e-5));
    EXPECT_TRUE(r.ok()) << r.failure;
  }
}

TEST(NotchedSpecimen, PointsAtWhichTheDeflectionHasPassedTheSnapBackAreNotGuessed) {
  const Prediction p = run(fine_beam(), brittle(), Gauge::deflection_mid_depth, Eigen::VectorXd::Constant(1, 6e-5));
  EXPECT_FALSE(p.ok());
}

TEST(NotchedSpecimen, NoDilationIsAFailureThatSaysSo) {
  Parameters p = concrete();
  p.dilation_angle_deg = 0.0;
  const Prediction r = run(beam(), p, Gauge::cmod, Eigen::VectorXd::Constant(1, 2e-5));
  EXPECT_NE(r.failure.find("dilation"), std::string::npos) << r.failure;
}

TEST(NotchedSpecimen, ValidationNamesFieldValueAndConstraint) {
  NotchedSpecimen s = beam();
  s.notch = 0.09;
  s.span = 0.4;
  s.thickness = -1.0;
  const Validation v = validate(s);
  ASSERT_EQ(v.errors.size(), 3U);
  EXPECT_EQ(v.errors[0].field, "thickness");
  EXPECT_EQ(v.errors[1].field, "span");
  EXPECT_EQ(v.errors[2].field, "notch");
  EXPECT_NE(v.errors[1].constraint.find("0.32"), std::string::npos);
  EXPECT_THROW((void)condense(s, 0.2), std::invalid_argument);
  const Prediction p = run(s, concrete(), Gauge::cmod, Eigen::VectorXd::Constant(1, 1e-5));
  EXPECT_NE(p.failure.find("notch = 0.09"), std::string::npos) << p.failure;

  const Prediction point = run(beam(), concrete(), Gauge::deflection_load_point, Eigen::VectorXd::Constant(1, 1e-5));
  EXPECT_NE(point.failure.find("roller_width"), std::string::npos) << point.failure;
  Parameters wrong = concrete();
  wrong.poisson_ratio = 0.6;
  EXPECT_NE(run(beam(), wrong, Gauge::cmod, Eigen::VectorXd::Constant(1, 1e-5)).failure.find("poisson_ratio"),
            std::string::npos);
}

TEST(NotchedSpecimen, CacheFollowsTheSpecimen) {
  NotchedSpecimenTest t = test_of(coarse(beam()), Gauge::cmod, Eigen::VectorXd::Constant(1, 1e-6));
  const double before = predict(t, concrete(), none(t.gauge), false).values[0];
  t.specimen.notch *= 2.0;
  const double deeper = predict(t, concrete(), none(t.gauge), false).values[0];
  EXPECT_LT(deeper, 0.8 * before);
  t.specimen.notch *= 0.5;
  EXPECT_EQ(predict(t, concrete(), none(t.gauge), false).values[0], before);
}

TEST(NotchedSpecimen, LowCohesionIsWarnedAbout) {
  EXPECT_EQ(mode_one_warning(concrete()), "");
  const std::string text = mode_one_warning(fpz::test::table2());
  EXPECT_NE(text.find("inclined plane"), std::string::npos) << text;
  EXPECT_NE(text.find("cohesion = 2.9e+06"), std::string::npos) << text;
}

}  // namespace
}  // namespace fpz::calibration
