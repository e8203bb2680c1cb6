#include "undetermined.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "decompositions.hpp"
#include "statistics.hpp"
#include "words.hpp"

namespace fpz::calibration::detail {
namespace {

struct OpenDirection {
  Eigen::VectorXd direction;  ///< unit length, relative changes of the free parameters
  double singular_value = 0.0;
  bool rounding = false;  ///< the singular value is zero but for rounding
};

struct OpenDirections {
  Eigen::VectorXd singular_values;
  std::vector<OpenDirection> directions;
};

/// A basis of the same space (columns) with as many zeros as elimination finds, each of unit length: two independent
/// pairs of parameters are then named pair by pair.
Eigen::MatrixXd sparse_basis(Eigen::MatrixXd basis) {
  std::vector<Eigen::Index> taken;
  for (Eigen::Index c = 0; c < basis.cols(); ++c) {
    Eigen::VectorXd candidates = basis.col(c).cwiseAbs();
    for (const Eigen::Index r : taken) candidates[r] = 0.0;
    Eigen::Index pivot = 0;
    candidates.maxCoeff(&pivot);
    taken.push_back(pivot);
    basis.col(c) /= basis(pivot, c);
    for (Eigen::Index other = 0; other < basis.cols(); ++other) {
      if (other != c) basis.col(other) -= basis(pivot, other) * basis.col(c);
    }
  }
  basis = (basis.array().abs() < 1e-7).select(0.0, basis);
  basis.colwise().normalize();
  return basis;
}

OpenDirections open_directions(const Eigen::MatrixXd& jacobian) {
  OpenDirections out;
  const Eigen::Index n = jacobian.cols();
  if (n == 0) return out;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(std::max(jacobian.rows(), n), n);
  a.topRows(jacobian.rows()) = jacobian;
  const SingularValues svd = singular_values(a);
  out.singular_values = svd.values;
  const Eigen::VectorXd& s = out.singular_values;
  const double zero = negligible * s[0];
  Eigen::Index null = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (s[k] <= zero) {
      ++null;
    } else if (s[k] < 1.0) {
      out.directions.push_back({svd.right.col(k), s[k], false});
    }
  }
  const Eigen::MatrixXd basis = sparse_basis(svd.right.rightCols(null));
  for (Eigen::Index k = 0; k < null; ++k) {
    out.directions.push_back({basis.col(k), (jacobian * basis.col(k)).norm(), true});
  }
  return out;
}

/// Rows of the data sets, or of the priors too.
Eigen::MatrixXd stack(const LeastSquares& problem, const Linearised& lin, bool priors) {
  Eigen::Index rows = 0;
  for (const RowSet& set : problem.sets) rows += priors || set.prior_of < 0 ? set.size() : 0;
  Eigen::MatrixXd out(rows, static_cast<Eigen::Index>(lin.free.size()));
  Eigen::Index first = 0;
  for (std::size_t k = 0; k < problem.sets.size(); ++k) {
    if (!priors && problem.sets[k].prior_of >= 0) continue;
    const Eigen::Index count = problem.sets[k].size();
    out.middleRows(first, count) = lin.jacobian[k](Eigen::all, lin.free);
    first += count;
  }
  return out;
}

/// The names of parameters that take part, most important first; those that matter neither for the direction nor for
/// the predictions are left out (set to zero).
std::vector<Eigen::Index> participants(const Eigen::MatrixXd& data, Eigen::VectorXd& step) {
  const double largest = step.cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> out;
  for (Eigen::Index k = 0; k < step.size(); ++k) {
    const double effect = data.rows() > 0 ? data.col(k).cwiseAbs().maxCoeff() * std::abs(step[k]) : 0.0;
    if (std::abs(step[k]) < 1e-9 * largest || (std::abs(step[k]) < 0.05 * largest && effect < 0.01)) {
      step[k] = 0.0;
    } else {
      out.push_back(k);
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return std::abs(step[a]) > std::abs(step[b]); });
  return out;
}

std::string percent(double fraction) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * fraction);
  return text;
}

