// Notches that close, on specimens: a cut disc, a bar with a joint through it.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "fpz/specimen/scene.hpp"
#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen {
namespace {

/// Material of the tests: strong where nothing shall crack.
std::string material(double strength) {
  std::ostringstream s;
  s << R"({"young_modulus": 20e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": )" << strength
    << R"(, "cohesion": )" << 3.0 * strength
    << R"(, "friction_angle_deg": 35, "dilation_angle_deg": 5, "delta0": 6e-6, "normal_stiffness": 1e14, "shear_stiffness": 3e12})";
  return s.str();
}

struct Bearing {
  double stiffness = 0.0;  ///< N/m
  double overlap = 0.0;    ///< m, the largest
  sph::Energies energies;
  std::size_t cracked = 0;
};

/// Mean load over mean deflection during the last tenth of the time.
Bearing bearing(const std::string& text, double time) {
  const Scene scene = parse_scene(text, "contact_test.json");
  const Specimen specimen = make_specimen(scene);
  sph::Simulation<2> run(specimen.setup);
  Bearing b;
  double load = 0.0, deflection = 0.0;
  while (run.time() < time) {
    const sph::Outcome o = run.step();
    EXPECT_TRUE(o.ok()) << o.message();
    if (!o.ok()) break;
    if (run.time() < 0.9 * time) continue;
    load += specimen.gauges.at("load").value(run, scene.thickness);
    deflection += specimen.gauges.at("deflection").value(run, scene.thickness);
    b.overlap = std::max(b.overlap, run.overlap());
  }
  b.stiffness = load / deflection;
  b.energies = run.energies();
  b.cracked = run.cracked();
  return b;
}

/// Disc of 50 mm between platens, with a cut of 20 mm across the load line or without, beyond the load at which faces
/// that pass through each other have torn it (3 kN).
std::string disc(const char* arrangement, const char* notch) {
  std::ostringstream s;
  s << R"({"material": )" << material(5e6) << R"(, "setting": "plane_strain", "thickness": 0.025, "spacing": 0.00125,
    "shape": {"type": "disc", "radius": 0.025}, "arrangement": )"
    << arrangement << R"(, "notches": [)" << notch << R"(],
    "boundaries": [{"name": "top", "at": [0, 0.025], "direction": [0, 1], "width": 0.006, "fit": "flat",
                    "velocity": {"x": 0, "y": {"speed": -0.01, "ramp": 0.0005}}},
                   {"name": "bottom", "at": [0, -0.025], "direction": [0, -1], "width": 0.006, "fit": "flat",
                    "velocity": {"x": 0, "y": {"speed": 0.01, "ramp": 0.0005}}}],
    "gauges": {"load": {"force_on": "top", "direction": [0, -1]},
               "deflection": {"displacement_of": "top", "relative_to": "bottom", "direction": [0, -1]}},
    "stop": {"time": 1}})";
  return s.str();
}

TEST(ClosedNotch, ADiscBearsAsIfItWereWhole) {
  const char* cut = R"({"mouth": [0.01, 0], "length": 0.02, "angle_deg": 90, "width": 0})";
  for (const char* arrangement : {R"({"type": "lattice"})", R"({"type": "scattered"})"}) {
    const Bearing whole = bearing(disc(arrangement, ""), 2.5e-3), closed = bearing(disc(arrangement, cut), 2.5e-3);
    EXPECT_NEAR(closed.stiffness, whole.stiffness, 0.02 * whole.stiffness) << arrangement;
    EXPECT_LT(closed.overlap, 0.01 * 1.25e-3) << arrangement;
    EXPECT_EQ(closed.cracked, whole.cracked) << arrangement;
    EXPECT_LT(std::abs(closed.energies.error()), 1e-9 * closed.energies.external) << arrangement;
  }
}

/// A bar of 16 mm between smooth platens, with a joint through it at an angle to them, or without.
std::string bar(const char* arrangement, double angle_deg, double friction_deg) {
  constexpr double width = 0.016;
  const double slope = std::tan(degree * angle_deg), height = 0.024 + width * slope;
  std::ostringstream s;
  s.precision(17);
  s << R"({"material": )" << material(1e12) << R"(, "setting": "plane_strain", "thickness": 0.025, "spacing": 0.001,
    "shape": {"type": "rectangle", "low": [0, 0], "high": [)"
    << width << ", " << height << R"(]}, "arrangement": )" << arrangement << R"(, "notches": [)";
  if (friction_deg >= 0.0) {
    s << R"({"mouth": [0, )" << 0.5 * (height - width * slope) << R"(], "length": )"
      << width / std::cos(degree * angle_deg) << R"(, "angle_deg": )" << angle_deg - 90.0
      << R"(, "friction_angle_deg": )" << friction_deg << "}";
  }
  s << R"(], "boundaries": [
    {"name": "bottom", "at": [0.008, 0], "direction": [0, -1], "width": 0.016, "velocity": {"y": 0}},
    {"name": "top", "at": [0.008, )"
    << height << R"(], "direction": [0, 1], "width": 0.016,
     "velocity": {"y": {"speed": -0.02, "ramp": 0.0004}}}],
    "gauges": {"load": {"force_on": "bottom", "direction": [0, 1]},
               "deflection": {"displacement_of": "top", "relative_to": "bottom", "direction": [0, -1]}},
    "stop": {"time": 1}})";
  return s.str();
}

/// The stress of the bar is even: the joint slides when tan(angle) exceeds the friction, at any load, and is not there
/// when it does not.
void expect_sliding_at_the_friction_angle(const char* arrangement, const std::vector<double>& angles) {
  constexpr double time = 1e-3;
  for (const double angle : angles) {
    const double whole = bearing(bar(arrangement, angle, -1.0), time).stiffness;
    const auto friction = [&](double part) { return std::atan(part * std::tan(degree * angle)) / degree; };
    const Bearing sticks = bearing(bar(arrangement, angle, friction(1.02)), time);
    EXPECT_NEAR(sticks.stiffness, whole, 0.02 * whole) << angle;
    EXPECT_LT(std::abs(sticks.energies.error()), 1e-9 * sticks.energies.external) << angle;
    if (angle == 0.0) continue;
    const Bearing slides = bearing(bar(arrangement, angle, friction(0.98)), time);
    EXPECT_LT(slides.stiffness, 0.25 * whole) << angle;
    EXPECT_GT(slides.energies.friction, 0.4 * slides.energies.external) << angle;
  }
}

TEST(ThroughGoingJoint, SlidesAtTheFrictionAngleOnALattice) {
  expect_sliding_at_the_friction_angle(R"({"type": "lattice"})", {15.0, 30.0, 50.0});
}

TEST(ThroughGoingJoint, SlidesAtTheFrictionAngleAmongScatteredParticles) {
  expect_sliding_at_the_friction_angle(R"({"type": "scattered"})", {0.0, 20.0, 40.0, 50.0});
}

}  // namespace
}  // namespace fpz::specimen
