// Which numbers of the common room stand where in this interface. The names are theirs.
#pragma once

#include "fpz/point/properties.hpp"
#include "fpz/point/state_layout.hpp"

namespace fpz::generic {

/// Name of the behaviour, and what its symbols begin with.
inline constexpr const char* behaviour_name = "Fpz";

/// Material properties: the parameters and the choices of a material, the first ones of point::properties(). Every
/// choice is an enumeration of one byte.
inline constexpr std::size_t material_property_count = parameter_table<double>.size() + sizeof(MaterialChoices);

/// Parameters of the behaviour, which have defaults and hold for all points of a process: the options of the
/// integrator, the rest of point::properties().
inline constexpr std::size_t setting_count = point::property_count - material_property_count;

/// The state layout begins with strain and stress, which a client keeps as gradients and forces.
template <int Dim>
inline constexpr std::size_t kept_by_client = 2 * std::size_t{tensor_size<Dim>};

/// Internal state variables: the rest of the state layout.
template <int Dim>
inline constexpr std::size_t internal_count = point::state_size<Dim> - kept_by_client<Dim>;

}  // namespace fpz::generic
