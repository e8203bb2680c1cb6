// A material and its integration as one ordered list of numbers: PROPS of a UMAT, material properties of a generic
// behaviour, the array of the C interface.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fpz/options.hpp"
#include "fpz/parameters.hpp"

namespace fpz::point {

/// What is known about one number of the list.
struct Property {
  std::string name;            ///< "young_modulus", "softening", "integrator_tolerance", ...
  std::string unit;            ///< SI, as in parameter_table; any consistent units do
  bool required = false;       ///< false: `default_value` where it is 0 or missing at the end of the list
  double default_value = 0.0;  ///< 0 for the choices of the material: the first word of their list
  std::string values;          ///< "> 0 and < 90"; "0 (accurate), 1 (implicit) or 2 (paper)"
};

/// How long the full list is.
inline constexpr std::size_t property_count = 21;

/// The list: the parameters of parameter_table, the choices of visit_choices(), the options of visit_options() with the
/// prefix "integrator_". Words are numbers, their places in Words<E>::list from 0.
[[nodiscard]] const std::vector<Property>& properties();

/// What a list of numbers says.
struct Statement {
  Parameters parameters;
  Options options;
};

/// Reads a list; numbers missing at its end are 0. `rve_length` takes the place of an H that is 0 or missing. Throws
/// std::invalid_argument, one line for each fault with number, name, value and constraint: words that do not exist,
/// integers that are none, more numbers than property_count. Constraints of the model are left to validate().
[[nodiscard]] Statement read_properties(std::span<const double> list, double rve_length);

/// The inverse of read_properties(): property_count numbers.
[[nodiscard]] std::vector<double> write_properties(const Statement& statement);

}  // namespace fpz::point
