// The fit as a least-squares problem: data sets and priors as rows of one kind, with their noise and losses, and the
// scaled variables the solver works in.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fpz/calibration/fit.hpp"

namespace fpz::calibration::detail {

/// One unknown in the space of the solver. Positive parameters whose bounds span a factor of ten or more:
/// z = ln(value/reference) with the geometric mean of the bounds; all others: z = value/reference with the larger
/// bound. Values enter and leave here; all else of the fit that steps or compares does so in z.
class Variable {
 public:
  explicit Variable(const FitParameter& p);

  [[nodiscard]] double z(double value) const;
  [[nodiscard]] double value(double z) const;  ///< within the bounds, whatever rounding does
  [[nodiscard]] double slope(double z) const;  ///< d value / d z
  [[nodiscard]] double lower() const { return z(lower_); }
  [[nodiscard]] double upper() const { return z(upper_); }
  /// -1 or 1 at the lower or upper bound, else 0.
  [[nodiscard]] int side(double z) const;
  /// The size that relative changes of a value refer to: the value itself; with a linear variable at least a tenth and
  /// at most the whole of the range between the bounds.
  [[nodiscard]] double size(double value) const;

 private:
  bool logarithmic_ = false;
  double reference_ = 1.0;
  double lower_ = 0.0;  ///< bounds of the parameter itself
  double upper_ = 0.0;
};

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

/// The least-squares problem in its own space, made from the problem in parameter values.
struct LeastSquares {
  explicit LeastSquares(const FitProblem& problem);

  std::vector<FitParameter> parameters;
  std::vector<Variable> variables;
  std::vector<RowSet> sets;  ///< the data sets in the order of the problem, then the priors

  [[nodiscard]] int size() const { return static_cast<int>(parameters.size()); }
  [[nodiscard]] const Variable& variable(Eigen::Index k) const { return variables[static_cast<std::size_t>(k)]; }
  [[nodiscard]] Eigen::VectorXd values(const Eigen::VectorXd& z) const;
  [[nodiscard]] Eigen::VectorXd z(const Eigen::VectorXd& values) const;
  [[nodiscard]] Eigen::VectorXd slopes(const Eigen::VectorXd& z) const;  ///< d value / d z of each
};

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
