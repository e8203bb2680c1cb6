// The softening laws other than the exponential one in whole updates: closed forms in pure opening through kinks to
// full separation, derivatives across a kink, jump control across it.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "fpz/cohesive_update.hpp"
#include "fpz/energy.hpp"
#include "fpz/jump_control.hpp"
#include "fpz/tangent.hpp"
#include "fpz/update.hpp"
#include "fpz/update_any_scalar.hpp"
#include "support/paths.hpp"

namespace fpz::test {
namespace {

Parameters bilinear(double rve_length = 4e-3) { return table1_with(*from_word<SofteningKind>("bilinear"), rve_length); }

/// Petersson's curve by hand: w over the opening in units of delta0.
double petersson(double x) {
  if (x < 0.8) return 1.0 - x * (2.0 / 3.0) / 0.8;
  if (x < 3.6) return (3.6 - x) / 2.8 / 3.0;
  return 0.0;
}
/// Area under it up to x.
double petersson_area(double x) {
  const double first = std::min(x, 0.8);
  double area = 0.5 * (1.0 + petersson(first)) * first;
  if (x > 0.8) area += 0.5 * (1.0 / 3.0 + petersson(x)) * (std::min(x, 3.6) - 0.8);
  return area;
}

/// Pure opening of the zone alone: t = sigma_t0 w(u), energy sigma_t0 times the area, in any steps, to full separation.
TEST(Bilinear, PureOpeningIsPeterssonsCurve) {
  const Parameters p = bilinear();
  const CohesiveLaw<double> law = make_cohesive_law(p);
  const double spring = p.tensile_strength * p.tensile_strength / (2.0 * p.normal_stiffness);  // Y, given back with D
  for (const Method method : {Method::implicit, Method::accurate}) {
    for (const double step : {0.05, 0.31, 1.7, 5.0}) {
      SCOPED_TRACE(std::string(to_string(method)) + ", steps of " + std::to_string(step) + " delta0");
      Options o;
      o.method = method;
      CohesiveState<double, 2> z = cracked_at<double, 2>(law, Vec<double, 2>(p.tensile_strength, 0.0));
      for (double x = 0.0; x < 5.0; x += step) {
        ASSERT_TRUE(cohesive_update(law, o, z, Vec<double, 2>(step * p.delta0, 0.0), z).ok());
        const double u = x + step;
        EXPECT_NEAR(z.traction[0] / p.tensile_strength, petersson(u), 1e-12);
        EXPECT_NEAR(z.integrity, petersson(u), 1e-12);
        const double energy = p.tensile_strength * p.delta0 * petersson_area(u) + spring * (1.0 - petersson(u));
        EXPECT_NEAR(z.dissipated, energy, 1e-12 * energy);
      }
      EXPECT_EQ(z.integrity, 0.0);
      EXPECT_NEAR(z.dissipated - spring, p.tensile_strength * p.delta0, 1e-12 * p.tensile_strength * p.delta0);
    }
  }
}

/// After full separation: free in tension and shear, contact where it closes.
TEST(Bilinear, SeparatedZoneOnlyTouches) {
  const Parameters p = bilinear();
  const CohesiveLaw<double> law = make_cohesive_law(p);
  for (const Method method : {Method::implicit, Method::accurate}) {
    Options o;
    o.method = method;
    CohesiveState<double, 2> z = cracked_at<double, 2>(law, Vec<double, 2>(p.tensile_strength, 0.0));
    ASSERT_TRUE(cohesive_update(law, o, z, Vec<double, 2>(5.0 * p.delta0, 0.0), z).ok());
    ASSERT_TRUE(cohesive_update(law, o, z, Vec<double, 2>(p.delta0, 3.0 * p.delta0), z).ok());
    EXPECT_EQ(z.traction, (Vec<double, 2>(0.0, 0.0)));
    const double gap = z.plastic_jump[0] - z.offset[0];
    Vec<double, 2> close(gap - z.jump[0] - 2.0 * p.tensile_strength / p.normal_stiffness, 0.0);
    ASSERT_TRUE(cohesive_update(law, o, z, close, z).ok());
    EXPECT_NEAR(z.traction[0], -2.0 * p.tensile_strength, 1e-6 * p.tensile_strength);
    EXPECT_EQ(z.traction[1], 0.0);
  }
}

TEST(Bilinear, FractureEnergyAndSnapBackLength) {
  const Parameters p = bilinear();
  const double modulus = p.young_modulus * 0.75 / (1.25 * 0.5);
  EXPECT_NEAR(snap_back_length(p, Setting::plane_strain), modulus * 1.2 * p.delta0 / p.tensile_strength, 1e-15);
  // On either side of it: with a little less than that length an opening goes on, with a little more it snaps back.
  for (const Method method : {Method::implicit, Method::accurate}) {
    Options o;
    o.method = method;
    for (const double factor : {0.999, 1.001}) {
      Parameters q = p;
      q.rve_length = factor * snap_back_length(p, Setting::plane_strain);
      const Material<double> m = make_material(q, Setting::plane_strain);
      State2 s;
      const Report r = update<2>(m, o, s, strain2(1.3 * p.tensile_strength / modulus, 0, 0), s);
      EXPECT_EQ(r.status, factor < 1.0 ? Status::ok : Status::snap_back);
    }
  }
}

/// Tangents of single updates that end before, beyond and after jumping over both kinks, against central differences
/// and against ceres::Jet.
TEST(Bilinear, TangentsAcrossTheKink) {
  const Material<double> m = make_material(bilinear(1e-3), Setting::plane_strain);
  for (const Method method : {Method::implicit, Method::accurate}) {
    Options o;
    o.method = method;
    o.tolerance = 1e-10;
    int kinks_crossed = 0;
    for (const double size : {0.3, 0.9, 1.6, 3.0, 8.0}) {
      const double x = size * m.law.softening.length() / m.rve_length;
      const Tensor<double, 2> d = strain2(x, 0.1 * x, 0.4 * x);
      const Tensor<double, 2> first = strain2(2e-3, 0.0, 3e-4);
      State2 begin, end;
      ASSERT_TRUE(update<2>(m, o, begin, first, begin).ok());
      ASSERT_TRUE(begin.cracked);
      Tangent<2> tangent;
      ASSERT_TRUE(update_with_tangent<2>(m, o, begin, d, end, tangent).ok());
      kinks_crossed += m.law.softening.piece(end.crack.integrity) - m.law.softening.piece(begin.crack.integrity);
      const double scale = 2.0 * m.bulk.mu + m.bulk.lambda;
      using Jet = ceres::Jet<double, 3>;
      State<Jet, 2> begin_jet, end_jet;
      begin_jet.strain = convert<Jet>(begin.strain);
      begin_jet.stress = convert<Jet>(begin.stress);
      begin_jet.frame = convert<Jet>(begin.frame);
      begin_jet.crack = lift<Jet>(begin.crack);
      begin_jet.cracked = true;
      Tensor<Jet, 2> d_jet;
      for (int k = 0; k < 3; ++k) d_jet[k] = Jet(d[k], k);
      ASSERT_TRUE(update<2>(m, o, begin_jet, d_jet, end_jet).ok());
      for (int k = 0; k < 3; ++k) {
        const double h = 1e-5 * x;
        State2 up, down;
        Tensor<double, 2> d_up = d;
        Tensor<double, 2> d_down = d;
        d_up[k] += h;
        d_down[k] -= h;
        ASSERT_TRUE(update<2>(m, o, begin, d_up, up).ok());
        ASSERT_TRUE(update<2>(m, o, begin, d_down, down).ok());
        for (int i = 0; i < 3; ++i) {
          EXPECT_NEAR(tangent(i, k), (up.stress[i] - down.stress[i]) / (2.0 * h), 2e-5 * scale) << size;
          EXPECT_NEAR(tangent(i, k), end_jet.stress[i].v[k], 1e-9 * scale) << size;
        }
      }
    }
    EXPECT_GE(kinks_crossed, 4);
  }
}

/// Jump control goes over the kinks where strain control snaps back, and its energy is exact there too.
TEST(Bilinear, JumpControlBeyondSnapBack) {
  Parameters p = bilinear();
  p.rve_length = 3.0 * snap_back_length(p, Setting::plane_strain);
  const Material<double> m = make_material(p, Setting::plane_strain);
  Options o;
  State2 s;
  double kappa = 0.0;
  double factor = 0.0;
  bool turned = false;
  for (int k = 0; k < 30; ++k) {
    ASSERT_TRUE(update_controlled<2>(m, o, s, strain2(1, 0, 0), 0.17 * p.delta0, s, factor).ok());
    kappa += 0.17;
    turned = turned || (k > 0 && factor < 0.0);
    EXPECT_NEAR(s.stress[0] / p.tensile_strength, petersson(kappa), 1e-6);
    EXPECT_NEAR(s.crack.integrity, petersson(kappa), 1e-6);
  }
  EXPECT_TRUE(turned);
  EXPECT_GT(kappa, 3.6);
  const double spring = p.tensile_strength * p.tensile_strength / (2.0 * p.normal_stiffness);
  EXPECT_NEAR(s.crack.dissipated, p.tensile_strength * p.delta0 + spring, 1e-6 * p.tensile_strength * p.delta0);
}

/// `paper` has no way to the end of the law: it says so.
TEST(Bilinear, PaperFailsAtFullSeparationWithAStatus) {
  const Parameters p = bilinear(1e-3);
  const Material<double> m = make_material(p, Setting::plane_strain);
  Options o;
  State2 s;
  ASSERT_TRUE(update<2>(m, o, s, strain2(2e-3, 0, 0), s).ok());
  o.method = Method::paper;
  o.tolerance = 1e-4;
  Status status = Status::ok;
  for (int k = 0; k < 4000000 && status == Status::ok; ++k) {
    const State2 before = s;
    status = update<2>(m, o, before, strain2(1e-7, 0, 0), s).status;
    if (status == Status::ok) {
      ASSERT_GT(s.crack.integrity, 0.0);
    } else {
      EXPECT_EQ(s.crack.integrity, before.crack.integrity);
    }
    if (s.crack.jump[0] > 4.0 * p.delta0) break;
  }
  EXPECT_EQ(status, Status::non_convergence);
  EXPECT_LT(s.crack.integrity, 0.5);
}

}  // namespace
}  // namespace fpz::test
