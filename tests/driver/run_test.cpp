#include "fpz/driver/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "fpz/driver/compare.hpp"
#include "helpers.hpp"

namespace fpz::driver {
namespace {

using testing::HasSubstr;

CompareOptions within(double tolerance) {
  CompareOptions o;
  o.stress_tolerance = o.damage_tolerance = o.jump_tolerance = tolerance;
  o.stress_scale = 0.6e6;
  return o;
}

Comparison against_reference(const Result& result, double tolerance) {
  return compare_histories(io::parse_csv(to_csv(result.history), "history"),
                           io::read_csv(FPZ_DATA_DIR "/reference/four_stage.csv"), within(tolerance));
}

/// Confined by 5 MPa in plane stress, the plane that fails first is inclined out of the plane, at the strength of
/// uniaxial compression: 2 r with sqrt(r^2 + A^2) = c0 cos(phi) + r sin(phi).
TEST(OutOfPlane, ConfinedPlaneStressWarnsAtTheStrengthOf3D) {
  const auto path = [](const std::string& setting, const std::string& confinement) {
    return parse_path_file(R"({"name": "confined", "rve_length": 2e-4, "setting": ")" + setting + R"(",
      "integrator": {"name": "accurate", "tolerance": 1e-6},
      "material": {"young_modulus": 20e9, "poisson_ratio": 0.25, "density": 2400, "tensile_strength": 3e6,
        "cohesion": 8e6, "friction_angle_deg": 40, "dilation_angle_deg": 10, "delta0": 50e-6,
        "normal_stiffness": 1e14, "shear_stiffness": 1e14},
      "stages": [{"increments": 10, "stress": {"xx": )" +
                               confinement + R"(, "yy": )" + confinement + R"(}},
                 {"increments": 200, "strain": {"yy": -0.012}, "stress": {"xx": )" +
                               confinement + R"(}, "stop": {"D": 0.01}}]})",
                           "x.json")
        .tests.at(0);
  };
  const double phi = 40.0 * std::numbers::pi / 180.0, c = 8.0, a = c - 3.0 * std::tan(phi);
  const double k = c * std::cos(phi), s = std::sin(phi), q = 1.0 - s * s;
  const double strength = 2.0 * (k * s + std::sqrt(k * k * s * s - q * (a * a - k * k))) / q;  // MPa
  ASSERT_NEAR(strength, 28.64, 0.01);
  const Result confined = run_test(path("plane_stress", "-5e6"));
  ASSERT_EQ(confined.warnings.size(), 1u);
  for (const std::string& part :
       {std::string("test \"confined\": setting = \"plane_stress\""), std::string("sig_xx = -5,"),
        std::string("sig_yy = -28.64, sig_zz = 0"), std::string("\"setting\": \"3d\"")}) {
    EXPECT_THAT(confined.warnings[0], HasSubstr(part));
  }
  // Without confinement the plane is in the plane; in plane strain the stress across it lies between the others.
  EXPECT_TRUE(run_test(path("plane_stress", "0")).warnings.empty());
  EXPECT_TRUE(run_test(path("plane_strain", "-5e6")).warnings.empty());
}

/// A softening law from the material of a path file, all the way to history and summary.
TEST(Softening, IsChosenByTheMaterial) {
  const auto path = [](const std::string& softening) {
    return parse_path_file(
               R"({"name": "opening", "rve_length": 1e-3, "setting": "plane_strain", "integrator": {"name": "accurate", "tolerance": 1e-8},
      "material": {)" +
                   softening +
                   R"("young_modulus": 0.4e9, "poisson_ratio": 0.25, "density": 1540,
        "tensile_strength": 0.6e6, "cohesion": 1e6, "friction_angle_deg": 33, "dilation_angle_deg": 4, "delta0": 18e-6,
        "normal_stiffness": 1e13, "shear_stiffness": 1e11, "cohesive_zone": "published"},
      "stages": [{"increments": 50, "strain": {"xx": 0.08}}]})",
               "x.json")
        .tests.at(0);
  };
  const Result bilinear = run_test(path(R"("softening": "bilinear", )"));
  ASSERT_TRUE(bilinear.ok()) << bilinear.message;
  for (const Row& r : bilinear.history) {  // Petersson's two lines
    if (r.damage <= 0.0) continue;
    const double x = r.jump[0] / 18e-6;
    const double w = x < 0.8 ? 1.0 - x / 1.2 : std::max(3.6 - x, 0.0) / 8.4;
    EXPECT_NEAR(r.damage, 1.0 - w, 1e-5) << x;
  }
  EXPECT_EQ(bilinear.history.back().damage, 1.0);
  const Result exponential = run_test(path(""));
  EXPECT_LT(exponential.history.back().damage, 1.0);
  const auto material = [](const Result& r, const PathTest& test) {
    return nlohmann::json::parse(to_json(test, r)).at("material");
  };
  EXPECT_EQ(material(bilinear, path(R"("softening": "bilinear", )")).at("softening"), "bilinear");
  EXPECT_FALSE(material(exponential, path("")).contains("softening"));  // the default is not written
  try {
    (void)path(R"("softening": "linear", )");
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("material.softening: \"linear\" is not known; it must be exponential or bilinear"));
  }
}

TEST(FourStage, MatchesTheReference) {
  PathTest test = four_stages(1);
  for (Stage& s : test.stages) {  // rows at the reference's times: 200 a stage
    for (ComponentControl& c : s.controls) c.value *= s.increments / 600.0;
    s.increments = 600;
  }
  test.options.tolerance = 1e-8;
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  const Comparison c = against_reference(result, 1e-8);
  EXPECT_TRUE(c.ok()) << c.report();
  EXPECT_EQ(c.interpolated, 0u);
}

TEST(FourStage, LargeIncrementsStayWithinTheirTolerance) {
  PathTest test = four_stages(1);
  for (Stage& s : test.stages) {
    for (ComponentControl& c : s.controls) c.value *= s.increments / 200.0;
    s.increments = 200;
  }
  test.options.tolerance = 1e-5;
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  EXPECT_TRUE(against_reference(result, 1e-5).ok()) << against_reference(result, 1e-5).report();
}

TEST(FourStage, SummaryTellsOnsetAndEnergies) {
  const PathTest test = four_stages(10);
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  ASSERT_TRUE(result.summary.onset.has_value());
  EXPECT_NEAR(result.summary.onset->stress[xx], 0.6e6, 1e-3);
  EXPECT_NEAR(result.summary.onset->time, 0.00125 / 0.0036, 1e-12);
  EXPECT_NEAR(result.summary.onset->angle_deg, 0.0, 1e-9);
  EXPECT_NEAR(result.summary.highest[xx].value, 0.6e6, 1e-3);
  EXPECT_NEAR(result.summary.energy_balance, 0.0, 1e-5);  // the work is a trapezoidal sum
  const auto json = nlohmann::json::parse(to_json(test, result));
  EXPECT_EQ(json.at("final_damage").get<double>(), result.history.back().damage);
  EXPECT_EQ(json.at("material").at("rve_length").get<double>(), 4e-3);
}

/// Lateral stress is kept at zero while the axial strain is prescribed.
Result uniaxial_stress(Setting setting, double strain, int increments) {
  PathTest test = johnstone_test(setting);
  std::vector<ComponentControl> controls = {{xx, Prescribed::strain, strain}, {yy, Prescribed::stress, 0.0}};
  if (setting == Setting::three_d) controls.push_back({zz, Prescribed::stress, 0.0});
  test.stages = {stage(increments, controls)};
  return run_test(test);
}

TEST(MixedControl, UniaxialStressIsElasticWithItsClosedForms) {
  const double e = 0.4e9;
  const double nu = 0.25;
  const double strain = 1e-3;
  const Row solid = uniaxial_stress(Setting::three_d, strain, 3).history.back();
  EXPECT_NEAR(solid.stress[xx], e * strain, 1e-9 * e * strain);
  EXPECT_NEAR(solid.strain[yy], -nu * strain, 1e-12);
  const Row plane_stress = uniaxial_stress(Setting::plane_stress, strain, 3).history.back();
  EXPECT_NEAR(plane_stress.stress[xx], e * strain, 1e-9 * e * strain);
  EXPECT_NEAR(plane_stress.strain[zz], -nu * strain, 1e-12);
  EXPECT_EQ(plane_stress.stress[zz], 0.0);
  const Row plane_strain = uniaxial_stress(Setting::plane_strain, strain, 3).history.back();
  EXPECT_NEAR(plane_strain.stress[xx], e / (1 - nu * nu) * strain, 1e-9 * e * strain);
  EXPECT_NEAR(plane_strain.stress[zz], nu * plane_strain.stress[xx], 1e-9 * e * strain);
}

TEST(MixedControl, LateralStressStaysZeroAfterCracking) {
  const Result result = uniaxial_stress(Setting::plane_strain, 0.008, 400);
  ASSERT_TRUE(result.ok()) << result.message;
  EXPECT_GT(result.summary.damage, 0.5);
  for (const Row& r : result.history) EXPECT_NEAR(r.stress[yy], 0.0, 1e-10 * 0.6e6) << "time " << r.time;
}

TEST(MixedControl, PlaneStressModuli) {
  PathTest test = johnstone_test(Setting::plane_stress);
  test.stages = {stage(1, {{xx, Prescribed::strain, 1e-4}})};
  const Row r = run_test(test).history.back();
  EXPECT_NEAR(r.stress[xx], 0.4e9 / (1 - 0.0625) * 1e-4, 1e-6);
  EXPECT_NEAR(r.stress[yy], 0.25 * r.stress[xx], 1e-6);
}

TEST(MixedControl, LinearConstraintTiesComponents) {
  PathTest test = johnstone_test();
  Stage s = stage(10, {{xx, Prescribed::strain, 5e-4}});
  LinearConstraint equal_stress;  // sig_xx - sig_yy = 0
  equal_stress.stress[xx] = 1.0;
  equal_stress.stress[yy] = -1.0;
  s.constraints = {equal_stress};
  test.stages = {s};
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  const Row r = result.history.back();
  EXPECT_NEAR(r.stress[xx], r.stress[yy], 1e-4);
  EXPECT_NEAR(r.strain[yy], 5e-4, 1e-12);
}

TEST(MixedControl, TooManyConstraintsAreRefused) {
  PathTest test = johnstone_test();
  Stage s = stage(1, {{xx, Prescribed::strain, 1e-4}});
  LinearConstraint c;
  c.strain[xx] = 1.0;
  s.constraints = {c};
  test.stages = {s};
  EXPECT_THROW((void)run_test(test), InputError);
}

TEST(MixedControl, StressControlPastThePeakStopsAtTheLoadLimit) {
  PathTest test = johnstone_test();
  test.stages = {stage(100, {{xx, Prescribed::stress, 1e6}})};
  const Result result = run_test(test);
  EXPECT_EQ(result.status, "load_limit");
  EXPECT_THAT(result.message, HasSubstr("load limit"));
  EXPECT_THAT(result.message, HasSubstr("jump control"));
  EXPECT_NEAR(result.history.back().stress[xx], 0.6e6, 1.0);
  EXPECT_EQ(result.history.back().status, "load_limit");
}

/// Confined, sheared until the fracture has D = 0.02, and back to zero stress.
PathTest closed_stress_cycle(CohesiveZone zone) {
  PathTest test;
  test.name = "cycle";
  test.parameters = test::table3(1e-3);
  test.parameters.choices.cohesive_zone = zone;
  test.options.tolerance = 1e-6;
  test.stages = {
      stage(20, {{xx, Prescribed::stress, -20e6}, {yy, Prescribed::stress, -20e6}}),
      stage(4000, {{xy, Prescribed::strain, 0.05}, {xx, Prescribed::stress, -20e6}, {yy, Prescribed::stress, -20e6}}),
      stage(400, {{xx, Prescribed::stress, 0.0}, {yy, Prescribed::stress, 0.0}, {xy, Prescribed::stress, 0.0}})};
  test.stages[1].stop = {{"D", 0.02}};
  return test;
}

TEST(StoredEnergy, BelowZeroIsAnErrorOfTheModel) {
  const PathTest test = closed_stress_cycle(CohesiveZone::published);
  const Result result = run_test(test);
  EXPECT_EQ(result.status, "negative_energy");
  EXPECT_THAT(result.message, HasSubstr("gives back energy that nobody put in"));
  EXPECT_THAT(result.message, HasSubstr("\"cohesive_zone\": \"consistent\""));
  EXPECT_NEAR(result.history.back().stress[xy], 0.0, 1.0);  // the path is complete
  EXPECT_LT(result.summary.work * test.parameters.rve_length, -900.0);
  EXPECT_LT(result.summary.least_stored.value * test.parameters.rve_length, -1000.0);
}

TEST(StoredEnergy, IsNeverBelowZeroInTheConsistentZone) {
  const PathTest test = closed_stress_cycle(CohesiveZone::consistent);
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  EXPECT_GE(result.summary.work, 0.0);
  EXPECT_EQ(result.summary.least_stored.value, 0.0);
  EXPECT_GT(result.summary.dissipated, 0.0);
  EXPECT_LT(std::abs(result.summary.energy_balance), 1e-5);
}

TEST(StopCondition, EndsTheStageAtTheValue) {
  PathTest test = johnstone_test();
  test.stages = {stage(100, {{xx, Prescribed::strain, 4e-3}}), stage(10, {{xx, Prescribed::strain, 0.0}})};
  test.stages[0].stop = {{"D", 0.25}};
  test.stages[1].stop = {{"sig_xx", 1e5}};
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  double at_end_of_first = -1.0;
  for (const Row& r : result.history) {
    if (r.stage == 1) at_end_of_first = r.damage;
  }
  EXPECT_NEAR(at_end_of_first, 0.25, 1e-10);
  EXPECT_NEAR(result.history.back().stress[xx], 1e5, 1e-10 * 0.6e6 + 1e-4);
}

TEST(StopCondition, StartingAtTheValueDoesNotCount) {
  PathTest test = johnstone_test();
  test.stages = {stage(10, {{xx, Prescribed::strain, 1e-3}})};
  test.stages[0].stop = {{"sig_xx", 0.0}};
  EXPECT_EQ(run_test(test).history.size(), 11u);
}

TEST(SnapBack, MessageNamesTheWayOut) {
  PathTest test = johnstone_test(Setting::plane_strain, 20e-3);
  test.stages = {stage(100, {{xx, Prescribed::strain, 4e-3}})};
  const Result result = run_test(test);
  EXPECT_EQ(result.status, "snap_back");
  for (const char* part : {"\"test\"", "stage 1", "increment 32", "H = 0.02", "0.0144", "jump_control"}) {
    EXPECT_THAT(result.message, HasSubstr(part));
  }
  EXPECT_LE(result.history.back().stress[xx], 0.6e6);
  EXPECT_GT(result.history.back().stress[xx], 0.599e6);
}

TEST(JumpControl, GoesThroughSnapBack) {
  PathTest test = johnstone_test(Setting::plane_strain, 20e-3);
  Stage s = stage(400, {{xx, Prescribed::strain, 4e-3}});
  s.jump = JumpControl{18e-6 * 5 / 400};
  test.stages = {s};
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  const Row& end = result.history.back();
  EXPECT_NEAR(end.damage, 1.0 - std::exp(-5.0), 1e-9);
  EXPECT_NEAR(end.plastic_normal + end.plastic_slip, 5 * 18e-6, 1e-13);
  EXPECT_NEAR(result.summary.energy_balance, 0.0, 1e-3);
  bool turned_back = false;
  for (std::size_t i = 2; i < result.history.size(); ++i) {
    turned_back = turned_back || result.history[i].strain[xx] < result.history[i - 1].strain[xx];
  }
  EXPECT_TRUE(turned_back);
}

TEST(AutomaticSteps, FollowTheResponseWithinTheirTolerance) {
  PathTest test = johnstone_test();
  Stage s = stage(1, {{xx, Prescribed::strain, 4e-3}});
  s.automatic = true;
  s.step_tolerance = 1e-3;
  test.stages = {s};
  const Result result = run_test(test);
  ASSERT_TRUE(result.ok()) << result.message;
  EXPECT_LT(result.history.size(), 200u);
  EXPECT_EQ(result.history.back().time, 1.0);
  PathTest fine = test;
  fine.stages[0].step_tolerance = 1e-5;
  EXPECT_GT(run_test(fine).history.size(), 2 * result.history.size());
}

TEST(Halving, GivesOneRowPerIncrement) {
  PathTest test = four_stages(100);  // 100 times the paper's increments: too large for its algorithm
  test.options.method = Method::paper;
  test.options.tolerance = 1e-4;
  const Result result = run_test(test);
  EXPECT_GT(result.summary.counts.updates, 156);
  ASSERT_TRUE(result.ok()) << result.message;
  EXPECT_EQ(result.history.size(), 157u);
}

TEST(Observer, HearsOfEveryRow) {
  PathTest test = johnstone_test();
  test.stages = {stage(7, {{xx, Prescribed::strain, 1e-4}})};
  int calls = 0;
  (void)run_test(test, [&](const Progress& p) {
    ++calls;
    EXPECT_EQ(p.stages, 1);
  });
  EXPECT_EQ(calls, 8);
}

}  // namespace
}  // namespace fpz::driver
