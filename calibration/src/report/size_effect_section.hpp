// Largest loads in the report: apparent toughness and size-effect law beside the cohesive model.
#pragma once

#include <string>

#include "fpz/calibration/calibration.hpp"

namespace fpz::calibration::detail {

/// Markdown: tables with a sentence on what each says.
[[nodiscard]] std::string size_effect_section(const DataSet& set, const SizeEffect& effect);

}  // namespace fpz::calibration::detail
