#include "solver.hpp"

#include <ceres/ceres.h>

#include <cmath>
#include <limits>
#include <memory>

#include "settle.hpp"

namespace fpz::calibration::detail {
namespace {

/// The last prediction of one data set, so that its forward model runs once per parameter vector, for all blocks. It is
/// always asked for derivatives: most trial points become the next iterate, and a model that has values but no
/// derivatives somewhere then only costs a step.
class CachedPrediction {
 public:
  CachedPrediction(const LeastSquares& problem, const RowSet& set) : problem_(problem), set_(set) {}

  /// Residuals over deviations and their Jacobian with respect to z; false when the model has none.
  bool at(const Eigen::VectorXd& z) {
    if (z.size() == z_.size() && z == z_) return prediction.ok();
    z_ = z;
    prediction = predict(set_, problem_.values(z), true);
    if (!prediction.ok()) {
      failure = set_.name + ": " + prediction.failure;
      return false;
    }
    residuals = standardised(set_, prediction);
    jacobian = standardised_jacobian(set_, prediction);
    for (Eigen::Index k = 0; k < z.size(); ++k) jacobian.col(k) *= problem_.variable(k).slope(z[k]);
    return true;
  }

  Prediction prediction;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  std::string failure;  ///< the last one

 private:
  const LeastSquares& problem_;
  const RowSet& set_;
  Eigen::VectorXd z_;
};

using Caches = std::vector<std::unique_ptr<CachedPrediction>>;

/// Rows first ... first + count - 1 of one data set. Ceres applies a loss to the squared norm of a block, so a set with
/// a loss is cut into blocks of one row.
class RowsCost final : public ceres::CostFunction {
 public:
  RowsCost(CachedPrediction& cache, Eigen::Index first, Eigen::Index count, int parameters)
      : cache_(cache), first_(first), count_(count) {
    set_num_residuals(static_cast<int>(count));
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(parameters), 1);
  }

  bool Evaluate(double const* const* z, double* residuals, double** jacobians) const override {
    Eigen::VectorXd point(static_cast<Eigen::Index>(parameter_block_sizes().size()));
    for (Eigen::Index k = 0; k < point.size(); ++k) point[k] = *z[k];
    if (!cache_.at(point)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, count_) = cache_.residuals.segment(first_, count_);
    if (jacobians == nullptr) return true;
    for (std::size_t k = 0; k < parameter_block_sizes().size(); ++k) {
      if (jacobians[k] == nullptr) continue;
      Eigen::Map<Eigen::VectorXd>(jacobians[k], count_) =
          cache_.jacobian.col(static_cast<Eigen::Index>(k)).segment(first_, count_);
    }
    return true;
  }

