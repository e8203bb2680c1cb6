#include "fpz/specimen/sweep.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "fpz/io/csv.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"
#include "fpz/specimen/run.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

const fs::path data = FPZ_DATA_DIR;

fs::path fresh(const std::string& name) {
  const fs::path f = fpz::test::fresh_path(name);
  fs::create_directories(f);
  return f;
}

fs::path write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file;
}

/// Two speeds and two moduli of a coarse elastic beam: about 600 steps each.
fs::path small_sweep(const fs::path& folder, const std::string& values = "[-0.05, -0.1]") {
  return write(folder / "sweep.json", R"({
  "name": "small",
  "scene": ")" + (data / "scenes/beam_3pb.json").string() +
                                          R"(",
  "set": {"spacing": 0.008, "stop": {"time": 4e-4}, "output": {"history_rows": 50, "frames": 1, "pictures": false}},
  "parameter": {"name": "speed", "unit": "m/s", "path": "boundaries[0].velocity.y.speed", "values": )" +
                                          values + R"(},
  "series": [{"name": "plane strain"}, {"name": "plane stress", "set": {"setting": "plane_stress"}}]
})");
}

SweepResult run(const Sweep& sweep, const fs::path& folder, bool force = false) {
  SweepRequest request;
  request.folder = folder;
  request.jobs = 2;
  request.force = force;
  request.pictures = false;
  return run_sweep(sweep, request);
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(SweepFile, AllProblemsAreReportedWithTheirPlaces) {
  const fs::path file = write(fresh("problems") / "bad.json", R"({
  "scene": "x.json",
  "parametre": 1,
  "parameter": {"name": "angle", "values": [30, {"label": "a,b", "set": {}}, [1]]},
  "series": [{"set": {"spacing": 0.001}}],
  "references": [{"name": "r", "file": "none.csv", "x": "a", "y": "peak_lode"}],
  "pictures": [{"y": "peak_load", "curves": true}, {"x": "K_I"}, {"maps": 1}]
})");
  std::string what;
  try {
    (void)read_sweep(file);
  } catch (const fpz::io::InputError& e) {
    what = e.what();
  }
  for (const char* expected :
       {"bad.json:3: parametre: unknown key \"parametre\"; did you mean \"parameter\"?",
        "bad.json:4: parameter.values[0]: needs the \"path\" of the parameter",
        "parameter.values[1].label: \"a,b\": must have no comma", "parameter.values[1].set: the object is empty",
        "parameter.values[2]: expected a number", "bad.json:5: series[0]: missing key \"name\"",
        "references[0].y: unknown choice \"peak_lode\"; did you mean \"peak_load\"?", "references[0].file: ",
        "pictures[0]: needs one of", "pictures[1]: needs one of", "pictures[2].maps: expected true or false"}) {
    EXPECT_NE(what.find(expected), std::string::npos) << expected << "\nin\n" << what;
  }
}

TEST(SweepFile, ProblemsOfTheScenesNameTheRunOnce) {
  const fs::path folder = fresh("scene_problems");
  std::string what;
  try {
    (void)read_sweep(small_sweep(folder), {"method.courrant=1"});
  } catch (const fpz::io::InputError& e) {
    what = e.what();
  }
  const auto first = what.find("did you mean \"courant\"?");
  EXPECT_NE(what.find("plane_strain/-0.05"), std::string::npos) << what;
  ASSERT_NE(first, std::string::npos) << what;
  EXPECT_EQ(what.find("did you mean \"courant\"?", first + 1), std::string::npos) << what;
  EXPECT_THROW((void)read_sweep(small_sweep(folder, "[-0.1, -0.1]")), fpz::io::InputError);  // one folder for two
  EXPECT_THROW((void)read_sweep(small_sweep(folder), {"boundaries[0].velocity.y.speed=1"}), fpz::io::InputError);
}

