// Numbers and lists in messages.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace fpz::calibration::detail {

[[nodiscard]] inline std::string number(double x, int significant = 4) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", significant, x);
  return text;
}

[[nodiscard]] inline std::string with_unit(double x, const std::string& unit) {
  return unit.empty() ? number(x) : number(x) + " " + unit;
}

/// "a", "a and b", "a, b and c".
[[nodiscard]] inline std::string listed(const std::vector<std::string>& items) {
  std::string out;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) out += k + 1 == items.size() ? " and " : ", ";
    out += items[k];
  }
  return out;
}

}  // namespace fpz::calibration::detail
