// How runs get through their loading: the same results at another pace, and what each solver promises.
#include <gtest/gtest.h>

#include <cmath>

#include "fpz/io/csv.hpp"
#include "fpz/io/input_error.hpp"
#include "run_to_end.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
using fpz::test::run_to_end;
namespace fs = std::filesystem;

/// A plate 40 x 20 mm too strong to crack, pulled slowly at one end, 2 mm particles.
std::string pulled(const std::string& drive, const std::string& more) {
  return R"({"material": {"young_modulus": 50e9, "poisson_ratio": 0.25, "density": 2500, "tensile_strength": 1e9,
    "cohesion": 1e10, "friction_angle_deg": 40, "dilation_angle_deg": 10, "normal_stiffness": 1e14,
    "shear_stiffness": 1e14, "delta0": 1e-3}, "setting": "plane_strain", "thickness": 0.05, "spacing": 0.002,
    "shape": {"type": "rectangle", "low": [-0.02, -0.01], "high": [0.02, 0.01]},
    "boundaries": [{"name": "left", "at": [-0.02, 0], "direction": [-1, 0], "width": 0.02, "velocity": {"x": 0}},
      {"name": "right", "at": [0.02, 0], "direction": [1, 0], "width": 0.02, )" +
         drive + R"(}],
    "gauges": {"load": {"force_on": "right", "direction": [1, 0]},
      "deflection": {"displacement_of": "right", "direction": [1, 0]}},
    "output": {"frames": 0, "pictures": false, "history_rows": 100, "checkpoint_seconds": 0}, )" +
         more + "}";
}

RunResult run(const std::string& text, const std::string& folder) {
  return run_to_end(parse_scene(text, "/elsewhere/scene.json"), fpz::test::fresh_path(folder));
}

