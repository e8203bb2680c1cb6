#include "fpz/specimen/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "fpz/energy.hpp"
#include "fpz/io/csv.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"
#include "fpz/specimen/summary.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

const fs::path scenes = fs::path(FPZ_DATA_DIR) / "scenes";

/// A small beam that cracks within about 3000 steps.
Scene small_beam(const Overrides& more = {}) {
  Overrides set = {"spacing=0.008",   "boundaries[0].velocity.y.speed=-0.05",
                   "stop.time=2e-3",  "output.history_rows=200",
                   "output.frames=4", "output.pictures=false"};
  set.insert(set.end(), more.begin(), more.end());
  return read_scene(scenes / "beam_3pb.json", set);
}

RunResult run(const Scene& scene, const fs::path& folder, long long steps = 0, bool resume = false) {
  RunRequest request;
  request.folder = folder;
  request.most_steps = steps;
  request.resume = resume;
  return run_scene(scene, request);
}

TEST(Run, CoarseBeamCracksAndBalances) {
  const Scene scene = small_beam();
  const fs::path folder = fpz::test::fresh_path("beam");
  const RunResult r = run(scene, folder);
  EXPECT_EQ(r.ending, Ending::finished) << r.reason;
  const fpz::io::Table t = fpz::io::read_csv(folder / "history.csv");
  for (const char* name : {"step", "time", "deflection", "load", "support", "cmod", "energy_external", "energy_elastic",
                           "energy_kinetic", "energy_fracture", "energy_viscous", "damaged_particles"}) {
    EXPECT_NE(t.find(name), nullptr) << name;
  }
  EXPECT_GT(t.at("damaged_particles").back(), 4.0);
  EXPECT_GT(t.at("cmod").back(), 0.0);
  const Findings f = findings(scene, r.history, 0.05, 0.0);
  EXPECT_GT(f.peak_load, 1500.0);
  EXPECT_LT(f.peak_load, 6000.0);
  EXPECT_LT(f.balance_error, 0.01);
  // The work of the load, from the load and the path of the loaded boundary, is the external work.
  double work = 0.0;
  const auto& load = t.at("load");
  const auto& path = t.at("load_point");
  for (std::size_t k = 1; k < load.size(); ++k) work += 0.5 * (load[k] + load[k - 1]) * (path[k] - path[k - 1]);
  EXPECT_NEAR(work, t.at("energy_external").back(), 0.03 * work);
  // Frames read back, the summary is there, nothing is left over.
  const auto frames = read_pvd(folder / "frames.pvd");
  ASSERT_GE(frames.size(), 5u);
  const PointCloud last = read_vtk(folder / frames.back().file);
  EXPECT_EQ(last.time, t.at("time").back());
  EXPECT_NEAR(static_cast<double>(fs::file_size(folder / frames.back().file)), frame_bytes(last.size()),
              0.05 * frame_bytes(last.size()));
  for (const char* name :
       {"damage", "crack_normal", "jump", "stress_xx", "velocity", "elastic_energy", "dissipated_energy"}) {
    EXPECT_NE(last.find(name), nullptr) << name;
  }
  EXPECT_NE(fpz::test::text_of(folder / "summary.json").find("\"fracture_energy_ratio\""), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "checkpoint.bin"));
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    EXPECT_NE(entry.path().filename().string()[0], '.');
}

