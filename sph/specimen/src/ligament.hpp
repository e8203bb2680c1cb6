// The narrowest neck of a body: where the fewest rows of particles lie side by side.
#pragma once

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen::detail {

struct Ligament {
  double width = 0.0;  ///< m; infinite where there is none
  Point from = Point::Zero(), to = Point::Zero();
};

/// The smallest distance between surfaces that face each other across material, and from ends of notches and re-entrant
/// corners to the surface ahead of them. Corners, towards which every body tapers to nothing, are no ligaments: between
/// faces only local minima of the distance count. Good to about a thousandth.
[[nodiscard]] Ligament smallest_ligament(const Body& body);

}  // namespace fpz::specimen::detail
