#include "fpz/calibration/units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fpz::calibration {

const std::vector<Unit>& units(Quantity q) {
  static const double root_milli = std::sqrt(1e-3);
  static const std::vector<Unit> length = {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};
  static const std::vector<Unit> force = {{"N", 1.0}, {"kN", 1e3}, {"MN", 1e6}};
  static const std::vector<Unit> stress = {{"Pa", 1.0}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}, {"N/mm2", 1e6}};
  static const std::vector<Unit> energy = {{"J/m2", 1.0}, {"N/m", 1.0}, {"N/mm", 1e3}, {"kJ/m2", 1e3}, {"mJ/mm2", 1e3}};
  static const std::vector<Unit> toughness = {
      {"Pa.sqrt(m)", 1.0}, {"kPa.sqrt(m)", 1e3}, {"MPa.sqrt(m)", 1e6}, {"MPa.sqrt(mm)", 1e6 * root_milli}};
  static const std::vector<Unit> stiffness = {{"Pa/m", 1.0},   {"MPa/m", 1e6},   {"GPa/m", 1e9},
                                              {"MPa/mm", 1e9}, {"GPa/mm", 1e12}, {"N/mm3", 1e9}};
  static const std::vector<Unit> density = {{"kg/m3", 1.0}, {"g/cm3", 1e3}, {"t/m3", 1e3}};
  static const std::vector<Unit> angle = {{"deg", 1.0}, {"rad", 180.0 / std::numbers::pi}};
  static const std::vector<Unit> number = {{"", 1.0}, {"%", 1e-2}, {"1e-3", 1e-3}, {"1e-6", 1e-6}};
  switch (q) {
    case Quantity::length:
      return length;
    case Quantity::force:
      return force;
    case Quantity::stress:
      return stress;
    case Quantity::energy_per_area:
      return energy;
    case Quantity::toughness:
      return toughness;
    case Quantity::stiffness:
      return stiffness;
    case Quantity::density:
      return density;
    case Quantity::angle:
      return angle;
    case Quantity::number:
      break;
  }
  return number;
}

std::string_view si_unit(Quantity q) { return units(q).front().name; }

std::optional<double> unit_factor(Quantity q, std::string_view name) {
  const std::vector<Unit>& known = units(q);
  const auto found = std::find_if(known.begin(), known.end(), [&](const Unit& u) { return u.name == name; });
  if (found == known.end()) return std::nullopt;
  return found->factor;
}

}  // namespace fpz::calibration
