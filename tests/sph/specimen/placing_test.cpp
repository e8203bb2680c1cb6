#include "fpz/specimen/placing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
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
      const auto [least, most] = std::minmax_element(a.volume.begin(), a.volume.end());
      EXPECT_GT(*least, 0.4 * 0.04 * 0.04);
      EXPECT_LT(*most, 2.1 * 0.04 * 0.04);
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
        if (x[1] < 0.03) continue;  // cells that the surface cuts
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

/// The lines of the surface and the cuts.
std::vector<std::vector<Point>> walls(const Body& body) {
  std::vector<std::vector<Point>> lines = surface_lines(body, 1e-3);
  for (const Notch& n : body.notches) {
    if (n.width <= 0.0) lines.push_back({n.mouth, n.tip});
  }
  return lines;
}

double distance_to(const std::vector<std::vector<Point>>& lines, const Point& x) {
  double nearest = 1e300;
  for (const auto& line : lines) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point d = line[k + 1] - line[k];
      const double along = std::clamp((x - line[k]).dot(d) / d.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (line[k] + along * d - x).norm());
    }
  }
  return nearest;
}

/// Of the particles of a body: distances to the nearest neighbour in spacings; and of those three spacings away from
/// walls, beside which they lie in rows, the length of the mean of exp(n i angle) over the directions to the nearest
/// neighbour: 1 where all are multiples of 360/n degrees apart.
struct Neighbours {
  double least = 1e300, mean = 0.0, fourfold = 0.0, sixfold = 0.0;
};

Neighbours neighbours(const fpz::sph::Arrangement<2>& a, const Body& body) {
  const std::vector<std::vector<Point>> lines = walls(body);
  Neighbours all;
  std::complex<double> four, six;
  const auto count = static_cast<double>(a.size());
  double inner = 0.0;
  for (const Point& x : a.position) {
    Point nearest = Point::Constant(1e300);
    for (const Point& y : a.position) {
      if (&x != &y && (y - x).squaredNorm() < nearest.squaredNorm()) nearest = y - x;
    }
    const double angle = std::atan2(nearest[1], nearest[0]);
    all.least = std::min(all.least, nearest.norm() / a.spacing);
    all.mean += nearest.norm() / a.spacing / count;
    if (distance_to(lines, x) < 3.0 * a.spacing) continue;
    inner += 1.0;
    four += std::polar(1.0, 4.0 * angle);
    six += std::polar(1.0, 6.0 * angle);
  }
  all.fourfold = std::abs(four) / inner;
  all.sixfold = std::abs(six) / inner;
  return all;
}

Pattern scattered(std::uint64_t seed) {
  Pattern p = pattern(Pattern::Kind::scattered);
  p.seed = seed;
  return p;
}

const Body notched_with_hole = {Rectangle{Point(-0.16, 0), Point(0.16, 0.08)},
                                {Disc{Point(0.06, 0.05), 0.015}},
                                {{Point(0, 0), Point(0, 0.02), 0.006}, {Point(-0.08, 0), Point(-0.07, 0.03), 0.0}}};

TEST(Placing, ScatteredParticlesAreEvenAndHaveNoDirections) {
  const Body bodies[] = {
      notched_with_hole,
      {Disc{Point(0, 0), 0.1}, {}, {}},
      {HalfDisc{Point(0, 0), 0.12}, {}, {}},
      {Ring{Point(0, 0), 0.03, 0.1}, {}, {}},
      {Polygon{{Point(0, 0), Point(0.2, 0), Point(0.2, 0.1), Point(0.1, 0.1), Point(0, 0.2)}}, {}, {}}};
  constexpr double spacing = 0.003;
  for (const Body& b : bodies) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const fpz::sph::Arrangement<2> a = place_specimen(b, scattered(seed), spacing);
      EXPECT_EQ(a.size(), static_cast<std::size_t>(std::lround(area(b) / (spacing * spacing))));
      EXPECT_NEAR(volume(a), area(b), 1e-12 * area(b));
      const Neighbours n = neighbours(a, b);
      EXPECT_GE(n.least, 0.6);
      EXPECT_GE(n.mean, 0.85);
      EXPECT_LE(n.mean, 1.05);
      EXPECT_LT(n.fourfold, 0.1);
      EXPECT_LT(n.sixfold, 0.1);
    }
  }
  const Neighbours lattice = neighbours(place_specimen(bodies[1], pattern(Pattern::Kind::lattice), spacing), bodies[1]);
  EXPECT_NEAR(lattice.fourfold, 1.0, 1e-9);
}

