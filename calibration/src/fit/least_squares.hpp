// The fit as a least-squares problem: data sets and priors as rows of one kind, with their noise and losses, and the
// scaled variables the solver works in.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fpz/calibration/fit.hpp"

namespace fpz::calibration::detail {

/// The solver's variable of one parameter. Positive parameters whose bounds span a factor of ten or more:
/// z = ln(value/reference) with the geometric mean of the bounds; all others: z = value/reference with the larger
/// bound.
struct Variable {
  bool logarithmic = false;
  double reference = 1.0;
  double lower = 0.0;  ///< bounds of the parameter itself
  double upper = 0.0;
};

[[nodiscard]] Variable make_variable(const FitParameter& p);
[[nodiscard]] double to_value(const Variable& v, double z);
[[nodiscard]] double to_z(const Variable& v, double value);
[[nodiscard]] double slope(const Variable& v, double z);  ///< d value / d z

/// A data set, or a prior as a data set of one value.
struct RowSet {
  std::string name;
  Eigen::VectorXd measured;
  Eigen::VectorXd deviation;  ///< as given
  double weight = 1.0;
  Loss loss;
  Forward forward;
  int prior_of = -1;       ///< the parameter, for a prior
  bool estimated = false;  ///< the common factor of the deviations is estimated
  double factor = 1.0;     ///< estimated over given deviations

  [[nodiscard]] Eigen::Index size() const { return measured.size(); }
};

struct LeastSquares {
  std::vector<FitParameter> parameters;
  std::vector<Variable> variables;
  std::vector<RowSet> sets;  ///< the data sets in the order of the problem, then the priors

  [[nodiscard]] int size() const { return static_cast<int>(parameters.size()); }
};

[[nodiscard]] LeastSquares make_least_squares(const FitProblem& problem);
[[nodiscard]] Eigen::VectorXd to_values(const LeastSquares& problem, const Eigen::VectorXd& z);
[[nodiscard]] Eigen::VectorXd to_z(const LeastSquares& problem, const Eigen::VectorXd& values);

/// rho, rho' and rho'' of a loss at a squared standardised residual (rho = s without a loss).
struct Rho {
  double value = 0.0;
  double first = 1.0;
  double second = 0.0;
};
[[nodiscard]] Rho rho(const Loss& loss, double squared);

/// One forward model, with whatever goes wrong in it (exceptions, wrong sizes, values that are not finite) as failure.
[[nodiscard]] Prediction predict(const RowSet& set, const Eigen::VectorXd& values, bool derivatives);

/// All forward models at one point.
struct Evaluation {
  std::vector<Prediction> sets;
  std::string failure;  ///< of the first set that failed, with its name; empty when there is none

  [[nodiscard]] bool ok() const { return failure.empty(); }
};
[[nodiscard]] Evaluation evaluate(const LeastSquares& problem, const Eigen::VectorXd& values, bool derivatives);

/// (predicted - measured) over the current standard deviation.
[[nodiscard]] Eigen::VectorXd standardised(const RowSet& set, const Prediction& prediction);

/// d standardised / d parameter.
[[nodiscard]] Eigen::MatrixXd standardised_jacobian(const RowSet& set, const Prediction& prediction);

/// Half the sum of weight * rho.
[[nodiscard]] double cost(const LeastSquares& problem, const Evaluation& e);

/// d cost / d parameter.
[[nodiscard]] Eigen::VectorXd cost_gradient(const LeastSquares& problem, const Evaluation& e);

/// Residuals and their Jacobian with respect to z, rows times sqrt(weight rho'), stacked: the problem as Gauss and
/// Newton see it.
struct Stack {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};
[[nodiscard]] Stack gauss_newton_stack(const LeastSquares& problem, const Eigen::VectorXd& values, const Evaluation& e);

}  // namespace fpz::calibration::detail
