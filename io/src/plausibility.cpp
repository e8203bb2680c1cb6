#include "fpz/io/plausibility.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "fpz/io/problems.hpp"

namespace fpz::io {
namespace {

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
  const double centre = 0.5 * (std::log(t.range.low) + std::log(t.range.high));
  const Unit* best = nullptr;
  double best_distance = 0.0;
  for (const Unit& unit : units(t.quantity)) {
    const double x = value.number * unit.factor;
    if (unit.name == value.unit || x < t.range.low || x > t.range.high) continue;
    const double distance = std::abs(std::log(x) - centre);
    if (best != nullptr && distance >= best_distance) continue;
    best = &unit;
    best_distance = distance;
  }
  return best;
}

}  // namespace

std::string likely_unit(const Written& value, const Typical& t, Spelling spelling) {
  const Unit* unit = value.si > 0.0 ? meant_unit(value, t) : nullptr;
  if (unit == nullptr) return "";
  std::string text = "; " + with_unit(value.number, unit->name) + " was probably meant: write " +
                     four_digits(value.number * unit->factor);
  if (spelling == Spelling::with_unit) text += " or \"unit\": \"" + std::string(unit->name) + '"';
  return text;
}

Judgement judge(std::string_view what, const Written& value, const Typical& t, Spelling spelling) {
  if (value.si >= t.range.low && value.si <= t.range.high) return {};
  Judgement j;
  const bool far = !(value.si >= t.range.far_low && value.si <= t.range.far_high);
  j.verdict = far ? Verdict::impossible : Verdict::doubtful;
  const std::string unit = likely_unit(value, t, spelling);
  j.other_unit = !unit.empty();
  j.text = std::string(what) + " = " + with_unit(value.number, value.unit) + " is " + (far ? "far " : "") +
           (value.si < t.range.low ? "below" : "above") + (far ? " any" : " the usual") +
           " value for rock and concrete (" + with_unit(t.range.low, "") + " to " +
           with_unit(t.range.high, si_unit(t.quantity)) + ")" + unit;
  return j;
}

Judgement judge_parameter(std::string_view name, double si) {
  const Typical t = typical_parameter(name);
  return judge(name, {si, si, si_unit(t.quantity)}, t, Spelling::si_only);
}

Typical scaled(const Typical& t, Quantity quantity, double factor) {
  const Plausible& r = t.range;
  return {quantity, {r.far_low / factor, r.low / factor, r.high / factor, r.far_high / factor}};
}

Typical typical_parameter(std::string_view name) {
  for (const ParameterInfo<double>& p : parameter_table<double>) {
    if (p.name == name) return {quantity_of(p.unit), p.plausible};
  }
  throw std::invalid_argument("no parameter \"" + std::string(name) + '"');
}

}  // namespace fpz::io
