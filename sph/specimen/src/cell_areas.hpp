// The part of a body that is nearest to each of its particles.
#pragma once

#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen::detail {

struct Cell {
  double area = 0.0;               ///< m^2
  bool cut = false;                ///< by the surface
  Point centroid = Point::Zero();  ///< of a cell that the surface cuts, m
};

/// The Voronoi cells of the points in the body. Areas inside are exact, those that the surface cuts to 1e-3 (sums over
/// horizontal lines); all are scaled alike, so that their sum is the area of the body. Notches of width 0 part no
/// cells. `spacing` is the mean distance of the points; no cell reaches farther than three of it.
[[nodiscard]] std::vector<Cell> cells(const Body& body, const std::vector<Point>& points, double spacing);

}  // namespace fpz::specimen::detail
