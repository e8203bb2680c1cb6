#include "surface_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fpz::specimen::detail {
namespace {

/// Calls f(p, q) for every straight piece of the outlines of shape and holes.
template <class F>
void for_pieces(const Body& body, F&& f) {
  for (const std::vector<Point>& line : outlines(without_notches(body))) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) f(line[k], line[k + 1]);
  }
}

}  // namespace

Body without_notches(const Body& body) { return {body.shape, body.holes, {}}; }

Point nearest_on_surface(const Body& body, const Point& x) {
  Point nearest = x;
  double least = std::numeric_limits<double>::infinity();
  for_pieces(body, [&](const Point& p, const Point& q) {
    const Point foot = nearest_on(p, q, x);
    const double distance = (x - foot).norm();
    if (distance < least) least = distance, nearest = foot;
  });
  return nearest;
}

double distance_to(const std::vector<Point>& line, const Point& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    least = std::min(least, (x - nearest_on(line[k], line[k + 1], x)).norm());
  }
  return least;
}

double depth(const Body& body, const Point& x) {
  const double distance = (x - nearest_on_surface(body, x)).norm();
  return contains(without_notches(body), x) ? distance : -distance;
}

std::vector<std::pair<double, double>> parts_inside(const Body& body, const Point& a, const Point& b) {
  const Point way = b - a;
  const double length = way.norm();
  std::vector<double> passages = {0.0, length};
  for_pieces(body, [&](const Point& p, const Point& q) {
    const Point d = q - p;
    const double parallel = cross(way, d);
    if (std::abs(parallel) <= 1e-12 * length * d.norm()) return;
    const double along = cross(p - a, d) / parallel, on_piece = cross(p - a, way) / parallel;
    if (along > 0.0 && along < 1.0 && on_piece >= 0.0 && on_piece <= 1.0) passages.push_back(along * length);
  });
  std::sort(passages.begin(), passages.end());
  const Body whole = without_notches(body);
  std::vector<std::pair<double, double>> parts;
  for (std::size_t k = 0; k + 1 < passages.size(); ++k) {
    const double from = passages[k], to = passages[k + 1];
    if (to - from <= 1e-9 * length || !contains(whole, a + 0.5 * (from + to) / length * way)) continue;
    if (!parts.empty() && from - parts.back().second <= 1e-9 * length) {
      parts.back().second = to;
    } else {
      parts.emplace_back(from, to);
    }
  }
  return parts;
}

}  // namespace fpz::specimen::detail
