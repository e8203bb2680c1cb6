// Repulsion of discs of unequal size: equal ones gather in grains of a hexagonal lattice, so large that a body of some
// thousand particles has directions again.
#include "scattered.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>

#include "point_grid.hpp"

namespace fpz::specimen::detail {
namespace {

// Lengths in spacings.
constexpr double clearance = 0.5;       // from surfaces and cuts
constexpr double mean_diameter = 1.07;  // of a disc: hexagonal packing of one particle per spacing^2
constexpr double spread = 0.2;          // diameters are within mean_diameter (1 +- spread)
constexpr double longest_step = 0.1;    // per sweep; below twice the clearance, so that no step crosses a wall
constexpr double wall_piece = 0.25;
constexpr int block = 2;  // the sweeps would not forget the directions of blocks with one particle
constexpr int sweeps = 200;

/// Numbers that do not depend on the standard library: its engines are specified to the bit, its distributions not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// 0 <= x < 1.
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  Point in_box(const Point& low, const Point& high) {
    const double x = uniform(), y = uniform();
    return low + Point(x, y).cwiseProduct(high - low);
  }

 private:
  std::mt19937_64 engine_;
};

/// Surfaces and cuts, in short pieces.
class Walls {
 public:
  Walls(const Body& body, double spacing)
      : body_(body),
        spacing_(spacing),
        lines_(pieces_of(body, spacing)),
        middles_(middles_of(lines_)),
        grid_(middles_, reach() * spacing) {}

  /// x, or the place close to it that has the clearance; nothing when there is none or x is not in the body.
  [[nodiscard]] std::optional<Point> cleared(Point x) const {
    constexpr int tries = 8;  // a corner takes two, a rounded or acute one some more
    const double wanted = clearance * spacing_;
    if (!contains(body_, x)) return std::nullopt;
    for (int n = 0; n < tries; ++n) {
      const std::optional<Point> wall = nearest(x);
      if (!wall) return x;
      const double distance = (x - *wall).norm();
      if (distance >= wanted * (1.0 - 1e-9)) return x;
      if (distance <= 1e-6 * spacing_) return std::nullopt;  // on the wall: its sides cannot be told apart
      x = *wall + wanted / distance * (x - *wall);
      if (!contains(body_, x)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  using Piece = std::pair<Point, Point>;

  static constexpr double reach() { return clearance + 0.5 * wall_piece; }

  static std::vector<Piece> pieces_of(const Body& body, double spacing) {
    std::vector<Piece> pieces;
    for (const auto& line : surface_lines(body, wall_piece * spacing)) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) pieces.emplace_back(line[k], line[k + 1]);
    }
    for (const Notch& n : body.notches) {
      if (n.width > 0.0) continue;
      const int steps = std::max(1, static_cast<int>(std::ceil((n.tip - n.mouth).norm() / (wall_piece * spacing))));
      const Point step = (n.tip - n.mouth) / steps;
      for (int k = 0; k < steps; ++k) pieces.emplace_back(n.mouth + k * step, n.mouth + (k + 1) * step);
    }
    return pieces;
  }

  static std::vector<Point> middles_of(const std::vector<Piece>& pieces) {
    std::vector<Point> middles;
    for (const auto& [a, b] : pieces) middles.emplace_back(0.5 * (a + b));
    return middles;
  }

  /// The point of the walls next to x, if there is one within the clearance.
  [[nodiscard]] std::optional<Point> nearest(const Point& x) const {
    std::optional<Point> best;
    grid_.near(x, reach() * spacing_, [&](std::size_t k) {
      const Point at = nearest_on(lines_[k].first, lines_[k].second, x);
      if (!best || (at - x).squaredNorm() < (*best - x).squaredNorm()) best = at;
    });
    return best;
  }

  const Body& body_;
  double spacing_;
  std::vector<Piece> lines_;
  std::vector<Point> middles_;
  PointGrid grid_;
};

/// As many particles in each of the equal blocks that fill the extent as its area asks for, anywhere in it; those near
/// a wall are moved away from it. What the blocks at the boundary lack or have too many is added or removed anywhere.
std::vector<Point> first_places(const Body& body, const Walls& walls, Random& random, double spacing) {
  const auto count = static_cast<std::size_t>(std::llround(area(body) / (spacing * spacing)));
  const auto [low, high] = extent(body.shape);
  std::vector<Point> x;
  const Point blocks = ((high - low) / (block * spacing)).array().round().max(1.0);
  const Point side = (high - low).cwiseQuotient(blocks);
  double due = 0.0;
  for (double j = 0.0; j < blocks[1]; ++j) {
    for (double i = 0.0; i < blocks[0]; ++i) {
      const Point corner = low + side.cwiseProduct(Point(i, j));
      for (due += side.prod() / (spacing * spacing); due >= 0.5; --due) {
        if (const auto place = walls.cleared(random.in_box(corner, corner + side))) x.push_back(*place);
      }
    }
  }
  while (x.size() > count) {
    std::swap(x[static_cast<std::size_t>(random.uniform() * static_cast<double>(x.size()))], x.back());
    x.pop_back();
  }
  const double cells = (high - low).prod() / (spacing * spacing);
  for (double left = 1000.0 * (cells + 1.0); x.size() < count; --left) {
    if (left < 0.0) throw std::invalid_argument("the body is too thin for particles of this spacing");
    if (const auto place = walls.cleared(random.in_box(low, high))) x.push_back(*place);
  }
  return x;
}

/// Moves all particles at once, each away from those whose discs overlap its own.
void sweep(std::vector<Point>& x, const std::vector<double>& diameter, const Walls& walls, double spacing) {
  constexpr double share = 0.3;  // of the overlap: half would part two particles alone, and overshoot with six around
  const double reach = mean_diameter * (1.0 + spread) * spacing;
  const PointGrid grid(x, reach);
  std::vector<Point> next = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    Point step = Point::Zero();
    grid.near(x[i], reach, [&](std::size_t k) {
      if (k == i) return;
      Point d = x[i] - x[k];
      // Two in one corner: walls along the axes let one of them out of it.
      if (d.isZero(0.0)) d = (i < k ? 1e-6 : -1e-6) * spacing * Point(1.0, 1.0);
      const double r = d.norm(), rest = 0.5 * (diameter[i] + diameter[k]);
      if (r < rest) step += share * (rest - r) / r * d;
    });
    const double length = step.norm();
    if (length > longest_step * spacing) step *= longest_step * spacing / length;
    next[i] = walls.cleared(x[i] + step).value_or(x[i]);
  }
  x.swap(next);
}

}  // namespace

