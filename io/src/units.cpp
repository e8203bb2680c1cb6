#include "fpz/io/units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace fpz::io {

namespace {

struct UnitsOf {
  Quantity quantity;
  std::vector<Unit> units;
};

const std::vector<UnitsOf>& table() {
  static const double root_milli = std::sqrt(1e-3);
  static const std::vector<UnitsOf> list = {
      {Quantity::length, {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}}},
      {Quantity::force, {{"N", 1.0}, {"kN", 1e3}, {"MN", 1e6}}},
      {Quantity::stress, {{"Pa", 1.0}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}, {"N/mm2", 1e6}}},
      {Quantity::energy_per_area, {{"J/m2", 1.0}, {"N/m", 1.0}, {"N/mm", 1e3}, {"kJ/m2", 1e3}, {"mJ/mm2", 1e3}}},
      {Quantity::toughness,
       {{"Pa.sqrt(m)", 1.0}, {"kPa.sqrt(m)", 1e3}, {"MPa.sqrt(m)", 1e6}, {"MPa.sqrt(mm)", 1e6 * root_milli}}},
      {Quantity::stiffness,
       {{"Pa/m", 1.0}, {"MPa/m", 1e6}, {"GPa/m", 1e9}, {"MPa/mm", 1e9}, {"GPa/mm", 1e12}, {"N/mm3", 1e9}}},
      {Quantity::density, {{"kg/m3", 1.0}, {"g/cm3", 1e3}, {"t/m3", 1e3}}},
      {Quantity::angle, {{"deg", 1.0}, {"rad", 180.0 / std::numbers::pi}}},
      {Quantity::number, {{"", 1.0}, {"%", 1e-2}, {"1e-3", 1e-3}, {"1e-6", 1e-6}}}};
  return list;
}

}  // namespace

const std::vector<Unit>& units(Quantity q) {
  const std::vector<UnitsOf>& all = table();
  return std::find_if(all.begin(), all.end(), [q](const UnitsOf& u) { return u.quantity == q; })->units;
}

std::string_view si_unit(Quantity q) { return units(q).front().name; }

Quantity quantity_of(std::string_view si_unit) {
  for (const UnitsOf& u : table()) {
    if (u.units.front().name == si_unit) return u.quantity;
  }
  throw std::invalid_argument("no quantity has the SI unit \"" + std::string(si_unit) + '"');
}

std::optional<double> unit_factor(Quantity q, std::string_view name) {
  const std::vector<Unit>& known = units(q);
  const auto found = std::find_if(known.begin(), known.end(), [&](const Unit& u) { return u.name == name; });
  if (found == known.end()) return std::nullopt;
  return found->factor;
}

}  // namespace fpz::io
