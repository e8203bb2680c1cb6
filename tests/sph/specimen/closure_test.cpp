#include "fpz/specimen/closure.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fpz::specimen {
namespace {

constexpr double spacing = 1e-3;

/// A square around an inclined notch: what lies on its left is moved by `left` along its left normal, the rest not.
double overlap_after(double left, double width, double asked_width) {
  const Notch n{Point(0.0, 0.0), Point(4e-3, 6e-3), width, asked_width};
  std::vector<Point> start, displacement;
  for (int j = -10; j <= 10; ++j) {
    for (int i = -10; i <= 10; ++i) {
      // A lattice along the notch, its columns half a spacing beside the faces.
      const double side = i < 0 ? -1.0 : 1.0;
      const double d = (i + 0.5) * spacing + side * 0.5 * width;
      start.emplace_back(j * spacing * along(n) + d * across(n));
      displacement.emplace_back(d > 0.0 ? Point(left * across(n)) : Point::Zero());
    }
  }
  return face_overlap(n, start, displacement, spacing);
}

TEST(Closure, IsWhatFacesHaveMovedIntoEachOther) {
  EXPECT_EQ(overlap_after(2e-5, 0.0, 0.0), 0.0);
  EXPECT_NEAR(overlap_after(-2e-5, 0.0, 0.0), 2e-5, 1e-15);
  // A slot that is a cut has the width that it was asked to have, and so has a wide one.
  EXPECT_NEAR(overlap_after(-2e-5, 0.0, 1.5e-5), 0.5e-5, 1e-15);
  EXPECT_EQ(overlap_after(-2e-5, 0.0, 3e-5), 0.0);
  EXPECT_EQ(overlap_after(-2e-5, 3e-3, 3e-3), 0.0);
  EXPECT_NEAR(overlap_after(-3.1e-3, 3e-3, 3e-3), 1e-4, 1e-15);
}

TEST(Closure, IsWarnedOf) {
  EXPECT_EQ(warning_of_closure({0.0, 0.9e-6}, spacing), "");
  const std::string warning = warning_of_closure({0.0, 29e-6}, spacing);
  EXPECT_NE(warning.find("faces of notch 1 are 29 um inside each other"), std::string::npos) << warning;
}

}  // namespace
}  // namespace fpz::specimen