sph::Arrangement<2> scatter(const Body& body, std::uint64_t seed, double spacing) {
  Random random(seed);
  const Walls walls(body, spacing);
  std::vector<Point> x = first_places(body, walls, random, spacing);
  std::vector<double> diameter;
  for (std::size_t i = 0; i < x.size(); ++i) {
    diameter.push_back(mean_diameter * spacing * (1.0 + spread * (2.0 * random.uniform() - 1.0)));
  }
  for (int n = 0; n < sweeps; ++n) sweep(x, diameter, walls, spacing);
  sph::Arrangement<2> a;
  a.spacing = spacing;
  for (const Point& place : x) a.add(place, spacing * spacing);
  return a;
}

void move_at_random(sph::Arrangement<2>& a, const Body& body, double distance, std::uint64_t seed) {
  constexpr int tries = 100;
  Random random(seed);
  // A particle that lies on a cut stays there: an error for whoever made the scene.
  const auto allowed = [&](const Point& from, const Point& to) {
    return contains(body, to) && std::none_of(body.notches.begin(), body.notches.end(), [&](const Notch& n) {
             const sph::Cut<2> cut = cut_of(n);
             return n.width <= 0.0 && (sph::lies_on(cut, from) || sph::lies_on(cut, to) || sph::crosses(cut, from, to));
           });
  };
  const Point reach(distance, distance);
  for (Point& x : a.position) {
    for (int n = 0; n < tries; ++n) {
      const Point to = random.in_box(x - reach, x + reach);
      if (!allowed(x, to)) continue;
      x = to;
      break;
    }
  }
}

}  // namespace fpz::specimen::detail
