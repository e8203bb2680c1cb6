#include "fpz/calibration/stress_strain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "differences.hpp"
#include "fpz/driver/run.hpp"
#include "fpz/material.hpp"
#include "support/materials.hpp"

namespace fpz::calibration {
namespace {

using driver::ComponentControl;
using driver::Prescribed;
using driver::Stage;

constexpr int xx = 0, yy = 1, zz = 2, xy = 3;

Stage stage(int increments, std::vector<ComponentControl> controls) {
  Stage s;
  s.increments = increments;
  s.controls = std::move(controls);
  return s;
}

StressStrainTest make(const Parameters& p, std::vector<Stage> stages, Setting setting = Setting::plane_strain) {
  StressStrainTest t;
  t.path.name = "test";
  t.path.parameters = p;
  t.path.setting = setting;
  t.path.options.tolerance = 1e-11;
  t.path.stages = std::move(stages);
  t.ordinate = {TensorKind::stress, xx};
  return t;
}

/// Uniaxial strain up to an opening of about 3 delta0.
StressStrainTest opening(const Parameters& p, int increments = 40) {
  return make(p, {stage(increments, {{xx, Prescribed::strain, 3.0 * p.delta0 / p.rve_length}})});
}

/// Tension with free sides, partial unloading, then shear at a constant side stress.
StressStrainTest mixed_control(const Parameters& p, Setting setting) {
  const double e = 2.5 * p.delta0 / p.rve_length;
  return make(p,
              {stage(30, {{xx, Prescribed::strain, e}, {yy, Prescribed::stress, 0.0}}),
               stage(10, {{xx, Prescribed::strain, 0.9 * e}, {yy, Prescribed::stress, 0.0}}),
               stage(20, {{yy, Prescribed::stress, -0.2 * p.tensile_strength},
                          {xx, Prescribed::strain_increment, 0.02 * e},
                          {xy, Prescribed::strain_increment, 0.03 * e}})},
              setting);
}

double onset_strain(const Parameters& p) {
  const Material<double> m = make_material(p, Setting::plane_strain);
  return p.tensile_strength / (m.bulk.lambda + 2.0 * m.bulk.mu);
}

/// sig_xx in uniaxial strain, from the jump: eps = sigma/M + u/H with sigma = sigma_t0 exp(-u/delta0).
double opening_stress(const Parameters& p, double strain) {
  const double peak = onset_strain(p);
  if (strain <= peak) return strain / peak * p.tensile_strength;
  double u = 0.0;
  for (int k = 0; k < 100; ++k) {
    const double w = std::exp(-u / p.delta0);
    u -= (w * peak + u / p.rve_length - strain) / (-w * peak / p.delta0 + 1.0 / p.rve_length);
  }
  return p.tensile_strength * std::exp(-u / p.delta0);
}

std::vector<Parameters> mode_one_tables() { return {test::table1(4e-3), test::table3(0.5e-3)}; }

TEST(StressStrain, OpeningIsTheClosedFormBetweenTheIncrementsToo) {
  for (const Parameters& p : mode_one_tables()) {
    StressStrainTest t = opening(p);
    t.abscissa_strain = xx;
    const double peak = onset_strain(p);
    t.points = {0.0, 0.5 * peak, peak * (1.0 - 1e-9), peak * (1.0 + 1e-9), 1.3 * peak, 5.0 * peak, 2.3 * peak};
    const Prediction x = predict(t, p, true);
    ASSERT_TRUE(x.ok()) << x.failure;
    for (std::size_t i = 0; i < t.points.size(); ++i) {
      EXPECT_NEAR(x.values[static_cast<Eigen::Index>(i)], opening_stress(p, t.points[i]), 1e-9 * p.tensile_strength);
    }
  }
}

TEST(StressStrain, DerivativesKeepToTheirSideOfTheKink) {
  const Parameters p = test::table1(4e-3);
  StressStrainTest t = opening(p);
  t.abscissa_strain = xx;
  const double peak = onset_strain(p);
  t.points = {peak * (1.0 - 1e-6), peak * (1.0 + 1e-6)};
  const Prediction x = predict(t, p, true);
  ASSERT_TRUE(x.ok()) << x.failure;
  const auto e = static_cast<int>(Parameter::young_modulus);
  const auto strength = static_cast<int>(Parameter::tensile_strength);
  EXPECT_NEAR(x.jacobian(0, e) * p.young_modulus, x.values[0], 1e-6 * x.values[0]);
  EXPECT_NEAR(x.jacobian(0, strength), 0.0, 1e-9);
  // Just after: sigma = sigma_t0 - softening of the increment beyond the peak; eps = sigma/M + u/H.
  const double modulus = p.tensile_strength / peak;
  const double soft = p.tensile_strength / p.delta0;
  const double slope = -soft / (1.0 / p.rve_length - soft / modulus);  // d sigma / d eps
  EXPECT_NEAR(x.jacobian(1, strength), 1.0 - slope / modulus, 1e-5 * std::abs(slope / modulus));
}

TEST(StressStrain, TimeAndStrainNameTheSamePoint) {
  const Parameters p = test::table1(4e-3);
  StressStrainTest by_time = opening(p);
  StressStrainTest by_strain = opening(p);
  by_strain.abscissa_strain = xx;
  const double end = 3.0 * p.delta0 / p.rve_length;
  by_time.points = {0.013, 0.4, 0.987, 1.0};
  for (const double s : by_time.points) by_strain.points.push_back(s * end);
  const Prediction a = predict(by_time, p, true);
  const Prediction b = predict(by_strain, p, true);
  ASSERT_TRUE(a.ok() && b.ok()) << a.failure << b.failure;
  EXPECT_LT((a.values - b.values).norm(), 1e-9 * p.tensile_strength);
  EXPECT_LT((a.jacobian - b.jacobian).norm(), 1e-9 * a.jacobian.norm());
}

TEST(StressStrain, RowsOfTheDriverAreMet) {
  const Parameters p = test::table1(4e-3);
  for (const Setting setting : {Setting::plane_strain, Setting::plane_stress, Setting::three_d}) {
    StressStrainTest t = mixed_control(p, setting);
    const driver::Result run = driver::run_test(t.path);
    ASSERT_TRUE(run.ok()) << run.message;
    for (const driver::Row& r : run.history) t.points.push_back(r.time);
    for (const int c : {xx, yy, zz, xy}) {
      for (const TensorKind kind : {TensorKind::stress, TensorKind::strain}) {
        t.ordinate = {kind, c};
        const Prediction x = predict(t, p, false);
        ASSERT_TRUE(x.ok()) << x.failure;
        for (std::size_t i = 0; i < run.history.size(); ++i) {
          const auto k = static_cast<std::size_t>(c);
          const double row = kind == TensorKind::stress ? run.history[i].stress[k] : run.history[i].strain[k];
          const double scale = kind == TensorKind::stress ? p.tensile_strength : p.tensile_strength / p.young_modulus;
          EXPECT_NEAR(x.values[static_cast<Eigen::Index>(i)], row, 1e-11 * scale);
        }
      }
    }
  }
}

TEST(StressStrain, Derivatives) {
  for (const Parameters& p : {test::table1(4e-3), test::table2(0.3e-3), test::table3(0.2e-3)}) {
    StressStrainTest t = opening(p);
    t.points = {0.01, 0.2, 0.517, 1.0};
    expect_derivatives([&](const Parameters& q, bool d) { return predict(t, q, d); }, p, 5e-4, 1e-6);
  }
}

struct MixedCase {
  Parameters parameters;
  Setting setting;
  TensorComponent ordinate;
};

TEST(StressStrain, DerivativesUnderMixedControl) {
  for (const MixedCase& c : {MixedCase{test::table1(4e-3), Setting::plane_strain, {TensorKind::stress, xx}},
                             MixedCase{test::table1(4e-3), Setting::plane_stress, {TensorKind::strain, zz}},
                             MixedCase{test::table1(4e-3), Setting::three_d, {TensorKind::stress, zz}},
                             MixedCase{test::table2(0.3e-3), Setting::plane_strain, {TensorKind::stress, xy}},
                             MixedCase{test::table3(0.2e-3), Setting::plane_stress, {TensorKind::strain, yy}}}) {
    StressStrainTest t = mixed_control(c.parameters, c.setting);
    t.points = {0.011, 0.5, 0.983, 1.0, 1.455, 2.0, 2.31, 2.99};
    t.ordinate = c.ordinate;
    expect_derivatives([&](const Parameters& q, bool d) { return predict(t, q, d); }, c.parameters, 5e-4, 1e-6,
                       c.ordinate.kind == TensorKind::stress ? 1.0 : 1e-9);
  }
}

TEST(StressStrain, DerivativesAtAStrainThatIsAResponse) {
  const Parameters p = test::table1(4e-3);
  StressStrainTest t = mixed_control(p, Setting::plane_strain);
  // The side strain falls up to the peak and comes back while the crack opens.
  StressStrainTest probe = t;
  probe.ordinate = {TensorKind::strain, yy};
  probe.points = {0.01, 0.02, 0.4, 0.7};
  const Prediction side = predict(probe, p, false);
  ASSERT_TRUE(side.ok()) << side.failure;
  const double peak_time = onset_strain(p) / (2.5 * p.delta0 / p.rve_length);  // about
  t.abscissa_strain = yy;
  t.points = {side.values[2], side.values[3]};
  t.window = {0.34, 1.0};
  ASSERT_LT(peak_time, 0.34);
  const Prediction x = predict(t, p, true);
  ASSERT_TRUE(x.ok()) << x.failure;
  StressStrainTest same = probe;
  same.ordinate = t.ordinate;
  same.points = {0.4, 0.7};
  EXPECT_LT((predict(same, p, false).values - x.values).norm(), 1e-8 * p.tensile_strength);
  expect_derivatives([&](const Parameters& q, bool d) { return predict(t, q, d); }, p, 5e-4, 1e-6);
}

TEST(StressStrain, ConstraintsCarryDerivatives) {
  // Confined out-of-plane stress: a linear constraint whose coefficients contain Poisson's ratio in plane strain.
  const Parameters p = test::table1(4e-3);
  Stage s = stage(30, {{xx, Prescribed::strain, 2.0 * p.delta0 / p.rve_length}});
  driver::LinearConstraint c;
  c.stress[zz] = 1.0;
  c.stress[yy] = 0.5;
  s.constraints.push_back(c);
  StressStrainTest t = make(p, {s});
  t.points = {0.03, 0.6, 0.95};
  expect_derivatives([&](const Parameters& q, bool d) { return predict(t, q, d); }, p, 5e-4, 1e-6);
  t.ordinate = {TensorKind::stress, zz};
  expect_derivatives([&](const Parameters& q, bool d) { return predict(t, q, d); }, p, 5e-4, 1e-6, 1.0);
}

TEST(StressStrain, Failures) {
  const Parameters p = test::table1(4e-3);
  const auto why = [&](const StressStrainTest& t, const Parameters& q) { return predict(t, q, true).failure; };
  StressStrainTest t = opening(p);
  t.points = {1.5};
  EXPECT_NE(why(t, p).find("outside the path"), std::string::npos);
  t.points = {-0.1};
  EXPECT_NE(why(t, p).find("outside the path"), std::string::npos);
  t.points = {std::nan("")};
  EXPECT_NE(why(t, p).find("not a number"), std::string::npos);

  StressStrainTest snap = opening(test::table1(20e-3));
  snap.points = {0.9};
  EXPECT_NE(why(snap, p).find("snap-back"), std::string::npos);
  snap.points = {0.01};  // before the snap-back all is well
  EXPECT_EQ(why(snap, p), "");

  StressStrainTest load = make(p, {stage(20, {{xx, Prescribed::stress, 2.0 * p.tensile_strength}})});
  load.points = {0.9};
  EXPECT_NE(why(load, p).find("load limit"), std::string::npos);

  StressStrainTest turning = mixed_control(p, Setting::plane_strain);
  turning.abscissa_strain = xx;
  turning.points = {1e-3};
  EXPECT_NE(why(turning, p).find("turns round"), std::string::npos);
  turning.window = {0.0, 1.0};
  EXPECT_EQ(why(turning, p), "");
  turning.points = {1.0};
  EXPECT_NE(why(turning, p).find("runs from"), std::string::npos);

  StressStrainTest stopped = mixed_control(p, Setting::plane_strain);
  stopped.path.stages[0].stop = {{"D", 0.5}};
  stopped.points = {0.1, 1.5};
  EXPECT_NE(why(stopped, p).find("stop condition"), std::string::npos);
  stopped.points = {0.1};
  EXPECT_EQ(why(stopped, p), "");

  StressStrainTest jump = opening(p);
  jump.path.stages[0].jump = driver::JumpControl{1e-6};
  jump.points = {0.5};
  EXPECT_NE(why(jump, p).find("jump control"), std::string::npos);
}

}  // namespace
}  // namespace fpz::calibration
