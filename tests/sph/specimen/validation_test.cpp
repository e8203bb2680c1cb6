// Coarse versions of the semicircular bending test and of the disc and rings (sections 5.2, 5.3), through the scenes of
// data/scenes. The runs at the paper's spacings are in docs/validation.md; the beam is in beam_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fpz/specimen/crack.hpp"
#include "fpz/specimen/scene.hpp"
#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen {
namespace {

const std::filesystem::path scenes = std::filesystem::path(FPZ_DATA_DIR) / "scenes";

struct Tested {
  double peak = 0.0;               ///< N
  double first_load = 0.0;         ///< N, when the first particle cracks
  std::vector<Spot> first_cracks;  ///< damaged particles then
  std::vector<Spot> end;
};

/// Loads a specimen until the load has fallen to `until` times its peak. The load is the mean over 50 steps.
Tested test(const Scene& scene, double until) {
  constexpr int window = 50;
  const Specimen specimen = make_specimen(scene);
  sph::Simulation<2> run(specimen.setup);
  Tested t;
  double load = 0.0, sum = 0.0;
  while (run.time() < scene.stop.time && (run.cracked() == 0 || load > until * t.peak)) {
    if (const sph::Outcome o = run.step(); !o.ok()) {
      ADD_FAILURE() << o.message();
      return t;
    }
    sum += specimen.gauges.at("load").value(run, scene.thickness);
    if (run.cracked() > 0 && t.first_cracks.empty()) {
      t.first_load = load;
      for (const Spot& s : spots(run, specimen)) {
        if (s.damage > 0.0) t.first_cracks.push_back(s);
      }
    }
    if (run.steps() % window != 0) continue;
    load = sum / window;
    sum = 0.0;
    t.peak = std::max(t.peak, load);
  }
  EXPECT_LT(run.time(), scene.stop.time) << "the load has not fallen";
  t.end = spots(run, specimen);
  return t;
}

Tested semicircular(const std::string& angle) {
  return test(read_scene(scenes / "scb.json", {"spacing=0.002", "notches[0].angle_deg=" + angle,
                                               "boundaries[0].velocity.y={\"speed\": -0.008, \"ramp\": 0.0025}"}),
              0.4);
}

TEST(SemicircularBending, CrackTurnsFromTheNotchToTheLoad) {
  const Tested upright = semicircular("0"), inclined = semicircular("45");
  EXPECT_GT(inclined.peak, 1.05 * upright.peak);
  // Upright: the crack goes on along the notch, in the plane of symmetry.
  const auto straight = crack_paths(upright.end, 0.002);
  ASSERT_FALSE(straight.empty());
  for (const Point& p : straight.front().points) EXPECT_LT(std::abs(p[0]), 0.002);
  EXPECT_GT(straight.front().length(), 0.010);
  // Inclined: from the tip (left of the middle) to the right, towards the load, not along the notch.
  const Point tip(-0.0166 * std::sin(M_PI / 4.0), 0.0166 * std::cos(M_PI / 4.0)), load(0.0, 0.0475);
  const auto turned = crack_paths(inclined.end, 0.002);
  ASSERT_FALSE(turned.empty());
  const auto distance_to_tip = [&](const Point& a, const Point& b) { return (a - tip).norm() < (b - tip).norm(); };
  const auto& points = turned.front().points;
  const Point start = *std::min_element(points.begin(), points.end(), distance_to_tip);
  const Point end = *std::max_element(points.begin(), points.end(), distance_to_tip);
  EXPECT_LT((start - tip).norm(), 0.006);
  const Point way = (end - start).normalized(), to_load = (load - tip).normalized(), on = tip.normalized();
  EXPECT_GT(way.dot(to_load), std::cos(M_PI / 9.0));
  EXPECT_LT(way.dot(on), std::cos(M_PI / 6.0));
}

/// A plate in compression between bonded platens bears a little less than the closed form of even stress, because the
/// platens raise the stress at their edges: on the Mohr circle of the first shear plane with p = -r,
/// sqrt(r^2 + A^2) = c0 cos(phi) - p sin(phi), A = c0 - sigma_t0 tan(phi). What cracked particles make of shear and
/// pressure must not weaken it.
TEST(UniaxialCompression, BearsTheLoadOfTheFirstShearPlane) {
  const Scene scene = read_scene(scenes / "uniaxial_compression.json", {"spacing=0.002"});
  const Parameters& m = scene.parameters;
  const double phi = m.friction_angle_deg * M_PI / 180.0;
  const double a = m.cohesion - m.tensile_strength * std::tan(phi);
  const double r = (m.cohesion * std::sin(phi) + std::sqrt(m.cohesion * m.cohesion - a * a)) / std::cos(phi);
  const double closed_form = 2.0 * r * 0.05 * scene.thickness;
  const double peak = test(scene, 0.7).peak;
  EXPECT_GT(peak, 0.93 * closed_form);
  EXPECT_LT(peak, 1.02 * closed_form);
}

Tested ring(const std::string& ratio) {
  return test(
      read_scene(scenes / "ring.json", {"spacing=0.00125", "shape.diameter_ratio=" + ratio,
                                        "boundaries[0].velocity.y.speed=-0.02", "boundaries[1].velocity.y.speed=0.02"}),
      0.8);
}

TEST(Ring, FirstCrackOnTheLoadLineAndTheLoadFallsWithTheHole) {
  double before = HUGE_VAL;
  for (const double ratio : {0.0, 0.3, 0.5}) {
    const Tested t = ring(std::to_string(ratio));
    EXPECT_LT(t.peak, 0.9 * before) << ratio;
    before = t.peak;
    ASSERT_FALSE(t.first_cracks.empty());
    for (const Spot& s : t.first_cracks) {
      EXPECT_LT(std::abs(s.at[0]), 2.0 * 0.00125) << ratio;
      if (ratio > 0.0) {
        EXPECT_LT(s.at.norm() - ratio * 0.025, 2.0 * 0.00125) << ratio;
      }
      // It opens across the load line; at the centre of the disc the critical plane of marble is 17 degrees off
      // already.
      EXPECT_GT(std::abs(s.normal[0]), 0.85) << ratio;
    }
  }
}

}  // namespace
}  // namespace fpz::specimen