TEST(Placing, ScatteredParticlesKeepHalfASpacingFromSurfacesAndCuts) {
  constexpr double spacing = 0.004;
  const fpz::sph::Arrangement<2> a = place_specimen(notched_with_hole, scattered(1), spacing);
  const std::vector<std::vector<Point>> lines = walls(notched_with_hole);
  std::size_t at_the_wall = 0;
  for (const Point& x : a.position) {
    EXPECT_TRUE(contains(notched_with_hole, x));
    const double distance = distance_to(lines, x) / spacing;
    EXPECT_GE(distance, 0.5 - 1e-3);
    if (distance < 0.7) ++at_the_wall;
  }
  // One per spacing of the surface and of both sides of the cut, but for the corners.
  const double length = 2 * (0.32 + 0.08) + 2 * pi * 0.015 + 2 * 0.02 + 2 * std::hypot(0.01, 0.03);
  EXPECT_NEAR(static_cast<double>(at_the_wall), length / spacing, 0.15 * length / spacing);
}

TEST(Placing, ScatteredParticlesDoNotCrowdInCorners) {
  const Body square = {Rectangle{Point(0, 0), Point(0.1, 0.1)}, {}, {}};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    EXPECT_GE(neighbours(place_specimen(square, scattered(seed), 0.01), square).least, 0.6) << seed;
  }
}

TEST(Placing, TheSeedDecidesWhereParticlesAreScattered) {
  const Body disc = {Disc{Point(0, 0), 0.1}, {}, {}};
  const fpz::sph::Arrangement<2> a = place_specimen(disc, scattered(7), 0.01),
                                 b = place_specimen(disc, scattered(7), 0.01),
                                 c = place_specimen(disc, scattered(8), 0.01);
  EXPECT_EQ(a.position, b.position);
  ASSERT_EQ(a.size(), c.size());
  EXPECT_NE(a.position, c.position);
  EXPECT_THROW((void)place_specimen({Rectangle{Point(0, 0), Point(0.1, 0.006)}, {}, {}}, scattered(1), 0.01),
               std::invalid_argument);
}

TEST(Placing, MoveDisplacesByAtMostItsShareOfTheSpacing) {
  const Body half = {HalfDisc{Point(0, 0), 0.1}, {}, {{Point(0, 0), Point(0.011, 0.03), 0.0}}};
  const Notch& cut = half.notches[0];
  constexpr double spacing = 0.003;
  for (const auto kind : {Pattern::Kind::lattice, Pattern::Kind::rings}) {
    Pattern p = pattern(kind);
    p.move = 1e-9;  // without any, a lattice would have its particles in the middle of their cells
    const fpz::sph::Arrangement<2> still = place_specimen(half, p, spacing);
    p.move = 0.3;
    p.seed = 5;
    const fpz::sph::Arrangement<2> moved = place_specimen(half, p, spacing);
    EXPECT_EQ(moved.position, place_specimen(half, p, spacing).position);
    p.seed = 6;
    EXPECT_NE(moved.position, place_specimen(half, p, spacing).position);
    ASSERT_EQ(still.size(), moved.size());
    EXPECT_NEAR(volume(moved), area(half), 1e-12 * area(half));
    double largest = 0.0, square = 0.0;
    Point mean = Point::Zero();
    for (std::size_t i = 0; i < still.size(); ++i) {
      const Point d = (moved.position[i] - still.position[i]) / spacing;
      largest = std::max(largest, d.cwiseAbs().maxCoeff());
      square += d.squaredNorm() / static_cast<double>(still.size());
      mean += d / static_cast<double>(still.size());
      EXPECT_TRUE(contains(half, moved.position[i]));
      const Point from = still.position[i] - cut.mouth, to = moved.position[i] - cut.mouth;
      const double length = (cut.tip - cut.mouth).norm();
      const auto level_with_cut = [&](const Point& at) {
        return at.dot(along(cut)) > 0.0 && at.dot(along(cut)) < length;
      };
      const bool beside = level_with_cut(from) && level_with_cut(to);
      EXPECT_TRUE(!beside || from.dot(across(cut)) * to.dot(across(cut)) > 0.0);
    }
    EXPECT_LE(largest, 0.3 + 1e-9);
    EXPECT_GT(largest, 0.29);
    EXPECT_NEAR(square, 2.0 * 0.3 * 0.3 / 3.0, 0.005);  // uniform in the square
    EXPECT_LT(mean.norm(), 0.02);
  }
}

