#include "fpz/calibration/traction_separation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "differences.hpp"
#include "fpz/calibration/fracture_energy.hpp"
#include "fpz/cohesive_update.hpp"
#include "support/materials.hpp"

namespace fpz::calibration {
namespace {

std::vector<Parameters> tables() { return {test::table1(), test::table2(), test::table3()}; }

ZoneRow at_jump(double normal, double shear) {
  ZoneRow r;
  r.shear_jump = shear;
  r.normal_jump = normal;
  return r;
}

ZoneRow at_traction(double normal, double shear) {
  ZoneRow r;
  r.shear_jump = shear;
  r.normal_traction = normal;
  return r;
}

void observe(TractionSeparationTest& t, ZoneQuantity q) {
  for (int k = 0; k < static_cast<int>(t.rows.size()); ++k) t.points.push_back({k, q});
}

/// A shear box: constant normal traction, slip forward to `far`, back by `back`, forward again beyond.
TractionSeparationTest shear_box(double traction, double far, double back, int per_leg) {
  TractionSeparationTest t;
  const double ends[] = {far, far - back, 1.3 * far};
  double from = 0.0;
  t.rows.push_back(at_traction(traction, 0.0));
  for (const double to : ends) {
    for (int k = 1; k <= per_leg; ++k) t.rows.push_back(at_traction(traction, from + (to - from) * k / per_leg));
    from = to;
  }
  observe(t, ZoneQuantity::shear_traction);
  observe(t, ZoneQuantity::normal_jump);
  return t;
}

TractionSeparationTest mixed() {
  TractionSeparationTest t;
  t.rows = {at_jump(1e-6, 2e-6),  at_jump(4e-6, 6e-6),  at_jump(3.9e-6, 5e-6),
            at_jump(6e-6, 14e-6), at_jump(2e-6, 14e-6), at_jump(9e-6, 9e-6)};
  observe(t, ZoneQuantity::normal_traction);
  observe(t, ZoneQuantity::shear_traction);
  return t;
}

TEST(TractionSeparation, PureOpeningIsExponentialWithSecantUnloading) {
  for (const Parameters& p : tables()) {
    TractionSeparationTest t;
    t.rows = {at_jump(0.0, 0.0), at_jump(5e-6, 0.0), at_jump(20e-6, 0.0), at_jump(20e-6 - 1e-9, 0.0),
              at_jump(30e-6, 0.0)};
    observe(t, ZoneQuantity::normal_traction);
    const Prediction x = predict(t, p, false);
    ASSERT_TRUE(x.ok()) << x.failure;
    const auto envelope = [&](double u) { return p.tensile_strength * std::exp(-u / p.delta0); };
    for (const int k : {0, 1, 2, 4}) {
      EXPECT_NEAR(x.values[k], envelope(*t.rows[static_cast<std::size_t>(k)].normal_jump), 1e-12 * p.tensile_strength);
    }
    const double slope = p.normal_stiffness * std::exp(-20e-6 / p.delta0);
    EXPECT_NEAR(x.values[3], envelope(20e-6) - slope * 1e-9, 1e-9 * p.tensile_strength);
  }
}

TEST(TractionSeparation, ShearWithoutNormalTractionIsExponentialAndDilatesAtAConstantRate) {
  for (const Parameters& p : tables()) {
    const CohesiveLaw<double> law = make_cohesive_law(p);
    const double tau0 = std::sqrt(law.surface.cohesion * law.surface.cohesion - law.surface.apex * law.surface.apex);
    const double m = law.surface.tan_psi * law.surface.cohesion / tau0;
    for (const double sign : {1.0, -1.0}) {
      TractionSeparationTest t;
      for (int k = 0; k <= 10; ++k) t.rows.push_back(at_traction(0.0, sign * k * 3e-6));
      observe(t, ZoneQuantity::shear_traction);
      observe(t, ZoneQuantity::normal_jump);
      const Prediction x = predict(t, p, false);
      ASSERT_TRUE(x.ok()) << x.failure;
      for (int k = 0; k <= 10; ++k) {
        const double u = k * 3e-6;
        EXPECT_NEAR(x.values[k], sign * tau0 * std::exp(-(1.0 + m) * u / p.delta0), 1e-7 * tau0) << k;
        EXPECT_NEAR(x.values[k + 11], m * u, 1e-7 * p.delta0) << k;
      }
    }
  }
}

/// Work of a curve under constant normal traction against the quadrature, which shares nothing with it.
TEST(TractionSeparation, ShearBoxSpendsTheWorkOfFracture) {
  for (const Parameters& p : tables()) {
    const double normal = -0.7 * p.cohesion;
    const double end = 1.5 * p.delta0;
    const int n = 600;
    TractionSeparationTest t;
    for (int k = 0; k <= n; ++k) t.rows.push_back(at_traction(normal, end * k / n));
    observe(t, ZoneQuantity::shear_traction);
    observe(t, ZoneQuantity::normal_jump);
    const Prediction x = predict(t, p, false);
    ASSERT_TRUE(x.ok()) << x.failure;
    double work = normal * x.values[2 * n + 1];
    for (int k = 0; k <= n; ++k) work += x.values[k] * (k % n == 0 ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0)) * end / n / 3.0;
    FractureEnergyTest whole;
    whole.path = FracturePath::shear_at_normal_traction;
    whole.normal_traction = normal;
    whole.end = end;
    const double expected = predict(whole, p, false).values[0];
    EXPECT_NEAR(work, expected, 2e-7 * expected);
  }
}

TEST(TractionSeparation, RowsInBetweenDoNotChangeTheCurve) {
  for (const Parameters& p : tables()) {
    for (const double normal : {-2.0 * p.cohesion, -0.05 * p.cohesion, 0.0}) {
      for (const bool elastic : {false, true}) {
        TractionSeparationTest coarse = shear_box(normal, 15e-6, 6e-6, 4);
        TractionSeparationTest fine = shear_box(normal, 15e-6, 6e-6, 32);
        coarse.elastic_before_onset = fine.elastic_before_onset = elastic;
        const Prediction a = predict(coarse, p, false);
        const Prediction b = predict(fine, p, false);
        ASSERT_TRUE(a.ok() && b.ok()) << a.failure << b.failure;
        for (int k = 0; k < 13; ++k) {
          EXPECT_NEAR(a.values[k], b.values[8 * k], 2e-5 * p.cohesion) << k << " " << normal << " " << elastic;
          EXPECT_NEAR(a.values[13 + k], b.values[97 + 8 * k], 2e-5 * p.delta0) << k << " " << normal << " " << elastic;
        }
      }
    }
  }
}

TEST(TractionSeparation, ElasticRiseFollowsTheSprings) {
  const Parameters p = test::table1();
  TractionSeparationTest t;
  t.elastic_before_onset = true;
  t.rows = {at_traction(-0.5e6, 0.0), at_traction(-0.5e6, 4e-6), at_traction(-0.5e6, 2e-6)};
  observe(t, ZoneQuantity::shear_traction);
  observe(t, ZoneQuantity::normal_jump);
  observe(t, ZoneQuantity::normal_traction);
  const Prediction x = predict(t, p, false);
  ASSERT_TRUE(x.ok()) << x.failure;
  EXPECT_NEAR(x.values[1], 4e-6 * p.shear_stiffness, 1e-9);
  EXPECT_NEAR(x.values[2], 2e-6 * p.shear_stiffness, 1e-9);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(x.values[3 + k], 0.0, 1e-18);
    EXPECT_NEAR(x.values[6 + k], -0.5e6, 1e-6);
  }
}

