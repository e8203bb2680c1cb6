// The part of a body that is nearest to each of its particles.
#pragma once

#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen::detail {

/// Areas of the Voronoi cells of the points in the body, m^2. Those inside are exact, those that the surface cuts to
/// 1e-3 (sums over horizontal lines); all are scaled alike, so that their sum is the area of the body. Notches of width
/// 0 part no cells. `spacing` is the mean distance of the points; no cell reaches farther than three of it.
[[nodiscard]] std::vector<double> cell_areas(const Body& body, const std::vector<Point>& points, double spacing);

}  // namespace fpz::specimen::detail
