#include "least_squares.hpp"

#include <ceres/loss_function.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace fpz::calibration::detail {
namespace {

RowSet prior_rows(const FitParameter& p, int index, int count) {
  RowSet set;
  set.name = "prior of " + p.name;
  set.measured = Eigen::VectorXd::Constant(1, p.prior->mean);
  set.deviation = Eigen::VectorXd::Constant(1, p.prior->deviation);
  set.prior_of = index;
  set.forward = [index, count](const Eigen::VectorXd& values, bool derivatives) {
    Prediction out;
    out.values = Eigen::VectorXd::Constant(1, values[index]);
    if (derivatives) out.jacobian = Eigen::RowVectorXd::Unit(count, index);
    return out;
  };
  return set;
}

Rho from(const ceres::LossFunction& loss, double squared) {
  double out[3];
  loss.Evaluate(squared, out);
  return {out[0], out[1], out[2]};
}

}  // namespace

Variable::Variable(const FitParameter& p) : lower_(p.lower), upper_(p.upper) {
  logarithmic_ = p.lower > 0.0 && p.upper >= 10.0 * p.lower;
  reference_ = logarithmic_ ? std::sqrt(p.lower) * std::sqrt(p.upper) : std::max(-p.lower, p.upper);
  if (!logarithmic_ && p.upper <= 0.0) reference_ = -p.lower;
}

double Variable::value(double z) const {
  const double x = logarithmic_ ? reference_ * std::exp(z) : reference_ * z;
  return std::clamp(x, lower_, upper_);  // rounding must not carry a parameter over its bound
}

double Variable::z(double value) const { return logarithmic_ ? std::log(value / reference_) : value / reference_; }

double Variable::slope(double z) const { return logarithmic_ ? reference_ * std::exp(z) : reference_; }

int Variable::side(double z) const {
  const double close = 1e-10 * (upper() - lower());
  if (z <= lower() + close) return -1;
  return z >= upper() - close ? 1 : 0;
}

double Variable::size(double value) const {
  if (logarithmic_) return value;
  const double range = upper_ - lower_;
  return std::clamp(std::abs(value), 0.1 * range, range);
}

LeastSquares::LeastSquares(const FitProblem& problem) : parameters(problem.parameters) {
  for (const FitParameter& p : parameters) variables.emplace_back(p);
  for (const Observations& data : problem.data) {
    RowSet set;
    set.name = data.name;
    set.measured = data.measured;
    set.deviation = data.deviation;
    set.weight = data.weight;
    set.loss = data.loss;
    set.forward = data.forward;
    set.estimated = !data.deviation_known;
    sets.push_back(std::move(set));
  }
  for (int k = 0; k < size(); ++k) {
    const FitParameter& p = parameters[static_cast<std::size_t>(k)];
    if (p.prior) sets.push_back(prior_rows(p, k, size()));
  }
}

Eigen::VectorXd LeastSquares::values(const Eigen::VectorXd& z) const {
  Eigen::VectorXd out(z.size());
  for (Eigen::Index k = 0; k < z.size(); ++k) out[k] = variable(k).value(z[k]);
  return out;
}

Eigen::VectorXd LeastSquares::z(const Eigen::VectorXd& values) const {
  Eigen::VectorXd out(values.size());
  for (Eigen::Index k = 0; k < values.size(); ++k) out[k] = variable(k).z(values[k]);
  return out;
}

Eigen::VectorXd LeastSquares::slopes(const Eigen::VectorXd& z) const {
  Eigen::VectorXd out(z.size());
  for (Eigen::Index k = 0; k < z.size(); ++k) out[k] = variable(k).slope(z[k]);
  return out;
}

