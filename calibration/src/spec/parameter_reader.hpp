// The keys "material", "parameters" and "fit" of a specification.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "fpz/calibration/specification.hpp"
#include "fpz/io/material_file.hpp"
#include "quantity_reader.hpp"

namespace fpz::calibration::detail {

/// What the parameters of a specification leave to be done when the data are there.
struct SlopeRequest {
  bool as_prior = false;
  io::Location at;
};

struct ParameterEntries {
  std::array<io::Location, parameter_count> locations;
  std::optional<SlopeRequest> slope;  ///< young_modulus from the initial slope of a data set
};

/// Fills in the parameters of `spec`, density and the name of the material.
[[nodiscard]] ParameterEntries read_parameters(const Context& c, const std::filesystem::path& folder, const Place& root,
                                               Specification& spec);

/// Bounds of a fitted parameter that has none: a factor of 20 either way, angles and nu within what they can be.
[[nodiscard]] std::pair<double, double> default_bounds(Parameter which, double start);

/// fpz::validate() on the start values; errors become problems at their places.
void check_start(const Context& c, const Specification& spec, const ParameterEntries& entries);

}  // namespace fpz::calibration::detail
