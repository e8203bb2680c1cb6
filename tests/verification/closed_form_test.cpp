// The model against solutions on paper.
#include <gtest/gtest.h>

#include <random>

#include "fpz/cohesive_update.hpp"
#include "fpz/energy.hpp"
#include "fpz/update.hpp"
#include "support/paths.hpp"

namespace fpz::test {
namespace {

Options with(Method method, double tolerance = 1e-10) {
  Options o;
  o.method = method;
  o.tolerance = tolerance;
  return o;
}

/// Mode I traction-separation. The inelastic opening is up = -delta0 log(w), the elastic part t/(w Kn) - t_onset/Kn is
/// constant because tau_n = sigma_t0: u = up, t = sigma_t0 exp(-u/delta0). Exact for backward Euler too.
TEST(ModeOne, TractionSeparationIsExponential) {
  for (const Parameters& p : {table1(4e-3), table3()}) {
    for (const Method method : {Method::implicit, Method::accurate}) {
      const Material<double> m = make_material(p, Setting::plane_strain);
      State2 s;
      const Tensor<double, 2> d = strain2(p.tensile_strength / p.young_modulus / 7.0, 0, 0);
      for (int k = 0; k < 20000 && damage(s) < 0.999; ++k) {
        ASSERT_TRUE(update<2>(m, with(method), s, d, s).ok());
        if (!s.cracked) continue;
        const double u = s.crack.jump[0];
        EXPECT_NEAR(s.crack.traction[0], p.tensile_strength * std::exp(-u / p.delta0), 1e-9 * p.tensile_strength);
        EXPECT_NEAR(s.stress[0], s.crack.traction[0], 1e-9 * p.tensile_strength);
        EXPECT_NEAR(damage(s), 1.0 - std::exp(-u / p.delta0), 1e-9);
      }
      EXPECT_GT(damage(s), 0.999);
    }
  }
}

/// Energy to the opening u_f: sigma_t0 delta0 (1 - exp(-u_f/delta0)). The free energy of the zone falls by D sigma_t0^2
/// / (2 Kn) while t.du is spent, so dissipation is larger by that amount.
TEST(ModeOne, FractureEnergy) {
  const Parameters p = table1(4e-3);
  const Material<double> m = make_material(p, Setting::plane_strain);
  const double energy = p.tensile_strength * p.delta0;
  for (const Method method : {Method::implicit, Method::accurate}) {
    for (const double step : {9e-5, 1e-6}) {
      State2 s;
      const Tensor<double, 2> d = strain2(step, 0, 0);
      for (int k = 0; k * step < 2e-2; ++k) ASSERT_TRUE(update<2>(m, with(method), s, d, s).ok());
      const double open = energy * (1.0 - std::exp(-s.crack.jump[0] / p.delta0));
      EXPECT_NEAR(s.crack.dissipated + free_energy(m.law, s.crack), open, 1e-9 * energy);
      const double spring = 0.5 * p.tensile_strength * p.tensile_strength / p.normal_stiffness;
      EXPECT_NEAR(s.crack.dissipated, open + damage(s) * spring, 1e-9 * energy);
    }
  }
}

/// The same when one update opens the crack completely: the sub-steps must resolve the softening, although the scaled
/// traction does not change at all; and an opening of a metre must not cost a sub-step per delta0.
TEST(ModeOne, FractureEnergyInOneUpdate) {
  const Parameters p = table1(4e-3);
  const CohesiveLaw<double> law = make_cohesive_law(p);
  Vec<double, 2> onset, du;
  onset << p.tensile_strength, 0.0;
  const CohesiveState<double, 2> fresh = cracked_at<double, 2>(law, onset);
  const double energy = p.tensile_strength * p.delta0;
  for (const double opening : {1e-6, 20e-6, 100e-6, 1e-3, 1.0}) {
    du << opening, 0.0;
    CohesiveState<double, 2> s;
    const Report report = cohesive_update<double, 2>(law, {}, fresh, du, s);
    ASSERT_TRUE(report.ok());
    EXPECT_LT(report.substeps, 50);
    EXPECT_NEAR(s.dissipated + free_energy(law, s), energy * -std::expm1(-opening / p.delta0), 1e-13 * energy);
  }
}

/// With compression the traction stays on the Coulomb-like surface |t_s|^2 = (c - t_n tan phi)^2 - (c - s tan phi)^2,
/// and for D -> 1 that is friction: |t_s| = -t_n tan phi, the cohesive part being at most w c0.
TEST(Compression, SlidingFollowsTheSurfaceAndEndsAsFriction) {
  const Parameters p = table1(0.5e-3);
  const Material<double> m = make_material(p, Setting::plane_strain);
  for (const Method method : {Method::implicit, Method::accurate}) {
    State2 s;
    ASSERT_TRUE(update<2>(m, with(method), s, strain2(3e-3, 0, 0), s).ok());  // a crack across x
    ASSERT_TRUE(s.cracked);
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(update<2>(m, with(method), s, strain2(-1e-3, 0, 0), s).ok());
    ASSERT_LT(s.crack.traction[0], -p.cohesion);
    for (int k = 0; k < 3000; ++k) ASSERT_TRUE(update<2>(m, with(method), s, strain2(0, 0, 2e-3), s).ok());
    const double tn = s.crack.traction[0];
    const double ts = std::abs(s.crack.traction[1]);
    const double w = s.crack.integrity;
    const double c = p.cohesion * w - tn * m.law.surface.tan_phi;
    EXPECT_NEAR(ts, std::sqrt(c * c - m.law.surface.apex * m.law.surface.apex * w * w), 1e-9 * p.cohesion);
    // The shear spring of a damaged contact softens with w (eq 46), so that t_s/(w Ks) takes up most of the shear jump
    // and w falls only as the reciprocal of the imposed shear.
    EXPECT_LT(w, 0.03);
    EXPECT_GE(ts, -tn * m.law.surface.tan_phi);
    EXPECT_LE(ts, -tn * m.law.surface.tan_phi + w * p.cohesion);
  }
}

TEST(Elastic, ConstantsOfThePlaneSettings) {
  const Parameters p = table1();
  const double e = p.young_modulus;
  const double nu = p.poisson_ratio;
  const Tensor<double, 2> strain = strain2(3e-4, -2e-4, 1e-4);
  State2 s;
  const Material<double> stress = make_material(p, Setting::plane_stress);
  ASSERT_TRUE(update<2>(stress, Options{}, State2{}, strain, s).ok());
  EXPECT_NEAR(s.stress[0], e / (1 - nu * nu) * (strain[0] + nu * strain[1]), 1e-9 * p.cohesion);
  EXPECT_NEAR(s.stress[1], e / (1 - nu * nu) * (strain[1] + nu * strain[0]), 1e-9 * p.cohesion);
  EXPECT_NEAR(s.stress[2], e / (1 + nu) * strain[2], 1e-9 * p.cohesion);
  EXPECT_EQ(stress_zz(stress, s), 0.0);
  EXPECT_NEAR(strain_zz(stress, s), -nu / (1 - nu) * (strain[0] + strain[1]), 1e-15);
  const Material<double> plane = make_material(p, Setting::plane_strain);
  ASSERT_TRUE(update<2>(plane, Options{}, State2{}, strain, s).ok());
  // Hooke's law inverted: the strain comes back, and the out-of-plane one is zero.
  const double zz = stress_zz(plane, s);
  EXPECT_NEAR((s.stress[0] - nu * (s.stress[1] + zz)) / e, strain[0], 1e-15);
  EXPECT_NEAR((s.stress[1] - nu * (s.stress[0] + zz)) / e, strain[1], 1e-15);
  EXPECT_NEAR(zz - nu * (s.stress[0] + s.stress[1]), 0.0, 1e-9 * p.cohesion);
  EXPECT_NEAR(stored_energy(plane, s), 0.5 * double_dot<2>(s.stress, strain), 1e-12);
}

/// 3-D with eps_zz = 0 is plane strain as long as sigma_zz is the intermediate principal stress at onset.
TEST(ThreeD, ReducesToPlaneStrain) {
  for (const Method method : {Method::implicit, Method::accurate}) {
    for (const Path<2>& path : {mixed_mode(), compressive_shear(), closing()}) {
      const Material<double> m2 = make_material(path.parameters, Setting::plane_strain);
      const Material<double> m3 = make_material(path.parameters, Setting::three_d);
      State2 s2;
      State3 s3;
      for (const Tensor<double, 2>& leg : path.legs) {
        for (int k = 0; k < 60; ++k) {
          const Tensor<double, 2> d = leg / 60.0;
          Options o = with(method, 1e-8);
          ASSERT_TRUE(update<2>(m2, o, s2, d, s2).ok());
          if (s2.cracked) o.preferred_normal.head<2>() = s2.frame.row(0).transpose();
          ASSERT_TRUE(update<3>(m3, o, s3, strain3(d[0], d[1], 0, d[2], 0, 0), s3).ok());
          ASSERT_EQ(s2.cracked, s3.cracked);
          // Twice the tolerance of either integration; implicit solves the same equations to rounding.
          const double tolerance = (method == Method::accurate ? 2e-8 : 1e-10) * path.parameters.tensile_strength;
          ASSERT_NEAR(s3.stress[0], s2.stress[0], tolerance);
          ASSERT_NEAR(s3.stress[1], s2.stress[1], tolerance);
          ASSERT_NEAR(s3.stress[3], s2.stress[2], tolerance);
          ASSERT_NEAR(s3.stress[2], stress_zz(m2, s2), tolerance);
          ASSERT_NEAR(damage(s3), damage(s2), 2e-8);
        }
      }
    }
  }
}

/// Eq 48 as printed and the form the library works with have the same zeros on the physical branch.
TEST(YieldFunction, FormsAgree) {
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Parameters& p : {table1(), table2(), table3()}) {
    const CohesiveLaw<double> law = make_cohesive_law(p);
    for (int i = 0; i < 1000; ++i) {
      const double w = std::pow(10.0, -8.0 * uniform(rng));
      const double ts = 3.0 * p.cohesion * w * uniform(rng);
      const double tn = (law.surface.cohesion * w - std::hypot(ts, law.surface.apex * w)) / law.surface.tan_phi;
      EXPECT_NEAR(law.surface.value_at(tn, ts * ts, w), 0.0, 1e-14 * 10.0 * p.cohesion * w);
      EXPECT_NEAR(law.surface.printed_value(tn, ts * ts, w), 0.0, 1e-13 * 10.0 * p.cohesion * p.cohesion * w * w);
      for (const double off : {-1e-3, 1e-3}) {
        const double moved = tn + off * p.cohesion * w;
        EXPECT_GT(off * law.surface.value_at(moved, ts * ts, w), 0.0);
        EXPECT_GT(off * law.surface.printed_value(moved, ts * ts, w), 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace fpz::test