/// The softening law of the material reaches the particles: those that open lie on Petersson's two lines.
TEST(Run, SofteningIsThatOfTheMaterial) {
  const Scene scene = small_beam({"material=../materials/bellego_mode1_bilinear.json", "output.frames=20"});
  const fs::path folder = fpz::test::fresh_path("bilinear_beam");
  const RunResult r = run(scene, folder);
  EXPECT_EQ(r.ending, Ending::finished) << r.reason;
  EXPECT_LT(findings(scene, r.history, 0.05, 0.0).balance_error, 0.01);
  EXPECT_NE(fpz::test::text_of(folder / "summary.json").find("\"softening\": \"bilinear\""), std::string::npos);
  int first_line = 0, second_line = 0;
  for (const Frame& frame : r.frames) {
    const PointCloud cloud = read_vtk(folder / frame.file);
    const std::vector<double>& damage = cloud.find("damage")->values;
    const std::vector<double>& jump = cloud.find("jump")->values;
    const std::vector<double>& normal = cloud.find("crack_normal")->values;
    for (std::size_t i = 0; i < damage.size(); ++i) {
      const double opening = jump[3 * i] * normal[3 * i] + jump[3 * i + 1] * normal[3 * i + 1];
      const double x = opening / scene.parameters.delta0;
      if (damage[i] <= 0.0 || damage[i] >= 1.0 || x <= 0.0) continue;
      const double w = x < 0.8 ? 1.0 - x / 1.2 : std::max(3.6 - x, 0.0) / 8.4;
      EXPECT_GE(damage[i], 1.0 - w - 1e-6);  // slip and unloading can only add to it
      if (damage[i] - (1.0 - w) < (x < 0.8 ? 2e-3 : 2e-2)) ++(x < 0.8 ? first_line : second_line);
    }
  }
  EXPECT_GT(first_line, 1);
  EXPECT_GT(second_line, 1);
}

/// Through cracking, so that every part of a checkpoint matters: gauges of all kinds, frames at deflections and at
/// parts of the peak load, a stop rule that needs the peak.
TEST(Run, ResumesBitForBit) {
  for (const char* configuration : {"reference", "updated"}) {
    const Scene scene =
        small_beam({std::string("method.configuration=") + configuration, "stop.load_below=0.6",
                    "output.frames_at=[5e-6, 1e-5]", R"(gauges.sigma={"stress": "xx", "of": {"point": [0, 0.02]}})"});
    const fs::path whole = fpz::test::fresh_path("whole"), parts = fpz::test::fresh_path("parts");
    (void)run(scene, whole);
    RunResult r = run(scene, parts, 137);
    EXPECT_EQ(r.ending, Ending::interrupted);
    int pieces = 1;
    for (; r.ending == Ending::interrupted && pieces < 50; ++pieces) r = run(scene, parts, 137, true);
    EXPECT_EQ(r.ending, Ending::finished) << r.reason;
    EXPECT_NE(r.reason.find("stop.load_below"), std::string::npos) << r.reason;
    EXPECT_GT(pieces, 3);
    EXPECT_GT(r.frames.size(), 7u);  // more than those at equal intervals
    EXPECT_EQ(fpz::test::text_of(parts / "history.csv"), fpz::test::text_of(whole / "history.csv"));
    EXPECT_EQ(fpz::test::text_of(parts / "frames.pvd"), fpz::test::text_of(whole / "frames.pvd"));
    for (const Frame& f : read_pvd(whole / "frames.pvd"))
      EXPECT_EQ(fpz::test::text_of(parts / f.file), fpz::test::text_of(whole / f.file));
    EXPECT_EQ(fpz::test::text_of(parts / "crack.csv"), fpz::test::text_of(whole / "crack.csv"));
  }
}

/// A run that has come to its end goes on to a later one as if it had been meant so, rows and frames at the distances
/// of its first end; without a checkpoint there is nothing to go on from.
TEST(Run, GoesOnToALaterEnd) {
  const auto scene = [](const std::string& time, const std::string& rows) {
    return small_beam({"stop.time=" + time, "output.history_rows=" + rows, "output.frames=0"});
  };
  const fs::path whole = fpz::test::fresh_path("to_the_end"), parts = fpz::test::fresh_path("to_a_later_end");
  (void)run(scene("1.6e-3", "160"), whole);
  RunRequest request;
  request.folder = parts;
  request.keep_checkpoint = true;
  (void)run_scene(scene("0.8e-3", "80"), request);
  EXPECT_TRUE(fs::exists(parts / "summary.json"));
  request.resume = true;
  request.keep_checkpoint = false;
  const RunResult r = run_scene(scene("1.6e-3", "80"), request);
  EXPECT_EQ(r.ending, Ending::finished);
  EXPECT_EQ(fpz::test::text_of(parts / "history.csv"), fpz::test::text_of(whole / "history.csv"));
  EXPECT_FALSE(fs::exists(parts / "checkpoint.bin"));
  EXPECT_THROW((void)run_scene(scene("1.6e-3", "80"), request), fpz::io::InputError);
}

