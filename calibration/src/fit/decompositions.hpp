// The decompositions of matrices of any size that the statistics of a fit need, compiled once: Eigen's templates behind
// them cost seconds in every source that names them.
#pragma once

#include <Eigen/Core>

namespace fpz::calibration::detail {

/// A = U diag(values) right', with at least as many rows as columns. Values fall; one column of `right` for each.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd right;
};
[[nodiscard]] SingularValues singular_values(const Eigen::MatrixXd& a);

/// Of a symmetric matrix; values rise, one column of `vectors` for each.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
[[nodiscard]] Eigenpairs eigenpairs(const Eigen::MatrixXd& symmetric);

/// Squared length of the part of b in the space of the columns of a, by QR with column pivoting; columns below
/// `threshold` of the largest pivot count as dependent.
[[nodiscard]] double squared_projection(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold);

}  // namespace fpz::calibration::detail
