// The lengths of notched specimens in a specification, one list per shape.
#include "notched_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fpz::calibration::detail {
namespace {

/// A length and the member that it is.
struct LengthKey {
  std::string_view key;
  double NotchedSpecimen::*member;
  const Typical* typical;
  bool required = true;
  bool zero_allowed = false;
};

using S = NotchedSpecimen;
constexpr const Typical* size = &typical::specimen_size;
constexpr const Typical* small = &typical::small_size;

constexpr LengthKey thickness{"thickness", &S::thickness, small};
constexpr LengthKey roller_width{"roller_width", &S::roller_width, small, false, true};
constexpr LengthKey clip_gauge{"clip_gauge_distance", &S::clip_gauge_distance, small, false, true};

constexpr std::array<LengthKey, 8> beam_keys = {{thickness,
                                                 {"span", &S::span, size},
                                                 {"notch", &S::notch, small, true, true},
                                                 {"depth", &S::depth, size},
                                                 {"length", &S::length, size, false},
                                                 {"load_span", &S::load_span, size, false, true},
                                                 roller_width,
                                                 clip_gauge}};
constexpr std::array<LengthKey, 6> disc_keys = {{thickness,
                                                 {"span", &S::span, size},
                                                 {"notch", &S::notch, small},
                                                 {"radius", &S::radius, size},
                                                 roller_width,
                                                 clip_gauge}};
// Depth and notch are counted from the line of the forces here and from the face in NotchedSpecimen.
constexpr std::array<LengthKey, 8> compact_keys = {{thickness,
                                                    {"width", &S::depth, size},
                                                    {"notch", &S::notch, small},
                                                    {"length", &S::length, size, false},
                                                    {"span", &S::span, size, false},
                                                    {"load_depth", &S::load_depth, small, false},
                                                    {"hole", &S::hole, small, false, true},
                                                    clip_gauge}};
// The ligament stands in the place of the notch.
constexpr std::array<LengthKey, 10> wedge_keys = {{thickness,
                                                   {"length", &S::length, size},
                                                   {"depth", &S::depth, size},
                                                   {"ligament", &S::notch, small},
                                                   {"span", &S::span, size},
                                                   {"load_depth", &S::load_depth, small, true, true},
                                                   {"groove_width", &S::groove_width, small, false, true},
                                                   {"groove_depth", &S::groove_depth, small, false, true},
                                                   roller_width,
                                                   clip_gauge}};
constexpr std::array<LengthKey, 8> cantilever_keys = {{thickness,
                                                       {"height", &S::length, size},
                                                       {"length", &S::depth, size},
                                                       {"notch", &S::notch, size},
                                                       {"span", &S::span, small, false},
                                                       {"load_depth", &S::load_depth, small, false, true},
                                                       roller_width,
                                                       clip_gauge}};

std::span<const LengthKey> keys_of(SpecimenShape shape) {
  switch (shape) {
    case SpecimenShape::beam:
      return beam_keys;
    case SpecimenShape::semicircular:
      return disc_keys;
    case SpecimenShape::compact_tension:
      return compact_keys;
    case SpecimenShape::wedge_splitting:
      return wedge_keys;
    case SpecimenShape::double_cantilever:
      return cantilever_keys;
  }
  return {};
}

constexpr std::string_view offset_key = "notch_offset";
constexpr std::string_view wedge_key = "wedge_half_angle_deg";

/// The model has its crack at mid-span; where the notch is somewhere else, it says so and who can do it.
void refuse_eccentric_notch(const Context& c, const Place& at) {
  const JsonValue* given = at.value().find(offset_key);
  if (given == nullptr) return;
  const auto offset = c.reader.number(Place(at, *given));
  if (!offset || *offset == 0.0) return;
  c.problem(Place(at, *given),
            "must be 0: the crack of this kind is straight, at mid-span and in pure mode I, and one from an eccentric "
            "notch is not; use a data set of the kind \"scene\" (data/calibration/eccentric_beam_scene.json)");
}

void read_wedge(const Context& c, const Place& at, NotchedSpecimen& g) {
  const JsonValue* given = at.value().find(wedge_key);
  if (given == nullptr) return;
  const Place place(at, *given);
  const auto angle = c.reader.number(place);
  if (!angle) return;
  if (!(*angle > 0.0 && *angle < 60.0)) return c.problem(place, io::exact(*angle) + ": must be > 0 and < 60 degrees");
  g.wedge_slope = std::tan(*angle * std::numbers::pi / 180.0);
}

/// The process zone between arms is no longer than they are high, however long the ligament: ten elements on that.
void refine(NotchedSpecimen& g) {
  constexpr double finest = 0.0025;
  if (!(g.depth > g.notch)) return;  // refused below
  const double wanted = 0.05 * g.length / g.ligament();
  g.mesh.ligament_fraction = std::max(finest, std::min(g.mesh.ligament_fraction, wanted));
}

/// What NotchedSpecimen counts in another way, and what is left out.
void complete(NotchedSpecimen& g, const Place& at) {
  const auto stated = [&at](std::string_view key) { return at.value().find(key) != nullptr; };
  switch (g.shape) {
    case SpecimenShape::beam:
      if (!stated("length")) g.length = g.span + g.depth;  // what overhangs carries nothing
      break;
    case SpecimenShape::semicircular:
      break;
    case SpecimenShape::compact_tension: {
      const NotchedSpecimen standard = compact_tension(g.depth, g.notch, g.thickness);
      if (!stated("length")) g.length = standard.length;
      if (!stated("span")) g.span = standard.span;
      if (!stated("load_depth")) g.load_depth = standard.load_depth;
      if (!stated("hole")) g.hole = standard.hole;
      g.depth += g.load_depth;
      g.notch += g.load_depth;
      break;
    }
    case SpecimenShape::wedge_splitting:
      g.notch = g.depth - g.notch;
      break;
    case SpecimenShape::double_cantilever:
      if (!stated("span")) g.span = 0.5 * g.length;
      g.notch += g.load_depth;
      refine(g);
      break;
  }
}

}  // namespace

