// The consistent cohesive zone against what it promises: nothing stored at onset, never less than nothing later, the
// fracture energy of the paper in closed form for any stiffness, no work out of a closed cycle, and friction that
// lasts.
#include <gtest/gtest.h>

#include <random>

#include "fpz/cohesive_update.hpp"
#include "fpz/energy.hpp"
#include "fpz/jump_control.hpp"
#include "fpz/law/softening.hpp"
#include "fpz/onset.hpp"
#include "fpz/update.hpp"
#include "support/paths.hpp"

namespace fpz::test {
namespace {

constexpr Method methods[] = {Method::accurate, Method::implicit};
constexpr double stiffnesses[] = {1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

Options with(Method method, double tolerance = 1e-8) {
  Options o;
  o.method = method;
  o.tolerance = tolerance;
  return o;
}

Parameters consistent(Parameters p, SofteningKind softening = {}) {
  p.choices = {softening, CohesiveZone::consistent};
  return p;
}

Parameters with_stiffness(Parameters p, double k) {
  p.normal_stiffness = p.shear_stiffness = k;
  return p;
}

TEST(ConsistentZone, StartsWithoutJumpOrEnergyAndWithTheTraction) {
  const CohesiveLaw<double> law = make_cohesive_law(consistent(table3()));
  const Vec<double, 2> t(-5e6, 12e6);
  const CohesiveState<double, 2> z = cracked_at<double, 2>(law, t);
  EXPECT_EQ(z.jump.norm(), 0.0);
  EXPECT_EQ(z.traction, t);
  EXPECT_EQ(free_energy(law, z), 0.0);
}

/// kappa and the integral of w over it, in units of delta0, where the integrity has fallen to w: on paper.
struct Fallen {
  double kappa, area;
};
Fallen fallen_to(double w, SofteningKind softening) {
  if (softening == softening_kind<ExponentialSoftening>) return {-std::log(w), 1.0 - w};
  const double first = 0.8 / (2.0 / 3.0);  // d(kappa)/d(-w) of Petersson's lines
  const double second = 2.8 / (1.0 / 3.0);
  if (w > 1.0 / 3.0) return {first * (1.0 - w), 0.5 * first * (1.0 - w * w)};
  return {0.8 + second * (1.0 / 3.0 - w), 0.5 * first * (8.0 / 9.0) + 0.5 * second * (1.0 / 9.0 - w * w)};
}

/// Mode I on paper: t = sigma_t0 w, up = kappa - sigma_t0 (1 - w^2)/(4 Kn), u = up + (1 - w) t/Kn, and G_I = sigma_t0
/// delta0 for any stiffness, softening, integrator and increment, to what is left at the least integrity.
TEST(ConsistentZone, ModeOneIsExact) {
  for (const Word<SofteningKind>& softening : Words<SofteningKind>::list) {
    for (const Method method : methods) {
      for (const double k : stiffnesses) {
        for (const double step : {9e-5, 3e-3, 5e-2}) {
          SCOPED_TRACE(std::string(softening.text) + ", " + to_string(method) + ", K " + std::to_string(k));
          const Parameters p = with_stiffness(consistent(table1(), softening.value), k);
          const double spring = 1.0 / std::max(k, p.tensile_strength / p.delta0);
          const Material<double> m = make_material(p, Setting::plane_strain);
          const double energy = p.tensile_strength * p.delta0;
          State2 s;
          for (int i = 0; i * step < 0.12; ++i) {
            ASSERT_TRUE(update<2>(m, with(method), s, strain2(step, 0, 0), s).ok());
            if (!s.cracked) continue;
            ASSERT_GE(free_energy(m.law, s.crack), 0.0);
            const double w = s.crack.integrity;
            if (w < 1e-8) continue;
            const Fallen on_paper = fallen_to(w, softening.value);
            const double t = p.tensile_strength * w;
            const double up = on_paper.kappa * p.delta0 - 0.25 * spring * p.tensile_strength * (1.0 - w * w);
            ASSERT_NEAR(s.crack.traction[0], t, 1e-9 * p.tensile_strength);
            ASSERT_NEAR(s.crack.plastic_jump[0], up, 1e-6 * p.delta0);
            ASSERT_NEAR(s.crack.jump[0], up + (1.0 - w) * spring * t, 1e-6 * p.delta0);
            ASSERT_NEAR(s.crack.dissipated, energy * on_paper.area, 1e-9 * energy);
          }
          EXPECT_LE(s.crack.integrity, least_integrity);
          EXPECT_NEAR(s.crack.dissipated, energy, 1e-9 * energy);
          EXPECT_LE(free_energy(m.law, s.crack), 1e-15 * energy);
        }
      }
    }
  }
}

/// Mode II without normal traction, on paper: tau stays (0, tau0), tau0^2 = c0^2 - A^2, the flow (m, 1)/(1 + m); the
/// work is tau0 delta0/(1 + m) for any Ks. The drive that keeps t_n = 0 is followed in short chords.
TEST(ConsistentZone, FractureEnergyInModeTwo) {
  for (const double k : stiffnesses) {
    SCOPED_TRACE(k);
    const Parameters p = with_stiffness(consistent(table3()), k);
    const Material<double> m = make_material(p, Setting::plane_strain);
    const double tan_psi = std::tan(p.dilation_angle_deg * degree);
    const double apex = p.cohesion - p.tensile_strength * std::tan(p.friction_angle_deg * degree);
    const double tau = std::sqrt(p.cohesion * p.cohesion - apex * apex);
    const double ratio = tan_psi * p.cohesion / tau;
    const double spring = 1.0 / std::max(k, p.cohesion / p.delta0);
    CohesiveState<double, 2> z = cracked_at<double, 2>(m.law, Vec<double, 2>(0.0, tau));
    Drive<double, 2> way{Vec<double, 2>(0.0, m.series.shear * tau), {}};
    const int parts = 20000;
    for (int i = 1; i <= parts; ++i) {
      const double w = std::exp(-15.0 * i / parts);
      const double kappa = -p.delta0 * std::log(w);
      const double up = kappa / (1.0 + ratio) - 0.25 * spring * tau * (1.0 - w * w);
      way.to = Vec<double, 2>(kappa * ratio / (1.0 + ratio), up + (m.series.shear + (1.0 - w) * spring) * w * tau);
      ASSERT_TRUE(integrate_cohesive(Zone(m.law, m.series), with(Method::accurate), z, way, z).ok());
      ASSERT_NEAR(z.traction[0], 0.0, 1e-3 * p.tensile_strength);
      way.from = way.to;
    }
    const double energy = tau * p.delta0 / (1.0 + ratio);
    EXPECT_NEAR(z.dissipated, energy, 1e-5 * energy);
    EXPECT_NEAR(z.slip, 15.0 * p.delta0 / (1.0 + ratio), 1e-5 * 15.0 * p.delta0);
  }
}

/// Sliding 1000 delta0 under pressure, in few updates and sub-steps: the friction that is left is tan(phi) exactly.
/// Turned round, the faces stick: the traction falls with Ks in series with the bulk, over 2 tan(phi) t_n, and slides
/// back.
TEST(ConsistentZone, FrictionLastsAndStartsAgain) {
  for (const Word<SofteningKind>& softening : Words<SofteningKind>::list) {
    for (const Method method : methods) {
      SCOPED_TRACE(std::string(softening.text) + ", " + to_string(method));
      const Parameters p = consistent(table3(), softening.value);
      const Material<double> m = make_material(p, Setting::plane_strain);
      const Zone zone(m.law, m.series);
      const double pressure = 20e6;
      const double friction = pressure * m.law.surface.tan_phi;
      // A soft spring holds the normal traction: dilation moves it by less than a thousandth.
      const SeriesCompliance<double> soft{1e-2 / pressure, m.series.shear};
      const Zone held(m.law, soft);
      const double onset = std::sqrt(std::pow(p.cohesion + friction, 2) - std::pow(m.law.surface.apex, 2));
      CohesiveState<double, 2> z = cracked_at<double, 2>(m.law, Vec<double, 2>(-pressure, onset));
      Drive<double, 2> way{Vec<double, 2>(-soft.normal * pressure, soft.shear * onset), {}};
      const auto slide = [&](double by) {
        way.to = way.from + Vec<double, 2>(0.0, by);
        const Report r = integrate_cohesive(held, with(method, 1e-6), z, way, z);
        way.from = way.to;
        return r;
      };
      int substeps = 0;
      for (int k = 0; k < 10; ++k) {
        const Report r = slide(100.0 * p.delta0);
        ASSERT_EQ(r.status, Status::ok);
        substeps += r.substeps;
      }
      EXPECT_LE(substeps, 1500);
      EXPECT_EQ(z.integrity, least_integrity);
      const double slipped = z.slip;
      EXPECT_GT(slipped, 900.0 * p.delta0);
      EXPECT_NEAR(z.traction[1], -z.traction[0] * m.law.surface.tan_phi, 1e-8 * friction);
      EXPECT_NEAR(-z.traction[0], pressure, 0.01 * pressure);
      // Back: elastic first.
      const double series = soft.shear + 1.0 / m.law.ks;
      const double before = z.traction[1];
      ASSERT_EQ(slide(-0.5 * before * series).status, Status::ok);
      EXPECT_NEAR(z.traction[1], 0.5 * before, 1e-6 * friction);
      EXPECT_EQ(z.slip, slipped);
      ASSERT_EQ(slide(-10.0 * before * series).status, Status::ok);
      EXPECT_NEAR(z.traction[1], z.traction[0] * m.law.surface.tan_phi, 1e-8 * friction);
      EXPECT_GT(z.slip, slipped);
    }
  }
}

/// Opened to nothing, then closed: contact begins where the plastic jump is, is as stiff as Kn and the bulk, and
/// carries friction.
TEST(ConsistentZone, ContactAfterOpening) {
  for (const Method method : methods) {
    const Parameters p = consistent(table1(1e-3));
    const Material<double> m = make_material(p, Setting::plane_strain);
    State2 s;
    ASSERT_TRUE(update<2>(m, with(method), s, strain2(0.6, 0, 0), s).ok());
    ASSERT_EQ(s.crack.integrity, least_integrity);
    const double up = s.crack.plastic_jump[0];
    const double modulus = m.bulk.lambda + 2.0 * m.bulk.mu;
    const double closed = up - 5e6 * (1.0 / m.law.kn + p.rve_length / modulus);
    ASSERT_TRUE(update<2>(m, with(method), s, strain2(closed / p.rve_length - s.strain[0], 0, 0), s).ok());
    EXPECT_NEAR(s.crack.traction[0], -5e6, 1.0);
    EXPECT_NEAR(s.crack.jump[0] - up, -5e6 / m.law.kn, 1e-9 * p.delta0);
    ASSERT_TRUE(update<2>(m, with(method), s, strain2(0, 0, 0.1), s).ok());
    EXPECT_NEAR(std::abs(s.crack.traction[1]), -s.crack.traction[0] * m.law.surface.tan_phi, 1e-6 * p.cohesion);
  }
}

/// A zone softer than the secant of its curve would snap back by itself: the stiffness in use is never below.
TEST(ConsistentZone, SoftStiffnessesAreRaised) {
  Parameters p = consistent(table3());
  p.normal_stiffness = 1e10;
  p.shear_stiffness = 1e10;
  const UnloadingStiffness<double> k = unloading_stiffness(p);
  EXPECT_DOUBLE_EQ(k.normal, p.tensile_strength / p.delta0);
  EXPECT_DOUBLE_EQ(k.shear, p.cohesion / p.delta0);
  p.choices.cohesive_zone = CohesiveZone::published;
  EXPECT_EQ(unloading_stiffness(p).normal, 1e10);
  EXPECT_EQ(unloading_stiffness(p).shear, 1e10);
}

/// 500 J/m2 against G = 30.6 in the marble of Table 3: the published zone's preload.
TEST(PublishedZone, PreloadOverFractureEnergy) {
  const Parameters p = table3();
  const OnsetPreload preload = onset_preload(p);
  double largest = 0.0;
  const double tan_phi = std::tan(p.friction_angle_deg * degree);
  const double apex = p.cohesion - p.tensile_strength * tan_phi;
  for (int k = 0; k <= 1000; ++k) {
    const double n = -p.cohesion + (p.cohesion + p.tensile_strength) * k / 1000.0;
    const double s2 = std::pow(p.cohesion - n * tan_phi, 2) - apex * apex;
    largest = std::max(largest, 0.5 * (n * n / p.normal_stiffness + s2 / p.shear_stiffness));
  }
  EXPECT_NEAR(preload.ratio, largest / (p.tensile_strength * p.delta0), 1e-12 * preload.ratio);
  EXPECT_GT(preload.ratio, 30.0);
  EXPECT_EQ(preload.stiffness, p.shear_stiffness);
  EXPECT_EQ(onset_preload(consistent(p)).ratio, 0.0);
}

/// Mode I just below and above the snap-back length, for stiff and soft springs and both softening laws.
TEST(ConsistentZone, SnapBackLengthIsSharp) {
  for (const Word<SofteningKind>& softening : Words<SofteningKind>::list) {
    for (const double k : {3.4e10, 1e11, 1e15}) {
      for (const double factor : {0.999, 1.001}) {
        SCOPED_TRACE(std::string(softening.text) + ", K " + std::to_string(k) + ", " + std::to_string(factor));
        Parameters p = with_stiffness(consistent(table1(), softening.value), k);
        p.rve_length = factor * snap_back_length(p, Setting::plane_strain);
        const Material<double> m = make_material(p, Setting::plane_strain);
        State2 s;
        Status status = Status::ok;
        for (int i = 0; i < 3000 && status == Status::ok; ++i) {
          status = update<2>(m, with(Method::accurate), s, strain2(2e-2 / 3000, 0, 0), s).status;
        }
        EXPECT_EQ(status, factor < 1.0 ? Status::ok : Status::snap_back);
      }
    }
  }
}

/// On paper for the exponential law, with L = delta0/sigma_t0 and F = 1/Kn: (lambda + 2 mu) (L + F/2), or (sqrt(6 F L)
/// - F) where F > 2 L/3.
TEST(ConsistentZone, SnapBackLengthInClosedForm) {
  for (const double k : stiffnesses) {
    const Parameters p = with_stiffness(consistent(table1()), k);
    const double modulus = p.young_modulus * 0.75 / (1.25 * 0.5);
    const double length = p.delta0 / p.tensile_strength;
    const double spring = 1.0 / unloading_stiffness(p).normal;
    const double b = spring > 2.0 / 3.0 * length ? std::sqrt(6.0 * spring * length) - spring : length + 0.5 * spring;
    EXPECT_NEAR(snap_back_length(p, Setting::plane_strain), modulus * b, 1e-9 * modulus * b);
  }
}

TEST(ConsistentZone, PaperRefuses) {
  const Material<double> m = make_material(consistent(table1()), Setting::plane_strain);
  State2 s;
  EXPECT_EQ(update<2>(m, with(Method::paper), s, strain2(2e-3, 0, 0), s).status, Status::invalid_input);
  EXPECT_FALSE(why_unfit(Method::paper, {{}, CohesiveZone::consistent}).empty());
  EXPECT_TRUE(why_unfit(Method::paper, {{}, CohesiveZone::published}).empty());
  EXPECT_TRUE(why_unfit(Method::accurate, {{}, CohesiveZone::consistent}).empty());
}

/// Jump control agrees with strain control, in friction and in tension.
TEST(ConsistentZone, JumpControlAgreesWithStrainControl) {
  const Material<double> m = make_material(consistent(table1(1e-3)), Setting::plane_strain);
  const Tensor<double, 2> ways[][2] = {{strain2(3e-3, 0, 0), strain2(1, -0.2, 3)},
                                       {strain2(-2e-3, 0, 0), strain2(0, 0, 1)}};
  for (const auto& way : ways) {
    State2 s;
    ASSERT_TRUE(update<2>(m, with(Method::accurate, 1e-9), s, way[0], s).ok());
    for (const double step : {1e-7, 1e-6, 5e-6, 2e-5}) {
      double load = 0.0;
      State2 controlled, strained;
      ASSERT_TRUE(update_controlled<2>(m, with(Method::accurate, 1e-9), s, way[1], step, controlled, load).ok());
      const Tensor<double, 2> d = way[1] * (load / way[1].lpNorm<Eigen::Infinity>());
      ASSERT_TRUE(update<2>(m, with(Method::accurate, 1e-9), s, d, strained).ok());
      EXPECT_LE((strained.stress - controlled.stress).norm(), 1e-7 * m.law.surface.tensile_strength);
      EXPECT_NEAR(damage(strained), damage(controlled), 1e-8);
      s = controlled;
    }
  }
}

}  // namespace
}  // namespace fpz::test