Rho rho(const Loss& loss, double squared) {
  switch (loss.kind) {
    case LossKind::huber:
      return from(ceres::HuberLoss(loss.scale), squared);
    case LossKind::soft_l1:
      return from(ceres::SoftLOneLoss(loss.scale), squared);
    case LossKind::cauchy:
      return from(ceres::CauchyLoss(loss.scale), squared);
    case LossKind::tukey:
      return from(ceres::TukeyLoss(loss.scale), squared);
    case LossKind::none:
      break;
  }
  return {squared, 1.0, 0.0};
}

Prediction predict(const RowSet& set, const Eigen::VectorXd& values, bool derivatives) {
  Prediction out;
  try {
    out = set.forward(values, derivatives);
  } catch (const std::exception& e) {
    return failed(e.what());
  }
  if (!out.ok()) return out;
  if (out.values.size() != set.size()) {
    return failed("the model returned " + std::to_string(out.values.size()) + " values for " +
                  std::to_string(set.size()) + " measured ones");
  }
  if (!out.values.allFinite()) return failed("the model returned a value that is not finite");
  if (!derivatives) return out;
  if (out.jacobian.rows() != set.size() || out.jacobian.cols() != values.size()) {
    return failed("the model returned a Jacobian of " + std::to_string(out.jacobian.rows()) + " x " +
                  std::to_string(out.jacobian.cols()) + ", not " + std::to_string(set.size()) + " x " +
                  std::to_string(values.size()));
  }
  if (!out.jacobian.allFinite()) return failed("the model returned a derivative that is not finite");
  return out;
}

Evaluation evaluate(const LeastSquares& problem, const Eigen::VectorXd& values, bool derivatives) {
  Evaluation out;
  for (const RowSet& set : problem.sets) {
    out.sets.push_back(predict(set, values, derivatives));
    if (out.sets.back().ok()) continue;
    out.failure = set.name + ": " + out.sets.back().failure;
    return out;
  }
  return out;
}

Eigen::VectorXd standardised(const RowSet& set, const Prediction& prediction) {
  return (prediction.values - set.measured).cwiseQuotient(set.deviation) / set.factor;
}

Eigen::MatrixXd standardised_jacobian(const RowSet& set, const Prediction& prediction) {
  return (set.deviation * set.factor).cwiseInverse().asDiagonal() * prediction.jacobian;
}

double cost(const LeastSquares& problem, const Evaluation& e) {
  double sum = 0.0;
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    const RowSet& set = problem.sets[k];
    const Eigen::VectorXd r = standardised(set, e.sets[k]);
    for (const double x : r) sum += set.weight * rho(set.loss, x * x).value;
  }
  return 0.5 * sum;
}

Eigen::VectorXd cost_gradient(const LeastSquares& problem, const Evaluation& e) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(problem.size());
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    const RowSet& set = problem.sets[k];
    Eigen::VectorXd r = standardised(set, e.sets[k]);
    for (double& x : r) x *= set.weight * rho(set.loss, x * x).first;
    out += standardised_jacobian(set, e.sets[k]).transpose() * r;
  }
  return out;
}

Stack gauss_newton_stack(const LeastSquares& problem, const Eigen::VectorXd& values, const Evaluation& e) {
  Eigen::Index rows = 0;
  for (const RowSet& set : problem.sets) rows += set.size();
  Stack out{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, problem.size())};
  const Eigen::VectorXd slopes = problem.slopes(problem.z(values));
  Eigen::Index first = 0;
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    const RowSet& set = problem.sets[k];
    const Eigen::VectorXd r = standardised(set, e.sets[k]);
    Eigen::VectorXd factor(r.size());
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      factor[i] = std::sqrt(set.weight * rho(set.loss, r[i] * r[i]).first);
    }
    out.residuals.segment(first, r.size()) = factor.cwiseProduct(r);
    out.jacobian.middleRows(first, r.size()) =
        factor.asDiagonal() * standardised_jacobian(set, e.sets[k]) * slopes.asDiagonal();
    first += r.size();
  }
  return out;
}

}  // namespace fpz::calibration::detail
