#include "fpz/specimen/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace fpz::specimen;
constexpr double pi = std::numbers::pi;

Notch notch(Point mouth, double length, double degrees, double width) {
  const double a = degrees * pi / 180.0;
  return {mouth, mouth + length * Point(-std::sin(a), std::cos(a)), width};
}

TEST(Geometry, AreasOfShapesAreExact) {
  EXPECT_DOUBLE_EQ(area(Shape(Rectangle{Point(-1, 0), Point(2, 2)})), 6.0);
  EXPECT_DOUBLE_EQ(area(Shape(Disc{Point(1, 1), 2.0})), 4.0 * pi);
  EXPECT_DOUBLE_EQ(area(Shape(HalfDisc{Point(0, 0), 2.0})), 2.0 * pi);
  EXPECT_DOUBLE_EQ(area(Shape(Ring{Point(0, 0), 1.0, 2.0})), 3.0 * pi);
  EXPECT_DOUBLE_EQ(area(Shape(Polygon{{Point(0, 0), Point(4, 0), Point(0, 3)}})), 6.0);
  EXPECT_DOUBLE_EQ(area(Shape(Polygon{{Point(0, 3), Point(4, 0), Point(0, 0)}})), 6.0);
}

TEST(Geometry, NotchesAndHolesAreTakenOut) {
  Body b{Rectangle{Point(-1, 0), Point(1, 1)}, {}, {}};
  b.notches = {notch(Point(0, 0), 0.5, 0.0, 0.0)};
  EXPECT_DOUBLE_EQ(area(b), 2.0);
  b.notches = {notch(Point(0, 0), 0.5, 0.0, 0.1)};
  EXPECT_NEAR(area(b), 2.0 - 0.05, 1e-7);
  // An inclined slot is cut off by the surface along its own centre height: length times width stays.
  b.notches = {notch(Point(0, 0), 0.5, 30.0, 0.1)};
  EXPECT_NEAR(area(b), 2.0 - 0.05, 1e-7);
  b.holes = {Disc{Point(0.6, 0.6), 0.2}};
  EXPECT_NEAR(area(b), 2.0 - 0.05 - 0.04 * pi, 1e-6);
  b.holes.emplace_back(Disc{Point(0.6, 0.6), 0.1});  // inside the other: nothing more
  EXPECT_NEAR(area(b), 2.0 - 0.05 - 0.04 * pi, 1e-6);
}

TEST(Geometry, ContainsKnowsNotchesAndHoles) {
  Body b{HalfDisc{Point(0, 0), 1.0}, {Disc{Point(0, 0.7), 0.1}}, {notch(Point(0, 0), 0.4, 45.0, 0.1)}};
  EXPECT_TRUE(contains(b, Point(0.5, 0.1)));
  EXPECT_FALSE(contains(b, Point(0.5, -0.1)));
  EXPECT_FALSE(contains(b, Point(0.0, 0.7)));
  EXPECT_FALSE(contains(b, Point(-0.2, 0.2)));
  EXPECT_TRUE(contains(b, Point(0.2, 0.2)));
  EXPECT_TRUE(contains(b, Point(-0.3, 0.3)));  // beyond the tip
}

/// All of the surface and nothing else: its length, also where a slot opens it and where arcs are made of chords.
TEST(Geometry, SurfaceLinesHaveTheLengthOfTheSurface) {
  const auto length = [](const Body& b) {
    double sum = 0.0;
    for (const auto& line : surface_lines(b, 0.01)) {
      for (std::size_t k = 1; k < line.size(); ++k) sum += (line[k] - line[k - 1]).norm();
    }
    return sum;
  };
  constexpr double circle = 2.0 * 3.14159265358979;
  EXPECT_NEAR(length({Disc{Point(0, 0), 1.0}, {}, {}}), circle, 1e-4);
  EXPECT_NEAR(length({Ring{Point(0, 0), 0.3, 1.0}, {}, {}}), 1.3 * circle, 1e-4);
  EXPECT_NEAR(length({Disc{Point(0, 0), 1.0}, {Disc{Point(0.2, 0.1), 0.2}}, {}}), 1.2 * circle, 1e-4);
  const Rectangle sheet{Point(0, 0), Point(2, 1)};
  EXPECT_NEAR(length({sheet, {}, {{Point(1, 0), Point(1, 0.4), 0.0}}}), 6.0, 1e-12);
  EXPECT_NEAR(length({sheet, {}, {{Point(1, 0), Point(1, 0.4), 0.2}}}), 6.8, 0.03);
}

}  // namespace
