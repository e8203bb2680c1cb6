#include "fpz/cohesive_update.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/materials.hpp"

namespace fpz::test {
namespace {

/// Opening to `u` in one step from a mode I onset, with 1, 2 or 3 traction components.
template <int Dim>
CohesiveState<double, Dim> open_to(Method method, double u, double& stiffness) {
  const Parameters p = table1();
  const CohesiveLaw<double> law = make_cohesive_law(p);
  Options o;
  o.method = method;
  o.tolerance = 1e-10;
  Vec<double, Dim> t0 = Vec<double, Dim>::Zero();
  t0[0] = p.tensile_strength;
  CohesiveState<double, Dim> z = cracked_at<double, Dim>(law, t0);
  Vec<double, Dim> du = Vec<double, Dim>::Zero();
  du[0] = u;
  Mat<double, Dim, Dim> k;
  EXPECT_EQ(cohesive_update(law, o, z, du, z, &k).status, Status::ok);
  stiffness = k(0, 0);
  return z;
}

TEST(CohesiveLaw, OneTwoOrThreeTractionComponents) {
  const Parameters p = table1();
  for (const Method method : {Method::implicit, Method::accurate}) {
    for (const double u : {1e-8, 5e-6, 4e-5, 1e-3}) {
      const double exact = p.tensile_strength * std::exp(-u / p.delta0);
      double k[3];
      const auto one = open_to<1>(method, u, k[0]);
      const auto two = open_to<2>(method, u, k[1]);
      const auto three = open_to<3>(method, u, k[2]);
      for (const double t : {one.traction[0], two.traction[0], three.traction[0]}) {
        EXPECT_NEAR(t, exact, 1e-9 * p.tensile_strength);
      }
      for (const double slope : k) EXPECT_NEAR(slope, -exact / p.delta0, 1e-8 * p.tensile_strength / p.delta0);
    }
  }
}

/// The printed Algorithm 1 returns once; far outside the surface its result is refused, not returned.
TEST(CohesiveLaw, PaperReturnRefusesWhatLandsOffTheSurface) {
  const Parameters p = table1();
  const CohesiveLaw<double> law = make_cohesive_law(p);
  Options o;
  o.method = Method::paper;
  Vec<double, 2> t0, du;
  t0 << p.tensile_strength, 0.0;
  const CohesiveState<double, 2> begin = cracked_at<double, 2>(law, t0);
  CohesiveState<double, 2> end = begin;
  for (const double u : {1e-10, 1e-9}) {
    du << u, 0.0;
    ASSERT_EQ(cohesive_update(law, o, begin, du, end).status, Status::ok);
    EXPECT_NEAR(end.traction[0], p.tensile_strength * std::exp(-u / p.delta0), 0.02 * p.tensile_strength);
  }
  for (const double u : {1e-7, 1e-6, 5e-5}) {
    du << u, 0.0;
    end = begin;
    EXPECT_EQ(cohesive_update(law, o, begin, du, end).status, Status::non_convergence);
    EXPECT_EQ(end.traction, begin.traction);
  }
}

/// An increment that ends exactly on the surface is elastic: traction and tangent.
TEST(CohesiveLaw, TouchingTheSurfaceIsElastic) {
  const Parameters p = table1();
  const CohesiveLaw<double> law = make_cohesive_law(p);
  for (const Method method : {Method::implicit, Method::accurate}) {
    Options o;
    o.method = method;
    Vec<double, 2> t0, du;
    t0 << p.tensile_strength, 0.0;
    CohesiveState<double, 2> z = cracked_at<double, 2>(law, t0);
    du << 8e-6, 0.0;
    ASSERT_TRUE(cohesive_update(law, o, z, du, z).ok());
    const CohesiveState<double, 2> on_surface = z;
    du << -2e-8, 0.0;
    ASSERT_TRUE(cohesive_update(law, o, z, du, z).ok());
    Mat<double, 2, 2> k;
    ASSERT_TRUE(cohesive_update(law, o, z, Vec<double, 2>(-du), z, &k).ok());
    EXPECT_NEAR(z.traction[0], on_surface.traction[0], 1e-8 * p.tensile_strength);
    EXPECT_NEAR(z.integrity, on_surface.integrity, 1e-12);
    EXPECT_NEAR(k(0, 0), on_surface.integrity * p.normal_stiffness, 1e-9 * p.normal_stiffness);
  }
}

/// The hyperbola under another name: the integrators know it by its members only.
struct OtherSurface : HyperbolicSurface<double> {
  [[nodiscard]] static OtherSurface make(const Parameters& p) { return {HyperbolicSurface<double>::make(p)}; }
};

/// Surface and softening are values: given statically, without the choice at run time and without the coordinates that
/// `implicit` has for the hyperbola, they give the same.
TEST(CohesiveUpdate, LawsAreValues) {
  const Parameters p = table1();
  using Static = CohesiveLaw<double, OtherSurface, ExponentialSoftening<double>>;
  const Static general = Static::make(p);
  const CohesiveLaw<double> law = make_cohesive_law(p);
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Method method : {Method::accurate, Method::implicit}) {
    Options o;
    o.method = method;
    CohesiveState<double, 3> a = cracked_at<double, 3>(law, Vec<double, 3>(p.tensile_strength, 0.0, 0.0));
    CohesiveState<double, 3> b = a;
    for (int k = 0; k < 400; ++k) {
      const double size = 0.05 * p.delta0;
      const Vec<double, 3> du(size * (0.3 + uniform(rng)), size * uniform(rng), size * uniform(rng));
      ASSERT_TRUE(cohesive_update(law, o, a, du, a).ok());
      ASSERT_TRUE(cohesive_update(general, o, b, du, b).ok());
      const double tolerance = method == Method::accurate ? 0.0 : 1e-9;
      ASSERT_LE((a.traction - b.traction).norm(), tolerance * p.tensile_strength) << k;
      ASSERT_NEAR(a.integrity, b.integrity, tolerance);
      ASSERT_NEAR(a.dissipated, b.dissipated, tolerance * p.tensile_strength * p.delta0);
    }
    EXPECT_LT(a.integrity, 0.1);
  }
}

}  // namespace
}  // namespace fpz::test
