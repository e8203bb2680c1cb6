// The end of a minimisation where the predictions have kinks.
#pragma once

#include <vector>

#include "solver.hpp"

namespace fpz::calibration::detail {

/// How far a minimum may be from the end of a run, in standard errors, where the predictions are smooth there.
inline constexpr double smooth_tolerance = 0.01;
/// The same where they have kinks: derivatives from one side promise a gain that is not there.
inline constexpr double kink_tolerance = 0.1;

/// Length of the Gauss-Newton step of the parameters that may move, in standard errors: the root of twice the gain in
/// cost that it promises.
[[nodiscard]] double promised_step(const LeastSquares& problem, const Minimum& m, const std::vector<bool>& held);

/// Looks for a lower cost beyond the kinks around `m`, and goes there, until there is none: gradients are sampled
/// within a few per cent of a standard error around the point, and the shortest vector in their convex hull is the
/// steepest descent that holds on all sides of the kinks (Burke, Lewis, Overton 2005). Returns the length of that
/// vector in standard errors; at most kink_tolerance at a minimum. `m` is left with prediction, cost and gradient.
[[nodiscard]] double settle(const LeastSquares& problem, const std::vector<bool>& held, Minimum& m);

}  // namespace fpz::calibration::detail
