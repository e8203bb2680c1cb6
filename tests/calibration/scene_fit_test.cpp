// The fit of data that only runs predict, with a made-up program in place of the particle method: a curve with a known
// answer and as much scatter from run to run as wanted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "fit_models.hpp"
#include "fpz/calibration/calibration.hpp"

namespace fpz::calibration {
namespace {

constexpr double true_modulus = 30e9;
constexpr double true_strength = 3.5e6;

/// Load at a deflection: straight at first, largest where strength over modulus says.
double load_at(double deflection, const Parameters& p) {
  const double length = 1e-4 * (p.tensile_strength / 3e6) / (p.young_modulus / 30e9);
  return 5e7 * (p.young_modulus / 30e9) * deflection * std::exp(-deflection / length);
}

/// A number in [-1, 1] that jumps from one parameter set to the next, always the same one for the same set.
double jump(const Parameters& p) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const double x : {p.young_modulus, p.tensile_strength, p.delta0}) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    for (int k = 0; k < 8; ++k) hash = (hash ^ ((bits >> (8 * k)) & 255U)) * 0x100000001b3U;
  }
  return static_cast<double>(hash >> 11) * 0x1.0p-52 - 1.0;
}

/// Loads scatter by `scatter` (standard deviation over the load).
RunScenes program(double scatter, std::size_t* made = nullptr) {
  return [scatter, made](const std::vector<SceneRun>& runs, const SceneProgress&) {
    std::vector<SceneOutcome> out;
    for (const SceneRun& run : runs) {
      SceneOutcome o;
      o.columns = {"deflection", "load"};
      o.readings.resize(2);
      for (int k = 0; k <= 400; ++k) {
        const double x = 1e-6 * k;
        o.readings[0].push_back(x);
        o.readings[1].push_back((1.0 + std::sqrt(3.0) * scatter * jump(run.parameters)) * load_at(x, run.parameters));
      }
      out.push_back(std::move(o));
    }
    if (made != nullptr) *made += runs.size();
    return out;
  };
}

/// E and strength are fitted; the data are put in afterwards.
Specification specification() {
  Specification spec = parse_specification(
      R"({"parameters": {"young_modulus": {"start": 38e9, "lower": 5e9, "upper": 200e9}, "poisson_ratio": 0.2,
          "density": 2400, "tensile_strength": {"start": 2.7e6, "lower": 0.5e6, "upper": 20e6}, "cohesion": 10e6,
          "friction_angle_deg": 35, "dilation_angle_deg": 5, "delta0": 25e-6, "normal_stiffness": 1e14,
          "shear_stiffness": 1e14},
          "data": [{"name": "x", "kind": "fracture_energy", "mode": "I", "energy": 80, "deviation": 8}]})",
      "made_up.json");
  spec.data.clear();
  return spec;
}

Parameters truth() {
  Parameters p = specification().start();
  p.young_modulus = true_modulus;
  p.tensile_strength = true_strength;
  return p;
}

/// Twenty points of the true curve with normal noise.
DataSet curve(double noise, std::uint64_t seed) {
  testing::Normal normal(seed);
  DataSet set;
  set.name = "curve";
  set.kind = "scene";
  set.abscissa = Eigen::VectorXd::LinSpaced(20, 1e-5, 2.5e-4);
  set.measured.resize(20);
  SceneData data;
  data.scenes = {{"made_up_scene.json", {}}};
  for (Eigen::Index k = 0; k < 20; ++k) {
    set.measured[k] = load_at(set.abscissa[k], truth());
    data.values.push_back({0, "load", "deflection", set.abscissa[k], "N"});
  }
  const double deviation = noise * set.measured.maxCoeff();
  set.measured += deviation * normal.vector(20);
  set.deviation = Eigen::VectorXd::Constant(20, deviation);
  set.deviation_known = false;
  set.test = data;
  return set;
}

TEST(SceneFit, RecoversWithinItsErrors) {
  for (const double scatter : {0.0, 0.003}) {
    int inside = 0, usable = 0, count = 0;
    std::size_t made = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      Specification spec = specification();
      spec.options.seed = seed;
      spec.data = {curve(0.01, seed)};
      const Calibration c = calibrate(spec, {}, program(scatter, &made));
      ++count;
      usable += c.result.usable() ? 1 : 0;
      ASSERT_EQ(c.result.values.size(), 2);
      const double e = (c.parameters.young_modulus - true_modulus) / c.result.standard_error[0];
      const double s = (c.parameters.tensile_strength - true_strength) / c.result.standard_error[1];
      inside += std::abs(e) < 2.1 ? 1 : 0;
      inside += std::abs(s) < 2.1 ? 1 : 0;
      EXPECT_LT(std::abs(e), 5.0) << seed;
      EXPECT_LT(std::abs(s), 5.0) << seed;
    }
    EXPECT_EQ(usable, count) << scatter;
    EXPECT_GE(inside, 2 * count * 85 / 100) << scatter;
    EXPECT_LE(made, static_cast<std::size_t>(50 * count)) << scatter;
    RecordProperty("runs_each_" + std::to_string(scatter), static_cast<int>(made) / count);
  }
}

