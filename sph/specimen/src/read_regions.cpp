// Regions of other materials.
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 3> region_keys = {"name", "material", "shape"};

/// One shape, or several.
std::vector<Shape> read_shapes(const InputReader& r, const Place& place) {
  std::vector<Shape> shapes;
  const auto add = [&](const Place& p) {
    if (auto s = read_shape(r, p)) shapes.push_back(*s);
  };
  if (!place.value().is(JsonValue::Kind::array)) {
    add(place);
    return shapes;
  }
  if (!r.array(place, "shapes")) return shapes;
  for (const JsonValue& item : place.value().items) add(Place(place, item));
  return shapes;
}

Region read_region(const InputReader& r, const Place& place, const Scene& scene) {
  Region region;
  if (!r.object(place, "\"name\", \"material\" and \"shape\"")) return region;
  r.known_keys(place, region_keys);
  region.name = read_name(r, place, scene.regions, "regions");
  (void)r.required(place, "material");
  // Particles of a file may say themselves which region they are in.
  if (!scene.particles) (void)r.required(place, "shape");
  with(place, "shape", [&](const Place& p) { region.shapes = read_shapes(r, p); });
  return region;
}

}  // namespace

void read_regions(const InputReader& r, const Place& place, std::span<const std::size_t> materials, Scene& scene) {
  if (!r.array(place, "regions")) return;
  for (const JsonValue& item : place.value().items) {
    Region region = read_region(r, Place(place, item), scene);
    region.material = materials[scene.regions.size()];
    scene.regions.push_back(std::move(region));
  }
}

}  // namespace fpz::specimen::detail
