#include <limits>

#include "scene_reader.hpp"

namespace fpz::specimen::detail {

using Kind = JsonValue::Kind;

JsonValue* member(JsonValue& object, std::string_view key) {
  for (JsonValue& m : object.items) {
    if (m.key == key) return &m;
  }
  return nullptr;
}

std::optional<NamedTree> load_tree(const InputReader& r, const Place& place, const char* what) {
  const std::filesystem::path file = std::filesystem::path(r.file()).parent_path() / place.value().text;
  NamedTree tree{{}, file.lexically_normal().string(), file.stem().string()};
  std::string text, error;
  if (!io::load_text(file, io::FileKind::regular, r.limits(), text, error)) {
    r.problem(place, "cannot read " + std::string(what) + " " + io::in_quotes(tree.shown_as) + ": " + error);
    return std::nullopt;
  }
  if (!io::parse_json(text, tree.shown_as, r.limits(), r.problems(), tree.root)) return std::nullopt;
  return tree;
}

std::optional<std::string_view> word(const InputReader& r, const Place& place,
                                     std::span<const std::string_view> valid) {
  const auto name = r.text(place, longest_name);
  if (!name) return std::nullopt;
  const auto at = std::find(valid.begin(), valid.end(), *name);
  if (at != valid.end()) return *at;
  r.problem(place, "unknown choice " + io::in_quotes(*name) + io::suggestion(*name, valid));
  return std::nullopt;
}

std::optional<bool> boolean(const InputReader& r, const Place& place) {
  if (place.value().is(Kind::boolean)) return place.value().boolean;
  r.problem(place, "expected true or false, found " + place.value().description());
  return std::nullopt;
}

std::optional<Point> point(const InputReader& r, const Place& place) {
  if (!place.value().is(Kind::array) || place.value().items.size() != 2) {
    r.problem(place, "expected two numbers [x, y], found " + place.value().description());
    return std::nullopt;
  }
  const auto x = r.number(Place(place, place.value().items[0]));
  const auto y = r.number(Place(place, place.value().items[1]));
  if (!x || !y) return std::nullopt;
  return Point(*x, *y);
}

std::optional<Point> direction(const InputReader& r, const Place& place) {
  const auto d = point(r, place);
  if (!d) return std::nullopt;
  if (d->norm() > 0.0) return d->normalized();
  r.problem(place, "is zero; a direction is needed");
  return std::nullopt;
}

std::optional<double> not_negative(const InputReader& r, const Place& place) {
  const auto x = r.number(place);
  if (!x || *x >= 0.0) return x;
  r.problem(place, io::shown(place.value().text) + ": must be >= 0");
  return std::nullopt;
}

}  // namespace fpz::specimen::detail
