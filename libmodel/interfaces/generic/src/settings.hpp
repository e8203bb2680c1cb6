// The parameters of the behaviour: options of the integrator, one set for all points of a process.
#pragma once

#include <array>
#include <string_view>

#include "lists.hpp"

namespace fpz::generic {

/// Sets the parameter of that name; false when there is none or the value is not finite. Whether the value is sound is
/// checked where it is used. May be called while other threads integrate.
[[nodiscard]] bool set_parameter(std::string_view name, double value) noexcept;

/// A material's properties (those of the client) and the settings, as point::behaviour_of() takes them, but for H: its
/// place is 0, so that points of different size share one checked material.
[[nodiscard]] std::array<double, point::property_count> full_list(const double* material_properties) noexcept;

/// Where H is in that list.
inline constexpr std::size_t length_place = material_parameter_count;

}  // namespace fpz::generic
