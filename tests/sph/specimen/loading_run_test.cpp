// Runs of scenes under forces and pressures, stage by stage, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/run.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

/// A plate 40 x 20 mm of marble too strong to crack, 2 mm particles.
std::string plate(const std::string& more, const std::string& shape = R"({"type": "rectangle", "low": [-0.02, -0.01],
  "high": [0.02, 0.01]})") {
  return R"({"material": {"young_modulus": 50e9, "poisson_ratio": 0.25, "density": 2500, "tensile_strength": 1e9,
    "cohesion": 1e10, "friction_angle_deg": 40, "dilation_angle_deg": 10, "normal_stiffness": 1e14,
    "shear_stiffness": 1e14, "delta0": 1e-3}, "setting": "plane_strain", "thickness": 0.05, "spacing": 0.002,
    "shape": )" +
         shape + ", " + more + "}";
}

RunResult run(const std::string& text, const std::string& folder, long long steps = 0, bool resume = false) {
  RunRequest request;
  request.folder = resume ? fs::path(folder) : fpz::test::fresh_path(folder);
  request.most_steps = steps;
  request.threads = 1;
  return run_scene(parse_scene(text, "/elsewhere/scene.json"), request);
}

std::string complaint(const std::string& text) {
  try {
    (void)make_specimen(parse_scene(text, "/elsewhere/scene.json"));
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
  return "";
}

const std::string roller = R"("boundaries": [{"name": "left", "at": [-0.02, 0], "direction": [-1, 0], "width": 0.02,
  "velocity": {"x": 0}}],)";
const std::string gauges = R"("gauges": {"load": {"force_on": "left", "direction": [1, 0]},
  "deflection": {"displacement_of": {"point": [0.019, 0]}, "relative_to": "left", "direction": [-1, 0]},
  "sxx": {"stress": "xx", "of": {"point": [0, 0], "radius": 0.003}},
  "syy": {"stress": "yy", "of": {"point": [0, 0], "radius": 0.003}}},)";

/// A pressure on one end and on both sides of a plate on a roller: even stresses, and the roller carries the end.
TEST(LoadingRun, PressuresMakeTheStressesOfTheClosedForm) {
  for (const char* configuration : {"reference", "updated"}) {
    const std::string text =
        plate(roller + gauges + R"("loads": [
      {"name": "end", "on": {"low": [0.02, -0.01], "high": [0.02, 0.01]}, "pressure": {"value": 20e6, "ramp": 2e-4}},
      {"name": "sides", "on": [{"low": [-0.02, 0.01], "high": [0.02, 0.01]}, {"low": [-0.02, -0.01], "high": [0.02, -0.01]}],
       "pressure": {"value": 5e6, "ramp": 2e-4}}],
      "method": {"damping": 0.3, "configuration": ")" +
              configuration +
              R"("}, "stop": {"time": 4e-4}, "output": {"frames": 0, "pictures": false, "history_rows": 100})");
    const RunResult r = run(text, std::string("pressed_") + configuration);
    ASSERT_EQ(r.ending, Ending::finished) << r.reason;
    const History& h = r.history;
    EXPECT_NEAR(h.last("sxx"), -20e6, 0.01 * 20e6) << configuration;
    EXPECT_NEAR(h.last("syy"), -5e6, 0.02 * 5e6) << configuration;
    EXPECT_NEAR(h.last("load"), 20e6 * 0.02 * 0.05, 2e-3 * 20e3);
    EXPECT_LT(std::abs(h.last("energy_error")), 2e-3 * h.last("energy_external"));
    // The stored energy of even stresses, per volume; the roller's rows are extra.
    const double nu = 0.25, e = 50e9, a = 20e6, b = 5e6, z = nu * (a + b);
    const double density = (a * a + b * b + z * z - 2.0 * nu * (a * b + b * z + z * a)) / (2.0 * e);
    EXPECT_NEAR(h.last("energy_elastic"), density * 0.04 * 0.02 * 0.05, 0.12 * h.last("energy_elastic"));
  }
}

TEST(LoadingRun, WhatIsWrongWithALoadIsNamed) {
  const auto said = [](const std::string& load) {
    return complaint(plate(roller + gauges + R"("stop": {"time": 1e-4}, "loads": [{"name": "p", )" + load + "}]"));
  };
  const std::string all = R"("on": "all", )", pressure = R"("pressure": {"value": 1e6, "ramp": 1e-3})";
  EXPECT_EQ(said(all + pressure), "");
  EXPECT_NE(said(R"("on": "all")").find("loads[0]: needs one of \"pressure\""), std::string::npos);
  EXPECT_NE(said(all + R"("pressure": 1e6)").find("loads[0].pressure: would act at once"), std::string::npos);
  EXPECT_NE(said(pressure).find("loads[0]: missing key \"on\""), std::string::npos);
  EXPECT_NE(said(R"("on": "left", )" + pressure).find("unknown choice \"left\""), std::string::npos);
  EXPECT_NE(said(R"("on": {"hole": 0}, )" + pressure).find("loads[0].on.hole: the body has no holes"),
            std::string::npos);
  EXPECT_NE(said(R"("on": {"low": [1, 1], "high": [2, 2]}, )" + pressure).find("load \"p\": there is no free surface"),
            std::string::npos);
  EXPECT_NE(said(R"("on": {"low": [1, 1], "high": [0, 0]}, )" + pressure).find("must be above and right"),
            std::string::npos);
  EXPECT_NE(said(R"("on": {"from_deg": 20, "to_deg": 10}, )" + pressure).find("must be above \"from_deg\""),
            std::string::npos);
  EXPECT_NE(said(R"("on": "all", "direction": [1, 0], )" + pressure).find("is for a traction"), std::string::npos);
  EXPECT_NE(said(R"("on": "all", "traction": {"value": 1, "ramp": 1})").find("missing key \"direction\""),
            std::string::npos);
  EXPECT_NE(complaint(plate(roller + gauges + R"("stop": {"time": 1e-4}, "method": {"momentum": "paper"},
      "loads": [{"name": "p", "on": "all", "pressure": {"value": 1, "ramp": 1}}])"))
                .find("needs the momentum form adjoint"),
            std::string::npos);
}

}  // namespace
