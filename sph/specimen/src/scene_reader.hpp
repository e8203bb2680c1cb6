// Parts of a scene from JSON. What is wrong becomes a problem at its place; a usable default is returned then.
#pragma once

#include <algorithm>
#include <span>

#include "fpz/io/input_reader.hpp"
#include "fpz/specimen/scene.hpp"
#include "fpz/words.hpp"

namespace fpz::specimen::detail {

using io::InputReader;
using io::JsonValue;
using io::Place;

inline constexpr std::size_t longest_name = 200;
/// Keys of the components of a vector that a scene states one by one.
inline constexpr std::array<std::string_view, 2> component_names = {"x", "y"};

/// Calls f(place) for a member when it is there.
template <class F>
void with(const Place& object, std::string_view key, F&& f) {
  if (const JsonValue* v = object.value().find(key)) f(Place(object, *v));
}

/// Calls f(place) for a member; its absence is a problem.
template <class F>
void with_required(const InputReader& r, const Place& object, std::string_view key, F&& f) {
  if (const JsonValue* v = r.required(object, key)) f(Place(object, *v));
}

/// The member of an object that may be changed, or null.
[[nodiscard]] JsonValue* member(JsonValue& object, std::string_view key);

/// A JSON file that a value names, relative to the file that is read.
struct NamedTree {
  JsonValue root;
  std::string shown_as;  ///< its name in messages
  std::string stem;
};
/// `what` is what it should be ("material file"); a file that cannot be read is a problem.
[[nodiscard]] std::optional<NamedTree> load_tree(const InputReader& r, const Place& place, const char* what);

/// A string that must be one of the valid words.
[[nodiscard]] std::optional<std::string_view> word(const InputReader& r, const Place& place,
                                                   std::span<const std::string_view> valid);

/// The value of an enumeration by its word, one of `valid`.
template <Worded E>
[[nodiscard]] std::optional<E> choice(const InputReader& r, const Place& place, std::initializer_list<E> valid) {
  std::vector<std::string_view> words;
  for (const E value : valid) words.emplace_back(fpz::to_string(value));
  const auto text = word(r, place, words);
  return text ? from_word<E>(*text) : std::nullopt;
}

/// The same with all values of the enumeration.
template <Worded E>
[[nodiscard]] std::optional<E> choice(const InputReader& r, const Place& place) {
  std::vector<std::string_view> words;
  for (const Word<E>& w : Words<E>::list) words.emplace_back(w.text);
  const auto text = word(r, place, words);
  return text ? from_word<E>(*text) : std::nullopt;
}

/// An entry of a table of kinds, by its word: whatever has a member `word`.
template <class Kind, std::size_t N>
[[nodiscard]] const Kind* kind(const InputReader& r, const Place& place, const std::array<Kind, N>& kinds) {
  std::vector<std::string_view> words;
  for (const Kind& k : kinds) words.push_back(k.word);
  const auto text = word(r, place, words);
  const auto at = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return text && k.word == *text; });
  return at == kinds.end() ? nullptr : &*at;
}

/// "name" of an entry, which no earlier one of its list has; `entries` is what they are ("loads").
template <class Entry>
[[nodiscard]] std::string read_name(const InputReader& r, const Place& entry, const std::vector<Entry>& earlier,
                                    const char* entries) {
  std::string name;
  with_required(r, entry, "name", [&](const Place& p) { name = r.text(p, longest_name).value_or(""); });
  const auto has_it = [&](const Entry& other) { return !name.empty() && other.name == name; };
  for (auto k = std::count_if(earlier.begin(), earlier.end(), has_it); k > 0; --k) {
    r.problem(entry, "two " + std::string(entries) + " with the name " + io::in_quotes(name));
  }
  return name;
}

[[nodiscard]] std::optional<bool> boolean(const InputReader& r, const Place& place);
[[nodiscard]] std::optional<Point> point(const InputReader& r, const Place& place);
/// A point that is not (0, 0), made a unit vector.
[[nodiscard]] std::optional<Point> direction(const InputReader& r, const Place& place);
[[nodiscard]] std::optional<double> not_negative(const InputReader& r, const Place& place);

/// The notch that `place` names by its index.
[[nodiscard]] const Notch* notch_at(const InputReader& r, const Place& place, const Scene& scene);

/// A shape; that of a file may have holes.
struct ShapeWithHoles {
  Shape shape;
  std::vector<Shape> holes;
};
[[nodiscard]] std::optional<ShapeWithHoles> read_shape_with_holes(const InputReader& r, const Place& place);
[[nodiscard]] std::optional<Shape> read_shape(const InputReader& r, const Place& place);
void read_body(const InputReader& r, const Place& root, Scene& scene);
void read_arrangement(const InputReader& r, const Place& root, Scene& scene);

/// What a quantity over time may be.
struct CourseRules {
  std::string_view value;      ///< the word for a value that is reached by a ramp: "speed", "value"
  bool begins_at_zero = true;  ///< it may not jump when the run begins
  bool first_stage = true;     ///< nothing was before it
  bool relative = false;       ///< it counts from the begin of its stage
  static constexpr std::array<std::string_view, 1> words = {"hold"};
};
[[nodiscard]] TimeCourse read_time_course(const InputReader& r, const Place& place, const CourseRules& rules);
struct ActuationRules {
  bool first_stage = true;
  std::span<const std::string> gauges;  ///< of the scene, by name: what a servo may follow
};
/// The driven components of a boundary, and the machine that drives them, in place of those in `drive`. False when it
/// names none. `stated` tells which components change.
bool read_actuations(const InputReader& r, const Place& boundary, const ActuationRules& rules, Actuations& drive,
                     std::array<bool, 2>* stated = nullptr);

/// `materials`: numbers of the materials of the interfaces, of the regions, of the boundaries.
void read_strength_field(const InputReader& r, const Place& place, Scene& scene);
void read_interfaces(const InputReader& r, const Place& place, std::span<const std::size_t> materials, Scene& scene);
void read_regions(const InputReader& r, const Place& place, std::span<const std::size_t> materials, Scene& scene);
void read_boundaries(const InputReader& r, const Place& place, std::span<const std::string> gauges,
                     std::span<const std::size_t> materials, Scene& scene);
void read_loads(const InputReader& r, const Place& place, Scene& scene);
void read_solver(const InputReader& r, const Place& place, Scene& scene);
void read_method(const InputReader& r, const Place& place, sph::Options<2>& options);
void read_gauges(const InputReader& r, const Place& place, Scene& scene);
/// After the body and the boundaries. The content of a file with factors takes the place of its name in `root`.
void read_toughness(const InputReader& r, JsonValue& root, Scene& scene);
void read_stop(const InputReader& r, const Place& place, const Scene& scene, StopRules& stop);
/// "stages", or the one stage of "stop"; after boundaries, loads and gauges.
void read_stages(const InputReader& r, const Place& root, std::span<const std::string> gauges, Scene& scene);
void read_output(const InputReader& r, const Place& place, OutputRules& output);

}  // namespace fpz::specimen::detail
