// Weights of particles that stand for a place among or beside them: moving least squares with linear fields.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "fpz/types.hpp"

namespace fpz::sph {

class LinearFit {
 public:
  /// Particles as seen from the place, in units of the reach, with their volumes. They count with the bell
  /// (1 - q^2)^2, q being the distance: not at all beyond the reach.
  LinearFit(const std::vector<Vec<double, 2>>& seen, const std::vector<double>& volume);

  /// False when there are too few, or all on one line.
  [[nodiscard]] bool is_determined() const { return determined_; }
  /// One for each particle, linear in the place times bell and volume: their sum, and the sums of weight times x and y,
  /// are `sums`. (1, 0, 0) gives the value of a field at the place, (0, x, y) its slope along (x, y).
  [[nodiscard]] std::vector<double> weights(const Eigen::Vector3d& sums) const;

 private:
  std::vector<Eigen::Vector3d> terms_;  ///< bell times volume times (1, x, y)
  Eigen::FullPivLU<Eigen::Matrix3d> factors_;
  bool determined_ = false;
};

}  // namespace fpz::sph
