// Interfaces with a strength of their own.
#include <cmath>

#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 4> interface_keys = {"name", "material", "line", "bedding"};
constexpr std::array<std::string_view, 3> bedding_keys = {"angle_deg", "spacing", "origin"};

std::vector<Point> read_line(const InputReader& r, const Place& place) {
  std::vector<Point> line;
  if (!r.array(place, "points [x, y]")) return line;
  for (const JsonValue& item : place.value().items) {
    const Place p(place, item);
    const auto x = point(r, p);
    if (!x) continue;
    if (!line.empty() && line.back() == *x) r.problem(p, "repeats the point before it");
    line.push_back(*x);
  }
  if (line.size() < 2) r.problem(place, "has fewer than 2 points");
  return line;
}

Bedding read_bedding(const InputReader& r, const Place& place) {
  Bedding b;
  if (!r.object(place, "\"angle_deg\" and \"spacing\"")) return b;
  r.known_keys(place, bedding_keys);
  with_required(r, place, "angle_deg",
                [&](const Place& p) { b.angle = degree * r.number_between(p, -180.0, 180.0, true).value_or(0.0); });
  with_required(r, place, "spacing", [&](const Place& p) { b.spacing = r.positive(p).value_or(1.0); });
  with(place, "origin", [&](const Place& p) { b.origin = point(r, p).value_or(b.origin); });
  return b;
}

Interface read_interface(const InputReader& r, const Place& place, const Scene& scene) {
  Interface f;
  if (!r.object(place, "\"name\", \"material\" and \"line\" or \"bedding\"")) return f;
  r.known_keys(place, interface_keys);
  f.name = read_name(r, place, scene.interfaces, "interfaces");
  (void)r.required(place, "material");
  with(place, "line", [&](const Place& p) { f.line = read_line(r, p); });
  with(place, "bedding", [&](const Place& p) { f.bedding = read_bedding(r, p); });
  const bool has_line = place.value().find("line") != nullptr;
  if (has_line == f.bedding.has_value()) r.problem(place, "needs either \"line\" or \"bedding\": where it is");
  return f;
}

}  // namespace

void read_interfaces(const InputReader& r, const Place& place, std::span<const std::size_t> materials, Scene& scene) {
  if (!r.array(place, "interfaces")) return;
  for (const JsonValue& item : place.value().items) {
    Interface f = read_interface(r, Place(place, item), scene);
    const std::size_t number = materials[scene.interfaces.size()];
    if (number > 0) f.material = scene.interface_materials[number - 1].parameters;
    scene.interfaces.push_back(std::move(f));
  }
}

}  // namespace fpz::specimen::detail
