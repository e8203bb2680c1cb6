#include "statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "decompositions.hpp"
#include "words.hpp"

namespace fpz::calibration::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// (A' A)^+ of a tall matrix, without forming A' A.
Eigen::MatrixXd inverse_gram(const Eigen::MatrixXd& a) {
  if (a.cols() == 0) return {};  // all parameters at bounds
  const SingularValues svd = singular_values(a);
  const Eigen::VectorXd& s = svd.values;
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(s.size());
  for (Eigen::Index k = 0; k < s.size(); ++k) {
    if (s[k] > negligible * s[0]) inverse[k] = 1.0 / (s[k] * s[k]);
  }
  return svd.right * inverse.asDiagonal() * svd.right.transpose();
}

/// The sets' Jacobians times their factors, on top of each other.
Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& jacobian, const Eigen::VectorXd& factor) {
  Eigen::Index rows = 0;
  for (const Eigen::MatrixXd& j : jacobian) rows += j.rows();
  Eigen::MatrixXd out(rows, jacobian.empty() ? 0 : jacobian.front().cols());
  Eigen::Index first = 0;
  for (std::size_t k = 0; k < jacobian.size(); ++k) {
    out.middleRows(first, jacobian[k].rows()) = factor[static_cast<Eigen::Index>(k)] * jacobian[k];
    first += jacobian[k].rows();
  }
  return out;
}

std::vector<Eigen::MatrixXd> columns(const std::vector<Eigen::MatrixXd>& jacobian, const std::vector<int>& which) {
  std::vector<Eigen::MatrixXd> out;
  for (const Eigen::MatrixXd& j : jacobian) out.emplace_back(j(Eigen::all, which));
  return out;
}

/// What a robust loss does to the Gauss-Newton matrix and to the variance of its right side (Huber 1981, section 7.6);
/// both 1 without a loss.
struct Robustness {
  double curvature = 1.0;  ///< mean of psi'
  double variance = 1.0;   ///< sum of psi^2 over the redundancy
};

Robustness robustness(const RowSet& set, const Eigen::VectorXd& residual, double redundancy) {
  if (set.loss.kind == LossKind::none) return {};
  Robustness out{0.0, 0.0};
  for (const double r : residual) {
    const Rho x = rho(set.loss, r * r);
    out.curvature += x.first + 2.0 * r * r * x.second;
    out.variance += x.first * x.first * r * r;
  }
  // A loss so tight that most points lie outside it leaves next to no curvature, which must not become infinite or
  // negative certainty.
  out.curvature = std::max(0.1, out.curvature / static_cast<double>(residual.size()));
  out.variance /= std::max(1.0, redundancy);
  return out;
}

Eigen::VectorXd weights(const LeastSquares& problem) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(problem.sets.size()));
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = problem.sets[static_cast<std::size_t>(k)].weight;
  return out;
}

/// Expectation of each set's sum of squared residuals over its noise variance, for the weighted linear fit.
Eigen::VectorXd redundancies(const LeastSquares& problem, const std::vector<Eigen::MatrixXd>& free_jacobian) {
  const Eigen::VectorXd w = weights(problem);
  Eigen::VectorXd out(w.size());
  const Eigen::MatrixXd inverse = inverse_gram(stacked(free_jacobian, w.cwiseSqrt()));
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(inverse.rows(), inverse.cols());
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    const Eigen::MatrixXd part = w[k] * free_jacobian[static_cast<std::size_t>(k)] * inverse;
    variance += part.transpose() * part;
  }
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    const Eigen::MatrixXd& j = free_jacobian[static_cast<std::size_t>(k)];
    const double n = static_cast<double>(j.rows());
    const double expected = n - 2.0 * w[k] * (j * inverse).cwiseProduct(j).sum() + (j * variance).cwiseProduct(j).sum();
    out[k] = std::max(0.0, expected);
  }
  return out;
}

/// 1.4826 times the median of the absolute values: the standard deviation, whatever a few outliers do.
double median_deviation(Eigen::VectorXd r) {
  r = r.cwiseAbs().eval();
  double* const middle = r.data() + r.size() / 2;
  std::nth_element(r.data(), middle, r.data() + r.size());
  double median = *middle;
  if (r.size() % 2 == 0) median = 0.5 * (median + *std::max_element(r.data(), middle));
  return 1.482602218505602 * median;
}

/// Noise-free data must not divide by zero: no noise is smaller than 1e-9 of the measured values.
double least_factor(const RowSet& set) {
  const double level = set.measured.cwiseQuotient(set.deviation).norm() / std::sqrt(static_cast<double>(set.size()));
  return level > 0.0 ? 1e-9 * level : 1e-9;
}