TEST(TractionSeparation, ElasticAndRigidCurvesDifferByTheSprings) {
  // In pure opening the traction is the same when the elastic opening sigma_t0/Kn is taken off.
  const Parameters p = test::table1();
  TractionSeparationTest rigid, elastic;
  elastic.elastic_before_onset = true;
  for (const double u : {1e-6, 10e-6, 40e-6}) {
    rigid.rows.push_back(at_jump(u, 0.0));
    elastic.rows.push_back(at_jump(u + p.tensile_strength / p.normal_stiffness, 0.0));
  }
  observe(rigid, ZoneQuantity::normal_traction);
  observe(elastic, ZoneQuantity::normal_traction);
  const Prediction a = predict(rigid, p, false);
  const Prediction b = predict(elastic, p, false);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_LT((a.values - b.values).lpNorm<Eigen::Infinity>(), 1e-11 * p.tensile_strength);
}

TEST(TractionSeparation, Derivatives) {
  for (const Parameters& p : tables()) {
    for (const bool elastic : {false, true}) {
      std::vector<TractionSeparationTest> all = {mixed(), shear_box(-0.6e6, 15e-6, 6e-6, 3),
                                                 shear_box(0.0, 15e-6, 6e-6, 3)};
      for (TractionSeparationTest& t : all) {
        t.elastic_before_onset = elastic;
        t.tolerance = 1e-12;
        expect_derivatives([&](const Parameters& q, bool d) { return predict(t, q, d); }, p, 5e-4, 1e-6, 1e-8);
      }
    }
  }
}

TEST(TractionSeparation, Failures) {
  const Parameters p = test::table1();
  const auto why = [&](std::vector<ZoneRow> rows) {
    TractionSeparationTest t;
    t.rows = std::move(rows);
    observe(t, ZoneQuantity::shear_traction);
    return predict(t, p, true).failure;
  };
  EXPECT_NE(why({}).find("no rows"), std::string::npos);
  EXPECT_NE(why({ZoneRow{}}).find("either the normal jump"), std::string::npos);
  EXPECT_NE(why({at_jump(std::nan(""), 0.0)}).find("finite"), std::string::npos);
  EXPECT_NE(why({at_jump(0.0, 0.0)}).find("direction"), std::string::npos);
  EXPECT_NE(why({at_jump(-1e-6, 0.0)}).find("no onset"), std::string::npos);
  EXPECT_NE(why({at_traction(0.6e6, 1e-6)}).find("tensile strength"), std::string::npos);
  EXPECT_NE(why({at_traction(0.2e6, 0.0), at_traction(0.2e6, 60e-6)}).find("row 2"), std::string::npos);
  TractionSeparationTest t;
  t.rows = {at_jump(1e-6, 0.0)};
  t.points = {{1, ZoneQuantity::normal_traction}};
  EXPECT_NE(predict(t, p, false).failure.find("row 2 of 1"), std::string::npos);
}

}  // namespace
}  // namespace fpz::calibration
