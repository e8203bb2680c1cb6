// Units of the quantities in specifications and data files.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace fpz::io {

enum class Quantity { length, force, stress, energy_per_area, toughness, stiffness, density, angle, number };

/// A unit's name and the factor that turns a value in it into SI (angles: into degrees).
struct Unit {
  std::string_view name;
  double factor = 1.0;
};

/// The SI unit (degrees for angles, "" for plain numbers).
[[nodiscard]] std::string_view si_unit(Quantity q);

/// The quantity with this SI unit, e.g. of a row of the table of parameters. Throws std::invalid_argument for a unit
/// that none has.
[[nodiscard]] Quantity quantity_of(std::string_view si_unit);

/// The units of a quantity that messages offer, SI first.
[[nodiscard]] const std::vector<Unit>& units(Quantity q);

/// The named unit, one of units() or a further one (psi, lbf, ...), in any of its spellings: N/mm^2, µm, MPa m^0.5,
/// MPa*sqrt(m), MPa√m, MN/m^1.5. Nothing when the quantity has no such unit.
[[nodiscard]] std::optional<Unit> find_unit(Quantity q, std::string_view name);

/// Its factor.
[[nodiscard]] std::optional<double> unit_factor(Quantity q, std::string_view name);

/// Is it a unit of some quantity?
[[nodiscard]] bool is_unit(std::string_view name);

/// Is it one in which the number is the same as in SI (degrees for angles), seconds included?
[[nodiscard]] bool is_si_unit(std::string_view name);

}  // namespace fpz::io