TEST(SweepFile, EntriesApplyInTheirOrder) {
  const fs::path folder = fresh("order");
  const Sweep sweep = read_sweep(small_sweep(folder, R"([-0.05, {"label": "fine", "value": 3,
      "set": {"spacing": 0.004, "boundaries[0].velocity.y.speed": -0.2}}])"),
                                 {"stop.time=2e-4"});
  ASSERT_EQ(sweep.runs.size(), 4u);
  EXPECT_EQ(sweep.runs[0].scene.stop.time, 2e-4);
  EXPECT_EQ(sweep.runs[0].scene.spacing, 0.008);
  EXPECT_EQ(sweep.runs[0].scene.boundaries[0].drive[1]->course.value, -0.05);
  EXPECT_EQ(sweep.runs[0].value, -0.05);
  EXPECT_EQ(sweep.runs[3].scene.spacing, 0.004);
  EXPECT_EQ(sweep.runs[3].scene.boundaries[0].drive[1]->course.value, -0.2);
  EXPECT_EQ(sweep.runs[3].scene.setting, fpz::Setting::plane_stress);
  EXPECT_EQ(sweep.runs[3].value, 3.0);
  EXPECT_EQ(sweep.runs[3].folder, fs::path("plane_stress/fine"));
}

TEST(SweepFile, AllReadySweepsAreValid) {
  for (const fs::directory_entry& file : fs::directory_iterator(data / "sweeps")) {
    EXPECT_FALSE(read_sweep(file.path()).runs.empty()) << file.path();
  }
}

TEST(SweepFile, TheSweepsOfThePaperMeanWhatTheySay) {
  const Sweep angles = read_sweep(data / "sweeps/scb_angles.json", {"spacing=0.002"});
  ASSERT_EQ(angles.runs.size(), 13u);
  EXPECT_EQ(angles.runs[11].value, 54.0);
  const SweepRun& leaning = angles.runs[6];
  EXPECT_NEAR(leaning.scene.body.notches[0].tip[0], -0.0083, 1e-9);
  EXPECT_EQ(angles.references.at(1).x, "K_I");
  const Sweep updated = read_sweep(data / "sweeps/scb_updated.json", {"spacing=0.002"});
  ASSERT_EQ(updated.runs.size(), 10u);
  EXPECT_EQ(updated.runs.front().scene.options.artificial_stress, 0.2);
  EXPECT_EQ(updated.runs.back().scene.options.artificial_stress, 0.0);
  const Sweep rings = read_sweep(data / "sweeps/ring_diameters.json", {"spacing=0.002"});
  ASSERT_EQ(rings.runs.size(), 6u);
  EXPECT_NEAR(std::get<Ring>(rings.runs[5].scene.body.shape).inner, 0.0125, 1e-12);
}

