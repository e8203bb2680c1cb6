#include "multi_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace fpz::calibration::detail {
namespace {

/// In [0, 1), the same with every standard library.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1.0p-53; }

/// Parameter values of a Latin hypercube: in every variable one point per stratum.
std::vector<Eigen::VectorXd> latin_hypercube(const LeastSquares& problem, int count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<Eigen::VectorXd> points(static_cast<std::size_t>(count), Eigen::VectorXd(problem.size()));
  for (int k = 0; k < problem.size(); ++k) {
    std::vector<int> stratum(static_cast<std::size_t>(count));
    std::iota(stratum.begin(), stratum.end(), 0);
    for (std::size_t i = stratum.size(); i > 1; --i) {
      std::swap(stratum[i - 1], stratum[static_cast<std::size_t>(uniform(generator) * static_cast<double>(i))]);
    }
    const Variable& v = problem.variable(k);
    const double lower = v.lower();
    const double upper = v.upper();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double fraction = (static_cast<double>(stratum[i]) + uniform(generator)) / static_cast<double>(count);
      points[i][k] = v.value(lower + fraction * (upper - lower));
    }
  }
  return points;
}

/// `point`, or the first on the way (by halves, in the scaled variables) to the given start that has a prediction.
Eigen::VectorXd admissible(const LeastSquares& problem, const Eigen::VectorXd& given, Eigen::VectorXd point) {
  for (int halving = 0; halving < 10; ++halving) {
    if (evaluate(problem, point, false).ok()) break;
    point = problem.values(0.5 * (problem.z(point) + problem.z(given)));
  }
  return point;
}

/// Does the point lie in the neighbourhood of a minimum where the cost is its quadratic model?
class Neighbourhood {
 public:
  Neighbourhood(const LeastSquares& problem, const Minimum& m)
      : minimum_(&m), jacobian_(gauss_newton_stack(problem, m.values, m.evaluation).jacobian) {}

  [[nodiscard]] bool holds(const Eigen::VectorXd& z, double cost) const {
    const double excess = 0.5 * (jacobian_ * (z - minimum_->z)).squaredNorm();
    const double rounding = 1e-9 * (1.0 + minimum_->cost);
    return excess < 0.5 && std::abs(cost - minimum_->cost - excess) < 0.2 * excess + rounding;
  }

 private:
  const Minimum* minimum_;
  Eigen::MatrixXd jacobian_;
};

StartResult describe(const Eigen::VectorXd& start, const Minimum& m) {
  StartResult out;
  out.start = start;
  out.end = m.values;
  out.cost = m.cost;
  out.converged = m.converged;
  out.iterations = m.iterations;
  out.message = m.message;
  return out;
}

}  // namespace

bool same_minimum(const LeastSquares& problem, const Minimum& a, const Minimum& b) {
  if (Neighbourhood(problem, a).holds(b.z, b.cost)) return true;
  const double high = std::max(a.cost, b.cost);
  if (high - std::min(a.cost, b.cost) > 0.01 + 1e-6 * high) return false;
  for (const double x : {0.25, 0.5, 0.75}) {
    const Evaluation e = evaluate(problem, problem.values(a.z + x * (b.z - a.z)), false);
    if (!e.ok() || cost(problem, e) > high + 0.01 + 1e-6 * high) return false;
  }
  return true;
}

MultiStart multi_start(const LeastSquares& problem, const FitOptions& options) {
  MultiStart out;
  Eigen::VectorXd given(problem.size());
  for (int k = 0; k < problem.size(); ++k) given[k] = problem.parameters[static_cast<std::size_t>(k)].start;
  std::vector<Eigen::VectorXd> points = latin_hypercube(problem, std::max(0, options.starts - 1), options.seed);
  points.insert(points.begin(), given);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::VectorXd start = i == 0 ? given : admissible(problem, given, points[i]);
    std::vector<Neighbourhood> known;
    for (const Minimum& m : out.minima) known.emplace_back(problem, m);
    std::size_t arrived = out.minima.size();
    SolverRun run;
    run.max_iterations = options.max_iterations;
    run.stop = [&](const Eigen::VectorXd& z, double value) {
      for (arrived = 0; arrived < known.size(); ++arrived) {
        if (known[arrived].holds(z, value)) return true;
      }
      return false;
    };
    Minimum m = minimise(problem, start, run);
    StartResult result = describe(start, m);
    int which = -1;
    if (m.stopped) {
      which = static_cast<int>(arrived);
      const Minimum& known_minimum = out.minima[arrived];
      result.end = known_minimum.values;
      result.cost = known_minimum.cost;
      result.converged = known_minimum.converged;
      result.message = "reached the minimum of an earlier start";
    } else if (m.ok()) {
      for (std::size_t k = 0; k < out.minima.size() && which < 0; ++k) {
        if (!m.converged || !same_minimum(problem, out.minima[k], m)) continue;
        which = static_cast<int>(k);
        if (m.cost < out.minima[k].cost) out.minima[k] = m;
      }
      if (which < 0) {
        which = static_cast<int>(out.minima.size());
        out.minima.push_back(m);
      }
    }
    out.starts.push_back(std::move(result));
    out.minimum_of.push_back(which);
    if (options.progress) {
      options.progress({"start " + std::to_string(i + 1) + " of " + std::to_string(points.size()),
                        static_cast<double>(i + 1) / static_cast<double>(points.size()), out.starts.back().cost});
    }
  }
  return out;
}

}  // namespace fpz::calibration::detail
