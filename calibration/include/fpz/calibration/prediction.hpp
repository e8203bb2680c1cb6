// What every forward model of the calibration returns: predicted values and their derivatives with respect to the
// material parameters.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>

#include "fpz/calibration/parameter.hpp"

namespace fpz::calibration {

/// Predicted values, one per measured point. Columns of the Jacobian: the material parameters in the order of
/// `Parameter` (per SI unit or degree), then the test's own nuisance parameters, if it has any. Empty when derivatives
/// were not asked for.
struct Prediction {
  Eigen::VectorXd values;
  Eigen::MatrixXd jacobian;
  std::string failure;  ///< why there is no prediction; empty when there is one

  [[nodiscard]] bool ok() const { return failure.empty(); }
};

[[nodiscard]] inline Prediction failed(std::string why) {
  Prediction p;
  p.failure = std::move(why);
  return p;
}

}  // namespace fpz::calibration