TEST(Sweep, EveryRunIsThatOfItsScene) {
  const fs::path folder = fresh("runs");
  const Sweep sweep = read_sweep(small_sweep(folder));
  // Its history is the one that the scene gives by itself. With threads, and first: the processes of the sweep must not
  // wait for threads that only this process has.
  RunRequest alone;
  alone.folder = folder / "alone";
  alone.threads = 2;
  (void)run_scene(sweep.runs[3].scene, alone);
  const SweepResult result = run(sweep, folder / "out");
  EXPECT_EQ(result.count(RunStatus::finished), 4u);
  EXPECT_EQ(fpz::test::text_of(folder / "alone/history.csv"),
            fpz::test::text_of(folder / "out/plane_stress/-0.1/history.csv"));
  // The table has the figures of the histories, in the order of the sweep.
  const fpz::io::Table t = fpz::io::read_csv(folder / "out/sweep.csv");
  ASSERT_EQ(t.rows(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const fpz::io::Table h = fpz::io::read_csv(folder / "out" / sweep.runs[k].folder / "history.csv");
    const auto& load = h.at("load");
    EXPECT_EQ(t.at("peak_load")[k], *std::max_element(load.begin(), load.end()));
    EXPECT_EQ(t.at("energy_external")[k], h.at("energy_external").back());
    EXPECT_EQ(t.at("value")[k], sweep.runs[k].value);
    EXPECT_TRUE(std::isnan(t.at("K_I")[k]));
  }
  const auto lines = lines_of(folder / "out/sweep.csv");
  EXPECT_EQ(lines[0],
            "series,value,label,status,peak_load,deflection_at_peak,stiffness,fracture_energy_ratio,crack_area,"
            "energy_balance_error,kinetic_over_internal,load_support_imbalance,energy_external,energy_fracture,K_I,"
            "K_II,particles,steps,wall_seconds,warnings,folder");
  EXPECT_EQ(lines[4].rfind("plane stress,-0.1,-0.1,finished,", 0), 0u) << lines[4];
  // Twice the speed, twice the work at the same force per displacement: four times.
  EXPECT_NEAR(t.at("energy_external")[1], 4.0 * t.at("energy_external")[0], 0.05 * t.at("energy_external")[1]);
}

TEST(Sweep, NothingThatIsDoneIsRepeated) {
  const fs::path folder = fresh("again"), out = folder / "out";
  const Sweep sweep = read_sweep(small_sweep(folder));
  (void)run(sweep, out);
  const auto written = fs::last_write_time(out / "plane_strain/-0.1/history.csv");
  fs::remove_all(out / "plane_stress/-0.1");
  const SweepResult again = run(sweep, out);
  EXPECT_EQ(again.count(RunStatus::finished), 4u);
  EXPECT_TRUE(again.rows[1].kept);
  EXPECT_FALSE(again.rows[3].kept);
  EXPECT_EQ(fs::last_write_time(out / "plane_strain/-0.1/history.csv"), written);
  // Another scene is refused, or replaced when that is wished.
  const Sweep other = read_sweep(small_sweep(folder), {"thickness=0.08"});
  EXPECT_THROW((void)run(other, out), fpz::io::OutputError);
  const double before = again.rows[0].figures[1];
  EXPECT_NEAR(run(other, out, true).rows[0].figures[1], 2.0 * before, 1e-9 * before);
}

TEST(Sweep, AnInterruptedOneGoesOnBitForBit) {
  const fs::path folder = fresh("interrupted");
  const Sweep sweep = read_sweep(small_sweep(folder), {"spacing=0.004", "output.checkpoint_seconds=0"});
  volatile std::sig_atomic_t stop = 0;
  SweepRequest request;
  request.folder = folder / "out";
  request.jobs = 2;
  request.pictures = false;
  request.interrupt = &stop;
  request.progress = [&](const SweepProgress& p) { stop = p.remaining > 0.0 ? 1 : 0; };  // once the first is under way
  const SweepResult first = run_sweep(sweep, request);
  EXPECT_GT(first.count(RunStatus::interrupted), 0u);
  EXPECT_EQ(first.count(RunStatus::failed), 0u);
  EXPECT_TRUE(fs::exists(folder / "out/plane_strain/-0.05/checkpoint.bin"));
  EXPECT_EQ(run(sweep, folder / "out").count(RunStatus::finished), 4u);
  (void)run(sweep, folder / "whole");
  for (const SweepRun& r : sweep.runs) {
    EXPECT_EQ(fpz::test::text_of(folder / "out" / r.folder / "history.csv"),
              fpz::test::text_of(folder / "whole" / r.folder / "history.csv"));
  }
}

TEST(Sweep, AFailedRunDoesNotStopTheOthers) {
  const fs::path folder = fresh("failed"), out = folder / "out";
  const Sweep sweep = read_sweep(small_sweep(folder, R"([{"label": "explodes", "set":
      {"boundaries[0].velocity.y": {"speed": -4000}}}, -0.1])"));
  fs::create_directories(out / "plane_stress");
  write(out / "plane_stress/-0.1", "a file where a folder should be");
  const SweepResult result = run(sweep, out);
  EXPECT_EQ(result.rows[0].status, RunStatus::failed);
  EXPECT_NE(result.rows[0].reason.find("particle"), std::string::npos) << result.rows[0].reason;
  EXPECT_EQ(result.rows[1].status, RunStatus::finished);
  EXPECT_EQ(result.rows[2].status, RunStatus::failed);
  EXPECT_EQ(result.rows[3].status, RunStatus::failed);
  EXPECT_NE(result.rows[3].reason.find("-0.1"), std::string::npos) << result.rows[3].reason;
  EXPECT_TRUE(std::isnan(result.rows[3].figures[1]));
  EXPECT_NE(lines_of(out / "sweep.csv")[1].find("plane strain,nan,explodes,failed,"), std::string::npos);
  // What failed for a reason of its own would fail again; only --force repeats it.
  EXPECT_TRUE(run(sweep, out).rows[0].kept);
  EXPECT_FALSE(run(sweep, out, true).rows[0].kept);
}

}  // namespace
