// Scenes in specifications, and their runs by the particle program on a coarse specimen.
#include "fpz/calibration/scene_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "fpz/calibration/calibration.hpp"
#include "fpz/io/material_file.hpp"
#include "support/temporary_folder.hpp"

namespace fpz::calibration {
namespace {

namespace fs = std::filesystem;

const fs::path data = FPZ_DATA_DIR;

std::string quoted(const std::string& text) { return '"' + text + '"'; }

/// The semicircular specimen with its notch at 30 degrees, coarse and fast: a fraction of a second.
const std::string coarse =
    R"({"spacing": 0.0025, "notches[0].angle_deg": 30,
        "boundaries[0].velocity.y": {"speed": -0.01, "ramp": 0.005}, "stop.time": 0.05})";

/// A specification with one data set, whose keys beyond name, kind and scene are given.
std::string specification(const std::string& keys, const std::string& set = coarse) {
  return R"({"material": )" + quoted((data / "materials/johnstone.json").string()) +
         R"(, "fit": ["young_modulus", "tensile_strength"],
             "parameters": {"young_modulus": {"start": 0.45e9, "lower": 0.1e9, "upper": 2e9},
                            "tensile_strength": {"start": 0.57e6, "lower": 0.2e6, "upper": 2e6}},
             "options": {"profiles": []},
             "data": [{"name": "test", "kind": "scene", "scene": )" +
         quoted((data / "scenes/scb.json").string()) + R"(, "set": )" + set + ", " + keys + "}]}";
}

std::string problems_of(const std::string& text) {
  try {
    (void)parse_specification(text, "spec.json");
  } catch (const io::InputError& e) {
    return e.what();
  }
  return {};
}

std::vector<SceneRun> coarse_runs(const std::vector<double>& strengths) {
  const Specification spec =
      parse_specification(specification(R"("points": [{"largest": 200}], "deviation": 2)"), "spec.json");
  std::vector<SceneRun> runs;
  for (const double s : strengths) {
    Parameters p = io::read_material_file(data / "materials/johnstone.json");
    p.tensile_strength = s;
    runs.push_back({std::get<SceneData>(spec.data[0].test).scenes[0], p});
  }
  return runs;
}

double largest_load(const SceneOutcome& o) {
  const auto at = std::find(o.columns.begin(), o.columns.end(), "load") - o.columns.begin();
  const std::vector<double>& load = o.readings[static_cast<std::size_t>(at)];
  return *std::max_element(load.begin(), load.end());
}

std::vector<fs::path> histories(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().filename() == "history.csv") out.push_back(entry.path());
  }
  return out;
}

TEST(SceneSet, SaysWhatIsWrong) {
  const std::string points = R"("points": [{"largest": 200}], "deviation": 2)";
  EXPECT_EQ(problems_of(specification(points)), "");
  const std::pair<std::string, const char*> wrong[] = {
      {specification(R"("points": [{"largest": 200, "gauge": "lode"}], "deviation": 2)"), R"(unknown gauge "lode")"},
      {specification(R"("points": [{"largest": -200}], "deviation": 2)"), "must be > 0"},
      {specification(R"("points": [{"largest": 200}])"), "from a single value no scatter"},
      {specification(R"("points": [{"largest": 200, "set": {"spacing": -1}}], "deviation": 2)"), "spacing"},
      {specification(points, R"({"material.delta0": 1e-5})"), "the one that is fitted"},
      {specification(points, R"({"setting": "plane_stress"})"), "state the same \"setting\""},
      {specification(R"("measured": "load", "values": {"cmot": [1e-6, 2e-6], "load": [1, 2]})"), "cmod"},
      {specification(R"("measured": "load", "cyclic": true,
                        "values": {"cmod": {"unit": "m", "list": [1e-6, 2e-6, 1e-6]},
                                   "load": {"unit": "N", "list": [1, 2, 1]}})"),
       "goes back"}};
  for (const auto& [text, expected] : wrong) {
    EXPECT_NE(problems_of(text).find(expected), std::string::npos) << expected << " in: " << problems_of(text);
  }
}

