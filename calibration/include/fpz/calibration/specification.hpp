// What a calibration is asked to do, read from a JSON file. The format is documented in docs/calibration.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/calibration/data_set.hpp"
#include "fpz/calibration/fit.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/parameters.hpp"

namespace fpz::calibration {

/// How one material parameter takes part.
struct ParameterSetting {
  double value = 0.0;  ///< fixed, or the start, SI
  bool fitted = false;
  double lower = 0.0;  ///< of a fitted one
  double upper = 0.0;
  std::optional<Prior> prior;
  std::optional<std::string> slope_of;        ///< the data set whose initial slope gave the value
  std::optional<ModulusEstimate> from_slope;  ///< goes with it
  std::string origin;                         ///< where the value stands: key path and file name
};

/// A value from elsewhere, e.g. printed in a paper, that the report compares with the fitted one.
struct ReferenceValue {
  std::string parameter;
  double value = 0.0;  ///< SI
  std::string source;
};

struct Specification {
  std::filesystem::path file;
  std::string name;
  std::string description;
  Setting setting = Setting::plane_strain;
  std::string material_name;                                 ///< of the result
  double density = 0.0;                                      ///< kg/m^3
  MaterialChoices choices;                                   ///< of the base material
  std::array<ParameterSetting, parameter_count> parameters;  ///< in the order of Parameter
  std::vector<DataSet> data;
  std::vector<ReferenceValue> references;
  std::vector<std::string> profiles;     ///< names of fitted parameters
  FitOptions options;                    ///< without the profiles, which make_problem's caller numbers
  std::vector<std::string> conversions;  ///< parameters that follow from other quantities of the material, in words
  std::vector<std::string> warnings;     ///< doubtful but admissible; one line each, with file and line

  [[nodiscard]] const ParameterSetting& operator[](Parameter p) const {
    return parameters[static_cast<std::size_t>(p)];
  }
  /// All parameters at their fixed or start values; rve_length is 0.
  [[nodiscard]] Parameters start() const;
};

/// Reads a specification with all the files that it names. Throws io::InputError listing every problem found.
[[nodiscard]] Specification read_specification(const std::filesystem::path& file);

/// The same from text; `origin` names it in messages and gives the folder for other files.
[[nodiscard]] Specification parse_specification(std::string_view text, const std::filesystem::path& origin,
                                                const io::ReadLimits& limits = {});

}  // namespace fpz::calibration