Eigen::VectorXd over_sizes(const std::vector<int>& which, const Eigen::VectorXd& all) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(which.size()));
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = all[which[static_cast<std::size_t>(k)]];
  return out;
}

/// Warns when residuals whose noise is known are much larger or smaller than that noise.
void judge_scatter(const RowSet& set, double sum_of_squares, double redundancy, FitResult& result) {
  if (redundancy < 0.5) return;  // nothing is left to judge by
  const boost::math::chi_squared distribution(redundancy);
  const std::string ratio = number(std::sqrt(sum_of_squares / redundancy));
  if (sum_of_squares > quantile(complement(distribution, 1e-4))) {
    result.warnings.push_back(
        "data set " + set.name + ": the residuals are " + ratio +
        " times as large as its standard deviations allow: the model does not describe these data, "
        "or the deviations are too small; the standard errors are too small by about that factor");
  } else if (sum_of_squares < quantile(distribution, 1e-4)) {
    result.warnings.push_back("data set " + set.name + ": the residuals are only " + ratio +
                              " of its standard deviations: the stated deviations are probably too large");
  }
}

/// Warns of systematic residuals, but not of the rounding that remains of noise-free data.
void judge_order(const RowSet& set, const DataSetResult& r, FitResult& result) {
  const double n = static_cast<double>(set.size());
  if (r.residuals.norm() < 1e-8 * set.measured.norm()) return;
  if (r.autocorrelation < std::max(0.3, 3.0 / std::sqrt(n))) return;
  result.warnings.push_back(
      "data set " + r.name + ": its residuals are systematic (neighbouring points are correlated by " +
      number(r.autocorrelation) + "): the model departs from the data by more than noise, and its " +
      std::to_string(set.size()) + " points tell no more than about " + number(r.effective_points) +
      " independent ones; use the correlated errors, not the standard errors");
}

}  // namespace

Linearised linearise(const LeastSquares& problem, const Minimum& m) {
  Linearised out;
  out.size.resize(problem.size());
  for (int k = 0; k < problem.size(); ++k) {
    out.size[k] = problem.variable(k).size(m.values[k]);
    if (m.bound[static_cast<std::size_t>(k)] == 0) out.free.push_back(k);
  }
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    out.residual.push_back(standardised(problem.sets[k], m.evaluation.sets[k]));
    out.jacobian.emplace_back(standardised_jacobian(problem.sets[k], m.evaluation.sets[k]) * out.size.asDiagonal());
  }
  out.redundancy = redundancies(problem, columns(out.jacobian, out.free));
  return out;
}

void update_factors(LeastSquares& problem, const Minimum& m) {
  const Linearised lin = linearise(problem, m);
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    RowSet& set = problem.sets[k];
    if (!set.estimated) continue;
    const double redundancy = lin.redundancy[static_cast<Eigen::Index>(k)];
    if (redundancy < 1.0) {
      set.estimated = false;
      set.factor = 1.0;
      continue;
    }
    const double n = static_cast<double>(set.size());
    const double scale = set.loss.kind == LossKind::none
                             ? lin.residual[k].norm() / std::sqrt(redundancy)
                             : median_deviation(lin.residual[k]) * std::sqrt(n / redundancy);
    set.factor = std::max(set.factor * scale, least_factor(set));
  }
}

Certainty certainty(const LeastSquares& problem, const Linearised& lin, const Eigen::VectorXd& inflation) {
  const Eigen::VectorXd w = weights(problem);
  Eigen::VectorXd curvature(w.size());  // of the sets in H and in the variance of the gradient
  Eigen::VectorXd variance(w.size());
  Certainty out;
  out.noise_freedom = Eigen::VectorXd::Constant(w.size(), infinity);
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    const RowSet& set = problem.sets[static_cast<std::size_t>(k)];
    const Robustness r = robustness(set, lin.residual[static_cast<std::size_t>(k)], lin.redundancy[k]);
    curvature[k] = w[k] * r.curvature;
    variance[k] = w[k] * w[k] * r.variance * (inflation.size() > 0 ? inflation[k] : 1.0);
    if (set.estimated || set.loss.kind != LossKind::none) out.noise_freedom[k] = std::max(1.0, lin.redundancy[k]);
  }
  const std::vector<Eigen::MatrixXd> jacobian = columns(lin.jacobian, lin.free);
  out.inverse = inverse_gram(stacked(jacobian, curvature.cwiseSqrt()));
  const Eigen::Index n = out.inverse.rows();
  out.covariance = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    const Eigen::MatrixXd part = std::sqrt(variance[k]) * jacobian[static_cast<std::size_t>(k)] * out.inverse;
    out.spread.emplace_back(part.transpose() * part);
    out.covariance += out.spread.back();
  }
  // C^+ = H V^+ H with V the variance of the gradient; equal to H when weights are 1 and there is no loss.
  const Eigen::MatrixXd a = stacked(lin.jacobian, curvature.cwiseSqrt());
  const Eigen::MatrixXd h = a.transpose() * a;
  const Eigen::VectorXd per_size = lin.size.cwiseInverse();
  const Eigen::MatrixXd relative = h * inverse_gram(stacked(lin.jacobian, variance.cwiseSqrt())) * h;
  out.information = per_size.asDiagonal() * relative * per_size.asDiagonal();
  return out;
}

