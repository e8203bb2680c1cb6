// Where points and lines are with respect to the surface of a body.
#pragma once

#include <utility>
#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen::detail {

/// The body without its notches.
[[nodiscard]] Body without_notches(const Body& body);

/// The point of the surface of shape and holes that is nearest to x. Round lines are good to 2e-4 of their radius.
[[nodiscard]] Point nearest_on_surface(const Body& body, const Point& x);

/// Distance of x from a line of straight pieces, m.
[[nodiscard]] double distance_to(const std::vector<Point>& line, const Point& x);

/// Distance from that point, m: positive in the body, negative outside. Notches are not looked at.
[[nodiscard]] double depth(const Body& body, const Point& x);

/// The parts of the straight line from a to b that are inside shape and outside holes: distances from a of their begins
/// and ends, m, ascending.
[[nodiscard]] std::vector<std::pair<double, double>> parts_inside(const Body& body, const Point& a, const Point& b);

}  // namespace fpz::specimen::detail
