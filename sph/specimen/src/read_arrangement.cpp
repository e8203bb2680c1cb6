// How the particles of the specimen lie: one reader per kind of arrangement, listed in arrangement_kinds.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fpz/io/csv_options.hpp"
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

using Keys = std::span<const std::string_view>;

Point default_origin(const Shape& shape) {
  if (const auto* d = std::get_if<Disc>(&shape)) return d->centre;
  if (const auto* h = std::get_if<HalfDisc>(&shape)) return h->centre;
  if (const auto* g = std::get_if<Ring>(&shape)) return g->centre;
  return extent(shape).first;
}

/// Angle and origin of a lattice, or the notch that it follows.
void read_lattice_axes(const InputReader& r, const Place& place, Scene& scene) {
  Pattern& pattern = scene.pattern;
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

void read_seed(const InputReader& r, const Place& place, Pattern& pattern) {
  with(place, "seed", [&](const Place& p) {
    pattern.seed = static_cast<std::uint64_t>(r.integer(p, 0, std::numeric_limits<int>::max()).value_or(1));
  });
}

/// Random displacements of particles that are in order.
void read_move(const InputReader& r, const Place& place, Pattern& pattern) {
  with(place, "move", [&](const Place& p) { pattern.move = r.number_between(p, 0.0, 0.3, true).value_or(0.0); });
  with(place, "seed", [&](const Place& p) {
    if (place.value().find("move") == nullptr) r.problem(p, "has no effect without \"move\"");
  });
  read_seed(r, place, pattern);
}

constexpr std::string_view lattice_keys[] = {"type", "angle_deg", "origin", "align_to_notch", "move", "seed"};
void read_lattice(const InputReader& r, const Place& place, Scene& scene) {
  scene.pattern.kind = Pattern::Kind::lattice;
  read_lattice_axes(r, place, scene);
  read_move(r, place, scene.pattern);
}

constexpr std::string_view sheared_keys[] = {"type", "angle_deg", "origin", "align_to_notch"};
void read_sheared(const InputReader& r, const Place& place, Scene& scene) {
  scene.pattern.kind = Pattern::Kind::sheared;
  scene.pattern.fit = false;
  read_lattice_axes(r, place, scene);
}

constexpr std::string_view rings_keys[] = {"type", "move", "seed"};
void read_rings(const InputReader& r, const Place& place, Scene& scene) {
  scene.pattern.kind = Pattern::Kind::rings;
  read_move(r, place, scene.pattern);
  if (std::holds_alternative<Rectangle>(scene.body.shape) || std::holds_alternative<Polygon>(scene.body.shape)) {
    r.problem(place, "rings need a disc, a half disc or a ring");
  }
}

constexpr std::string_view scattered_keys[] = {"type", "seed"};
void read_scattered(const InputReader& r, const Place& place, Scene& scene) {
  scene.pattern.kind = Pattern::Kind::scattered;
  read_seed(r, place, scene.pattern);
}

constexpr auto file_keys = [] {
  std::array<std::string_view, 2 + io::csv_option_keys.size()> keys = {"type", "file"};
  std::copy(io::csv_option_keys.begin(), io::csv_option_keys.end(), keys.begin() + 2);
  return keys;
}();
void read_file(const InputReader& r, const Place& place, Scene& scene) {
  const io::CsvOptions notation = io::read_csv_options(r, place);
  with_required(r, place, "file", [&](const Place& p) {
    if (const auto name = r.text(p, 4000)) {
      scene.particles = ParticleFile{std::filesystem::path(r.file()).parent_path() / *name, notation};
      if (scene.particles->file.extension() == ".csv") return;
      for (const std::string_view key : io::csv_option_keys) {
        with(place, key, [&](const Place& of) { r.problem(of, "is of .csv files only"); });
      }
    }
  });
}

struct ArrangementKind {
  std::string_view word;
  Keys keys;
  void (*read)(const InputReader&, const Place&, Scene&);
};
constexpr std::array<ArrangementKind, 5> arrangement_kinds = {{{"lattice", lattice_keys, read_lattice},
                                                               {"sheared", sheared_keys, read_sheared},
                                                               {"rings", rings_keys, read_rings},
                                                               {"scattered", scattered_keys, read_scattered},
                                                               {"file", file_keys, read_file}}};

}  // namespace

void read_arrangement(const InputReader& r, const Place& root, Scene& scene) {
  Pattern& pattern = scene.pattern;
  pattern.fit = std::holds_alternative<Rectangle>(scene.body.shape);
  const JsonValue* shape = root.value().find("shape");
  if (shape != nullptr) pattern.origin = default_origin(scene.body.shape);
  const JsonValue* given = root.value().find("arrangement");
  const bool from_file = given != nullptr && given->find("type") != nullptr && given->find("type")->text == "file";
  if (shape == nullptr && !from_file) (void)r.required(root, "shape");
  if (given == nullptr) return;
  const Place place(root, *given);
  if (!r.object(place, "\"type\" and what belongs to it")) return;
  const ArrangementKind* arrangement = &arrangement_kinds.front();  // a lattice
  with(place, "type", [&](const Place& p) { arrangement = kind(r, p, arrangement_kinds); });
  if (arrangement == nullptr) return;
  r.known_keys(place, arrangement->keys);
  arrangement->read(r, place, scene);
}

}  // namespace fpz::specimen::detail