double freedom(const Certainty& c, const Eigen::VectorXd& g) {
  const double total = g.dot(c.covariance * g);
  double sum = 0.0;
  for (std::size_t k = 0; k < c.spread.size(); ++k) {
    const double part = g.dot(c.spread[k] * g);
    sum += part * part / c.noise_freedom[static_cast<Eigen::Index>(k)];
  }
  return sum > 0.0 ? total * total / sum : infinity;
}

double region_freedom(const Certainty& c) {
  if (c.covariance.size() == 0) return infinity;
  // Directions x = C^(1/2) v in which the sets with few degrees of freedom count most and least.
  const Eigen::VectorXd scale = c.covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd safe = (scale.array() > 0.0).select(scale.cwiseInverse(), 0.0);
  const Eigenpairs equilibrated = eigenpairs(safe.asDiagonal() * c.covariance * safe.asDiagonal());
  const double largest = equilibrated.values.maxCoeff();
  Eigen::VectorXd root = Eigen::VectorXd::Zero(scale.size());
  for (Eigen::Index i = 0; i < root.size(); ++i) {
    const double e = equilibrated.values[i];
    if (e > negligible * negligible * largest) root[i] = 1.0 / std::sqrt(e);
  }
  const Eigen::MatrixXd whitening = safe.asDiagonal() * equilibrated.vectors * root.asDiagonal();
  Eigen::MatrixXd uncertain = Eigen::MatrixXd::Zero(root.size(), root.size());
  for (std::size_t k = 0; k < c.spread.size(); ++k) {
    uncertain += whitening.transpose() * c.spread[k] * whitening / c.noise_freedom[static_cast<Eigen::Index>(k)];
  }
  const Eigenpairs directions = eigenpairs(uncertain);
  // Along each the squared deviation is F(1, nu); an F with the mean of their sum stands for it (Fai and Cornelius
  // 1996).
  double mean = 0.0;
  double least = infinity;
  for (Eigen::Index i = 0; i < root.size(); ++i) {
    const double nu = freedom(c, whitening * directions.vectors.col(i));
    least = std::min(least, nu);
    mean += std::isfinite(nu) ? nu / (nu - 2.0) : 1.0;
  }
  if (least <= 2.0) return std::max(1.0, least);
  const double count = static_cast<double>(root.size());
  return mean > count ? 2.0 * mean / (mean - count) : infinity;
}

double t_quantile(double confidence, double degrees_of_freedom) {
  const double tail = 0.5 * (1.0 - confidence);
  if (!std::isfinite(degrees_of_freedom)) return quantile(complement(boost::math::normal(), tail));
  return quantile(complement(boost::math::students_t(degrees_of_freedom), tail));
}

double region_quantile(double confidence, int n, double degrees_of_freedom) {
  const double count = static_cast<double>(n);
  if (!std::isfinite(degrees_of_freedom)) return quantile(boost::math::chi_squared(count), confidence);
  return count * quantile(boost::math::fisher_f(count, degrees_of_freedom), confidence);
}

double autocorrelation(const Eigen::VectorXd& residuals) {
  const Eigen::Index n = residuals.size();
  const double square = residuals.squaredNorm();
  if (n < 8 || square == 0.0) return 0.0;
  return residuals.head(n - 1).dot(residuals.tail(n - 1)) / square;
}

double effective_points(double autocorrelation, Eigen::Index n) {
  if (n < 8) return static_cast<double>(n);
  const double count = static_cast<double>(n);
  const double r = std::min(0.999, autocorrelation + (1.0 + 3.0 * autocorrelation) / count);
  if (r <= 0.0) return count;
  double sum = count;  // of the correlation matrix r^|i-j|
  double power = 1.0;
  for (Eigen::Index lag = 1; lag < n; ++lag) {
    power *= r;
    sum += 2.0 * static_cast<double>(n - lag) * power;
  }
  return std::clamp(count * count / sum, 1.0, count);
}

