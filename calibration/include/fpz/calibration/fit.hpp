// Weighted least squares with bounds, priors and robust losses, and what it says about the certainty of its result.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fpz/calibration/prediction.hpp"
#include "fpz/words.hpp"

namespace fpz::calibration {

/// Knowledge from elsewhere: a normal distribution, which counts as one more measured value.
struct Prior {
  double mean = 0.0;
  double deviation = 0.0;
};

/// One unknown of the fit. lower <= start <= upper, lower < upper, all finite.
struct FitParameter {
  std::string name;    ///< as in parameter_info, or "<data set>.<nuisance>"
  std::string symbol;  ///< for pictures and tables
  std::string unit;
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  std::optional<Prior> prior;
};

enum class LossKind { none, huber, soft_l1, cauchy, tukey };

}  // namespace fpz::calibration

template <>
struct fpz::Words<fpz::calibration::LossKind> {
  using K = calibration::LossKind;
  static constexpr Word<K> list[] = {
      {K::none, "none"}, {K::huber, "huber"}, {K::soft_l1, "soft_l1"}, {K::cauchy, "cauchy"}, {K::tukey, "tukey"}};
};

namespace fpz::calibration {

/// Robust loss (Ceres' rho) on residuals in units of their standard deviation.
struct Loss {
  LossKind kind = LossKind::none;
  double scale = 1.0;  ///< in standard deviations
};

/// Predictions for the values of all fit parameters. Columns of the Jacobian in the order of FitProblem::parameters.
/// A failure (parameters outside the model's constraints, no equilibrium) makes the solver shorten its step.
using Forward = std::function<Prediction(const Eigen::VectorXd& parameters, bool derivatives)>;

/// One data set.
struct Observations {
  std::string name;
  Eigen::VectorXd measured;
  Eigen::VectorXd deviation;  ///< standard deviation of each value, > 0
  /// False: only the ratios of the deviations are known, their common factor is estimated from the residuals.
  bool deviation_known = false;
  /// > 0; multiplies the squared residuals of the whole set. It says how much the set counts in the estimate and
  /// nothing about its noise: standard errors and intervals are those of the weighted estimate under the stated noise.
  double weight = 1.0;
  Loss loss;
  Forward forward;
};

struct FitProblem {
  std::vector<FitParameter> parameters;
  std::vector<Observations> data;
};

/// What is going on, for a progress line.
struct FitProgress {
  std::string stage;      ///< "start 2 of 8", "profile of delta0", ...
  double fraction = 0.0;  ///< of this stage
  double cost = 0.0;
  std::string detail = {};  ///< of stages that are more than numbers; shown in place of fraction and cost
};

struct FitOptions {
  int starts = 8;             ///< the given start and starts - 1 others, spread over the bounds
  std::uint64_t seed = 1;     ///< of the spread
  int max_iterations = 200;   ///< per start
  double confidence = 0.95;   ///< level of every interval, band and region
  int profile_points = 21;    ///< of each profile
  std::vector<int> profiles;  ///< indices of the parameters whose profile likelihood is wanted
  std::function<void(const FitProgress&)> progress;
};

/// Where one start ended.
struct StartResult {
  Eigen::VectorXd start;
  Eigen::VectorXd end;
  double cost = 0.0;  ///< half the sum of (robustified) squared residuals; infinite when the start failed
  bool converged = false;
  int iterations = 0;
  std::string message;
};

/// A direction in parameter space, in relative changes, along which the predictions do not change noticeably.
struct UndeterminedDirection {
  double singular_value = 0.0;  ///< of the Jacobian of residuals over deviations with respect to relative changes
  Eigen::VectorXd direction;    ///< unit length; entry k: relative change of parameter k
  std::string words;
};

/// Residuals of one data set at the best values.
struct DataSetResult {
  std::string name;
  Eigen::VectorXd predicted;
  Eigen::VectorXd residuals;         ///< predicted - measured
  Eigen::VectorXd standardised;      ///< residuals over the (estimated) deviation
  Eigen::VectorXd deviation;         ///< of the single values; estimated where it was not known
  Eigen::VectorXd band;              ///< half width of the confidence band of the prediction, same unit as the data
  double noise_factor = 1.0;         ///< estimated over given deviations; 1 where they are known
  double root_mean_square = 0.0;     ///< of the residuals
  double reduced_chi_squared = 0.0;  ///< with the given deviations, over the degrees of freedom of this set
  double autocorrelation = 0.0;   ///< lag 1, of the standardised residuals in the order of the points; 0 below 8 points
  double effective_points = 0.0;  ///< number of independent points that carry the same information
};

/// The profile likelihood of one parameter: the others are fitted anew at every value.
struct Profile {
  int parameter = 0;
  Eigen::VectorXd values;
  Eigen::VectorXd excess;       ///< 2 (cost - least cost), in units of the noise variance
  double threshold = 0.0;       ///< excess at the ends of the confidence interval
  std::optional<double> lower;  ///< ends of the interval; nothing where it is open within the bounds
  std::optional<double> upper;
};

enum class FitStatus {
  ok,
  not_converged,  ///< the iteration limit was reached, or no start found an admissible point
  undetermined,   ///< converged, but the data leave some direction of the parameters open
  failed          ///< the forward models gave no prediction at the start
};

}  // namespace fpz::calibration

