// The particle program as the calibration uses it. There are two implementations: with it, and without, where every
// function says that this program was built without it.
#pragma once

#include <string>
#include <vector>

#include "fpz/calibration/scene_data.hpp"
#include "fpz/io/units.hpp"

namespace fpz::calibration::detail {

/// A column that data may be compared with.
struct SceneColumn {
  std::string name;
  io::Quantity quantity = io::Quantity::number;
};

struct SceneFacts {
  Setting setting = Setting::plane_strain;
  std::vector<SceneColumn> columns;  ///< time and the gauges
  std::vector<std::string> warnings;
};

/// Reads a scene. Throws io::InputError with all problems.
[[nodiscard]] SceneFacts facts_of(const SceneSource& source);

/// About how long a run takes, s, on one core. Throws as facts_of().
[[nodiscard]] double seconds_of(const SceneRun& run);

}  // namespace fpz::calibration::detail
