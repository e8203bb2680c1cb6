// The fields of a run, each declared once: who owns fields has a function that calls visit(info, field, where) for each
// of them, `where` being the member of View through which the loops see it, or nothing. Allocation, the loops' view,
// snapshots and restoring derive from it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "fpz/sph/archive.hpp"
#include "fpz/sph/particles.hpp"
#include "view.hpp"

namespace fpz::sph::detail {

enum class Extent : std::uint8_t { particle, block };

/// Where its content comes from after a snapshot was read.
enum class Keep : std::uint8_t {
  constant,  ///< from the set-up: never changes during a run
  saved,     ///< from the snapshot
  passing    ///< made anew in every step before it is read
};

struct FieldInfo {
  const char* name;
  Extent extent;
  Keep keep;
  double fill = 0.0;  ///< at first, and for good in padding lanes: harmless there
};

using Mask = std::vector<unsigned char>;

/// P is Particles<Dim>, const or not. Saved is what a run shows, even where the next step makes it anew.
template <class P, class Visit>
void visit_fields(P& p, Visit&& visit) {
  using V = View<P::dimensions>;
  constexpr Extent each = Extent::particle;
  // clang-format off
  visit(FieldInfo{"start",        each, Keep::constant},               p.start,        &V::start);
  visit(FieldInfo{"position",     each, Keep::saved},                  p.position,     &V::position);
  visit(FieldInfo{"velocity",     each, Keep::saved},                  p.velocity,     &V::velocity);
  visit(FieldInfo{"acceleration", each, Keep::saved},                  p.acceleration, &V::acceleration);
  visit(FieldInfo{"predicted",    each, Keep::saved},                  p.predicted,    &V::predicted);
  visit(FieldInfo{"mass",         each, Keep::constant, 1.0},          p.mass,         &V::mass);
  visit(FieldInfo{"inverse_mass", each, Keep::constant},               p.inverse_mass, &V::inverse_mass);
  visit(FieldInfo{"volume",       each, Keep::saved, 1.0},             p.volume,       &V::volume);
  visit(FieldInfo{"density",      each, Keep::saved, 1.0},             p.density,      &V::density);
  visit(FieldInfo{"length",       each, Keep::saved, 1.0},             p.length,       nullptr);
  visit(FieldInfo{"fracture",     each, Keep::saved},                  p.fracture,     nullptr);
  visit(FieldInfo{"kind",         each, Keep::saved, kind::elastic},   p.kind,         &V::kind);
  visit(FieldInfo{"stress",       each, Keep::saved},                  p.stress,       &V::stress);
  visit(FieldInfo{"strain",       each, Keep::saved},                  p.strain,       &V::strain);
  visit(FieldInfo{"correction",   each, Keep::saved},                  p.correction,   &V::correction);
  visit(FieldInfo{"artificial",   each, Keep::saved},                  p.artificial,   &V::artificial);
  visit(FieldInfo{"gradient",     each, Keep::saved},                  p.gradient,     &V::gradient);
  visit(FieldInfo{"flux",         each, Keep::saved},                  p.flux,         &V::flux);
  visit(FieldInfo{"rotation",     each, Keep::saved},                  p.rotation,     &V::rotation);
  // clang-format on
}

/// Makes every component `padded` particles (or their blocks) long.
struct Allocate {
  std::size_t padded;
  template <class F, class Where>
  void operator()(const FieldInfo& info, F& field, Where) const {
    const std::size_t size = info.extent == Extent::particle ? padded : padded / lanes;
    if constexpr (std::is_same_v<F, Field>) {
      field.assign(size, info.fill);
    } else if constexpr (std::is_same_v<F, Mask>) {
      field.assign(size, 0);
    } else {
      for (Field& component : field) component.assign(size, info.fill);
    }
  }
};

/// Points the loops' view to the fields.
template <int Dim>
struct Point {
  View<Dim>& view;
  template <class F, class Where>
  void operator()(const FieldInfo&, F& field, Where where) const {
    if constexpr (std::is_same_v<F, Field> || std::is_same_v<F, Mask>) {
      if constexpr (!std::is_null_pointer_v<Where>) view.*where = field.data();
    } else if constexpr (!std::is_null_pointer_v<Where>) {
      for (std::size_t c = 0; c < field.size(); ++c) (view.*where)[c] = field[c].data();
    }
  }
};

/// Writes or reads the saved ones.
template <class Archive>
struct Transfer {
  Archive& archive;
  template <class F, class Where>
  void operator()(const FieldInfo& info, F& field, Where) const {
    if (info.keep == Keep::saved) archive(field);
  }
};

/// Makes the passing ones unusable (padding excepted), so that a field which is read before it is made does not pass
/// unnoticed after a restore.
struct Spoil {
  std::size_t count;  ///< real particles
  template <class F, class Where>
  void operator()(const FieldInfo& info, F& field, Where) const {
    if (info.keep != Keep::passing) return;
    const auto spoil = [&](auto& component) {
      const std::size_t size = info.extent == Extent::particle ? count : component.size();
      using T = typename std::remove_reference_t<decltype(component)>::value_type;
      const T useless = std::is_same_v<T, double> ? static_cast<T>(std::numeric_limits<double>::quiet_NaN()) : T{1};
      std::fill_n(component.begin(), size, useless);
    };
    if constexpr (std::is_same_v<F, Field> || std::is_same_v<F, Mask>) {
      spoil(field);
    } else {
      for (Field& component : field) spoil(component);
    }
  }
};

}  // namespace fpz::sph::detail
