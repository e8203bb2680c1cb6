// Where the straight part of the rise of a curve meets zero load: slack, a toe, or a reading that was not zeroed.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace fpz::calibration {

struct RiseIntercept {
  double reading = 0.0;         ///< where the line meets zero load, m
  double standard_error = 0.0;  ///< of that, from the scatter about the line, m
  double from = 0.0;            ///< part of the rise, over the peak load
  double to = 0.0;
  int points = 0;
  /// The reading lies beyond zero by more than chance (one-sided, 1e-4), and by more than 3 % of the reading at the
  /// peak. A process zone that flattens the rise moves it below zero, never beyond.
  bool beyond_zero = false;
};

/// The steepest of the straight lines through the points between 0.1 and 0.4, 0.2 and 0.5, 0.3 and 0.6, 0.2 and 0.7 of
/// the peak, on the way up; nothing where none of these has four points.
[[nodiscard]] std::optional<RiseIntercept> rise_intercept(const Eigen::VectorXd& readings,
                                                          const Eigen::VectorXd& loads);

}  // namespace fpz::calibration
