// Shapes: one reader per kind, listed in shape_kinds.
#include "fpz/io/input_error.hpp"
#include "fpz/specimen/outline.hpp"
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

using Keys = std::span<const std::string_view>;

constexpr std::string_view rectangle_keys[] = {"type", "low", "high"};
std::optional<ShapeWithHoles> read_rectangle(const InputReader& r, const Place& place) {
  Rectangle s;
  with_required(r, place, "low", [&](const Place& p) { s.low = point(r, p).value_or(s.low); });
  with_required(r, place, "high", [&](const Place& p) {
    const auto high = point(r, p);
    if (!high) return;
    s.high = *high;
    if (!((s.high - s.low).array() > 0.0).all()) r.problem(p, "must be above and to the right of \"low\"");
  });
  return ShapeWithHoles{s, {}};
}

/// "centre" and "radius", as all round shapes have them.
Disc read_circle(const InputReader& r, const Place& place) {
  Disc disc;
  with(place, "centre", [&](const Place& p) { disc.centre = point(r, p).value_or(disc.centre); });
  with_required(r, place, "radius", [&](const Place& p) { disc.radius = r.positive(p).value_or(1.0); });
  return disc;
}

constexpr std::string_view disc_keys[] = {"type", "centre", "radius"};
std::optional<ShapeWithHoles> read_disc(const InputReader& r, const Place& place) {
  return ShapeWithHoles{read_circle(r, place), {}};
}

std::optional<ShapeWithHoles> read_half_disc(const InputReader& r, const Place& place) {
  const Disc whole = read_circle(r, place);
  return ShapeWithHoles{HalfDisc{whole.centre, whole.radius}, {}};
}

constexpr std::string_view ring_keys[] = {"type", "centre", "radius", "diameter_ratio"};
/// A disc when the diameter ratio is 0.
std::optional<ShapeWithHoles> read_ring(const InputReader& r, const Place& place) {
  const Disc outer = read_circle(r, place);
  double ratio = 0.0;
  with_required(r, place, "diameter_ratio", [&](const Place& p) {
    const auto x = not_negative(r, p);
    if (x && *x >= 1.0) r.problem(p, io::shown(p.value().text) + ": must be < 1");
    ratio = x && *x < 1.0 ? *x : 0.0;
  });
  if (ratio == 0.0) return ShapeWithHoles{outer, {}};
  return ShapeWithHoles{Ring{outer.centre, ratio * outer.radius, outer.radius}, {}};
}

/// Which way the triangle a, b, c turns: > 0 counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - a); }

bool cross_each_other(const Point& a, const Point& b, const Point& c, const Point& d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

/// Sides from corner k to the next, round about.
void check_sides(const InputReader& r, const Place& p, const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  const auto side = [&](std::size_t k) { return std::pair(corners[k], corners[(k + 1) % n]); };
  for (std::size_t k = 0; k < n; ++k) {
    const auto [a, b] = side(k);
    if (a == b) {
      return r.problem(p, k + 1 == n
                              ? "the last corner repeats the first; leave it out: the polygon closes by itself"
                              : "corners " + std::to_string(k) + " and " + std::to_string(k + 1) + " are the same");
    }
    for (std::size_t j = 0; j + 1 < k; ++j) {
      const auto [c, d] = side(j);
      if (!cross_each_other(a, b, c, d)) continue;
      return r.problem(p, "the polygon crosses itself: the sides that begin at corners " + std::to_string(j) + " and " +
                              std::to_string(k) + "; corners must follow each other around the body");
    }
  }
}

constexpr std::string_view polygon_keys[] = {"type", "corners"};
std::optional<ShapeWithHoles> read_polygon(const InputReader& r, const Place& place) {
  Polygon polygon;
  with_required(r, place, "corners", [&](const Place& p) {
    if (!r.array(p, "corners [x, y]")) return;
    for (const JsonValue& item : p.value().items) {
      if (const auto c = point(r, Place(p, item))) polygon.corners.push_back(*c);
    }
    if (polygon.corners.size() < 3) {
      r.problem(p, "has fewer than 3 corners");
      return;
    }
    const std::size_t before = r.problems().size();
    check_sides(r, p, polygon.corners);
    if (r.problems().size() == before && area(Shape(polygon)) <= 0.0) {
      r.problem(p, "encloses no area");
    }
  });
  if (polygon.corners.size() < 3) return std::nullopt;
  return ShapeWithHoles{polygon, {}};
}

constexpr std::string_view outline_keys[] = {"type", "file", "scale"};
std::optional<ShapeWithHoles> read_outline_shape(const InputReader& r, const Place& place) {
  double scale = 1.0;
  with(place, "scale", [&](const Place& p) { scale = r.positive(p).value_or(1.0); });
  std::optional<ShapeWithHoles> shape;
  with_required(r, place, "file", [&](const Place& p) {
    const auto name = r.text(p, 4000);
    if (!name) return;
    try {
      Outline outline = read_outline(std::filesystem::path(r.file()).parent_path() / *name);
      const auto scaled = [scale](Polygon polygon) {
        for (Point& x : polygon.corners) x *= scale;
        return polygon;
      };
      shape = ShapeWithHoles{scaled(outline.outer), {}};
      for (const Polygon& hole : outline.holes) shape->holes.emplace_back(scaled(hole));
    } catch (const io::InputError& e) {
      r.problem(p, e.what());
    }
  });
  return shape;
}

struct ShapeKind {
  std::string_view word;
  Keys keys;
  std::optional<ShapeWithHoles> (*read)(const InputReader&, const Place&);
};
constexpr std::array<ShapeKind, 6> shape_kinds = {{{"rectangle", rectangle_keys, read_rectangle},
                                                   {"disc", disc_keys, read_disc},
                                                   {"half_disc", disc_keys, read_half_disc},
                                                   {"ring", ring_keys, read_ring},
                                                   {"polygon", polygon_keys, read_polygon},
                                                   {"outline", outline_keys, read_outline_shape}}};

}  // namespace

std::optional<ShapeWithHoles> read_shape_with_holes(const InputReader& r, const Place& place) {
  if (!r.object(place, "\"type\" and the measures of a shape")) return std::nullopt;
  const ShapeKind* shape = nullptr;
  with_required(r, place, "type", [&](const Place& p) { shape = kind(r, p, shape_kinds); });
  if (shape == nullptr) return std::nullopt;
  r.known_keys(place, shape->keys);
  return shape->read(r, place);
}

std::optional<Shape> read_shape(const InputReader& r, const Place& place) {
  auto shape = read_shape_with_holes(r, place);
  if (!shape) return std::nullopt;
  if (!shape->holes.empty()) r.problem(place, "the outline of its file has holes, which only \"shape\" may have");
  return std::move(shape->shape);
}

}  // namespace fpz::specimen::detail