TEST(Run, ResumeRefusesWhatDoesNotBelong) {
  const Scene scene = small_beam({"stop.time=6e-4"});
  const fs::path folder = fpz::test::fresh_path("refuse");
  EXPECT_THROW((void)run(scene, folder, 0, true), fpz::io::InputError);  // nothing there
  (void)run(scene, folder, 50);
  EXPECT_THROW((void)run(small_beam({"stop.time=6e-4", "method.courant=0.4"}), folder, 50, true), fpz::io::InputError);
  EXPECT_THROW((void)run(scene, folder, 50), fpz::io::OutputError);  // files in the way
  std::string bytes = fpz::test::text_of(folder / "checkpoint.bin");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder / "checkpoint.bin", std::ios::binary) << bytes;
  EXPECT_THROW((void)run(scene, folder, 50, true), fpz::io::InputError);
}

TEST(Run, StopsWhenToldTo) {
  const RunResult deflection = run(small_beam({"stop.deflection=1e-5"}), fpz::test::fresh_path("deflection"));
  EXPECT_NE(deflection.reason.find("stop.deflection"), std::string::npos);
  EXPECT_GE(deflection.history.last("deflection"), 1e-5);
  const RunResult drop = run(small_beam({"stop.load_below=0.9"}), fpz::test::fresh_path("drop"));
  EXPECT_NE(drop.reason.find("stop.load_below"), std::string::npos);
}

TEST(Run, AnExplodingRunSaysSo) {
  const RunResult r = run(small_beam({"boundaries[0].velocity.y={\"speed\": -4000}", "stop={\"time\": 2e-3}"}),
                          fpz::test::fresh_path("explodes"));
  EXPECT_EQ(r.ending, Ending::failed);
  EXPECT_NE(r.reason.find("particle"), std::string::npos);
}

TEST(Summary, WarnsWithoutBeingAsked) {
  const Scene scene = small_beam({"method.damping=0.1", "method.mass_scale=4"});
  History h;
  h.columns = {
      "deflection",      "load",           "support",      "energy_external", "energy_elastic",      "energy_kinetic",
      "energy_fracture", "energy_damping", "energy_error", "energy_viscous",  "failing_out_of_plane"};
  for (int k = 0; k <= 20; ++k) {
    const double u = 1e-6 * k;
    h.values.insert(h.values.end(), {u, 1e8 * u, 0.9e8 * u, 1.0, 0.5, 0.1, 0.1, 0.2, 0.05, 0.0, 0.0});
  }
  const Findings f = findings(scene, h, 0.0, 0.0);
  EXPECT_NEAR(f.stiffness, 1e8, 1.0);
  EXPECT_TRUE(std::isnan(f.fracture_energy_ratio));
  EXPECT_NEAR(f.imbalance, 0.1, 1e-9);
  std::string all;
  for (const std::string& w : warnings_of(scene, h, f)) all += w + "\n";
  for (const char* expected : {"still rising", "not quasi-static", "load and support differ", "balance drifts",
                               "local damping", "mass_scale"}) {
    EXPECT_NE(all.find(expected), std::string::npos) << expected << "\n" << all;
  }
}

/// A history of four rows: external work, elastic, kinetic, fracture and viscous energy of each.
History energies(const std::vector<std::array<double, 5>>& rows) {
  History h;
  h.columns = {
      "deflection",      "load",           "support",      "energy_external",     "energy_elastic", "energy_kinetic",
      "energy_fracture", "energy_viscous", "energy_error", "failing_out_of_plane"};
  double u = 0.0;
  for (const auto& [work, elastic, kinetic, fracture, viscous] : rows) {
    const double load = u < 2.5e-6 ? 1e8 * u : 0.0;
    h.values.insert(h.values.end(), {u, load, load, work, elastic, kinetic, fracture, viscous,
                                     work - elastic - kinetic - fracture - viscous, 0.0});
    u += 1e-6;
  }
  return h;
}

