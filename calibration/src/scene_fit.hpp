// The fit of data that only runs of the particle program predict.
#pragma once

#include <functional>

#include "fpz/calibration/calibration.hpp"

namespace fpz::calibration::detail {

[[nodiscard]] bool has_scenes(const Specification& specification);

struct SceneFit {
  FitResult result;             ///< standard errors, covariance and limits include the scatter of the runs
  Specification specification;  ///< as given, its scenes with surfaces through the runs around the best values
  SceneFitSummary summary;
};

/// Fits a polynomial through runs around the start, minimises on it within the reach of the runs, runs there, and so on
/// (a trust region on a local quadratic model; docs/calibration-scenes.md). The surface is the scene's forward model in
/// everything else: priors, other data sets, statistics, profiles are those of fit().
[[nodiscard]] SceneFit fit_with_runs(const Specification& specification, const FitOptions& options,
                                     const RunScenes& run);

}  // namespace fpz::calibration::detail
