// Holes against the body.
#include <algorithm>

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
