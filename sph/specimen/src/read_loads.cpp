// Loads: pressures and tractions on parts of the surface.
#include <numbers>

#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 5> load_keys = {"name", "on", "pressure", "traction", "direction"};
constexpr std::array<std::string_view, 9> part_keys = {"outside", "hole",   "notch",    "low",   "high",
                                                       "corners", "centre", "from_deg", "to_deg"};
constexpr const char* part_content =
    "\"all\", \"outside\", or an object with \"hole\", \"notch\", \"low\" and \"high\", \"corners\", or \"centre\", "
    "\"from_deg\" and \"to_deg\"";

/// Holes of a scene; that of a ring comes after those of "holes".
std::size_t hole_count(const Scene& scene) {
  return scene.body.holes.size() + (std::holds_alternative<Ring>(scene.body.shape) ? 1U : 0U);
}

void read_hole(const InputReader& r, const Place& p, const Scene& scene, SurfacePart& part) {
  const auto count = static_cast<int>(hole_count(scene));
  if (count == 0) return r.problem(p, "the body has no holes");
  if (const auto k = r.integer(p, 0, count - 1)) part.hole = static_cast<std::size_t>(*k);
}

void read_slot(const InputReader& r, const Place& p, const Scene& scene, SurfacePart& part) {
  const Notch* notch = notch_at(r, p, scene);
  if (notch == nullptr) return;
  if (notch->width <= 0.0) r.problem(p, "is a cut without width: no surface on which a load could act");
  part.notch = static_cast<std::size_t>(notch - scene.body.notches.data());
}

void read_box(const InputReader& r, const Place& place, SurfacePart& part) {
  Rectangle box;
  with_required(r, place, "low", [&](const Place& p) { box.low = point(r, p).value_or(box.low); });
  with_required(r, place, "high", [&](const Place& p) { box.high = point(r, p).value_or(box.high); });
  if (!((box.high - box.low).array() >= 0.0).all()) r.problem(place, "\"high\" must be above and right of \"low\"");
  part.within = box;
}

void read_corners(const InputReader& r, const Place& p, SurfacePart& part) {
  Polygon polygon;
  if (!r.array(p, "corners [x, y]")) return;
  for (const JsonValue& item : p.value().items) {
    if (const auto c = point(r, Place(p, item))) polygon.corners.push_back(*c);
  }
  if (polygon.corners.size() < 3) return r.problem(p, "has fewer than 3 corners");
  part.within = polygon;
}

void read_sector(const InputReader& r, const Place& place, SurfacePart& part) {
  SurfacePart::Sector s;
  with(place, "centre", [&](const Place& p) { s.centre = point(r, p).value_or(s.centre); });
  with_required(r, place, "from_deg", [&](const Place& p) { s.from = degree * r.number(p).value_or(0.0); });
  with_required(r, place, "to_deg", [&](const Place& p) {
    s.to = degree * r.number(p).value_or(1.0);
    if (!(s.to > s.from) || s.to > s.from + 2.0 * std::numbers::pi) {
      r.problem(p, "must be above \"from_deg\", by 360 at most");
    }
  });
  part.sector = s;
}

SurfacePart read_part(const InputReader& r, const Place& place, const Scene& scene) {
  SurfacePart part;
  if (place.value().is(JsonValue::Kind::string)) {
    constexpr std::array<std::string_view, 2> words = {"all", "outside"};
    part.outside = word(r, place, words) == std::optional<std::string_view>("outside");
    return part;
  }
  if (!r.object(place, part_content)) return part;
  r.known_keys(place, part_keys);
  const auto has = [&](std::string_view key) { return place.value().find(key) != nullptr; };
  with(place, "outside", [&](const Place& p) { part.outside = boolean(r, p).value_or(false); });
  with(place, "hole", [&](const Place& p) { read_hole(r, p, scene, part); });
  with(place, "notch", [&](const Place& p) { read_slot(r, p, scene, part); });
  if (has("low") || has("high")) read_box(r, place, part);
  with(place, "corners", [&](const Place& p) {
    if (part.within) r.problem(p, "stands beside \"low\" and \"high\": give one of both");
    read_corners(r, p, part);
  });
  if (has("centre") || has("from_deg") || has("to_deg")) read_sector(r, place, part);
  return part;
}

SurfaceLoad read_load(const InputReader& r, const Place& place, const Scene& scene) {
  SurfaceLoad load;
  if (!r.object(place, "\"name\", \"on\", and \"pressure\" or \"traction\"")) return load;
  r.known_keys(place, load_keys);
  load.name = read_name(r, place, scene.loads, "loads");
  with_required(r, place, "on", [&](const Place& p) {
    if (!p.value().is(JsonValue::Kind::array)) {
      load.on.push_back(read_part(r, p, scene));
    } else if (r.array(p, part_content)) {
      for (const JsonValue& item : p.value().items) load.on.push_back(read_part(r, Place(p, item), scene));
    }
  });
  const bool pressure = place.value().find("pressure") != nullptr;
  if (pressure == (place.value().find("traction") != nullptr)) {
    r.problem(place, "needs one of \"pressure\" (positive: inward) and \"traction\" with its \"direction\"");
    return load;
  }
  with(place, pressure ? "pressure" : "traction", [&](const Place& p) {
    load.course = read_time_course(r, p, {"value", !scene.initial_stress});
  });
  if (!pressure) {
    with_required(r, place, "direction",
                  [&](const Place& p) { load.direction = direction(r, p).value_or(Point(1.0, 0.0)); });
  } else {
    with(place, "direction", [&](const Place& p) { r.problem(p, "is for a traction; a pressure acts inward"); });
  }
  return load;
}

}  // namespace

void read_loads(const InputReader& r, const Place& place, Scene& scene) {
  if (!r.array(place, "loads")) return;
  if (scene.particles) r.problem(place, "particles from a file have no surface on which a load could act");
  for (const JsonValue& item : place.value().items) scene.loads.push_back(read_load(r, Place(place, item), scene));
}

}  // namespace fpz::specimen::detail
