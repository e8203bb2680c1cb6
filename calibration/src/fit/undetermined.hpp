// Directions in the space of the parameters that the data leave open, and how to say so.
#pragma once

#include "solver.hpp"

namespace fpz::calibration::detail {

/// Needs the statistics in `result`. Fills the singular values and the undetermined directions, makes the errors of
/// their parameters infinite, and warns of parameters that are weakly determined or by their prior alone.
///
/// Rule: a direction (unit vector of relative changes) is undetermined when its singular value is below 1, so that a
/// change by 100 % moves all predictions together by less than one standard deviation, or below 1e-9 of the largest
/// singular value, which is rounding. Only the latter makes errors infinite.
void add_undetermined(const LeastSquares& problem, const Minimum& m, FitResult& result);

}  // namespace fpz::calibration::detail