TEST(SceneRuns, AreKeptMadeAgainWhenDamagedAndDependOnTheMaterial) {
  const test::TemporaryFolder folder;
  const RunScenes run = scene_runner({folder.path(), 1});
  const std::vector<SceneOutcome> first = run(coarse_runs({0.6e6, 0.63e6, 0.6e6}), {});
  for (const SceneOutcome& o : first) ASSERT_EQ(o.failure, "");
  EXPECT_EQ(histories(folder.path()).size(), 2U);  // the third is the first
  EXPECT_EQ(largest_load(first[0]), largest_load(first[2]));
  EXPECT_GT(largest_load(first[1]), 1.01 * largest_load(first[0]));

  const std::vector<fs::path> kept = histories(folder.path());
  const auto written = fs::last_write_time(kept[0]);
  const std::vector<SceneOutcome> again = run(coarse_runs({0.6e6, 0.63e6}), {});
  EXPECT_EQ(fs::last_write_time(kept[0]), written);
  EXPECT_EQ(largest_load(again[0]), largest_load(first[0]));

  for (const fs::path& history : kept) {  // a digit that fell over, and a file that ends too early
    std::stringstream text;
    text << std::ifstream(history).rdbuf();
    std::string bytes = text.str();
    if (history == kept[0]) {
      bytes[bytes.size() / 2] = bytes[bytes.size() / 2] == '1' ? '2' : '1';
    } else {
      bytes.resize(bytes.size() / 2);
    }
    std::ofstream(history) << bytes;
  }
  const std::vector<SceneOutcome> mended = run(coarse_runs({0.6e6, 0.63e6}), {});
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_EQ(mended[k].failure, "");
    EXPECT_EQ(mended[k].readings, first[k].readings);
  }
}

TEST(SceneRuns, ASceneThatIsRefusedIsAFailureOfItsRunAlone) {
  const test::TemporaryFolder folder;
  std::vector<SceneRun> runs = coarse_runs({0.6e6, 0.6e6});
  runs[1].parameters.poisson_ratio = 0.7;
  const std::vector<SceneOutcome> out = scene_runner({folder.path(), 1})(runs, {});
  EXPECT_EQ(out[0].failure, "");
  EXPECT_NE(out[1].failure.find("poisson_ratio"), std::string::npos) << out[1].failure;
}

/// The whole way: data made by the program itself, found again from 12 and 5 % off.
TEST(SceneRuns, ParametersComeBack) {
  const test::TemporaryFolder folder;
  const RunScenes run = scene_runner({folder.path(), 0});
  const SceneOutcome made = run(coarse_runs({0.6e6}), {})[0];
  ASSERT_EQ(made.failure, "");
  SceneData curve;
  curve.scenes = {{"x", {}}};
  std::string deflections, loads;
  for (int k = 1; k <= 8; ++k) {
    curve.values.push_back({0, "load", "deflection", 1e-5 * k, "N"});
    deflections += (k > 1 ? ", " : "") + std::to_string(10 * k);
  }
  const Prediction read = readings_of(curve, {made});
  ASSERT_TRUE(read.ok()) << read.failure;
  for (const double x : read.values) loads += (loads.empty() ? "" : ", ") + std::to_string(x);
  std::string text = specification(R"("measured": "load", "deviation": 1,
      "values": {"deflection": {"unit": "um", "list": [)" +
                                   deflections + R"(]}, "load": [)" + loads + "]}");
  const std::string end = "]}";
  text.insert(text.size() - end.size(), R"(, {"name": "peak", "kind": "scene", "scene": )" +
                                            quoted((data / "scenes/scb.json").string()) + R"(, "set": )" + coarse +
                                            R"(, "deviation": 2, "points": [{"largest": )" +
                                            std::to_string(largest_load(made)) + "}]}");
  const Calibration c = calibrate(parse_specification(text, "spec.json"), {}, run);
  ASSERT_TRUE(c.result.usable()) << c.result.message;
  EXPECT_NEAR(c.parameters.young_modulus, 0.4e9, std::max(0.5 * c.result.standard_error[0], 1e6));
  EXPECT_NEAR(c.parameters.tensile_strength, 0.6e6, std::max(0.5 * c.result.standard_error[1], 3e3));
  EXPECT_LT(c.result.standard_error[0], 0.03 * 0.4e9);
  EXPECT_LT(c.result.standard_error[1], 0.05 * 0.6e6);
  ASSERT_TRUE(c.scenes);
  EXPECT_LT(c.scenes->runs, 60U);
  EXPECT_EQ(histories(folder.path()).size(), c.scenes->runs + 1);  // curve and peak share a run; and the truth
}

}  // namespace
}  // namespace fpz::calibration