std::string complaint(const std::string& text) {
  try {
    (void)parse_scene(text, "/elsewhere/scene.json");
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
  return "";
}

double value_at(const History& h, const char* column, double time) {
  for (std::size_t k = 0; k < h.rows(); ++k) {
    if (h.at(k, "time") >= time) return h.at(k, column);
  }
  return h.last(column);
}

const std::string tables[] = {R"("velocity": {"x": {"table": [[0, 0], [1e-3, 0.01], [3e-3, 0.01]]}})",
                              R"("displacement": {"x": {"table": [[0, 0], [3e-3, 3e-5]], "smooth": true}})",
                              R"("force": {"x": {"table": [[0, 0], [3e-3, 6e4]], "smooth": true}})"};

/// Elastic and slow: whatever the pace, the same curve over the time of the loading, in fewer steps.
TEST(Solver, AnotherPaceIsTheSameTestInOtherTime) {
  for (const std::string& table : tables) {
    const std::string stop = R"("stop": {"time": 3e-3})";
    const RunResult slow = run(pulled(table, stop), "pace_1");
    const RunResult fast = run(pulled(table, R"("solver": {"type": "dynamic", "pace": 4}, )" + stop), "pace_4");
    ASSERT_EQ(slow.ending, Ending::finished) << slow.reason;
    ASSERT_EQ(fast.ending, Ending::finished) << fast.reason;
    EXPECT_LT(fast.history.last("step"), 0.4 * slow.history.last("step"));
    EXPECT_NEAR(fast.history.last("time"), 3e-3, 3e-5) << "within a row";
    const double scale = slow.history.last("load");
    for (const double time : {0.5e-3, 1e-3, 1.5e-3, 2e-3, 2.5e-3}) {
      EXPECT_NEAR(value_at(fast.history, "load", time), value_at(slow.history, "load", time), 0.03 * scale) << table;
      EXPECT_NEAR(value_at(fast.history, "deflection", time), value_at(slow.history, "deflection", time),
                  0.03 * slow.history.last("deflection"))
          << table;
    }
    EXPECT_LT(std::abs(fast.history.last("energy_error")), 2e-3 * fast.history.last("energy_external"));
  }
}

/// Rows are as many and at the same times of the loading; the kinetic energy is as the square of the pace.
TEST(Solver, RowsAndKineticEnergyFollowThePace) {
  const std::string stop = R"("stop": {"time": 3e-3})";
  const RunResult slow = run(pulled(tables[0], stop), "rows_1");
  const RunResult fast = run(pulled(tables[0], R"("solver": {"type": "dynamic", "pace": 3}, )" + stop), "rows_3");
  EXPECT_NEAR(static_cast<double>(fast.history.rows()), static_cast<double>(slow.history.rows()), 2.0);
  double ratio = 0.0, rows = 0.0;
  for (double time = 2e-3; time < 2.9e-3; time += 1e-4, ++rows) {
    ratio += value_at(fast.history, "energy_kinetic", time) / value_at(slow.history, "energy_kinetic", time);
  }
  EXPECT_NEAR(ratio / rows, 9.0, 1.5);
}

TEST(Solver, AServoKeepsItsRateInTheTimeOfTheLoading) {
  const std::string servo = R"("velocity": {"x": {"servo": "deflection", "rate": 0.01, "speed": 0.01, "ramp": 5e-4}})";
  const RunResult r =
      run(pulled(servo, R"("solver": {"type": "dynamic", "pace": 3}, "stop": {"time": 4e-3})"), "servo_3");
  ASSERT_EQ(r.ending, Ending::finished) << r.reason;
  const double grown = value_at(r.history, "deflection", 3.9e-3) - value_at(r.history, "deflection", 2e-3);
  EXPECT_NEAR(grown / 1.9e-3, 0.01, 0.03 * 0.01);
}

TEST(Solver, RelaxationRestsInEquilibria) {
  const std::string solver =
      R"("solver": {"type": "relaxation", "increment": 5e-4, "kinetic_part": 1e-7, "fastest": 2}, )";
  const RunResult r = run(pulled(tables[1], solver + R"("stop": {"time": 3e-3})"), "relaxation");
  ASSERT_EQ(r.ending, Ending::finished) << r.reason;
  const History& h = r.history;
  ASSERT_GE(h.rows(), 6U);
  // Every row is a state of rest: load and energy are those of one stiffness.
  const double stiffness = h.last("load") / h.last("deflection");
  for (std::size_t k = 1; k < h.rows(); ++k) {
    EXPECT_NEAR(h.at(k, "load"), stiffness * h.at(k, "deflection"), 2e-3 * h.last("load"));
    EXPECT_NEAR(h.at(k, "energy_elastic"), 0.5 * h.at(k, "load") * h.at(k, "deflection"),
                0.01 * h.last("energy_elastic"));
  }
}

TEST(Solver, AdaptiveGoesAsFastAsItsKineticEnergyAllows) {
  const std::string stop = R"("stop": {"time": 0.02})";
  const std::string slow_drive = R"("velocity": {"x": {"speed": 0.001, "ramp": 1e-3}})";
  const RunResult r =
      run(pulled(slow_drive, R"("solver": {"type": "adaptive", "kinetic_part": 1e-3, "fastest": 100}, )" + stop),
          "adaptive");
  const RunResult plain = run(pulled(slow_drive, R"("stop": {"time": 5e-3})"), "not_adaptive");
  ASSERT_EQ(r.ending, Ending::finished) << r.reason;
  EXPECT_LT(r.history.last("step"), 0.5 * 4.0 * plain.history.last("step"));
  for (double time = 5e-3; time < 0.02; time += 1e-3) {
    EXPECT_LT(value_at(r.history, "energy_kinetic", time), 4e-3 * value_at(r.history, "energy_elastic", time));
  }
  const double stiffness = plain.history.last("load") / plain.history.last("deflection");
  EXPECT_NEAR(r.history.last("load"), stiffness * r.history.last("deflection"), 0.05 * r.history.last("load"));
}

/// The coarse beam: peak and work as in a slow run, and what it says of them is so.
TEST(Solver, ConvergedComesToTheSlowLimit) {
  const fpz::specimen::Overrides coarse = {"spacing=0.008", "stop={\"time\": 0.02, \"deflection\": 5e-5}",
                                           "output.frames=0", "output.pictures=false"};
  const auto scene = [&](const char* solver) {
    Overrides set = coarse;
    set.emplace_back(std::string("solver=") + solver);
    return read_scene(fs::path(FPZ_DATA_DIR) / "scenes" / "beam_3pb.json", set);
  };
  const auto peak = [](const RunResult& r) {
    double p = 0.0;
    for (std::size_t k = 0; k < r.history.rows(); ++k) p = std::max(p, r.history.at(k, "load"));
    return p;
  };
  const RunResult slow = run_to_end(scene(R"({"type": "dynamic", "pace": 0.5})"), fpz::test::fresh_path("slow"));
  const fs::path folder = fpz::test::fresh_path("converged");
  const RunResult r = run_to_end(scene(R"({"type": "converged", "tolerance": 0.03})"), folder);
  ASSERT_EQ(r.ending, Ending::finished) << r.reason;
  EXPECT_NEAR(peak(r), peak(slow), 0.03 * peak(slow));
  ASSERT_GE(r.convergence.size(), 2U);
  EXPECT_LE(r.convergence.back().change_of_peak, 0.03);
  EXPECT_LE(r.convergence.back().change_of_work, 0.03);
  EXPECT_NEAR(r.convergence.back().pace, 0.5 * r.convergence[r.convergence.size() - 2].pace, 1e-12);
  EXPECT_EQ(fpz::io::read_csv(folder / "convergence.csv").at("pace").size(), r.convergence.size());
  EXPECT_TRUE(fs::exists(folder / "history_1.csv"));
  // The first one is too fast to be right, or nothing would be shown.
  EXPECT_GT(std::abs(r.convergence.front().peak_load / peak(slow) - 1.0), 0.03);

  // Interrupted again and again: the same runs to the last bit.
  const RunResult pieces =
      run_to_end(scene(R"({"type": "converged", "tolerance": 0.03})"), fpz::test::fresh_path("converged_pieces"), 700);
  ASSERT_EQ(pieces.convergence.size(), r.convergence.size());
  EXPECT_EQ(pieces.convergence.back().peak_load, r.convergence.back().peak_load);
  EXPECT_EQ(pieces.convergence.back().change_of_work, r.convergence.back().change_of_work);
  EXPECT_EQ(pieces.history.values, r.history.values);

  const RunResult impossible =
      run_to_end(scene(R"({"type": "converged", "tolerance": 1e-9, "slowest": 4})"), fpz::test::fresh_path("never"));
  EXPECT_EQ(impossible.ending, Ending::failed);
  EXPECT_NE(impossible.reason.find("not converged"), std::string::npos) << impossible.reason;
}

TEST(Solver, SlipsAreNamed) {
  const std::string stop = R"(, "stop": {"time": 3e-3})";
  EXPECT_NE(complaint(pulled(tables[0], R"("solver": "convergd")" + stop)).find("converged"), std::string::npos);
  EXPECT_NE(complaint(pulled(tables[0], R"("solver": {"pace": 2})" + stop)).find("type"), std::string::npos);
  EXPECT_NE(complaint(pulled(tables[0], R"("solver": {"type": "dynamic", "tolerance": 0.1})" + stop)).find("tolerance"),
            std::string::npos);
  EXPECT_NE(complaint(pulled(tables[0], R"("solver": {"type": "dynamic", "pace": 0})" + stop)).find("pace"),
            std::string::npos);
  EXPECT_NE(complaint(pulled(tables[0], R"("solver": {"type": "adaptive", "slowest": 30, "fastest": 20})" + stop))
                .find("slowest"),
            std::string::npos);
  const std::string servo = R"("velocity": {"x": {"servo": "deflection", "rate": 0.01, "speed": 0.01}})";
  EXPECT_NE(complaint(pulled(servo, R"("solver": "relaxation")" + stop)).find("servo"), std::string::npos);
}

}  // namespace
