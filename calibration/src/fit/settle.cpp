#include "settle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "decompositions.hpp"

namespace fpz::calibration::detail {
namespace {

std::vector<Eigen::Index> free_columns(const std::vector<bool>& held) {
  std::vector<Eigen::Index> out;
  for (std::size_t k = 0; k < held.size(); ++k) {
    if (!held[k]) out.push_back(static_cast<Eigen::Index>(k));
  }
  return out;
}

/// Steps of one standard error in z, one column for each direction that the data determine.
Eigen::MatrixXd unit_steps(const Stack& stack, const std::vector<Eigen::Index>& columns) {
  constexpr double longest = 0.5;  // in z; directions that are left open must not carry the point away
  const Eigen::Index n = stack.jacobian.cols();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(std::max(stack.jacobian.rows(), n), n);
  a.topRows(stack.jacobian.rows())(Eigen::all, columns) = stack.jacobian(Eigen::all, columns);
  const SingularValues svd = singular_values(a);
  Eigen::MatrixXd out(n, 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (svd.values[k] < 1e-9 * svd.values[0] || svd.values[k] == 0.0) break;
    out.conservativeResize(n, k + 1);
    out.col(k) = svd.right.col(k) * std::min(longest, 1.0 / svd.values[k]);
  }
  return out;
}

Eigen::VectorXd within_bounds(const LeastSquares& problem, Eigen::VectorXd z) {
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const Variable& v = problem.variable(k);
    z[k] = std::clamp(z[k], v.lower(), v.upper());
  }
  return z;
}

/// The shortest vector in the convex hull of the columns of g (pairwise Frank-Wolfe steps).
Eigen::VectorXd shortest_in_hull(const Eigen::MatrixXd& g) {
  constexpr int most = 5000;
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(g.cols(), 1.0 / static_cast<double>(g.cols()));
  Eigen::VectorXd x = g * weight;
  for (int k = 0; k < most; ++k) {
    const Eigen::VectorXd along = g.transpose() * x;
    Eigen::Index to = 0;
    along.minCoeff(&to);
    Eigen::Index from = to;
    for (Eigen::Index j = 0; j < g.cols(); ++j) {
      if (weight[j] > 0.0 && along[j] > along[from]) from = j;
    }
    const Eigen::VectorXd step = g.col(to) - g.col(from);
    const double square = step.squaredNorm();
    const double gain = along[from] - along[to];
    if (square == 0.0 || gain <= 1e-6 * x.squaredNorm() + 1e-300) break;
    const double length = std::min(gain / square, weight[from]);
    weight[from] -= length;
    weight[to] += length;
    x += length * step;
  }
  return x;
}

/// Gradients in unit steps at the point and around it.
Eigen::MatrixXd sampled_gradients(const LeastSquares& problem, const Minimum& m, const Eigen::MatrixXd& unit,
                                  double radius) {
  std::vector<Eigen::VectorXd> list;
  const auto add = [&](const Eigen::VectorXd& z, const Evaluation& e) {
    const Stack stack = gauss_newton_stack(problem, problem.values(z), e);
    list.emplace_back(unit.transpose() * (stack.jacobian.transpose() * stack.residuals));
  };
  add(m.z, m.evaluation);
  for (Eigen::Index k = 0; k < unit.cols(); ++k) {
    for (const double side : {-radius, radius}) {
      const Eigen::VectorXd z = within_bounds(problem, m.z + side * unit.col(k));
      const Evaluation e = evaluate(problem, problem.values(z), true);
      if (e.ok()) add(z, e);
    }
  }
  Eigen::MatrixXd out(unit.cols(), static_cast<Eigen::Index>(list.size()));
  for (std::size_t k = 0; k < list.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = list[k];
  return out;
}

/// Goes along `step`, by halves, to a cost that is lower by a part of what is promised.
bool descend(const LeastSquares& problem, const Eigen::VectorXd& step, double promised, Minimum& m) {
  for (double length = 1.0; length > 1e-3; length *= 0.5) {
    const Eigen::VectorXd z = within_bounds(problem, m.z + length * step);
    const Eigen::VectorXd values = problem.values(z);
    Evaluation e = evaluate(problem, values, true);
    if (!e.ok()) continue;
    const double lower = cost(problem, e);
    if (!(lower < m.cost - 0.05 * length * promised)) continue;
    m.z = z;
    m.values = values;
    m.cost = lower;
    m.gradient = cost_gradient(problem, e);
    m.evaluation = std::move(e);
    return true;
  }
  return false;
}

}  // namespace

double promised_step(const LeastSquares& problem, const Minimum& m, const std::vector<bool>& held) {
  const std::vector<Eigen::Index> columns = free_columns(held);
  if (columns.empty()) return 0.0;
  const Stack stack = gauss_newton_stack(problem, m.values, m.evaluation);
  return std::sqrt(squared_projection(stack.jacobian(Eigen::all, columns), stack.residuals, 1e-9));
}

double settle(const LeastSquares& problem, const std::vector<bool>& held, Minimum& m) {
  constexpr int most_rounds = 40;
  constexpr double nearest = 0.025;  // radius of the samples, in standard errors
  constexpr double farthest = 0.11;
  const std::vector<Eigen::Index> columns = free_columns(held);
  double radius = nearest;
  double remaining = promised_step(problem, m, held);
  for (int round = 0; round < most_rounds && remaining > smooth_tolerance; ++round) {
    const Eigen::MatrixXd unit = unit_steps(gauss_newton_stack(problem, m.values, m.evaluation), columns);
    const Eigen::VectorXd steepest = shortest_in_hull(sampled_gradients(problem, m, unit, radius));
    remaining = steepest.norm();
    if (remaining <= kink_tolerance) break;
    if (descend(problem, -(unit * steepest), steepest.squaredNorm(), m)) {
      radius = nearest;
    } else if ((radius *= 2.0) > farthest) {
      break;
    }
  }
  return remaining;
}

}  // namespace fpz::calibration::detail