template <>
struct fpz::Words<fpz::calibration::FitStatus> {
  using K = calibration::FitStatus;
  static constexpr Word<K> list[] = {
      {K::ok, "ok"}, {K::not_converged, "not_converged"}, {K::undetermined, "undetermined"}, {K::failed, "failed"}};
};

namespace fpz::calibration {

/// With FitStatus::failed only message, values (the start) and starts are filled.
struct FitResult {
  FitStatus status = FitStatus::failed;
  std::string message;  ///< status in words, with the way out where there is one
  Eigen::VectorXd values;
  Eigen::VectorXd standard_error;    ///< from the Jacobian; parameters at a bound have 0 and are listed below
  Eigen::VectorXd correlated_error;  ///< the same, widened for the autocorrelation of the residuals
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd correlation;
  Eigen::VectorXd lower_limit;  ///< confidence interval, by Student's t or the normal distribution
  Eigen::VectorXd upper_limit;
  std::vector<int> at_lower_bound;
  std::vector<int> at_upper_bound;
  Eigen::VectorXd gradient;         ///< d cost / d parameter; not zero only at bounds
  Eigen::MatrixXd information;      ///< inverse covariance, with the parameters at bounds as if they were free
  Eigen::VectorXd singular_values;  ///< of the parameters that are not at bounds, largest first
  std::vector<UndeterminedDirection> undetermined;
  double cost = 0.0;
  double degrees_of_freedom = 0.0;        ///< values and priors less fitted parameters (with weights: expected chi^2)
  double noise_degrees_of_freedom = 0.0;  ///< behind the estimated noise; infinite when all deviations are known
  std::vector<DataSetResult> data;
  std::vector<StartResult> starts;
  int distinct_minima = 1;
  std::vector<Profile> profiles;
  std::vector<std::string> warnings;

  [[nodiscard]] bool usable() const { return status == FitStatus::ok; }
};

/// Checks the problem; throws std::invalid_argument naming the data set or parameter and the broken constraint.
void require_valid(const FitProblem& problem);

/// Fits all data together with Ceres (trust region, bounds) from several starts; docs/calibration-statistics.md says
/// what is computed. Deterministic. Throws what require_valid throws; everything else is said in status and message.
[[nodiscard]] FitResult fit(const FitProblem& problem, const FitOptions& options = {});

/// Is `truth` inside the joint confidence region of the fitted parameters (ellipsoid from the Jacobian, F or
/// chi-squared quantile)? With active bounds the region is that of the cost, gradient included, and ends at the
/// bounds. Directions that the data leave open do not count. Throws std::invalid_argument when the sizes differ.
[[nodiscard]] bool inside_confidence_region(const FitResult& result, const Eigen::VectorXd& truth, double confidence);

}  // namespace fpz::calibration