/// Share of samples of the body that are nearest to each particle.
std::vector<double> sampled_cells(const Body& body, const fpz::sph::Arrangement<2>& a, double step) {
  std::vector<double> cells(a.size(), 0.0);
  const auto [low, high] = extent(body.shape);
  for (double y = low[1] + 0.5 * step; y < high[1]; y += step) {
    for (double x = low[0] + 0.5 * step; x < high[0]; x += step) {
      const Point at(x, y);
      if (!contains(body, at)) continue;
      const auto nearest = std::min_element(a.position.begin(), a.position.end(), [&](const Point& p, const Point& q) {
        return (p - at).squaredNorm() < (q - at).squaredNorm();
      });
      cells[static_cast<std::size_t>(nearest - a.position.begin())] += step * step;
    }
  }
  return cells;
}

TEST(Placing, VolumesAreTheAreasOfCells) {
  const Body bodies[] = {
      {Rectangle{Point(0, 0), Point(0.12, 0.08)}, {Disc{Point(0.06, 0.04), 0.015}}, {}},
      {HalfDisc{Point(0, 0), 0.06}, {}, {{Point(0, 0), Point(0, 0.02), 0.006}}},
      {Polygon{{Point(0, 0), Point(0.1, 0), Point(0.1, 0.05), Point(0.05, 0.05), Point(0, 0.1)}}, {}, {}}};
  constexpr double spacing = 0.007;
  Pattern moved = pattern(Pattern::Kind::lattice, 20.0);
  moved.move = 0.3;
  for (const Body& b : bodies) {
    for (const Pattern& p : {scattered(2), moved}) {
      const fpz::sph::Arrangement<2> a = place_specimen(b, p, spacing);
      EXPECT_NEAR(volume(a), area(b), 1e-12 * area(b));
      const std::vector<double> sampled = sampled_cells(b, a, spacing / 40.0);
      double largest = 0.0, different = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a.volume[i] - sampled[i]) / (spacing * spacing));
        different = std::max(different, std::abs(a.volume[i] / (spacing * spacing) - 1.0));
      }
      EXPECT_LT(largest, 0.03);  // of samples a fortieth of a spacing apart
      EXPECT_GT(different, 0.15);
    }
  }
}

/// Whatever the surface leaves of its cells: area and first moment are those of the body.
TEST(Placing, ALatticeHasTheAreaAndTheCentreOfItsBody) {
  constexpr double spacing = 0.01;
  Body b{Rectangle{Point(0, 0), Point(0.2, 0.1)}, {}, {}};
  for (const double angle : {0.0, 10.0, 45.0}) {
    for (const double shift : {0.0, 0.2, 0.45, 0.5, 0.8}) {
      Pattern p = pattern(Pattern::Kind::lattice, angle);
      p.origin = Point(0.3 * spacing, shift * spacing);
      const fpz::sph::Arrangement<2> a = place_specimen(b, p, spacing);
      Point moment = Point::Zero();
      double nearest = 1.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        moment += a.volume[i] * a.position[i];
        nearest = std::min({nearest, a.position[i][1], 0.1 - a.position[i][1]});
      }
      EXPECT_NEAR(volume(a), area(b), 1e-12 * area(b));
      EXPECT_LT((moment / volume(a) - Point(0.1, 0.05)).norm(), 0.01 * spacing) << angle << " " << shift;
      EXPECT_GT(nearest, 0.2 * spacing) << angle << " " << shift;  // half of the narrowest row that has its own line
    }
  }
}

