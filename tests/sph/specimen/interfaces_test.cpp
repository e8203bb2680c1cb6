// Interfaces in scenes: who is beside them, and what a joint costs to open however the particles lie.
#include <gtest/gtest.h>

#include <cmath>

#include "fpz/specimen/specimen.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;
using fpz::sph::Motion;

constexpr double width = 0.06, height = 0.04;  // m
const std::string joint = R"({"name": "joint", "material": {"tensile_strength": 2e6, "cohesion": 6e6},
                              "line": [[-0.03, 0.02], [0.03, 0.02]]})";

/// A block of strong rock with interfaces, pulled up.
Scene block(const std::string& interfaces, const std::string& arrangement) {
  const std::string text = R"({"material": {"young_modulus": 30e9, "poisson_ratio": 0.2, "density": 2400,
      "tensile_strength": 8e6, "cohesion": 24e6, "friction_angle_deg": 37, "dilation_angle_deg": 5, "delta0": 16e-6,
      "normal_stiffness": 1e14, "shear_stiffness": 1e13},
    "setting": "plane_strain", "thickness": 1, "spacing": 0.002,
    "shape": {"type": "rectangle", "low": [-0.03, 0], "high": [0.03, 0.04]},
    "interfaces": [)" + interfaces +
                           R"(], "arrangement": )" + arrangement + R"(,
    "boundaries": [
      {"name": "top", "at": [0, 0.04], "direction": [0, 1], "width": 0.06,
       "velocity": {"y": {"speed": 0.002, "ramp": 2e-4}}},
      {"name": "bottom", "at": [0, 0], "direction": [0, -1], "width": 0.06, "velocity": {"y": 0}}],
    "gauges": {"load": {"force_on": "top", "direction": [0, 1]},
               "deflection": {"displacement_of": "top", "direction": [0, 1]}},
    "method": {"release_integrity": 0.02, "threads": 1},
    "stop": {"time": 0.001}})";
  return parse_scene(text, "block.json");
}

/// Moves both ends apart at `speed` each until `time` (s); the largest mean stress at the top.
double pull(fpz::sph::Simulation<2>& run, double speed, double time) {
  run.set_drive(0, 1, Motion{speed, 2e-4});
  run.set_drive(1, 1, Motion{-speed, 2e-4});
  double peak = 0.0;
  while (run.time() < time) {
    const fpz::sph::Outcome o = run.step();
    if (!o.ok()) throw std::runtime_error(o.message());
    peak = std::max(peak, run.reaction(0)[1] / width);
  }
  return peak;
}

struct Opened {
  double strength = 0.0;  ///< over that of the joint
  double energy = 0.0;    ///< work that does not come back, over its G up to the integrity at which bonds are cut
};
Opened open_joint(const Specimen& s) {
  const fpz::Parameters& m = s.setup.weak_planes.parameters.front();
  fpz::sph::Simulation<2> run(s.setup);
  Opened o;
  o.strength = pull(run, 0.002, 0.8e-3) / m.tensile_strength;
  (void)pull(run, 0.01, 0.8e-3 + 6.0 * m.delta0 / 0.02);
  const double to_the_cut = 1.0 - s.setup.options.release_integrity;
  const fpz::sph::Energies e = run.energies();
  o.energy = (e.external - e.elastic - e.kinetic) / (to_the_cut * m.tensile_strength * m.delta0 * width);
  return o;
}

constexpr const char* arrangements[] = {R"({"type": "lattice"})",
                                        R"({"type": "lattice", "origin": [0, 0.0005]})",
                                        R"({"type": "lattice", "origin": [0, 0.001]})",
                                        R"({"type": "lattice", "angle_deg": 20})",
                                        R"({"type": "lattice", "angle_deg": 45})",
                                        R"({"type": "scattered", "seed": 1})"};

TEST(Interfaces, AJointOpensAtItsStrengthWithItsEnergyHoweverTheParticlesLie) {
  for (const char* arrangement : arrangements) {
    const Opened o = open_joint(make_specimen(block(joint, arrangement)));
    RecordProperty(arrangement, std::to_string(o.strength) + " of the strength, " + std::to_string(o.energy) + " of G");
    EXPECT_NEAR(o.strength, 1.0, 0.01) << arrangement;
    EXPECT_NEAR(o.energy, 1.0, 0.05) << arrangement;
  }
}

/// Why particles up to one and a half spacings away are beside it: with fewer, rock of four times the strength shares
/// the opening.
TEST(Interfaces, FewerParticlesBesideAJointMakeItDearer) {
  for (const int k : {3, 4}) {
    Specimen s = make_specimen(block(joint, arrangements[k]));
    for (std::size_t i = 0; i < s.setup.arrangement.size(); ++i) {
      if (std::abs(s.setup.arrangement.position[i][1] - 0.5 * height) > 0.75 * s.setup.arrangement.spacing) {
        s.setup.weak_planes.of_particle[i] = fpz::sph::WeakPlanes<2>::none;
      }
    }
    const Opened o = open_joint(s);
    RecordProperty("narrow_" + std::to_string(k), std::to_string(o.energy));
    EXPECT_GT(o.energy, 1.3);
  }
}

TEST(Interfaces, LaterOnesGoBeforeEarlierOnesAndLinesEnd) {
  const std::string bedding = R"({"name": "bedding", "material": {"tensile_strength": 4e6},
                                  "bedding": {"angle_deg": 30, "spacing": 0.01, "origin": [0, 0.02]}})";
  const std::string half =
      R"({"name": "half", "material": {"tensile_strength": 2e6}, "line": [[0, 0.02], [0.05, 0.02]]})";
  const Specimen s = make_specimen(block(bedding + "," + half, arrangements[0]));
  const fpz::sph::WeakPlanes<2>& planes = s.setup.weak_planes;
  EXPECT_EQ(planes.parameters[0].tensile_strength, 4e6);
  EXPECT_EQ(planes.parameters[0].cohesion, 24e6);
  const Point n(-0.5, std::sqrt(0.75));
  for (std::size_t i = 0; i < s.setup.arrangement.size(); ++i) {
    const Point x = s.setup.arrangement.position[i];
    const double planes_away = n.dot(x - Point(0.0, 0.02)) / 0.01;
    int expected = std::abs(planes_away - std::round(planes_away)) <= 0.3 ? 0 : -1;
    if (x[0] > 0.0 && std::abs(x[1] - 0.02) < 0.0031) expected = 1;
    if (s.setup.arrangement.group[i] >= 0) expected = -1;
    ASSERT_EQ(planes.of_particle[i], expected) << x.transpose();
    if (expected == 0) {
      ASSERT_NEAR((planes.normal[i] - n).norm(), 0.0, 1e-12);
    }
  }
  const PointCloud frame = frame_of(fpz::sph::Simulation<2>(s.setup), s);
  ASSERT_NE(frame.find("interface"), nullptr);
  EXPECT_EQ(frame.find("interface")->values[100], planes.of_particle[100] + 1);
}

TEST(Interfaces, TheTextOfTheSceneReadsBackTheSame) {
  const Scene scene = block(joint, arrangements[0]);
  const Scene again = parse_scene(scene.text, "/elsewhere/scene.json");
  EXPECT_EQ(again.text, scene.text);
  EXPECT_EQ(again.interfaces.at(0).material.tensile_strength, 2e6);
  EXPECT_EQ(again.interfaces.at(0).material.delta0, 16e-6);
}

}  // namespace
