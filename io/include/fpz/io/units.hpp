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

/// All units known for a quantity, SI first.
[[nodiscard]] const std::vector<Unit>& units(Quantity q);

/// Factor of the named unit; nothing when the quantity has no such unit.
[[nodiscard]] std::optional<double> unit_factor(Quantity q, std::string_view name);

}  // namespace fpz::io