/// A slot is as wide and as long as it was asked for, wherever the columns and rows are.
TEST(Placing, SlotsAreWhatCellsLeave) {
  constexpr double spacing = 0.01;
  const Notch slot{Point(0.1, 0), Point(0.1, 0.033), 0.023, 0.023};
  const Body b{Rectangle{Point(0, 0), Point(0.2, 0.1)}, {}, {slot}};
  for (const double x : {0.0, 0.2, 0.5, 0.7}) {
    for (const double y : {0.0, 0.3, 0.6}) {
      Pattern p = pattern(Pattern::Kind::lattice);
      p.origin = spacing * Point(x, y);
      const fpz::sph::Arrangement<2> a = place_specimen(b, p, spacing);
      double left = 1.0, right = 1.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        const Point at = a.position[i];
        if (at[1] < 0.01 || at[1] > 0.025) continue;
        (at[0] < 0.1 ? left : right) = std::min(at[0] < 0.1 ? left : right, std::abs(at[0] - 0.1) - 50.0 * a.volume[i]);
      }
      EXPECT_NEAR(left + right, slot.width, 1e-4) << x << " " << y;
    }
  }
}

TEST(Placing, CellsOfALatticeInsideABodyAreItsSquares) {
  constexpr double spacing = 0.002;
  const Body disc = {Disc{Point(0, 0), 0.02}, {}, {}};
  const fpz::sph::Arrangement<2> a = place_specimen(disc, pattern(Pattern::Kind::lattice, 20.0), spacing);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.position[i].norm() > 0.02 - spacing) continue;
    EXPECT_NEAR(a.volume[i], spacing * spacing, 1e-4 * spacing * spacing);
  }
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

/// Columns of a flat platen begin on a line, those of a jaw on its arc, both touching the disc in its highest place.
TEST(Placing, JawsAreArcs) {
  const Shape disc = Disc{Point(0, 0), 0.025};
  Platen platen;
  platen.at = Point(0, 0.025), platen.direction = Point(0, 1), platen.width = 0.02;
  const double spacing = 0.001;
  const auto touch = platen_columns(disc, platen, spacing);
  ASSERT_EQ(touch.size(), 20u);
  for (const PlatenColumn& c : touch) EXPECT_EQ(c.face, c.foot);
  const double highest = std::sqrt(0.025 * 0.025 - 0.0005 * 0.0005);
  platen.fit = Platen::Fit::flat;
  for (const PlatenColumn& c : platen_columns(disc, platen, spacing)) EXPECT_NEAR(c.face[1], highest, 1e-9);
  platen.fit = Platen::Fit::jaw, platen.jaw_radius = 0.0375;
  for (const PlatenColumn& c : platen_columns(disc, platen, spacing)) {
    const double arc = highest - 0.0375 + std::sqrt(0.0375 * 0.0375 - c.face[0] * c.face[0]);
    EXPECT_NEAR(c.face[1], std::max(arc, c.foot[1]), 1e-9);
    EXPECT_GE(c.face[1], c.foot[1]);
  }
  // Faces that meet: one cut on a straight surface, one for each column elsewhere, as wide as their gap.
  platen.friction = 0.3;
  const auto bent = contact_of(disc, platen, spacing);
  ASSERT_EQ(bent.size(), 20u);
  EXPECT_GT(bent.front().gap, 3.0 * bent[8].gap);
  const Shape block = Rectangle{Point(-0.02, 0), Point(0.02, 0.025)};
  platen.fit = Platen::Fit::surface, platen.jaw_radius = 0.0;
  const auto straight = contact_of(block, platen, spacing);
  ASSERT_EQ(straight.size(), 1u);
  EXPECT_NEAR((straight[0].corner[1] - straight[0].corner[0]).norm(), 0.02, 1e-9);
  EXPECT_EQ(straight[0].friction, 0.3);
}

}  // namespace
