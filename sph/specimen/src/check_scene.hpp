// Checks of a scene that has been read: what is senseless is a problem, what is doubtful a warning, each at its place.
// One file per kind of check. Those that need no particles are here, the others in check_particles.hpp.
#pragma once

#include "scene_reader.hpp"

namespace fpz::specimen::detail {

/// What was read, where it stands, and where to complain.
struct SceneCheck {
  const InputReader& reader;
  const Place& root;
  const Scene& scene;
  std::vector<std::string>& warnings;

  /// `path: value: constraint`; the value is left out where it is an object.
  void problem(const Place& at, const std::string& constraint) const;
  void warn(const Place& at, const std::string& text) const;
};

void check_sizes(const SceneCheck& c);
void check_notches(const SceneCheck& c);
void check_holes(const SceneCheck& c);
void check_regions(const SceneCheck& c);
void check_interfaces(const SceneCheck& c);
void check_strength_field(const SceneCheck& c);
/// The spacing against the narrowest part of the body and the process zone.
void check_rows(const SceneCheck& c);
void check_boundaries(const SceneCheck& c);
void check_loading(const SceneCheck& c);
void check_loads(const SceneCheck& c);
void check_gauges(const SceneCheck& c);
void check_end(const SceneCheck& c);

/// All of them. The scene must have been read without problems; its warnings are added to.
void check_scene(const InputReader& r, const Place& root, Scene& scene);

/// Calls f(place, index) for the entries of the array that a key of the root holds.
template <class F>
void for_entries(const SceneCheck& c, std::string_view key, F&& f) {
  with(c.root, key, [&](const Place& list) {
    for (std::size_t k = 0; k < list.value().items.size(); ++k) f(Place(list, list.value().items[k]), k);
  });
}

/// Calls f(place) for the member of that name, or for the object itself where it is not given.
template <class F>
void at_member(const Place& object, std::string_view key, F&& f) {
  const JsonValue* v = object.value().find(key);
  if (v == nullptr) return f(object);
  f(Place(object, *v));
}

/// Four digits.
[[nodiscard]] std::string brief(double x);
/// "[0.1, 0.2]"
[[nodiscard]] std::string brief(const Point& x);
/// "; 8 mm was probably meant: write 0.008" where a number far above `high` is between `low` and `high` metres in mm,
/// cm or um.
[[nodiscard]] std::string likely_length(double metres, double low, double high);
/// The same for a place, when all that is not 0 of it is far outside the body.
[[nodiscard]] std::string likely_place(const Point& x, const Shape& body);

}  // namespace fpz::specimen::detail
