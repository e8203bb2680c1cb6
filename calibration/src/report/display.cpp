#include "display.hpp"

#include <cmath>

#include "words.hpp"

namespace fpz::calibration::detail {

Display display(std::string_view si_unit, double size) {
  const double x = std::abs(size);
  if (si_unit == "Pa") {
    if (x >= 1e9) return {1e9, "GPa"};
    if (x >= 1e4) return {1e6, "MPa"};
    return {1.0, "Pa"};
  }
  if (si_unit == "m") return x >= 1e-3 ? Display{1e-3, "mm"} : Display{1e-6, "um"};
  if (si_unit == "Pa.sqrt(m)") return {1e6, "MPa.sqrt(m)"};
  return {1.0, std::string(si_unit)};
}

std::string digits(double x, int significant) {
  if (std::isnan(x)) return "-";
  return number(x, significant);
}

std::string pretty_unit(std::string_view unit) {
  std::string text(unit);
  const auto replace = [&](std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
  };
  if (text == "um") return "µm";
  replace(".sqrt(mm)", "√mm");
  replace(".sqrt(m)", "√m");
  replace("m2", "m²");
  replace("m3", "m³");
  if (text == "deg") return "°";
  return text;
}

std::string shown_value(double value, std::string_view si_unit, int significant) {
  const Display d = display(si_unit, value);
  const std::string unit = pretty_unit(d.unit);
  std::string text = digits(value / d.factor, significant);
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

std::string percent(double relative, int significant) {
  if (std::isnan(relative)) return "-";
  std::string text(relative >= 0.0 ? "+" : "");
  return text.append(digits(100.0 * relative, significant)).append(" %");
}

}  // namespace fpz::calibration::detail
