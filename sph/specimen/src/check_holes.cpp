// Holes against the body.
#include <algorithm>
#include <cmath>

#include "check_scene.hpp"
#include "surface_depth.hpp"

namespace fpz::specimen::detail {
namespace {

std::string reach(const Shape& shape) {
  const auto [low, high] = extent(shape);
  return "from " + brief(low) + " to " + brief(high);
}

bool every_corner_in(const Shape& outer, const Shape& inner) {
  bool all = true;
  for (const auto& line : outlines(Body{inner, {}, {}})) {
    all = all && std::all_of(line.begin(), line.end(), [&](const Point& x) { return contains(outer, x); });
  }
  return all;
}

Point middle(const Shape& shape) {
  const auto [low, high] = extent(shape);
  return 0.5 * (low + high);
}

/// Least distance of the rim of a hole from a surface, m.
double distance_of(const Shape& hole, const Shape& surface) {
  double least = 1e300;
  for (const auto& rim : outlines(Body{hole, {}, {}})) {
    for (const auto& line : outlines(Body{surface, {}, {}})) {
      for (const Point& x : rim) least = std::min(least, distance_to(line, x));
      for (const Point& x : line) least = std::min(least, distance_to(rim, x));
    }
  }
  return least;
}

/// A wall that is no wall: rounding has kept a hole from what it was meant to touch or to cross.
void check_wall(const SceneCheck& c, const Place& p, const Shape& hole, const Shape& surface, const std::string& name) {
  constexpr double thin = 0.1, touching = 1e-12;  // spacings; m
  const double wall = distance_of(hole, surface);
  if (wall >= thin * c.scene.spacing || wall <= touching) return;
  c.problem(p, "the hole " + reach(hole) + " leaves a wall of " + brief(wall) + " m (" + brief(wall / c.scene.spacing) +
                   " spacings) to " + name +
                   ", which particles cannot show; must cross it by as much, or keep three spacings away");
}

void check_hole(const SceneCheck& c, const Place& p, std::size_t k) {
  const Scene& s = c.scene;
  const Shape& hole = s.body.holes[k];
  const double whole = area(s.body.shape), left = area(Body{s.body.shape, {hole}, {}});
  const auto [low, high] = extent(hole);
  const double size = (high - low).minCoeff();
  if (whole - left < 1e-6 * area(hole)) {
    return c.problem(p, "the hole reaches " + reach(hole) + " and is outside the body, which reaches " +
                            reach(s.body.shape) + ": it removes nothing");
  }
  if (left < 0.01 * whole) return c.problem(p, "the hole " + reach(hole) + " removes the whole body");
  if (size < 2.0 * s.spacing) {
    c.warn(p, "the hole is " + brief(size) + " m wide, less than two spacings: particles cannot follow it" +
                  likely_length(size, 2.0 * s.spacing, 0.5 * (extent(s.body.shape).second - low).maxCoeff()));
  }
  for (std::size_t j = 0; j < k; ++j) {
    if (every_corner_in(s.body.holes[j], hole)) {
      c.problem(p, "the hole lies within holes[" + std::to_string(j) + "]: it removes nothing");
    }
  }
  if (every_corner_in(s.body.shape, hole)) check_wall(c, p, hole, s.body.shape, "the surface of the body");
  for (std::size_t j = 0; j < k; ++j) {
    const bool apart = std::abs(area(Body{s.body.shape, {hole, s.body.holes[j]}, {}}) - left + area(s.body.holes[j])) <
                       1e-6 * area(hole);
    if (apart) check_wall(c, p, hole, s.body.holes[j], "holes[" + std::to_string(j) + "]");
  }
  // A bay is cut from outside; a hole whose middle is in the body was hardly meant to open its surface.
  if (!every_corner_in(s.body.shape, hole) && contains(s.body.shape, middle(hole))) {
    c.warn(p, "the hole " + reach(hole) + " crosses the surface of the body, which reaches " + reach(s.body.shape));
  }
}

}  // namespace

void check_holes(const SceneCheck& c) {
  for_entries(c, "holes", [&](const Place& p, std::size_t k) { check_hole(c, p, k); });
}

}  // namespace fpz::specimen::detail
