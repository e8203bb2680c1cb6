#include "cell_areas.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "point_grid.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr double reach = 3.0;  // spacings

/// What of a convex polygon lies on the near side of the middle between the origin and `other`.
std::vector<Point> nearer_part(const std::vector<Point>& polygon, const Point& other) {
  const double middle = 0.5 * other.squaredNorm();
  std::vector<Point> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point& a = polygon[k];
    const Point& b = polygon[(k + 1) % polygon.size()];
    const double beyond_a = a.dot(other) - middle, beyond_b = b.dot(other) - middle;
    if (beyond_a <= 0.0) part.push_back(a);
    if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0)) {
      part.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
    }
  }
  return part;
}

double farthest(const std::vector<Point>& polygon) {
  double square = 0.0;
  for (const Point& x : polygon) square = std::max(square, x.squaredNorm());
  return std::sqrt(square);
}

/// The points that are nearer to point i than to any other one, seen from it.
std::vector<Point> cell_of(const std::vector<Point>& points, std::size_t i, const PointGrid& grid, double spacing) {
  const double half = reach / std::sqrt(2.0) * spacing;
  std::vector<Point> cell = {Point(-half, -half), Point(half, -half), Point(half, half), Point(-half, half)};
  for (const double radius : {reach * spacing, 2.0 * reach * spacing}) {  // the second for cells on the surface
    std::vector<Point> others;
    grid.near(points[i], radius, [&](std::size_t k) {
      if (k != i) others.emplace_back(points[k] - points[i]);
    });
    std::sort(others.begin(), others.end(),
              [](const Point& a, const Point& b) { return a.squaredNorm() < b.squaredNorm(); });
    for (const Point& other : others) {
      if (other.norm() >= 2.0 * farthest(cell)) break;
      cell = nearer_part(cell, other);
    }
    if (radius >= 2.0 * farthest(cell)) break;
  }
  return cell;
}

/// The part of a polygon that lies in the body.
Cell part_within(const Body& body, const Polygon& polygon) {
  constexpr int lines = 256;
  const Body cell{polygon, {}, {}};
  const auto [low, high] = extent(polygon);
  const double bottom = std::max(low[1], extent(body.shape).first[1]);
  const double step = (std::min(high[1], extent(body.shape).second[1]) - bottom) / lines;
  Cell part;
  part.cut = true;
  for (int k = 0; k < lines && step > 0.0; ++k) {
    const double y = bottom + (k + 0.5) * step;
    for (const auto& [from, to] : chord(cell, y)) {
      for (const auto& [left, right] : chord(body, y)) {
        const double begin = std::max(from, left), end = std::min(to, right);
        const double area = step * std::max(0.0, end - begin);
        part.area += area;
        part.centroid += area * Point(0.5 * (begin + end), y);
      }
    }
  }
  if (part.area > 0.0) part.centroid /= part.area;
  return part;
}

}  // namespace

std::vector<Cell> cells(const Body& body, const std::vector<Point>& points, double spacing) {
  const double piece = 0.25 * spacing;
  std::vector<Point> surface;
  for (const auto& line : surface_lines(body, piece)) surface.insert(surface.end(), line.begin(), line.end());
  const PointGrid near_surface(surface, spacing), grid(points, spacing);
  std::vector<Cell> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Polygon cell{cell_of(points, i, grid, spacing)};
    const double radius = farthest(cell.corners);
    for (Point& corner : cell.corners) corner += points[i];
    bool whole = true;
    near_surface.near(points[i], radius + piece, [&](std::size_t) { whole = false; });
    all.push_back(whole ? Cell{area(Shape(cell)), false, Point::Zero()} : part_within(body, cell));
  }
  const double sum = std::accumulate(all.begin(), all.end(), 0.0, [](double s, const Cell& c) { return s + c.area; });
  const double scale = area(body) / sum;
  for (Cell& c : all) c.area *= scale;
  return all;
}

}  // namespace fpz::specimen::detail
