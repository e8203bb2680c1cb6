#include "ligament.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "surface_depth.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// A straight piece of the surface.
struct Piece {
  Point a, b;
  Point inward;  ///< unit normal, into the body
};
using Line = std::vector<Piece>;

Point normal_of(const Point& a, const Point& b) {
  const Point d = (b - a).normalized();
  return {-d[1], d[0]};
}

double perimeter(const Body& body) {
  double sum = 0.0;
  for (const auto& line : outlines(body)) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) sum += (line[k + 1] - line[k]).norm();
  }
  return sum;
}

/// The surface in lines of pieces, and both faces of cuts.
std::vector<Line> faces_of(const Body& body, double step) {
  std::vector<Line> faces;
  for (const std::vector<Point>& points : surface_lines(body, step)) {
    Line& line = faces.emplace_back();
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const Point n = normal_of(points[k], points[k + 1]);
      const bool left = contains(body, 0.5 * (points[k] + points[k + 1]) + 0.05 * step * n);
      line.push_back({points[k], points[k + 1], left ? n : Point(-n)});
    }
  }
  for (const Notch& notch : body.notches) {
    if (notch.width > 0.0) continue;
    for (const double side : {1.0, -1.0}) {
      Line& line = faces.emplace_back();
      const int pieces = std::max(1, static_cast<int>(std::ceil((notch.tip - notch.mouth).norm() / step)));
      for (int k = 0; k < pieces; ++k) {
        const Point a = notch.mouth + (notch.tip - notch.mouth) * k / pieces;
        const Point b = notch.mouth + (notch.tip - notch.mouth) * (k + 1) / pieces;
        if (contains(body, 0.5 * (a + b))) line.push_back({a, b, side * across(notch)});
      }
    }
  }
  return faces;
}

/// Width of the material that begins at the middle of a piece, along its normal; infinite where the face that ends it
/// is not turned towards it.
Ligament width_at(const Piece& from, const std::vector<Line>& faces) {
  constexpr double facing = 0.87;  // cosine of 30 degrees
  const Point start = 0.5 * (from.a + from.b);
  const double nothing = 1e-6 * (from.b - from.a).norm();
  double nearest = none, best = 0.0;
  for (const Line& line : faces) {
    for (const Piece& p : line) {
      const double turned = -p.inward.dot(from.inward);
      if (turned <= 0.0) continue;
      const Point d = p.b - p.a;
      const double parallel = cross(from.inward, d);
      if (parallel == 0.0) continue;
      const double along = cross(p.a - start, d) / parallel, on_piece = cross(p.a - start, from.inward) / parallel;
      if (along <= nothing || along >= nearest || on_piece < -1e-9 || on_piece > 1.0 + 1e-9) continue;
      nearest = along, best = turned;
    }
  }
  return {best >= facing ? nearest : none, start, start + nearest * from.inward};
}

/// Of the faces of a line, where the width is not less than beside it; ends of the line do not count.
Ligament narrowest_along(const Line& line, const std::vector<Line>& faces, std::size_t stride) {
  constexpr double equal = 1e-5;  // relative: chords of arcs differ by less
  Ligament best{none, {}, {}};
  std::vector<Ligament> widths;
  for (std::size_t k = 0; k < line.size(); k += stride) widths.push_back(width_at(line[k], faces));
  for (std::size_t k = 1; k + 1 < widths.size(); ++k) {
    const double least_beside = std::min(widths[k - 1].width, widths[k + 1].width);
    const bool between = widths[k - 1].width < none && widths[k + 1].width < none;
    if (between && widths[k].width <= (1.0 + equal) * least_beside && widths[k].width < best.width) best = widths[k];
  }
  return best;
}

/// From a point to the nearest face ahead of it, within 60 degrees and turned towards it.
Ligament ahead(const Point& from, const Point& direction, const std::vector<Line>& faces) {
  constexpr double cone = 0.5, near = 1e-6;
  Ligament best{none, from, from};
  for (const Line& line : faces) {
    for (const Piece& p : line) {
      const Point d = p.b - p.a;
      const Point foot = nearest_on(p.a, p.b, from);
      const Point way = foot - from;
      const double distance = way.norm();
      if (distance <= near * d.norm() || distance >= best.width) continue;
      if (way.dot(direction) >= cone * distance && -way.dot(p.inward) >= cone * distance) {
        best = {distance, from, foot};
      }
    }
  }
  return best;
}

/// Corners at which the body has an angle of more than 200 degrees, with the direction into it.
template <class F>
void for_reentrant_corners(const Line& line, F&& f) {
  constexpr double sine_of_bend = 0.34;
  const bool closed = line.size() > 2 && (line.front().a - line.back().b).norm() < 1e-12;
  for (std::size_t k = closed ? 0 : 1; k < line.size(); ++k) {
    const Piece& before = line[k == 0 ? line.size() - 1 : k - 1];
    const Piece& after = line[k];
    const Point along = (after.b - after.a).normalized();
    if (-before.inward.dot(along) >= sine_of_bend) f(after.a, (before.inward + after.inward).normalized());
  }
}

/// An end of a notch in the body, and where it points.
struct Tip {
  Point place, direction;
};

std::vector<Tip> tips_of(const Body& body) {
  std::vector<Tip> tips;
  for (const Notch& n : body.notches) {
    if (depth(body, n.tip) > 0.0) tips.push_back({n.tip, along(n)});
    if (n.internal) tips.push_back({n.mouth, -along(n)});
  }
  return tips;
}

}  // namespace

Ligament smallest_ligament(const Body& body) {
  constexpr double pieces = 1200.0, rays = 1500.0;
  const std::vector<Line> faces = faces_of(body, perimeter(body) / pieces);
  std::size_t count = 0;
  for (const Line& line : faces) count += line.size();
  const auto stride = static_cast<std::size_t>(std::ceil(static_cast<double>(count) / rays));
  Ligament best{none, {}, {}};
  const auto take = [&](const Ligament& l) {
    if (l.width < best.width) best = l;
  };
  for (const Line& line : faces) {
    take(narrowest_along(line, faces, std::max<std::size_t>(stride, 1)));
    for_reentrant_corners(line, [&](const Point& x, const Point& direction) { take(ahead(x, direction, faces)); });
  }
  const std::vector<Tip> tips = tips_of(body);
  for (const Tip& tip : tips) {
    take(ahead(tip.place, tip.direction, faces));
    for (const Tip& other : tips) {
      const Point way = other.place - tip.place;
      if (way.dot(tip.direction) > 0.5 * way.norm()) take({way.norm(), tip.place, other.place});
    }
  }
  return best;
}

}  // namespace fpz::specimen::detail
