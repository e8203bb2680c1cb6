// The body: shape, holes, notches.
#include <cmath>

#include "scene_reader.hpp"
#include "surface_depth.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 5> notch_keys = {"mouth", "length", "angle_deg", "width", "friction_angle_deg"};
constexpr std::array<std::string_view, 1> widths = {"narrowest"};
constexpr double mouth_of_surface = 0.5;  ///< spacings below it up to which a mouth is one
constexpr double end_of_surface = 0.01;   ///< spacings before it up to which an end is meant to be on it

/// A slot narrower than a spacing is a cut: the place of its tip matters more than its width, which particles cannot
/// follow.
Notch read_notch(const InputReader& r, const Place& place, double narrowest, double spacing) {
  Notch n;
  n.tip = Point(0.0, 1.0);
  if (!r.object(place, "\"mouth\" and \"length\"")) return n;
  r.known_keys(place, notch_keys);
  double length = 1.0, angle = 0.0;
  with_required(r, place, "mouth", [&](const Place& p) { n.mouth = point(r, p).value_or(n.mouth); });
  with_required(r, place, "length", [&](const Place& p) { length = r.positive(p).value_or(1.0); });
  with(place, "angle_deg",
       [&](const Place& p) { angle = degree * r.number_between(p, -360.0, 360.0, true).value_or(0.0); });
  with(place, "width", [&](const Place& p) {
    const bool by_word = p.value().is(JsonValue::Kind::string);
    n.asked_width = by_word ? narrowest : not_negative(r, p).value_or(0.0);
    n.width = n.asked_width < spacing ? 0.0 : n.asked_width;
    if (by_word) (void)word(r, p, widths);
  });
  with(place, "friction_angle_deg", [&](const Place& p) {
    if (const auto a = r.number_between(p, 0.0, 89.0, true)) n.friction_angle_deg = *a;
  });
  n.tip = n.mouth + length * Point(-std::sin(angle), std::cos(angle));
  return n;
}

/// A tip that rounding has left before the surface goes through it: nothing holds a bridge that thin.
void reach_surface(const Body& body, Notch& n, double spacing) {
  const double least = end_of_surface * spacing;
  const auto parts = parts_inside(body, n.tip, n.tip + 2.0 * least * along(n));
  if (parts.empty() || parts.front().first > 0.0 || parts.front().second > least) return;
  n.tip += (parts.front().second + 1e-6 * spacing) * along(n);
}

}  // namespace

const Notch* notch_at(const InputReader& r, const Place& place, const Scene& scene) {
  if (scene.body.notches.empty()) {
    r.problem(place, "there is no notch");
    return nullptr;
  }
  const auto k = r.integer(place, 0, static_cast<int>(scene.body.notches.size()) - 1);
  return k ? &scene.body.notches[static_cast<std::size_t>(*k)] : nullptr;
}

void read_body(const InputReader& r, const Place& root, Scene& scene) {
  std::vector<Shape> holes_of_shape;
  with(root, "shape", [&](const Place& p) {
    auto s = read_shape_with_holes(r, p);
    if (!s) return;
    scene.body.shape = std::move(s->shape);
    holes_of_shape = std::move(s->holes);
  });
  with(root, "holes", [&](const Place& p) {
    if (!p.value().is(JsonValue::Kind::array)) return r.problem(p, "expected an array of shapes");
    for (const JsonValue& item : p.value().items) {
      if (auto s = read_shape(r, Place(p, item))) scene.body.holes.push_back(*s);
    }
  });
  scene.body.holes.insert(scene.body.holes.end(), holes_of_shape.begin(), holes_of_shape.end());
  // Particles do not interact across a slot as wide as the support of the kernel.
  const double narrowest = sph::kernel_support * scene.options.smoothing_ratio * scene.spacing;
  with(root, "notches", [&](const Place& p) {
    if (!p.value().is(JsonValue::Kind::array)) return r.problem(p, "expected an array of notches");
    for (const JsonValue& item : p.value().items)
      scene.body.notches.push_back(read_notch(r, Place(p, item), narrowest, scene.spacing));
    for (Notch& n : scene.body.notches) {
      n.internal = depth(scene.body, n.mouth) > mouth_of_surface * scene.spacing;
      if (r.problems().empty()) reach_surface(scene.body, n, scene.spacing);
    }
  });
}

}  // namespace fpz::specimen::detail
