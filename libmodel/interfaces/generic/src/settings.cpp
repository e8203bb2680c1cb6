#include "settings.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace fpz::generic {

namespace {

// 0 stands for the default, as everywhere in a list of properties.
std::array<std::atomic<double>, setting_count> settings{};

}  // namespace

bool set_parameter(std::string_view name, double value) noexcept {
  if (!std::isfinite(value)) return false;
  const auto& all = point::properties();
  for (std::size_t k = 0; k < setting_count; ++k) {
    if (all[material_property_count + k].name == name) {
      settings[k].store(value, std::memory_order_relaxed);
      return true;
    }
  }
  return false;
}

std::array<double, point::property_count> full_list(const double* material_properties) noexcept {
  std::array<double, point::property_count> list;
  std::copy_n(material_properties, material_property_count, list.begin());
  list[length_place] = 0.0;
  for (std::size_t k = 0; k < setting_count; ++k) {
    list[material_property_count + k] = settings[k].load(std::memory_order_relaxed);
  }
  return list;
}

}  // namespace fpz::generic