TEST(SceneFit, ErrorGrowsWithTheScatterAndSaysSo) {
  const auto error = [](double scatter, Calibration& c) {
    Specification spec = specification();
    spec.data = {curve(0.001, 3)};
    c = calibrate(spec, {}, program(scatter));
    return c.result.standard_error[0];
  };
  Calibration smooth, rough;
  const double least = error(0.0, smooth);
  const double more = error(0.01, rough);
  ASSERT_TRUE(smooth.scenes && rough.scenes);
  EXPECT_GT(more, 3.0 * least);
  EXPECT_NEAR(rough.scenes->scatter, 0.01, 0.007);
  EXPECT_LT(smooth.scenes->scatter, 1e-4);
  const auto says = [](const Calibration& c) {
    return std::any_of(c.warnings.begin(), c.warnings.end(), [](const std::string& w) {
      return w.find("comes from the scatter of the runs") != std::string::npos;
    });
  };
  EXPECT_TRUE(says(rough));
  EXPECT_FALSE(says(smooth));
}

TEST(SceneFit, OtherDataTakePart) {
  Specification spec = specification();
  ParameterSetting& delta0 = spec.parameters[static_cast<std::size_t>(Parameter::delta0)];
  delta0.fitted = true;
  delta0.lower = 2e-6;
  delta0.upper = 200e-6;
  Specification with_energy = parse_specification(
      R"({"material": {"young_modulus": 30e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 3e6,
          "cohesion": 10e6, "friction_angle_deg": 35, "dilation_angle_deg": 5, "delta0": 25e-6,
          "normal_stiffness": 1e14, "shear_stiffness": 1e14}, "fit": ["delta0"],
          "data": [{"name": "G", "kind": "fracture_energy", "mode": "I", "energy": 70, "deviation": 0.7}]})",
      "energy.json");
  spec.data = {curve(0.002, 5), with_energy.data[0]};
  const Calibration c = calibrate(spec, {}, program(0.001));
  ASSERT_TRUE(c.result.usable()) << c.result.message;
  EXPECT_NEAR(c.parameters.tensile_strength, true_strength, 0.01 * true_strength);
  EXPECT_NEAR(c.parameters.tensile_strength * c.parameters.delta0, 70.0, 0.1);  // only the energy knows delta0
}

TEST(SceneFit, WhatTheRunsDoNotSeeIsUndetermined) {
  Specification spec = specification();
  spec.data = {curve(0.01, 1)};
  ParameterSetting& delta0 = spec.parameters[static_cast<std::size_t>(Parameter::delta0)];
  delta0.fitted = true;
  delta0.lower = 2e-6;
  delta0.upper = 200e-6;
  const Calibration c = calibrate(spec, {}, program(0.0));
  EXPECT_FALSE(c.result.usable());
}

TEST(SceneFit, FailedRunsAreNamedWithTheirParameters) {
  const auto failing_above = [](double modulus) -> RunScenes {
    return [modulus, good = program(0.0)](const std::vector<SceneRun>& runs, const SceneProgress& progress) {
      std::vector<SceneOutcome> out = good(runs, progress);
      for (std::size_t k = 0; k < runs.size(); ++k) {
        if (runs[k].parameters.young_modulus > modulus) out[k].failure = "a particle is too fast";
      }
      return out;
    };
  };
  Specification spec = specification();
  spec.data = {curve(0.01, 1)};
  const Calibration none = calibrate(spec, {}, failing_above(1e9));
  EXPECT_EQ(none.result.status, FitStatus::failed);
  EXPECT_NE(none.result.message.find("young_modulus = 38 GPa"), std::string::npos) << none.result.message;
  EXPECT_NE(none.result.message.find("a particle is too fast"), std::string::npos) << none.result.message;
  const Calibration some = calibrate(spec, {}, failing_above(40e9));
  EXPECT_TRUE(some.result.usable()) << some.result.message;
  EXPECT_NEAR(some.parameters.young_modulus, true_modulus, 4.0 * some.result.standard_error[0]);
  ASSERT_TRUE(some.scenes);
  EXPECT_GT(some.scenes->failed, 0U);
}

/// A thousand times too stiff the curve is zero where it was measured, whatever the parameters.
TEST(SceneFit, AStartThatSeesNothingIsNotUsable) {
  Specification spec = specification();
  ParameterSetting& modulus = spec.parameters[static_cast<std::size_t>(Parameter::young_modulus)];
  modulus.value = modulus.upper = 3e13;
  modulus.lower = 1e6;
  spec.data = {curve(0.01, 1)};
  const Calibration c = calibrate(spec, {}, program(0.0));
  EXPECT_FALSE(c.result.usable());
  EXPECT_NE(c.result.message.find("the data do not determine all parameters"), std::string::npos) << c.result.message;
}

