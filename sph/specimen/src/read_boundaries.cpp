// Boundaries: rollers and platens, and how they move.
#include "scene_reader.hpp"

namespace fpz::specimen {
namespace detail {
namespace {

constexpr std::array<std::string_view, 17> boundary_keys = {
    "name",     "at",      "direction", "width",    "layers",       "fit",   "jaw_radius",
    "friction", "elastic", "hinge",     "velocity", "displacement", "force", "machine_stiffness",
    "material", "rigid",   "also_at"};

/// true, or the point about which the boundary turns.
void read_hinge(const InputReader& r, const Place& p, Boundary& b) {
  if (p.value().is(JsonValue::Kind::boolean)) {
    b.hinged = p.value().boolean;
    if (b.hinged && !b.platen) r.problem(p, "particles of a file have no middle of their foot: give the point [x, y]");
    if (b.hinged && !b.also_at.empty()) r.problem(p, "a boundary in several places has no foot: give the point [x, y]");
    return;
  }
  b.hinge = point(r, p);
  b.hinged = b.hinge.has_value();
}

void read_further_places(const InputReader& r, const Place& place, Boundary& b) {
  if (!r.array(place, "points")) return;
  for (const JsonValue& item : place.value().items) {
    if (const std::optional<Point> at = point(r, Place(place, item))) b.also_at.push_back(*at);
  }
}

Boundary read_boundary(const InputReader& r, const Place& place, std::span<const std::string> gauges,
                       const Scene& scene) {
  Boundary b;
  if (!r.object(place, "\"name\", \"at\", \"direction\", \"width\" and how it is driven")) return b;
  r.known_keys(place, boundary_keys);
  b.name = read_name(r, place, scene.boundaries, "boundaries");
  // With particles from a file the boundary may be among them.
  if (!scene.particles || place.value().find("at") != nullptr) {
    Platen platen;
    platen.direction = Point(0.0, 1.0);
    with_required(r, place, "at", [&](const Place& p) { platen.at = point(r, p).value_or(platen.at); });
    with_required(r, place, "direction",
                  [&](const Place& p) { platen.direction = direction(r, p).value_or(platen.direction); });
    with_required(r, place, "width", [&](const Place& p) { platen.width = not_negative(r, p).value_or(0.0); });
    with(place, "layers", [&](const Place& p) { platen.layers = r.integer(p, 1, 100).value_or(3); });
    with(place, "fit", [&](const Place& p) { platen.fit = choice<Platen::Fit>(r, p).value_or(platen.fit); });
    with(place, "jaw_radius", [&](const Place& p) { platen.jaw_radius = r.positive(p).value_or(1.0); });
    if ((platen.fit == Platen::Fit::jaw) != (platen.jaw_radius > 0.0)) {
      r.problem(place, "\"fit\": \"jaw\" and \"jaw_radius\" belong together");
    }
    with(place, "friction", [&](const Place& p) { platen.friction = not_negative(r, p); });
    b.platen = platen;
    with(place, "also_at", [&](const Place& p) { read_further_places(r, p, b); });
  }
  if (!b.platen) {
    with(place, "friction", [&](const Place& p) {
      r.problem(p, "needs \"at\", \"direction\" and \"width\": particles of a file have no surface that touches");
    });
  }
  with(place, "hinge", [&](const Place& p) { read_hinge(r, p, b); });
  with(place, "rigid", [&](const Place& p) {
    b.rigid = boolean(r, p).value_or(false);
    if (b.rigid && b.hinged) r.problem(p, "one with a \"hinge\" is rigid already");
  });
  with(place, "elastic", [&](const Place& p) { b.elastic = boolean(r, p).value_or(true); });
  if (!read_actuations(r, place, {true, gauges}, b.drive)) {
    r.problem(place, "needs \"velocity\", \"displacement\" or \"force\": how it is driven");
  }
  return b;
}

}  // namespace

void read_boundaries(const InputReader& r, const Place& place, std::span<const std::string> gauges,
                     std::span<const std::size_t> materials, Scene& scene) {
  if (!r.array(place, "boundaries")) return;
  for (const JsonValue& item : place.value().items) {
    Boundary b = read_boundary(r, Place(place, item), gauges, scene);
    b.material = materials[scene.boundaries.size()];
    scene.boundaries.push_back(std::move(b));
  }
}

}  // namespace detail

std::vector<Platen> platens_of(const Boundary& boundary) {
  if (!boundary.platen) return {};
  std::vector<Platen> all = {*boundary.platen};
  for (const Point& at : boundary.also_at) {
    all.push_back(*boundary.platen);
    all.back().at = at;
  }
  return all;
}

}  // namespace fpz::specimen
