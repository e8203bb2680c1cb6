// One run of the trust-region solver from one start.
#pragma once

#include <functional>

#include "least_squares.hpp"

namespace fpz::calibration::detail {

/// Where a run ended.
struct Minimum {
  Eigen::VectorXd values;
  Eigen::VectorXd z;
  Evaluation evaluation;     ///< with derivatives, at `values`
  double cost = 0.0;         ///< infinite when there is no prediction at the start
  Eigen::VectorXd gradient;  ///< d cost / d parameter
  std::vector<int> bound;    ///< -1 at the lower bound, 1 at the upper bound, 0 between, 2 held fixed
  bool converged = false;
  bool stopped = false;  ///< by SolverRun::stop
  int iterations = 0;
  std::string message;

  [[nodiscard]] bool ok() const { return evaluation.ok(); }
};

struct SolverRun {
  std::vector<bool> fixed;  ///< parameters that keep their start value; empty: none
  int max_iterations = 200;
  std::function<bool(const Eigen::VectorXd& z, double cost)> stop;  ///< asked after every iteration
};

/// Minimises the cost from `start` (parameter values). Deterministic, one thread, no output.
[[nodiscard]] Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start, const SolverRun& run);

}  // namespace fpz::calibration::detail
