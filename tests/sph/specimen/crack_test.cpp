#include "fpz/specimen/crack.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace fpz::specimen;
constexpr double pi = std::numbers::pi;

/// A unit square of particles with a straight crack through its middle, `columns` spacings wide, from side to side.
std::vector<Spot> square(double degrees, double columns, double damage, double spacing = 0.01) {
  const double a = degrees * pi / 180.0;
  const Point n(std::cos(a), std::sin(a));
  std::vector<Spot> spots;
  const int count = static_cast<int>(std::lround(1.0 / spacing));
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      Spot s{Point((i + 0.5) * spacing - 0.5, (j + 0.5) * spacing - 0.5), spacing * spacing, 0.0, n};
      if (std::abs(s.at.dot(n)) < 0.5 * columns * spacing - 1e-9) s.damage = damage;
      spots.push_back(s);
    }
  }
  return spots;
}

TEST(Crack, OpenedLengthIsThatOfTheCrackWhateverItsWidth) {
  for (const double columns : {2.0, 4.0}) EXPECT_NEAR(opened_length(square(0.0, columns, 1.0), 0.01), 1.0, 1e-12);
  for (const double degrees : {15.0, 30.0, 45.0}) {
    const double length = 1.0 / std::cos(degrees * pi / 180.0);
    for (const double columns : {2.0, 3.0, 4.0}) {
      EXPECT_NEAR(opened_length(square(degrees, columns, 1.0), 0.01), length, 0.04 * length)
          << degrees << " " << columns;
    }
  }
}

TEST(Crack, AnOpeningCrackCountsWithItsDamage) {
  EXPECT_NEAR(opened_length(square(0.0, 2.0, 0.25), 0.01), 0.25, 1e-12);
  EXPECT_EQ(opened_length(square(0.0, 2.0, 0.0), 0.01), 0.0);
}

TEST(Crack, PathFollowsTheMiddle) {
  for (const double degrees : {0.0, 20.0, 45.0}) {
    const auto paths = crack_paths(square(degrees, 2.0, 1.0), 0.01);
    ASSERT_EQ(paths.size(), 1u);
    const double length = 1.0 / std::cos(degrees * pi / 180.0);
    EXPECT_NEAR(paths[0].length(), length, 0.05 * length);
    const Point n(std::cos(degrees * pi / 180.0), std::sin(degrees * pi / 180.0));
    for (const Point& x : paths[0].points) EXPECT_NEAR(x.dot(n), 0.0, 0.01);
  }
  EXPECT_TRUE(crack_paths(square(0.0, 2.0, 0.4), 0.01).empty());
}

TEST(Crack, BranchesAndSeparateCracksBecomeSeparatePaths) {
  // A cross of two cracks.
  std::vector<Spot> spots = square(0.0, 2.0, 1.0);
  for (Spot& s : spots) {
    if (std::abs(s.at[1]) < 0.01 - 1e-9 && s.damage == 0.0) s.damage = 1.0, s.normal = Point(0.0, 1.0);
  }
  const auto paths = crack_paths(spots, 0.01);
  double length = 0.0;
  for (const CrackPath& p : paths) length += p.length();
  EXPECT_NEAR(length, 2.0, 0.12);
}

TEST(Crack, PiecesAreCounted) {
  EXPECT_EQ(piece_areas(square(0.0, 2.0, 1.0), {}, 0.01).size(), 2u);
  EXPECT_EQ(piece_areas(square(0.0, 2.0, 0.5), {}, 0.01).size(), 1u);
  // Half crack, half notch.
  std::vector<Spot> spots = square(0.0, 2.0, 1.0);
  for (Spot& s : spots) {
    if (s.at[1] < 0.0) s.damage = 0.0;
  }
  EXPECT_EQ(piece_areas(spots, {}, 0.01).size(), 1u);
  const auto pieces = piece_areas(spots, {{Point(0.0, -0.5), Point(0.0, 0.0), 0.0}}, 0.01);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(pieces[0], 0.495, 1e-9);
}

}  // namespace
