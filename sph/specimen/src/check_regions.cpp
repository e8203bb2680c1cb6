// Regions against the body.
#include <algorithm>

#include "check_scene.hpp"

namespace fpz::specimen::detail {
namespace {

/// Calls f(place, shape) for the shapes of the region at a place.
template <class F>
void for_shapes(const Place& region, const std::vector<Shape>& shapes, F&& f) {
  with(region, "shape", [&](const Place& p) {
    const bool several = p.value().is(JsonValue::Kind::array);
    for (std::size_t k = 0; k < shapes.size(); ++k)
      several ? f(Place(p, p.value().items[k]), shapes[k]) : f(p, shapes[k]);
  });
}

void check_region_shape(const SceneCheck& c, const Place& p, const Shape& shape) {
  const Scene& s = c.scene;
  const double whole = area(s.body), left = [&] {
    Body rest = s.body;
    rest.holes.push_back(shape);
    return area(rest);
  }();
  const auto [low, high] = extent(shape);
  const auto [body_low, body_high] = extent(s.body.shape);
  if (whole - left < 1e-6 * area(shape)) {
    return c.problem(p, "it reaches from " + brief(low) + " to " + brief(high) +
                            " and is outside the body, which reaches from " + brief(body_low) + " to " +
                            brief(body_high) + likely_place(0.5 * (low + high), s.body.shape));
  }
  if (left < 1e-6 * whole) {
    c.warn(p, "it covers the whole body, of which nothing has the \"material\" of the scene: state that there");
  }
  const double size = (high - low).minCoeff();
  if (size < 2.0 * s.spacing) {
    c.warn(p, "it is " + brief(size) + " m wide, less than two spacings: particles cannot follow it" +
                  likely_length(size, 2.0 * s.spacing, 0.5 * (body_high - body_low).maxCoeff()));
  }
}

}  // namespace

void check_regions(const SceneCheck& c) {
  for_entries(c, "regions", [&](const Place& p, std::size_t k) {
    for_shapes(p, c.scene.regions[k].shapes,
               [&](const Place& at, const Shape& shape) { check_region_shape(c, at, shape); });
  });
}

}  // namespace fpz::specimen::detail
