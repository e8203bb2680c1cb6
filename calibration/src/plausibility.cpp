#include "fpz/calibration/plausibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fpz/io/problems.hpp"

namespace fpz::calibration {
namespace {

// Soft rocks such as Johnstone at one end, granites and high-strength concretes at the other.
constexpr std::array<std::pair<std::string_view, Typical>, 10> parameters = {{
    {"young_modulus", {Quantity::stress, 2e7, 1e8, 1.5e11, 1e12}},
    {"poisson_ratio", {Quantity::number, 0.005, 0.05, 0.45, 0.5}},
    {"density", {Quantity::density, 300.0, 1000.0, 3500.0, 1e4}},
    {"tensile_strength", {Quantity::stress, 1e4, 5e4, 3e7, 1e8}},
    {"cohesion", {Quantity::stress, 1e4, 5e4, 2e8, 1e9}},
    {"friction_angle_deg", {Quantity::angle, 2.0, 10.0, 65.0, 85.0}},
    {"dilation_angle_deg", {Quantity::angle, 0.02, 0.5, 40.0, 85.0}},
    {"delta0", {Quantity::length, 1e-9, 3e-7, 3e-4, 2e-3}},
    {"normal_stiffness", {Quantity::stiffness, 1e8, 1e11, 1e16, 1e19}},
    {"shear_stiffness", {Quantity::stiffness, 1e7, 1e9, 1e16, 1e19}},
}};

std::string four_digits(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", x);
  return text.data();
}

std::string with_unit(double number, std::string_view unit) {
  std::string text = io::exact(number);
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

/// A unit in which the number would be typical, the one that puts it closest to the middle.
const Unit* meant_unit(const Written& value, const Typical& t) {
  const double centre = 0.5 * (std::log(t.low) + std::log(t.high));
  const Unit* best = nullptr;
  double best_distance = 0.0;
  for (const Unit& unit : units(t.quantity)) {
    const double x = value.number * unit.factor;
    if (unit.name == value.unit || x < t.low || x > t.high) continue;
    const double distance = std::abs(std::log(x) - centre);
    if (best != nullptr && distance >= best_distance) continue;
    best = &unit;
    best_distance = distance;
  }
  return best;
}

}  // namespace

Judgement judge(std::string_view what, const Written& value, const Typical& t) {
  if (value.si >= t.low && value.si <= t.high) return {};
  Judgement j;
  const bool far = !(value.si >= t.far_low && value.si <= t.far_high);
  j.verdict = far ? Verdict::impossible : Verdict::doubtful;
  j.text = std::string(what) + " = " + with_unit(value.number, value.unit) + " is " + (far ? "far " : "") +
           (value.si < t.low ? "below" : "above") + (far ? " any" : " the usual") + " value for rock and concrete (" +
           with_unit(t.low, "") + " to " + with_unit(t.high, si_unit(t.quantity)) + ")";
  const Unit* unit = value.si > 0.0 ? meant_unit(value, t) : nullptr;
  if (unit != nullptr) {
    j.text += "; " + with_unit(value.number, unit->name) + " was probably meant: write " +
              four_digits(value.number * unit->factor) + " or \"unit\": \"" + std::string(unit->name) + '"';
  }
  return j;
}

const Typical& typical_parameter(std::string_view name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.first == name; });
  if (found == parameters.end()) throw std::invalid_argument("no parameter \"" + std::string(name) + '"');
  return found->second;
}

}  // namespace fpz::calibration
