// Shape, holes, notches, arrangement.
#include <cmath>
#include <numbers>

#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

using Keys = std::span<const std::string_view>;
constexpr std::array<std::string_view, 5> shapes = {"rectangle", "disc", "half_disc", "ring", "polygon"};
constexpr std::array<std::string_view, 3> rectangle_keys = {"type", "low", "high"};
constexpr std::array<std::string_view, 3> disc_keys = {"type", "centre", "radius"};
constexpr std::array<std::string_view, 4> ring_keys = {"type", "centre", "radius", "diameter_ratio"};
constexpr std::array<std::string_view, 2> polygon_keys = {"type", "corners"};
constexpr std::array<std::string_view, 4> notch_keys = {"mouth", "length", "angle_deg", "width"};
constexpr std::array<std::string_view, 1> widths = {"narrowest"};
constexpr std::array<std::string_view, 4> patterns = {"lattice", "sheared", "rings", "file"};
constexpr std::array<std::string_view, 4> lattice_keys = {"type", "angle_deg", "origin", "align_to_notch"};
constexpr std::array<std::string_view, 1> rings_keys = {"type"};
constexpr std::array<std::string_view, 2> file_keys = {"type", "file"};

Rectangle read_rectangle(const InputReader& r, const Place& place) {
  Rectangle s;
  with_required(r, place, "low", [&](const Place& p) { s.low = point(r, p).value_or(s.low); });
  with_required(r, place, "high", [&](const Place& p) {
    const auto high = point(r, p);
    if (!high) return;
    s.high = *high;
    if (!((s.high - s.low).array() > 0.0).all()) r.problem(p, "must be above and to the right of \"low\"");
  });
  return s;
}

std::optional<Shape> read_shape(const InputReader& r, const Place& place) {
  if (!r.object(place, "\"type\" and the measures of a shape")) return std::nullopt;
  std::optional<std::size_t> type;
  with_required(r, place, "type", [&](const Place& p) { type = choice(r, p, shapes); });
  if (!type) return std::nullopt;
  const Keys keys[] = {rectangle_keys, disc_keys, disc_keys, ring_keys, polygon_keys};
  r.known_keys(place, keys[*type]);
  if (*type == 0) return read_rectangle(r, place);
  if (*type == 4) {
    Polygon polygon;
    with_required(r, place, "corners", [&](const Place& p) {
      if (!r.array(p, "corners [x, y]")) return;
      for (const JsonValue& item : p.value().items) {
        if (const auto c = point(r, Place(p, item))) polygon.corners.push_back(*c);
      }
      if (polygon.corners.size() < 3) {
        r.problem(p, "has fewer than 3 corners");
      } else if (area(Shape(polygon)) <= 0.0) {
        r.problem(p, "encloses no area");
      }
    });
    if (polygon.corners.size() < 3) return std::nullopt;
    return polygon;
  }
  Point centre = Point::Zero();
  double radius = 0.0;
  double ratio = 0.0;
  with(place, "centre", [&](const Place& p) { centre = point(r, p).value_or(centre); });
  with_required(r, place, "radius", [&](const Place& p) { radius = r.positive(p).value_or(1.0); });
  if (*type == 1) return Disc{centre, radius};
  if (*type == 2) return HalfDisc{centre, radius};
  with_required(r, place, "diameter_ratio", [&](const Place& p) {
    const auto x = not_negative(r, p);
    if (x && *x >= 1.0) r.problem(p, io::shown(p.value().text) + ": must be < 1");
    ratio = x && *x < 1.0 ? *x : 0.0;
  });
  if (ratio == 0.0) return Disc{centre, radius};
  return Ring{centre, ratio * radius, radius};
}

Notch read_notch(const InputReader& r, const Place& place, double narrowest) {
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
    const bool word = p.value().is(JsonValue::Kind::string);
    n.width = word ? narrowest : not_negative(r, p).value_or(0.0);
    if (word) (void)choice(r, p, widths);
  });
  n.tip = n.mouth + length * Point(-std::sin(angle), std::cos(angle));
  return n;
}

Point default_origin(const Shape& shape) {
  if (const auto* d = std::get_if<Disc>(&shape)) return d->centre;
  if (const auto* h = std::get_if<HalfDisc>(&shape)) return h->centre;
  if (const auto* g = std::get_if<Ring>(&shape)) return g->centre;
  return extent(shape).first;
}

