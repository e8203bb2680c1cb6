// Gauges that see a deformation (strain, rotation) and gauges made of others.
#include <gtest/gtest.h>

#include <cmath>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/run.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace sph = fpz::sph;
using Matrix = Eigen::Matrix2d;

const std::filesystem::path beam = std::filesystem::path(FPZ_DATA_DIR) / "scenes/beam_3pb.json";

/// The value of a gauge of the beam when all particles have moved linearly, with deformation gradient F.
double value_in(const std::string& arrangement, const Matrix& f, const std::string& gauge) {
  const Scene scene = read_scene(beam, {"spacing=0.008", "arrangement=" + arrangement, "gauges.mine=" + gauge});
  Specimen s = make_specimen(scene);
  const double step = sph::time_step(s.setup);
  s.setup.parameters.young_modulus *= 1e-6;  // nothing but the motion counts
  s.setup.options.courant *= 1e-3;
  for (const Point& x : s.setup.arrangement.position) s.setup.velocity.push_back((f - Matrix::Identity()) * x / step);
  for (sph::Group<2>& g : s.setup.groups) g.drive = {};
  sph::Simulation<2> run(s.setup);
  (void)run.step();  // faster than sound
  const double part = run.time_step() / step;
  EXPECT_NEAR(part, 1.0, 1e-9);
  return s.gauges.at("mine").value(run, scene.thickness);
}

std::string gauge(const std::string& what, const std::string& site) {
  return what == "rotation" ? "{\"rotation_of\": " + site + "}"
                            : "{\"strain\": \"" + what + "\", \"of\": " + site + "}";
}

TEST(Gauges, StrainAndRotationOfALinearFieldAreExact) {
  const double angle = 0.3;
  const Matrix u{{1.02, -0.004}, {-0.004, 0.99}};
  const Matrix r{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
  for (const char* arrangement : {R"({"type": "lattice", "angle_deg": 20})", R"({"type": "scattered"})"}) {
    for (const char* site :
         {R"({"point": [0.05, 0.04], "radius": 0.02})", R"({"low": [-0.12, 0.02], "high": [0.1, 0.06]})"}) {
      const auto value = [&](const char* what) { return value_in(arrangement, r * u, gauge(what, site)); };
      EXPECT_NEAR(value("xx"), 0.02, 1e-9);
      EXPECT_NEAR(value("yy"), -0.01, 1e-9);
      EXPECT_NEAR(value("xy"), -0.004, 1e-9);
      EXPECT_NEAR(value("rotation"), angle, 1e-9);
    }
  }
}

/// A plate in tension, as a laboratory measures it: strain gauges, the nominal stress, and their ratio, which is the
/// modulus; Poisson's ratio from two strain gauges.
TEST(Gauges, SumsAndRatiosOfGauges) {
  const auto tension = [](const std::string& name, const std::string& gauge) {
    const Scene scene = read_scene(
        beam, {"shape={\"type\": \"rectangle\", \"low\": [0, 0], \"high\": [0.04, 0.08]}", "notches=[]",
               "setting=plane_stress", "spacing=0.004", "gauges={}",
               R"(boundaries=[{"name": "top", "at": [0.02, 0.08], "direction": [0, 1], "width": 0.04,
                   "displacement": {"y": {"value": 2e-6, "ramp": 5e-4}}},
                  {"name": "bottom", "at": [0.02, 0], "direction": [0, -1], "width": 0.04, "velocity": {"y": 0}}])",
               R"(gauges.load={"force_on": "top", "direction": [0, 1]})",
               R"(gauges.deflection={"displacement_of": "top", "direction": [0, 1]})",
               R"(gauges.support={"sum_of": {"left": 0.5, "right": 0.5}})",
               R"(gauges.left={"force_on": "top", "direction": [0, 1]})",
               R"(gauges.right={"force_on": "bottom", "direction": [0, -1]})",
               R"(gauges.along={"strain": "yy", "of": {"point": [0.02, 0.04], "radius": 0.01}})",
               R"(gauges.across={"strain": "xx", "of": {"point": [0.02, 0.04], "radius": 0.01}})", "gauges." + gauge,
               R"(stop={"time": 1.5e-3})", "method.damping=0.3", "output.pictures=false", "output.frames=0"});
    RunRequest request;
    request.folder = fpz::test::fresh_path(name);
    const RunResult r = run_scene(scene, request);
    EXPECT_NEAR(r.history.last("support"), r.history.last("load"), 1e-3 * r.history.last("load"));
    return std::pair(scene, r.history.last(gauge.substr(0, gauge.find('='))));
  };
  const auto [scene, modulus] =
      tension("modulus", R"(modulus={"sum_of": {"load": 625}, "over": {"along": 1}})");  // 1/(0.04 m * 0.04 m)
  EXPECT_EQ(scene.thickness, 0.04);
  EXPECT_NEAR(modulus, scene.parameters.young_modulus, 0.01 * scene.parameters.young_modulus);
  const auto [same, poisson] = tension("poisson", R"(ratio={"sum_of": {"across": -1}, "over": {"along": 1}})");
  EXPECT_NEAR(poisson, scene.parameters.poisson_ratio, 0.02 * scene.parameters.poisson_ratio);
}

std::string complaint(const std::vector<std::string>& set) {
  try {
    (void)make_specimen(read_scene(beam, set));
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
  return "valid";
}

TEST(Gauges, WhatIsWrongWithThemIsNamed) {
  const auto expect = [](const std::string& gauge, const std::string& text) {
    EXPECT_NE(complaint({"gauges." + gauge}).find(text), std::string::npos) << complaint({"gauges." + gauge});
  };
  expect(R"(s={"strain": "yy", "of": {"point": [0.0007, 0.0407]}})", "lie at one place or on one line");
  expect(R"(s={"strain": "zz", "of": {"point": [0, 0.04], "radius": 0.01}})", "gauges.s.strain");
  expect(R"(s={"rotation_of": {"point": [5, 0.04], "radius": 0.01}})", "outside the body");
  expect(R"(s={"sum_of": {"laod": 1}})", "there is no such gauge; did you mean \"load\"");
  expect(R"(s={"sum_of": {}})", "the object is empty; expected names of gauges");
  expect(R"(s={"sum_of": {"load": "x"}})", "gauges.s.sum_of.load");
  expect(R"(s={"sum_of": {"load": 1}, "over": {"s": 1}})", "is a sum itself");
  expect(R"(load={"sum_of": {"deflection": 1}})", "must measure a force");
  expect(R"(deflection={"sum_of": {"load": 1}, "over": {"support": 1}})", "must measure a displacement");
}

}  // namespace