/// "raising a by 10 % and lowering b by 10 % changes no prediction by more than 0.02 standard deviations".
std::string in_words(const LeastSquares& problem, const Linearised& lin, const Eigen::MatrixXd& data,
                     const OpenDirection& open) {
  Eigen::VectorXd step = 0.1 * open.direction / open.direction.cwiseAbs().maxCoeff();
  const std::vector<Eigen::Index> which = participants(data, step);
  if (step[which.front()] < 0.0) step = -step;
  std::vector<std::string> parts;
  for (const Eigen::Index k : which) {
    const std::string& name = problem.parameters[static_cast<std::size_t>(lin.free[static_cast<std::size_t>(k)])].name;
    parts.push_back((step[k] > 0.0 ? "raising " : "lowering ") + name + " by " + percent(std::abs(step[k])));
  }
  const double change = data.rows() > 0 ? (data * step).cwiseAbs().maxCoeff() : 0.0;
  if (parts.size() == 1 && change == 0.0) {
    const std::string& name =
        problem.parameters[static_cast<std::size_t>(lin.free[static_cast<std::size_t>(which.front())])].name;
    return name + " influences no prediction at all";
  }
  const std::string amount =
      open.rounding ? "at all (to first order)" : "by more than " + number(change) + " standard deviations";
  return listed(parts) + " changes no prediction " + amount;
}

bool involves(const OpenDirection& open, Eigen::Index k) { return std::abs(open.direction[k]) > 1e-3; }

void warn_of_priors(const LeastSquares& problem, const Linearised& lin, const Eigen::MatrixXd& data,
                    const Eigen::MatrixXd& all, FitResult& result) {
  for (const OpenDirection& open : open_directions(data).directions) {
    if ((all * open.direction).norm() < 1.0) continue;  // open with the priors too
    result.warnings.push_back("without the priors " + in_words(problem, lin, data, open) +
                              ": in this direction the result repeats the priors");
  }
}

void warn_of_weak_parameters(const LeastSquares& problem, const Linearised& lin, FitResult& result) {
  for (const int p : lin.free) {
    const double relative = result.standard_error[p] / lin.size[p];
    if (!(relative > 0.5) || !std::isfinite(relative)) continue;
    const FitParameter& parameter = problem.parameters[static_cast<std::size_t>(p)];
    result.warnings.push_back(parameter.name + " is weakly determined: its standard error is " +
                              with_unit(result.standard_error[p], parameter.unit) + ", " + percent(relative) + " of " +
                              (std::abs(result.values[p]) == lin.size[p] ? "its value" : "its reference size"));
  }
}

}  // namespace

void add_undetermined(const LeastSquares& problem, const Minimum& m, FitResult& result) {
  const Linearised lin = linearise(problem, m);
  const Eigen::MatrixXd all = stack(problem, lin, true);
  const Eigen::MatrixXd data = stack(problem, lin, false);
  const OpenDirections open = open_directions(all);
  result.singular_values = open.singular_values;
  for (const OpenDirection& direction : open.directions) {
    UndeterminedDirection u;
    u.singular_value = direction.singular_value;
    u.direction = Eigen::VectorXd::Zero(problem.size());
    u.direction(lin.free) = direction.direction;
    u.words = in_words(problem, lin, data, direction);
    result.undetermined.push_back(std::move(u));
    for (std::size_t j = 0; j < lin.free.size() && direction.rounding; ++j) {
      if (!involves(direction, static_cast<Eigen::Index>(j))) continue;
      const int p = lin.free[j];
      result.standard_error[p] = result.correlated_error[p] = std::numeric_limits<double>::infinity();
      result.lower_limit[p] = problem.parameters[static_cast<std::size_t>(p)].lower;
      result.upper_limit[p] = problem.parameters[static_cast<std::size_t>(p)].upper;
    }
  }
  warn_of_priors(problem, lin, data, all, result);
  warn_of_weak_parameters(problem, lin, result);
}

}  // namespace fpz::calibration::detail
