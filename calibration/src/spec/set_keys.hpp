// Keys that every data set may have, joined with those of its kind.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace fpz::calibration::detail {

[[nodiscard]] inline std::vector<std::string_view> set_keys(std::initializer_list<std::string_view> own,
                                                            std::span<const std::string_view> more = {}) {
  std::vector<std::string_view> keys = {"name", "kind", "source", "role", "weight", "loss"};
  keys.insert(keys.end(), own);
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

}  // namespace fpz::calibration::detail
