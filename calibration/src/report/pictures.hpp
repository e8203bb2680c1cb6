// The pictures of a calibration.
#pragma once

#include <string>
#include <vector>

#include "fpz/calibration/calibration.hpp"
#include "fpz/io/picture.hpp"

namespace fpz::calibration::detail {

/// File names without ending. Pictures that a calibration may have, whether or not it has the numbers for them.
[[nodiscard]] std::string data_picture_name(const DataSet& set);
[[nodiscard]] std::string size_effect_picture_name(const DataSet& set);
[[nodiscard]] std::string profile_picture_name(const std::string& parameter);
inline constexpr const char* residuals_picture = "residuals";
inline constexpr const char* correlation_picture = "correlation";
[[nodiscard]] std::vector<std::string> picture_names(const Specification& specification);

/// Those that can be drawn.
[[nodiscard]] std::vector<io::Picture> draw_pictures(const Calibration& calibration);

}  // namespace fpz::calibration::detail