NotchedSpecimen read_geometry(const SetContext& s, const Place& set, SpecimenShape shape) {
  const Context& c = s.c;
  NotchedSpecimen g;
  g.shape = shape;
  g.setting = s.setting;
  const JsonValue* geometry = c.reader.required(set, "geometry");
  if (geometry == nullptr) return g;
  const Place at(set, *geometry);
  if (!c.reader.object(at, "the lengths of the specimen")) return g;
  const std::size_t before = c.reader.problems().size();
  const std::span<const LengthKey> keys = keys_of(shape);
  std::vector<std::string_view> known = {"unit"};
  for (const LengthKey& k : keys) known.push_back(k.key);
  if (shape == SpecimenShape::beam) known.push_back(offset_key);
  if (shape == SpecimenShape::wedge_splitting) known.push_back(wedge_key);
  c.reader.known_keys(at, known);
  const auto unit = read_unit(c, at, Quantity::length);
  if (!unit) return g;
  for (const LengthKey& k : keys) {
    g.*k.member = read_member(c, at, k.key, *unit, *k.typical, k.required, k.zero_allowed).value_or(0.0);
  }
  if (shape == SpecimenShape::beam) refuse_eccentric_notch(c, at);
  if (shape == SpecimenShape::wedge_splitting) read_wedge(c, at, g);
  if (c.reader.problems().size() != before) return g;
  complete(g, at);
  const Validation found = validate(g);
  for (const Violation& v : found.errors) c.problem(at, v.field + " = " + io::exact(v.value) + " m: " + v.constraint);
  for (const Violation& v : found.warnings) c.warn(at, v.field + " = " + io::exact(v.value) + " m: " + v.constraint);
  return g;
}

/// By the nominal stress on the ligament.
Typical typical_load(const NotchedSpecimen& g) {
  return scaled(typical::bending_stress, Quantity::force, g.nominal_stress());
}

}  // namespace fpz::calibration::detail
