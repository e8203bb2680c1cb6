#include "patch_trials.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace fpz::report;
using fpz::specimen::Point;
constexpr double pi = std::numbers::pi;

constexpr double radius = 0.025;  // m
const double half_angle = std::asin(0.08);

/// Traction on a plane with this normal.
Point traction(const fpz::Tensor<double, 2>& s, const Point& n) {
  return {s[0] * n[0] + s[2] * n[1], s[2] * n[0] + s[1] * n[1]};
}

TEST(StressUnderPressure, HasTheTractionsOfThePressureOnTheRim) {
  const double pressure = 1.0 / (2.0 * radius * std::sin(half_angle));  // Pa
  for (const double angle : {0.0, 0.3, 1.0, 1.4, pi + 0.5}) {
    const Point n(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(traction(stress_under_pressure(radius * n, radius, half_angle), n).norm(), 0.0, 1e-3 * pressure);
  }
  // A little below the middle of the arc.
  const Point n(0.0, 1.0);
  const Point t = traction(stress_under_pressure(0.995 * radius * n, radius, half_angle), n);
  EXPECT_NEAR(t[1], -pressure, 0.02 * pressure);
}

TEST(StressUnderPressure, CarriesTheLoadAcrossEverySection) {
  for (const double y : {0.0, 0.3 * radius, 0.7 * radius}) {
    const double width = std::sqrt(radius * radius - y * y);
    Point sum(0.0, 0.0);
    constexpr int pieces = 2000;
    for (int k = 0; k < pieces; ++k) {
      const Point x(width * ((2.0 * k + 1.0) / pieces - 1.0), y);
      sum += 2.0 * width / pieces * traction(stress_under_pressure(x, radius, half_angle), Point(0.0, 1.0));
    }
    EXPECT_NEAR(sum[1], -1.0, 1e-5) << y;
    EXPECT_NEAR(sum[0], 0.0, 1e-9) << y;
  }
}

TEST(StressUnderPressure, TendsToTheLineLoads) {
  const fpz::Tensor<double, 2> centre = stress_under_pressure(Point(0.0, 0.0), radius, 1e-6);
  EXPECT_NEAR(centre[0], 1.0 / (pi * radius), 1e-6);
  EXPECT_NEAR(centre[1], -3.0 / (pi * radius), 1e-6);
}

TEST(PatchTrials, TheOperatorPassesWhereTheKernelFails) {
  for (const NamedPattern& p : strip_patterns()) {
    if (p.pattern.move < 0.3) continue;
    const BothFields good = strip_errors(p.pattern, 20, StripEnds::traction);
    EXPECT_LT(good[0].inside.worst, 0.03) << p.name;  // ten spacings from the ends
    EXPECT_LT(good[0].surface.worst, 0.03) << p.name;
    EXPECT_LT(good[1].inside.rms, 0.02) << p.name;
    EXPECT_GT(strip_errors(p.pattern, 20, StripEnds::traction, fpz::sph::Gradient::kernel)[0].inside.rms, 0.1);
  }
}

/// Only the particles that touch held ones are left without balance.
TEST(PatchTrials, HeldEndsHardlyDisturbTheMiddle) {
  for (const NamedPattern& p : strip_patterns()) {
    if (p.pattern.move < 0.3) continue;
    EXPECT_LT(strip_errors(p.pattern, 20, StripEnds::held)[0].inside.worst, 0.01) << p.name;
  }
}

}  // namespace
