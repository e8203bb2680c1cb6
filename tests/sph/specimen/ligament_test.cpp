// The narrowest part of bodies, by hand.
#include "../../../sph/specimen/src/ligament.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fpz/specimen/scene.hpp"

namespace {

using namespace fpz::specimen;
using detail::smallest_ligament;

const std::filesystem::path scenes = std::filesystem::path(FPZ_DATA_DIR) / "scenes";

double ligament_of(const char* scene, const Overrides& set = {}) {
  return smallest_ligament(read_scene(scenes / scene, set).body).width;
}

void expect_width(const Body& body, double width) { EXPECT_NEAR(smallest_ligament(body).width, width, 2e-3 * width); }

TEST(Ligament, OfTheShippedScenes) {
  EXPECT_NEAR(ligament_of("beam_3pb.json"), 0.072, 1e-4);                          // slot
  EXPECT_NEAR(ligament_of("beam_3pb.json", {"notches[0].width=0"}), 0.072, 1e-4);  // cut
  EXPECT_NEAR(ligament_of("scb.json"), 0.0475 - 0.0166, 1e-4);
  EXPECT_NEAR(ligament_of("ring.json"), 0.7 * 0.025, 1e-4);
  EXPECT_NEAR(ligament_of("disc.json"), 0.05, 1e-4);
  EXPECT_NEAR(ligament_of("dogbone.json"), 0.04, 1e-4);
  EXPECT_NEAR(ligament_of("uniaxial_compression.json"), 0.05, 1e-4);
}

TEST(Ligament, BetweenHolesAndSurfaces) {
  const Shape plate = Rectangle{Point(0.0, 0.0), Point(0.1, 0.1)};
  expect_width({plate, {Disc{Point(0.05, 0.02), 0.01}}, {}}, 0.01);
  expect_width({plate, {Disc{Point(0.035, 0.05), 0.01}, Disc{Point(0.065, 0.05), 0.01}}, {}}, 0.01);
}

TEST(Ligament, BesideAndBeyondNotches) {
  const Shape plate = Rectangle{Point(0.0, 0.0), Point(0.1, 0.1)};
  const auto cut = [](const Point& mouth, const Point& tip, bool internal) {
    Notch n;
    n.mouth = mouth, n.tip = tip, n.internal = internal;
    return n;
  };
  // A cut parallel to the surface; one whose both ends count; two that meet tip to tip.
  expect_width({plate, {}, {cut(Point(0.03, 0.004), Point(0.07, 0.004), true)}}, 0.004);
  expect_width({plate, {}, {cut(Point(0.006, 0.05), Point(0.05, 0.05), true)}}, 0.006);
  expect_width(
      {plate, {}, {cut(Point(0.0, 0.05), Point(0.045, 0.05), false), cut(Point(0.1, 0.05), Point(0.055, 0.05), false)}},
      0.01);
}

/// Every body tapers to nothing at its corners; that is no neck.
TEST(Ligament, CornersAndWedgesAreNone) {
  EXPECT_NEAR(smallest_ligament({HalfDisc{Point(0.0, 0.0), 0.05}, {}, {}}).width, 0.05, 1e-4);
  const Polygon wedge{{Point(0.0, 0.0), Point(0.1, 0.0), Point(0.1, 0.01)}};
  EXPECT_TRUE(std::isinf(smallest_ligament({wedge, {}, {}}).width));
}

TEST(Ligament, ReentrantCorners) {
  const Polygon l_panel{
      {Point(0.0, 0.0), Point(0.25, 0.0), Point(0.25, 0.25), Point(0.5, 0.25), Point(0.5, 0.5), Point(0.0, 0.5)}};
  expect_width({l_panel, {}, {}}, 0.25);
  const Polygon hourglass{
      {Point(0.0, 0.0), Point(0.1, 0.0), Point(0.06, 0.05), Point(0.1, 0.1), Point(0.0, 0.1), Point(0.04, 0.05)}};
  expect_width({hourglass, {}, {}}, 0.02);
}

}  // namespace