std::string warnings(const Scene& scene, const History& h, const Findings& f) {
  std::string all;
  for (const std::string& w : warnings_of(scene, h, f)) all += w + "\n";
  return all;
}

TEST(Summary, GaugesThatGoTheWrongWayAreNamed) {
  const Scene scene = small_beam({});
  History h = energies({{0, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {4, 4, 0, 0, 0}, {4, 0, 0, 4, 0}});
  EXPECT_EQ(warnings(scene, h, findings(scene, h, 0.0, 0.0)).find("wrong way"), std::string::npos);
  for (std::size_t r = 0; r < h.rows(); ++r) h.values[r * h.columns.size() + 1] *= -1.0;  // the load
  const std::string said = warnings(scene, h, findings(scene, h, 0.0, 0.0));
  EXPECT_NE(said.find("gauges.load.direction: the load falls to -200 and rises to 0 only"), std::string::npos) << said;
  EXPECT_EQ(said.find("gauges.deflection"), std::string::npos) << said;
}

/// Bonded platens confine a plate; in plane stress the stress across it is the largest there.
TEST(Run, PlanesOutOfThePlaneAreSaid) {
  const auto said = [](const char* setting) {
    const Scene scene =
        read_scene(scenes / "uniaxial_compression.json", {"spacing=0.005", "output.frames=0", "output.pictures=false",
                                                          "stop.time=0.003", std::string("setting=") + setting});
    std::string all;
    for (const std::string& w : run(scene, fpz::test::fresh_path(setting)).warnings) all += w + "\n";
    return all;
  };
  const std::string stress = said("plane_stress"), strain = said("plane_strain");
  EXPECT_NE(stress.find("setting = \"plane_stress\": up to "), std::string::npos) << stress;
  EXPECT_NE(stress.find("particles would have cracked on planes inclined out of the plane"), std::string::npos);
  EXPECT_EQ(strain.find("out of the plane"), std::string::npos) << strain;
}

TEST(Summary, MoreMotionThanWorkIsACollapse) {
  const Scene scene = small_beam({});
  const History calm = energies({{0, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {4, 4, 0, 0, 0}, {4, 0, 1.5, 0.5, 2}});
  EXPECT_EQ(warnings(scene, calm, findings(scene, calm, 0.0, 0.0)).find("brittle collapse"), std::string::npos);
  const History wild = energies({{0, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {4, 4, 0, 0, 0}, {4, -2, 3, 1, 2}});
  EXPECT_NE(warnings(scene, wild, findings(scene, wild, 0.0, 0.0)).find("brittle collapse"), std::string::npos);
}

TEST(Summary, LessThanNothingStoredIsAnErrorOfTheModel) {
  const Scene scene = small_beam({"material.cohesive_zone=published"});
  const History sound = energies({{0, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {4, 3, 0, 1, 0}, {4, 0, 0, 4, 0}});
  EXPECT_EQ(error_of_the_model(scene, findings(scene, sound, 0.0, 0.0)), "");
  const History negative = energies({{0, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {4, 3, 0, 1, 0}, {4, -0.1, 0, 4.1, 0}});
  const std::string error = error_of_the_model(scene, findings(scene, negative, 0.0, 0.0));
  EXPECT_NE(error.find("-2.5 % of the external work"), std::string::npos) << error;
  EXPECT_NE(error.find("\"cohesive_zone\": \"consistent\""), std::string::npos) << error;
}

TEST(Summary, FractureFarFromGIsSaid) {
  const Scene scene = small_beam({});
  const double area = 0.05 * scene.thickness;
  const double g = scene.parameters.tensile_strength * scene.parameters.delta0;
  const auto said = [&](double ratio) {
    const double fracture = ratio * area * g;
    const History h = energies({{0, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {4, 3, 0, 1, 0}, {4, 0, 0, fracture, 0}});
    return warnings(scene, h, findings(scene, h, 0.05, 0.0)).find("of crack area times G") != std::string::npos;
  };
  EXPECT_TRUE(said(0.5));
  EXPECT_FALSE(said(0.9));
  EXPECT_FALSE(said(1.2));
  EXPECT_TRUE(said(1.5));
}

}  // namespace
