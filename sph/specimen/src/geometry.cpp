#include "fpz/specimen/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fpz::specimen {
namespace {

constexpr double pi = std::numbers::pi;

template <class... F>
struct Overload : F... {
  using F::operator()...;
};

using Interval = std::pair<double, double>;
/// Disjoint, ascending.
using Intervals = std::vector<Interval>;

Intervals chord(const Point& centre, double radius, double y) {
  const double square = radius * radius - (y - centre[1]) * (y - centre[1]);
  if (square <= 0.0) return {};
  return {{centre[0] - std::sqrt(square), centre[0] + std::sqrt(square)}};
}

Intervals chord(const std::vector<Point>& polygon, double y) {
  std::vector<double> x;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point& a = polygon[k];
    const Point& b = polygon[(k + 1) % polygon.size()];
    if ((a[1] <= y) != (b[1] <= y)) x.push_back(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
  }
  std::sort(x.begin(), x.end());
  Intervals all;
  for (std::size_t k = 0; k + 1 < x.size(); k += 2) all.emplace_back(x[k], x[k + 1]);
  return all;
}

Intervals minus(const Intervals& a, const Intervals& b) {
  Intervals rest = a;
  for (const Interval& hole : b) {
    Intervals next;
    for (const Interval& piece : rest) {
      if (hole.first > piece.first) next.emplace_back(piece.first, std::min(piece.second, hole.first));
      if (hole.second < piece.second) next.emplace_back(std::max(piece.first, hole.second), piece.second);
    }
    std::erase_if(next, [](const Interval& i) { return i.second <= i.first; });
    rest.swap(next);
  }
  return rest;
}

/// Where the line at height y is inside the shape.
Intervals chord(const Shape& shape, double y) {
  return std::visit(
      Overload{[&](const Rectangle& r) -> Intervals {
                 if (y < r.low[1] || y > r.high[1]) return {};
                 return {{r.low[0], r.high[0]}};
               },
               [&](const Disc& d) { return chord(d.centre, d.radius, y); },
               [&](const HalfDisc& d) -> Intervals {
                 if (y < d.centre[1]) return {};
                 return chord(d.centre, d.radius, y);
               },
               [&](const Ring& r) { return minus(chord(r.centre, r.outer, y), chord(r.centre, r.inner, y)); },
               [&](const Polygon& p) { return chord(p.corners, y); }},
      shape);
}

constexpr int pieces_drawn = 180;  // of a circle or half circle

std::vector<Point> arc(const Point& centre, double radius, double from, double to, int pieces) {
  std::vector<Point> line;
  for (int k = 0; k <= pieces; ++k) {
    const double angle = from + (to - from) * k / pieces;
    line.emplace_back(centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle));
  }
  return line;
}

std::vector<Point> closed(std::vector<Point> line) {
  if (!line.empty()) line.push_back(line.front());
  return line;
}

std::vector<std::vector<Point>> outlines(const Shape& shape, int pieces) {
  using Lines = std::vector<std::vector<Point>>;
  return std::visit(
      Overload{[](const Rectangle& r) -> Lines {
                 return {closed({r.low, Point(r.high[0], r.low[1]), r.high, Point(r.low[0], r.high[1])})};
               },
               [&](const Disc& d) -> Lines { return {arc(d.centre, d.radius, 0.0, 2.0 * pi, pieces)}; },
               [&](const HalfDisc& d) -> Lines { return {closed(arc(d.centre, d.radius, 0.0, pi, pieces))}; },
               [&](const Ring& r) -> Lines {
                 Lines lines = {arc(r.centre, r.outer, 0.0, 2.0 * pi, pieces)};
                 if (r.inner > 0.0) lines.push_back(arc(r.centre, r.inner, 0.0, 2.0 * pi, pieces));
                 return lines;
               },
               [](const Polygon& p) -> Lines { return {closed(p.corners)}; }},
      shape);
}

}  // namespace

Point nearest_on(const Point& a, const Point& b, const Point& x) {
  const Point d = b - a;
  const double square = d.squaredNorm();
  return square > 0.0 ? Point(a + std::clamp((x - a).dot(d) / square, 0.0, 1.0) * d) : a;
}

bool contains(const Shape& shape, const Point& x) {
  for (const auto& [left, right] : chord(shape, x[1])) {
    if (x[0] >= left && x[0] <= right) return true;
  }
  return false;
}

bool contains(const Body& body, const Point& x) {
  if (!contains(body.shape, x)) return false;
  for (const Shape& hole : body.holes) {
    if (contains(hole, x)) return false;
  }
  return std::none_of(body.notches.begin(), body.notches.end(),
                      [&](const Notch& n) { return n.width > 0.0 && contains(Polygon{corners(n)}, x); });
}

std::vector<std::pair<double, double>> chord(const Body& body, double y) {
  Intervals inside = chord(body.shape, y);
  for (const Shape& hole : body.holes) inside = minus(inside, chord(hole, y));
  for (const Notch& n : body.notches) inside = minus(inside, chord(corners(n), y));
  return inside;
}