TEST(SceneFit, OnlyPredictedScenesAreRunOnce) {
  Specification spec = parse_specification(
      R"({"material": {"young_modulus": 30e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 3.5e6,
          "cohesion": 10e6, "friction_angle_deg": 35, "dilation_angle_deg": 5, "delta0": 25e-6,
          "normal_stiffness": 1e14, "shear_stiffness": 1e14}, "fit": ["delta0"],
          "data": [{"name": "G", "kind": "fracture_energy", "mode": "I", "energy": 70, "deviation": 0.7}]})",
      "energy.json");
  spec.data.push_back(curve(0.0, 1));
  spec.data.back().role = Role::predict;
  std::size_t made = 0;
  const Calibration c = calibrate(spec, {}, program(0.0, &made));
  EXPECT_EQ(made, 1U);
  ASSERT_TRUE(c.comparisons[1].ok()) << c.comparisons[1].failure;
  EXPECT_LT(c.comparisons[1].rms_over_peak, 1e-3);
}

TEST(SceneFit, NeedsSomethingThatRuns) {
  Specification spec = specification();
  spec.data = {curve(0.01, 1)};
  EXPECT_THROW((void)calibrate(spec), std::invalid_argument);
}

TEST(SceneData, ReadingsAreThoseOfTheFirstPassage) {
  SceneOutcome o;
  o.columns = {"cmod", "load"};
  o.readings = {{0.0, 1.0, 0.5, 3.0}, {0.0, 10.0, 20.0, 30.0}};
  SceneData data;
  data.scenes = {{"a.json", {}}};
  data.values = {{0, "load", "cmod", 0.5, "N"}, {0, "load", "cmod", 2.0, "N"}, {0, "load", "", 0.0, "N"}};
  const Prediction p = readings_of(data, {o});
  ASSERT_TRUE(p.ok()) << p.failure;
  EXPECT_DOUBLE_EQ(p.values[0], 5.0);
  EXPECT_DOUBLE_EQ(p.values[1], 26.0);
  EXPECT_DOUBLE_EQ(p.values[2], 30.0);
  data.values[1].at = 4.0;
  const Prediction short_run = readings_of(data, {o});
  EXPECT_NE(short_run.failure.find("before the reading at 4"), std::string::npos) << short_run.failure;
}

TEST(ResponseSurface, ReproducesItsPolynomialWithDerivatives) {
  const std::vector<Coordinate> coordinates = {{static_cast<int>(Parameter::young_modulus), true, 1.0},
                                               {static_cast<int>(Parameter::friction_angle_deg), false, 20.0}};
  const Eigen::Vector2d centre(std::log(30e9), 1.5), radius(0.1, 0.05);
  const auto exact = [&](const Eigen::VectorXd& y) {
    const Eigen::VectorXd u = (y - centre).cwiseQuotient(radius);
    return Eigen::VectorXd::Constant(1, 3.0 + u[0] - 2.0 * u[1] + 0.5 * u[0] * u[0] + 0.2 * u[1] * u[1] - u[0] * u[1]);
  };
  std::vector<SurfacePoint> points;
  testing::Normal normal(4);
  for (int k = 0; k < 9; ++k) {
    const Eigen::VectorXd y = centre + radius.cwiseProduct(0.5 * normal.vector(2));
    points.push_back({y, exact(y)});
  }
  ASSERT_EQ(order_for(points.size(), 2), SurfaceOrder::products);
  const ResponseSurface s = fit_surface(coordinates, centre, radius, points, SurfaceOrder::products);
  Parameters p = specification().start();
  p.young_modulus = 32e9;
  p.friction_angle_deg = 30.4;
  const Prediction here = predict(s, p, true);
  ASSERT_TRUE(here.ok()) << here.failure;
  EXPECT_NEAR(here.values[0], exact(Eigen::Vector2d(std::log(32e9), 1.52))[0], 1e-9);
  for (const Parameter which : {Parameter::young_modulus, Parameter::friction_angle_deg}) {
    const auto member = info(which).member;
    Parameters up = p, down = p;
    const double step = 1e-5 * p.*member;
    up.*member += step;
    down.*member -= step;
    const double slope = (predict(s, up, false).values[0] - predict(s, down, false).values[0]) / (2.0 * step);
    EXPECT_NEAR(here.jacobian(0, static_cast<int>(which)), slope, 1e-6 * std::abs(slope));
  }
  p.young_modulus = 60e9;
  EXPECT_NE(predict(s, p, false).failure.find("not run near young_modulus"), std::string::npos);
}

}  // namespace
}  // namespace fpz::calibration