 private:
  CachedPrediction& cache_;
  Eigen::Index first_;
  Eigen::Index count_;
};

/// Robust loss times weight; Ceres owns it.
ceres::LossFunction* make_loss(const RowSet& set) {
  ceres::LossFunction* loss = nullptr;
  switch (set.loss.kind) {
    case LossKind::none:
      break;
    case LossKind::huber:
      loss = new ceres::HuberLoss(set.loss.scale);
      break;
    case LossKind::soft_l1:
      loss = new ceres::SoftLOneLoss(set.loss.scale);
      break;
    case LossKind::cauchy:
      loss = new ceres::CauchyLoss(set.loss.scale);
      break;
    case LossKind::tukey:
      loss = new ceres::TukeyLoss(set.loss.scale);
      break;
  }
  return new ceres::ScaledLoss(loss, set.weight, ceres::TAKE_OWNERSHIP);
}

class StopCallback final : public ceres::IterationCallback {
 public:
  StopCallback(const SolverRun& run, const Eigen::VectorXd& z) : run_(run), z_(z) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return run_.stop(z_, summary.cost) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const SolverRun& run_;
  const Eigen::VectorXd& z_;
};

/// One Ceres solve; parameters with `held` stay where they are. z is start and result.
ceres::Solver::Summary solve(const LeastSquares& problem, const SolverRun& run, const std::vector<bool>& held,
                             int iterations, const Caches& caches, Eigen::VectorXd& z) {
  ceres::Problem ceres_problem;
  std::vector<double*> blocks;
  for (double& x : z) blocks.push_back(&x);
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    const RowSet& set = problem.sets[k];
    const Eigen::Index rows = set.loss.kind == LossKind::none ? set.size() : 1;
    for (Eigen::Index i = 0; i < set.size(); i += rows) {
      ceres_problem.AddResidualBlock(new RowsCost(*caches[k], i, rows, problem.size()), make_loss(set), blocks);
    }
  }
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Variable& v = problem.variables[k];
    ceres_problem.SetParameterLowerBound(blocks[k], 0, v.lower());
    ceres_problem.SetParameterUpperBound(blocks[k], 0, v.upper());
    if (held[k]) ceres_problem.SetParameterBlockConstant(blocks[k]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  options.max_num_iterations = iterations;
  options.max_num_consecutive_invalid_steps = 20;
  // In units of the noise: a cost known to 1e-14 of itself leaves the parameters within 1e-6 of a standard error.
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-12;
  options.min_trust_region_radius = 1e-12;
  StopCallback callback(run, z);
  if (run.stop) {
    options.callbacks.push_back(&callback);
    options.update_state_every_iteration = true;
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  return summary;
}

/// Prediction, cost and gradient at m.z; false when there is no prediction.
bool look(const LeastSquares& problem, const Caches& caches, Minimum& m) {
  m.values = problem.values(m.z);
  m.evaluation = {};
  for (const auto& cache : caches) {
    if (!cache->at(m.z)) {
      m.evaluation.failure = m.message = cache->failure;
      m.cost = std::numeric_limits<double>::infinity();
      return false;
    }
    m.evaluation.sets.push_back(cache->prediction);
  }
  m.cost = cost(problem, m.evaluation);
  m.gradient = cost_gradient(problem, m.evaluation);
  return true;
}

/// Why a run that Ceres calls finished is none, in words.
std::string early_end(const Caches& caches, const ceres::Solver::Summary& summary) {
  for (const auto& cache : caches) {
    if (!cache->failure.empty()) return "stopped at the edge of the range of the model (" + cache->failure + ")";
  }
  return "stopped before the minimum: " + summary.message;
}

}  // namespace

Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start, const SolverRun& run) {
  const std::size_t n = static_cast<std::size_t>(problem.size());
  std::vector<bool> fixed = run.fixed;
  fixed.resize(n, false);
  std::vector<bool> held = fixed;
  Minimum m;
  m.z = problem.z(start);
  m.bound.assign(n, 0);
  Caches caches;
  for (const RowSet& set : problem.sets) caches.push_back(std::make_unique<CachedPrediction>(problem, set));
  if (!look(problem, caches, m)) return m;
  ceres::Solver::Summary last;
  // Ceres projects its step onto the bounds, which converges slowly along them. So parameters that ended at a bound
  // with the cost falling beyond it are held there and the others solved for again, until nothing changes.
  for (std::size_t round = 0; round < 2 * n + 2; ++round) {
    last = solve(problem, run, held, std::max(0, run.max_iterations - m.iterations), caches, m.z);
    m.iterations += last.num_successful_steps + last.num_unsuccessful_steps;
    if (!look(problem, caches, m)) return m;
    m.stopped = last.termination_type == ceres::USER_SUCCESS;
    if (m.stopped || last.termination_type == ceres::NO_CONVERGENCE) break;
    bool changed = false;
    for (std::size_t k = 0; k < n; ++k) {
      if (fixed[k]) continue;
      const int at = problem.variables[k].side(m.z[static_cast<Eigen::Index>(k)]);
      const bool hold = at != 0 && m.gradient[static_cast<Eigen::Index>(k)] * at < 0.0;
      changed = changed || hold != held[k];
      held[k] = hold;
    }
    if (!changed) break;
  }
  const bool finished = !m.stopped && last.termination_type != ceres::NO_CONVERGENCE;
  double remaining = finished ? promised_step(problem, m, held) : 0.0;
  const bool smooth = remaining <= smooth_tolerance;
  if (!smooth) remaining = settle(problem, held, m);
  for (std::size_t k = 0; k < n; ++k) {
    m.bound[k] = fixed[k] ? 2 : problem.variables[k].side(m.z[static_cast<Eigen::Index>(k)]);
  }
  if (last.termination_type == ceres::NO_CONVERGENCE) {
    m.message = "the limit of " + std::to_string(run.max_iterations) + " iterations was reached";
  } else if (remaining > kink_tolerance) {
    m.message = early_end(caches, last);
  } else {
    m.converged = true;
    m.message = smooth ? "converged" : "converged to a kink of the predictions";
  }
  return m;
}

}  // namespace fpz::calibration::detail
