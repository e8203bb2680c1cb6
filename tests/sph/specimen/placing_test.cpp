#include "fpz/specimen/placing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace {

using namespace fpz::specimen;
constexpr double pi = std::numbers::pi;

double volume(const fpz::sph::Arrangement<2>& a) { return std::accumulate(a.volume.begin(), a.volume.end(), 0.0); }

Pattern pattern(Pattern::Kind kind, double degrees = 0.0) {
  Pattern p;
  p.kind = kind;
  p.angle = degrees * pi / 180.0;
  return p;
}

TEST(Placing, VolumesSumToTheTrueArea) {
  const Body bodies[] = {{HalfDisc{Point(0, 0), 1.0}, {}, {}},
                         {Disc{Point(0, 0), 1.0}, {Disc{Point(0.3, 0.2), 0.15}}, {}},
                         {Ring{Point(0, 0), 0.3, 1.0}, {}, {}},
                         {HalfDisc{Point(0, 0), 1.0}, {}, {{Point(0, 0), Point(-0.2, 0.3), 0.1}}}};
  for (const Body& b : bodies) {
    for (const auto kind : {Pattern::Kind::lattice, Pattern::Kind::sheared, Pattern::Kind::rings}) {
      const fpz::sph::Arrangement<2> a =
          place_specimen(b, pattern(kind, kind == Pattern::Kind::rings ? 0.0 : 30.0), 0.04);
      EXPECT_NEAR(volume(a), area(b), 1e-12);
      for (const Point& x : a.position) EXPECT_TRUE(contains(b, x));
      EXPECT_NEAR(a.volume.back(), 0.04 * 0.04, 0.2 * 0.04 * 0.04);
    }
  }
}

TEST(Placing, AFittedLatticeFillsARectangleWithWholeCells) {
  const Body b{Rectangle{Point(-0.16, 0), Point(0.16, 0.08)}, {}, {}};
  Pattern p = pattern(Pattern::Kind::lattice);
  p.fit = true;
  const fpz::sph::Arrangement<2> a = place_specimen(b, p, 0.003);
  EXPECT_EQ(a.size(), 107u * 27u);
  EXPECT_NEAR(a.position.front()[0], -0.16 + 0.5 * 0.32 / 107, 1e-15);
  EXPECT_NEAR(a.position.back()[1], 0.08 - 0.5 * 0.08 / 27, 1e-15);
}

TEST(Placing, NoParticleLiesOnACut) {
  // 107 columns would put one on the notch.
  const Body b{Rectangle{Point(-0.16, 0), Point(0.16, 0.08)}, {}, {{Point(0, 0), Point(0, 0.008), 0.0}}};
  Pattern p = pattern(Pattern::Kind::lattice);
  p.fit = true;
  const fpz::sph::Arrangement<2> a = place_specimen(b, p, 0.003);
  EXPECT_EQ(a.size() % 27u, 0u);
  for (const Point& x : a.position) EXPECT_GT(std::abs(x[0]), 0.4 * 0.003);
  EXPECT_NEAR(volume(a), 0.32 * 0.08, 1e-14);
}

TEST(Placing, ColumnsFollowAnInclinedNotch) {
  for (const auto kind : {Pattern::Kind::lattice, Pattern::Kind::sheared}) {
    for (const double degrees : {0.0, 15.0, 30.0, 54.0}) {
      const double angle = degrees * pi / 180.0;
      const Notch n{Point(0, 0), 0.4 * Point(-std::sin(angle), std::cos(angle)), 0.0};
      const Body b{HalfDisc{Point(0, 0), 1.0}, {}, {n}};
      const fpz::sph::Arrangement<2> a = place_specimen(b, pattern(kind, degrees), 0.02);
      double nearest = 1.0;
      for (const Point& x : a.position) {
        if (x.dot(along(n)) > 0.0 && x.dot(along(n)) < 0.4) nearest = std::min(nearest, std::abs(x.dot(across(n))));
      }
      const double expected = kind == Pattern::Kind::lattice ? 0.01 : 0.01 * std::cos(angle);
      EXPECT_NEAR(nearest, expected, 1e-12) << degrees;
    }
  }
}

TEST(Placing, RingsAreSymmetricAboutBothAxes) {
  for (const Body& b : {Body{Disc{Point(0, 0), 1.0}, {}, {}}, Body{Ring{Point(0, 0), 0.2, 1.0}, {}, {}}}) {
    const fpz::sph::Arrangement<2> a = place_specimen(b, pattern(Pattern::Kind::rings), 0.05);
    const auto has = [&](const Point& wanted) {
      for (const Point& x : a.position) {
        if ((x - wanted).norm() < 1e-9) return true;
      }
      return false;
    };
    for (const Point& x : a.position) {
      EXPECT_TRUE(has(Point(-x[0], x[1])));
      EXPECT_TRUE(has(Point(x[0], -x[1])));
    }
  }
  EXPECT_THROW((void)place_specimen({Rectangle{Point(0, 0), Point(1, 1)}, {}, {}}, pattern(Pattern::Kind::rings), 0.1),
               std::invalid_argument);
  EXPECT_THROW((void)place_specimen({Disc{Point(0, 0), 0.1}, {Disc{Point(0, 0), 0.2}}, {}},
                                    pattern(Pattern::Kind::lattice), 0.05),
               std::invalid_argument);
}

TEST(Placing, PlatensLieOnTheSurface) {
  fpz::sph::Arrangement<2> a;
  a.spacing = 0.02;
  const Disc disc{Point(0, 0), 1.0};
  place_platen(a, disc, {Point(0, 1), Point(0, 1), 0.2, 3}, 0);
  ASSERT_EQ(a.size(), 30u);
  for (std::size_t i = 0; i < a.size(); i += 3) {
    const double x = a.position[i][0];
    EXPECT_NEAR(a.position[i][1], std::sqrt(1.0 - x * x) + 0.01, 1e-9);
    EXPECT_NEAR(a.position[i + 2][1] - a.position[i][1], 0.04, 1e-12);
  }
  fpz::sph::Arrangement<2> flat;
  flat.spacing = 0.02;
  place_platen(flat, disc, {Point(0, -1), Point(0, -1), 0.2, 3, Platen::Fit::flat}, 4);
  double highest = -2.0;
  for (const Point& x : flat.position) highest = std::max(highest, x[1]);
  for (std::size_t i = 0; i < flat.size(); i += 3) EXPECT_NEAR(flat.position[i][1], highest, 1e-9);
  EXPECT_LT(highest, -1.0);
  EXPECT_EQ(flat.group.front(), 4);
  EXPECT_THROW(place_platen(a, disc, {Point(0, 1), Point(0, 1), 4.0, 3}, 0), std::invalid_argument);
}

}  // namespace
