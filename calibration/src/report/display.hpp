// Numbers and names as a person reads them, in reports and pictures.
#pragma once

#include <string>
#include <string_view>

namespace fpz::calibration::detail {

/// A unit to show SI values in: shown = value / factor.
struct Display {
  double factor = 1.0;
  std::string unit;
};

/// A readable unit for values of about this size: MPa or GPa for Pa, um or mm for m.
[[nodiscard]] Display display(std::string_view si_unit, double size);

/// Significant digits, without trailing zeros; "-" for NaN.
[[nodiscard]] std::string digits(double x, int significant = 4);

/// digits(value/factor) with the unit.
[[nodiscard]] std::string shown_value(double value, std::string_view si_unit, int significant = 4);

/// "micrometre" as the letter mu, square roots and squares as signs.
[[nodiscard]] std::string pretty_unit(std::string_view unit);

/// Percentage with a sign, e.g. "+3.1 %".
[[nodiscard]] std::string percent(double relative, int significant = 2);

}  // namespace fpz::calibration::detail
