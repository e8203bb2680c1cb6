// What the residuals and their Jacobian at the minimum say about noise and certainty (docs/calibration-statistics.md).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver.hpp"

namespace fpz::calibration::detail {

/// Singular values below this fraction of the largest count as zero.
inline constexpr double negligible = 1e-9;

/// The problem linearised at the minimum. All matrices belong to relative changes of the free parameters: change of
/// parameter free[j] over size[j].
struct Linearised {
  std::vector<int> free;                  ///< parameters that are not at a bound
  Eigen::VectorXd size;                   ///< of all parameters, see Variable::size()
  std::vector<Eigen::VectorXd> residual;  ///< per row set, over the current deviations
  std::vector<Eigen::MatrixXd> jacobian;  ///< per row set: of the residuals, all parameters
  Eigen::VectorXd redundancy;             ///< per row set: expectation of the sum of squared residuals
};

[[nodiscard]] Linearised linearise(const LeastSquares& problem, const Minimum& m);

/// The factors that the residuals at the minimum suggest for the data sets with `estimated`. Sets with fewer than one
/// degree of freedom left lose `estimated` and get the factor 1.
void update_factors(LeastSquares& problem, const Minimum& m);

/// The parameters' covariance and all that belongs to it, from independent or correlated errors.
struct Certainty {
  Eigen::MatrixXd covariance;           ///< of relative changes of the free parameters
  Eigen::MatrixXd inverse;              ///< H^+, the covariance if the cost were a log-likelihood
  Eigen::MatrixXd information;          ///< of the parameters themselves, those at bounds included
  std::vector<Eigen::MatrixXd> spread;  ///< per row set: its part of the covariance
  Eigen::VectorXd noise_freedom;        ///< per row set: degrees of freedom of its noise, infinite when known
};

/// `inflation` multiplies the variance of each row set (empty: 1).
[[nodiscard]] Certainty certainty(const LeastSquares& problem, const Linearised& lin, const Eigen::VectorXd& inflation);

/// Degrees of freedom of the variance g' covariance g (Satterthwaite); infinite when all its noise is known.
[[nodiscard]] double freedom(const Certainty& c, const Eigen::VectorXd& g);
/// The same for the whole region of the parameters.
[[nodiscard]] double region_freedom(const Certainty& c);

/// Two-sided quantile of Student's t, of the normal distribution for infinite degrees of freedom.
[[nodiscard]] double t_quantile(double confidence, double degrees_of_freedom);
/// Quantile of the squared radius of the joint region of n parameters: n F, chi-squared for infinite degrees of
/// freedom.
[[nodiscard]] double region_quantile(double confidence, int n, double degrees_of_freedom);

/// Lag-1 correlation of residuals about zero, 0 below 8 points.
[[nodiscard]] double autocorrelation(const Eigen::VectorXd& residuals);
/// Number of independent points that tell the mean of n first-order autoregressive ones equally well; the bias of the
/// estimated correlation is corrected; between 1 and n.
[[nodiscard]] double effective_points(double autocorrelation, Eigen::Index n);

/// Fills values, errors, intervals, correlations, bands, residual statistics and their warnings.
void add_statistics(const LeastSquares& problem, const Minimum& m, double confidence, FitResult& result);

}  // namespace fpz::calibration::detail
