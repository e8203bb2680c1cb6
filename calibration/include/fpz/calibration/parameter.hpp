// The material parameters that a calibration can find, as rows of the table of all parameters.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "fpz/parameters.hpp"

namespace fpz::calibration {

/// Density and the RVE length are not among them: no quasi-static test of a specimen depends on the first, and the
/// second belongs to the test.
template <class T>
[[nodiscard]] constexpr bool is_calibrated(const ParameterInfo<T>& p) {
  return p.of_material && p.member != &BasicParameters<T>::density;
}

inline constexpr int parameter_count =
    static_cast<int>(std::count_if(parameter_table<double>.begin(), parameter_table<double>.end(),
                                   [](const ParameterInfo<double>& p) { return is_calibrated(p); }));

/// Their rows of the table, in its order; derivatives stand in the same order.
template <class T>
inline constexpr auto calibrated_parameters = [] {
  std::array<ParameterInfo<T>, static_cast<std::size_t>(parameter_count)> rows{};
  std::copy_if(parameter_table<T>.begin(), parameter_table<T>.end(), rows.begin(),
               [](const ParameterInfo<T>& p) { return is_calibrated(p); });
  return rows;
}();
inline constexpr const auto& parameter_info = calibrated_parameters<double>;

/// The place of a member among them; does not compile for one that is not there.
[[nodiscard]] consteval int place_of(double Parameters::*member) {
  for (std::size_t k = 0; k < parameter_info.size(); ++k) {
    if (parameter_info[k].member == member) return static_cast<int>(k);
  }
  throw "this member is not calibrated";
}

/// Names for the places.
enum class Parameter : int {
  young_modulus = place_of(&Parameters::young_modulus),
  poisson_ratio = place_of(&Parameters::poisson_ratio),
  tensile_strength = place_of(&Parameters::tensile_strength),
  cohesion = place_of(&Parameters::cohesion),
  friction_angle_deg = place_of(&Parameters::friction_angle_deg),
  dilation_angle_deg = place_of(&Parameters::dilation_angle_deg),
  delta0 = place_of(&Parameters::delta0),
  normal_stiffness = place_of(&Parameters::normal_stiffness),
  shear_stiffness = place_of(&Parameters::shear_stiffness)
};

[[nodiscard]] constexpr const ParameterInfo<double>& info(Parameter p) {
  return parameter_info[static_cast<std::size_t>(p)];
}

/// The place of the parameter of that name, or nothing.
[[nodiscard]] constexpr std::optional<std::size_t> parameter_index(std::string_view name) {
  for (std::size_t k = 0; k < parameter_info.size(); ++k) {
    if (parameter_info[k].name == name) return k;
  }
  return std::nullopt;
}

}  // namespace fpz::calibration