void read_lattice(const InputReader& r, const Place& place, SceneFile& scene) {
  Pattern& pattern = scene.pattern;
  r.known_keys(place, lattice_keys);
  with(place, "angle_deg",
       [&](const Place& p) { pattern.angle = degree * r.number_between(p, -89.0, 89.0, true).value_or(0.0); });
  with(place, "origin", [&](const Place& p) {
    pattern.origin = point(r, p).value_or(pattern.origin);
    pattern.fit = false;
  });
  with(place, "align_to_notch", [&](const Place& p) {
    const Notch* n = notch_at(r, p, scene);
    for (const char* other : {"angle_deg", "origin"}) {
      if (place.value().find(other) != nullptr) r.problem(p, "leaves no choice of " + io::in_quotes(other));
    }
    if (n == nullptr) return;
    const Point d = along(*n);
    pattern.angle = std::atan2(-d[0], d[1]);
    if (std::abs(pattern.angle) < 1e-12) pattern.angle = 0.0;
    pattern.origin = n->mouth;
    if (pattern.kind == Pattern::Kind::sheared && std::abs(d[1]) < 0.01) {
      r.problem(p, "this notch is (nearly) parallel to x: columns cannot follow it");
    }
  });
}

}  // namespace

const Notch* notch_at(const InputReader& r, const Place& place, const SceneFile& scene) {
  if (scene.body.notches.empty()) {
    r.problem(place, "there is no notch");
    return nullptr;
  }
  const auto k = r.integer(place, 0, static_cast<int>(scene.body.notches.size()) - 1);
  return k ? &scene.body.notches[static_cast<std::size_t>(*k)] : nullptr;
}

void read_body(const InputReader& r, const Place& root, SceneFile& scene) {
  with(root, "shape", [&](const Place& p) {
    if (auto s = read_shape(r, p)) scene.body.shape = *s;
  });
  with(root, "holes", [&](const Place& p) {
    if (!p.value().is(JsonValue::Kind::array)) return r.problem(p, "expected an array of shapes");
    for (const JsonValue& item : p.value().items) {
      if (auto s = read_shape(r, Place(p, item))) scene.body.holes.push_back(*s);
    }
  });
  // Particles do not interact across a slot as wide as the support of the kernel.
  const double narrowest = sph::kernel_support * scene.options.smoothing_ratio * scene.spacing;
  with(root, "notches", [&](const Place& p) {
    if (!p.value().is(JsonValue::Kind::array)) return r.problem(p, "expected an array of notches");
    for (const JsonValue& item : p.value().items)
      scene.body.notches.push_back(read_notch(r, Place(p, item), narrowest));
  });
}

void read_arrangement(const InputReader& r, const Place& root, SceneFile& scene) {
  Pattern& pattern = scene.pattern;
  pattern.fit = std::holds_alternative<Rectangle>(scene.body.shape);
  const JsonValue* shape = root.value().find("shape");
  if (shape != nullptr) pattern.origin = default_origin(scene.body.shape);
  const JsonValue* given = root.value().find("arrangement");
  const bool from_file = given != nullptr && given->find("type") != nullptr && given->find("type")->text == "file";
  if (shape == nullptr && !from_file) (void)r.required(root, "shape");
  if (given == nullptr) return;
  const Place place(root, *given);
  if (!r.object(place, "\"type\"")) return;
  std::optional<std::size_t> type;
  with_required(r, place, "type", [&](const Place& p) { type = choice(r, p, patterns); });
  if (!type) return;
  if (*type == 3) {
    r.known_keys(place, file_keys);
    with_required(r, place, "file", [&](const Place& p) {
      if (const auto name = r.text(p, 4000)) {
        scene.particles = ParticleFile{(std::filesystem::path(r.file()).parent_path() / *name)};
      }
    });
  } else if (*type == 2) {
    pattern.kind = Pattern::Kind::rings;
    r.known_keys(place, rings_keys);
    if (std::holds_alternative<Rectangle>(scene.body.shape) || std::holds_alternative<Polygon>(scene.body.shape)) {
      r.problem(place, "rings need a disc, a half disc or a ring");
    }
  } else {
    pattern.kind = *type == 0 ? Pattern::Kind::lattice : Pattern::Kind::sheared;
    if (pattern.kind == Pattern::Kind::sheared) pattern.fit = false;
    read_lattice(r, place, scene);
  }
}

}  // namespace fpz::specimen::detail
