// Several starts, and the distinct minima they lead to.
#pragma once

#include "solver.hpp"

namespace fpz::calibration::detail {

struct MultiStart {
  std::vector<StartResult> starts;
  std::vector<Minimum> minima;  ///< distinct ones in the order they were found
  std::vector<int> minimum_of;  ///< per start: index into minima, -1 when it failed
};

/// Runs the given start and options.starts - 1 others from a Latin hypercube in the scaled variables. A start without
/// prediction is drawn towards the given one until it has one. A run that comes into the quadratic neighbourhood of a
/// minimum found before ends there.
[[nodiscard]] MultiStart multi_start(const LeastSquares& problem, const FitOptions& options);

/// Are both ends of one minimum (or valley)? Costs and predictions agree, or the cost has no barrier between them.
[[nodiscard]] bool same_minimum(const LeastSquares& problem, const Minimum& a, const Minimum& b);

}  // namespace fpz::calibration::detail