std::pair<Point, Point> extent(const Shape& shape) {
  const auto around = [](const Point& c, double r) {
    return std::pair(Point(c[0] - r, c[1] - r), Point(c[0] + r, c[1] + r));
  };
  return std::visit(Overload{[](const Rectangle& r) { return std::pair(r.low, r.high); },
                             [&](const Disc& d) { return around(d.centre, d.radius); },
                             [&](const HalfDisc& d) {
                               auto box = around(d.centre, d.radius);
                               box.first[1] = d.centre[1];
                               return box;
                             },
                             [&](const Ring& r) { return around(r.centre, r.outer); },
                             [](const Polygon& p) {
                               Point low = p.corners.front(), high = p.corners.front();
                               for (const Point& c : p.corners) {
                                 low = low.cwiseMin(c).eval();
                                 high = high.cwiseMax(c).eval();
                               }
                               return std::pair(low, high);
                             }},
                    shape);
}

double area(const Shape& shape) {
  return std::visit(Overload{[](const Rectangle& r) { return (r.high[0] - r.low[0]) * (r.high[1] - r.low[1]); },
                             [](const Disc& d) { return pi * d.radius * d.radius; },
                             [](const HalfDisc& d) { return 0.5 * pi * d.radius * d.radius; },
                             [](const Ring& r) { return pi * (r.outer * r.outer - r.inner * r.inner); },
                             [](const Polygon& p) {
                               double twice = 0.0;
                               for (std::size_t k = 0; k < p.corners.size(); ++k) {
                                 const Point& a = p.corners[k];
                                 const Point& b = p.corners[(k + 1) % p.corners.size()];
                                 twice += a[0] * b[1] - b[0] * a[1];
                               }
                               return 0.5 * std::abs(twice);
                             }},
                    shape);
}

double area(const Body& body) {
  std::vector<Shape> missing = body.holes;
  for (const Notch& n : body.notches) {
    if (n.width > 0.0) missing.emplace_back(Polygon{corners(n)});
  }
  if (missing.empty()) return area(body.shape);
  // The removed part alone is summed up, so that its error is relative to itself; each removed shape only where no
  // earlier one removed already.
  double removed = 0.0;
  constexpr int lines = 100'000;
  for (std::size_t m = 0; m < missing.size(); ++m) {
    const double low = std::max(extent(missing[m]).first[1], extent(body.shape).first[1]);
    const double high = std::min(extent(missing[m]).second[1], extent(body.shape).second[1]);
    const double step = (high - low) / lines;
    for (int k = 0; k < lines && step > 0.0; ++k) {
      const double y = low + (k + 0.5) * step;
      const Intervals shape = chord(body.shape, y);
      Intervals rest = minus(shape, minus(shape, chord(missing[m], y)));
      for (std::size_t e = 0; e < m; ++e) rest = minus(rest, chord(missing[e], y));
      for (const auto& [left, right] : rest) removed += (right - left) * step;
    }
  }
  return area(body.shape) - removed;
}

Point along(const Notch& n) { return (n.tip - n.mouth).normalized(); }

Point across(const Notch& n) {
  const Point d = along(n);
  return {-d[1], d[0]};
}

std::vector<Point> corners(const Notch& n) {
  if (n.width <= 0.0) return {};
  const Point side = 0.5 * n.width * across(n);
  const Point back = n.internal ? n.mouth : Point(n.mouth - n.width * along(n));
  return {back - side, n.tip - side, n.tip + side, back + side};
}

sph::Cut<2> cut_of(const Notch& n) { return {{n.mouth, n.tip}, {}}; }

sph::Cut<2> cut_in(const Body& body, const Notch& n, double spacing) {
  const Point beyond = 0.5 * spacing * along(n);
  sph::Cut<2> cut = cut_of(n);
  cut.width = n.width;
  cut.gap = std::max(n.width, n.asked_width);
  if (n.width <= 0.0) cut.is_tip = {contains(body, n.mouth - beyond), contains(body, n.tip + beyond)};
  return cut;
}

namespace {

std::vector<std::vector<Point>> outlines(const Body& body, int pieces) {
  std::vector<std::vector<Point>> lines = outlines(body.shape, pieces);
  for (const Shape& hole : body.holes) {
    for (auto& line : outlines(hole, pieces)) lines.push_back(std::move(line));
  }
  for (const Notch& n : body.notches) {
    lines.push_back(n.width > 0.0 ? closed(corners(n)) : std::vector<Point>{n.mouth, n.tip});
  }
  return lines;
}

}  // namespace

std::vector<std::vector<Point>> outlines(const Body& body) { return outlines(body, pieces_drawn); }

std::vector<std::vector<Point>> surface_lines(const Body& body, double step) {
  constexpr int pieces_of_arc = 1440;  // chords within 3e-6 of the radius, normals within an eighth of a degree
  std::vector<std::vector<Point>> surface;
  for (const std::vector<Point>& line : outlines(body, pieces_of_arc)) {
    std::vector<Point> part;
    const auto finish = [&] {
      if (part.size() > 1) surface.push_back(part);
      part.clear();
    };
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point d = line[k + 1] - line[k];
      const int steps = std::max(1, static_cast<int>(std::ceil(d.norm() / step)));
      const Point side = 0.05 * step * Point(-d[1], d[0]).normalized();
      for (int n = 0; n < steps; ++n) {
        const Point from = line[k] + d * n / steps, middle = line[k] + d * (n + 0.5) / steps;
        if (contains(body, middle + side) == contains(body, middle - side)) {
          finish();
          continue;
        }
        if (part.empty()) part.push_back(from);
        part.push_back(n + 1 == steps ? line[k + 1] : Point(line[k] + d * (n + 1) / steps));
      }
    }
    finish();
  }
  return surface;
}

}  // namespace fpz::specimen
