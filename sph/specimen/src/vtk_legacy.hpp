// Legacy .vtk files, ASCII and binary.
#pragma once

#include <string>
#include <string_view>

#include "fpz/specimen/vtu.hpp"

namespace fpz::specimen::detail {

/// Points and point data (SCALARS, VECTORS, FIELD). Throws io::InputError, which names the file.
[[nodiscard]] PointCloud read_legacy(std::string_view text, const std::string& file);

}  // namespace fpz::specimen::detail