namespace {

DataSetResult data_set_result(const RowSet& set, const Prediction& prediction, const Eigen::VectorXd& standard,
                              double redundancy) {
  DataSetResult r;
  r.name = set.name;
  r.predicted = prediction.values;
  r.residuals = prediction.values - set.measured;
  r.standardised = standard;
  r.deviation = set.deviation * set.factor;
  r.noise_factor = set.factor;
  const double n = static_cast<double>(set.size());
  r.root_mean_square = r.residuals.norm() / std::sqrt(n);
  const double sum = r.residuals.cwiseQuotient(set.deviation).squaredNorm();
  r.reduced_chi_squared = redundancy > 1e-6 ? sum / redundancy : std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd limited = standard;
  for (double& x : limited) x *= rho(set.loss, x * x).first;
  r.autocorrelation = autocorrelation(limited);
  r.effective_points = effective_points(r.autocorrelation, set.size());
  return r;
}

/// What correlated errors multiply the variance of one set by. With estimated noise, the degrees of freedom shrink with
/// the number of points.
double inflation(const RowSet& set, double redundancy, double effective) {
  const double n = static_cast<double>(set.size());
  if (!set.estimated) return n / effective;
  const double taken = n - redundancy;
  return redundancy / std::max(1.0, effective - taken);
}

Eigen::VectorXd band(const LeastSquares& problem, const Linearised& lin, const Certainty& c, std::size_t k,
                     double confidence) {
  const Eigen::MatrixXd j = lin.jacobian[k](Eigen::all, lin.free);
  const RowSet& set = problem.sets[k];
  Eigen::VectorXd out(j.rows());
  for (Eigen::Index i = 0; i < j.rows(); ++i) {
    const Eigen::VectorXd g = j.row(i).transpose();
    out[i] = t_quantile(confidence, freedom(c, g)) * std::sqrt(std::max(0.0, g.dot(c.covariance * g)));
  }
  return out.cwiseProduct(set.deviation) * set.factor;
}

/// Covariance of all parameters from that of relative changes of the free ones.
Eigen::MatrixXd expanded(const Linearised& lin, const Eigen::MatrixXd& relative) {
  const Eigen::Index n = lin.size.size();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  const Eigen::VectorXd size = over_sizes(lin.free, lin.size);
  out(lin.free, lin.free) = size.asDiagonal() * relative * size.asDiagonal();
  return out;
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd error = covariance.diagonal().cwiseSqrt();
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(error.size(), error.size());
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    for (Eigen::Index j = 0; j < error.size(); ++j) {
      if (i != j && error[i] > 0.0 && error[j] > 0.0) out(i, j) = covariance(i, j) / (error[i] * error[j]);
    }
  }
  return out;
}

}  // namespace

void add_statistics(const LeastSquares& problem, const Minimum& m, double confidence, FitResult& result) {
  const Linearised lin = linearise(problem, m);
  const Certainty independent = certainty(problem, lin, {});
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(lin.redundancy.size());
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    const RowSet& set = problem.sets[k];
    if (set.prior_of >= 0) continue;
    const double redundancy = lin.redundancy[static_cast<Eigen::Index>(k)];
    DataSetResult r = data_set_result(set, m.evaluation.sets[k], lin.residual[k], redundancy);
    r.band = band(problem, lin, independent, k, confidence);
    factor[static_cast<Eigen::Index>(k)] = inflation(set, redundancy, r.effective_points);
    judge_order(set, r, result);
    if (!set.estimated && set.loss.kind == LossKind::none) {
      judge_scatter(set, lin.residual[k].squaredNorm(), redundancy, result);
    }
    result.data.push_back(std::move(r));
  }
  result.values = m.values;
  result.cost = m.cost;
  result.gradient = m.gradient;
  result.degrees_of_freedom = lin.redundancy.sum();
  result.noise_degrees_of_freedom = region_freedom(independent);
  result.information = independent.information;
  result.covariance = expanded(lin, independent.covariance);
  result.correlation = correlation_of(result.covariance);
  result.standard_error = result.covariance.diagonal().cwiseSqrt();
  result.correlated_error = expanded(lin, certainty(problem, lin, factor).covariance).diagonal().cwiseSqrt();
  result.lower_limit = m.values;
  result.upper_limit = m.values;
  for (std::size_t j = 0; j < lin.free.size(); ++j) {
    const Eigen::Index p = lin.free[j];
    const Eigen::VectorXd g =
        Eigen::VectorXd::Unit(static_cast<Eigen::Index>(lin.free.size()), static_cast<Eigen::Index>(j));
    const double half = t_quantile(confidence, freedom(independent, g)) * result.standard_error[p];
    result.lower_limit[p] -= half;
    result.upper_limit[p] += half;
  }
}

}  // namespace fpz::calibration::detail
