// Data of the kind "scene": what the gauges of a specimen read that only the particle program can compute.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/calibration/response_surface.hpp"
#include "fpz/parameters.hpp"

namespace fpz::calibration {

/// A scene file and the entries of it that the data set changes, "path=value" each.
struct SceneSource {
  std::filesystem::path file;
  std::vector<std::string> changes;

  bool operator==(const SceneSource&) const = default;
};

/// One measured value: a gauge where another column of the history first reaches `at`, or the largest reading.
struct SceneValue {
  std::size_t scene = 0;  ///< index in SceneData::scenes
  std::string gauge;
  std::string abscissa;      ///< "time" or a gauge; empty: the largest reading of `gauge`
  double at = 0.0;           ///< SI
  std::string_view si_unit;  ///< of the gauge
};

struct SceneData {
  std::vector<SceneSource> scenes;
  std::vector<SceneValue> values;
  std::shared_ptr<const ResponseSurface> surface;  ///< through the runs that were made; none before them
};

/// One run of the particle program: the scene with its material replaced by these parameters.
struct SceneRun {
  SceneSource source;
  Parameters parameters;
};

/// What it gave.
struct SceneOutcome {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> readings;  ///< per column, SI
  std::string ending;                         ///< which stop rule ended it
  std::vector<std::string> warnings;          ///< what the program says about the run
  std::string failure;                        ///< why there are no readings; empty when there are
};

/// Told while runs go on: how many of how many are done, and seconds that the others will take (NaN: unknown).
using SceneProgress = std::function<void(std::size_t done, std::size_t all, double remaining)>;

/// Makes runs, several at the same time; outcomes in their order.
using RunScenes = std::function<std::vector<SceneOutcome>(const std::vector<SceneRun>& runs, const SceneProgress&)>;

/// The values of a data set from the outcomes of its scenes. A failure names scene and cause: a run that failed, one
/// that ended before a reading, a gauge that is not there.
[[nodiscard]] Prediction readings_of(const SceneData& data, const std::vector<SceneOutcome>& outcomes);

[[nodiscard]] inline std::string_view unit_of_value(const SceneData& data, std::size_t k) {
  return data.values[k].si_unit;
}

/// From the surface.
[[nodiscard]] Prediction predict(const SceneData& data, const Parameters& parameters, bool derivatives);

}  // namespace fpz::calibration
