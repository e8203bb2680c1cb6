#include "fpz/calibration/fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "multi_start.hpp"
#include "profile.hpp"
#include "statistics.hpp"
#include "undetermined.hpp"
#include "words.hpp"

namespace fpz::calibration {
namespace {

using namespace detail;  // NOLINT(google-build-using-namespace): the parts this file puts together

/// Noise for the first fit of sets whose noise is not known: 1 % of the measured values (root mean square), so that no
/// set drowns the others by its units. Robust losses that judge residuals by a noise nobody knows yet wait behind
/// Huber's, which cannot lock onto a wrong one.
void assume_noise(LeastSquares& problem) {
  for (RowSet& set : problem.sets) {
    if (!set.estimated) continue;
    const double level = set.measured.cwiseQuotient(set.deviation).norm() / std::sqrt(static_cast<double>(set.size()));
    set.factor = level > 0.0 ? 0.01 * level : 1.0;
    if (set.loss.kind != LossKind::none) set.loss = {LossKind::huber, 1.345};
  }
}

Minimum continue_from(const LeastSquares& problem, const Minimum& m, const FitOptions& options) {
  SolverRun run;
  run.max_iterations = options.max_iterations;
  return minimise(problem, m.values, run);
}

double largest_change(const LeastSquares& problem, const std::vector<double>& before) {
  double out = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    out = std::max(out, std::abs(std::log(problem.sets[k].factor / before[k])));
  }
  return out;
}

/// Fit and noise in turn until the noise changes no more. Returns the last relative change.
double settle_noise(LeastSquares& problem, const FitProblem& given, Minimum& m, const FitOptions& options) {
  double change = 0.0;
  for (int k = 0; k < 100; ++k) {
    std::vector<double> before;
    for (const RowSet& set : problem.sets) before.push_back(set.factor);
    update_factors(problem, m);
    for (std::size_t i = 0; i < given.data.size(); ++i) problem.sets[i].loss = given.data[i].loss;
    m = continue_from(problem, m, options);
    if (!m.ok()) break;
    change = largest_change(problem, before);
    if (change < 1e-7) break;
    if (options.progress) options.progress({"noise levels", static_cast<double>(k + 1) / 100.0, m.cost});
  }
  return change;
}

/// The minima of all starts under the settled noise of the best one.
struct Ranking {
  Minimum best;
  std::vector<Minimum> others;  ///< distinct from the best and from each other
  std::vector<Minimum> ends;    ///< per minimum of the multi-start
  double noise_change = 0.0;
};

Ranking rank(LeastSquares& problem, const FitProblem& given, const std::vector<Minimum>& minima,
             const FitOptions& options) {
  Ranking out;
  out.best =
      *std::min_element(minima.begin(), minima.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  out.ends = minima;
  for (int attempt = 0; attempt < 4; ++attempt) {
    out.noise_change = settle_noise(problem, given, out.best, options);
    const Minimum* least = &out.best;
    for (Minimum& m : out.ends) {
      m = continue_from(problem, m, options);
      if (m.ok() && m.converged && m.cost < least->cost - 1e-6 * (1.0 + least->cost)) least = &m;
    }
    if (least == &out.best) break;
    out.best = Minimum(*least);  // another one is better under the noise of the first
  }
  for (const Minimum& m : out.ends) {
    if (!m.ok() || !m.converged || same_minimum(problem, out.best, m)) continue;
    const bool new_one = std::none_of(out.others.begin(), out.others.end(),
                                      [&](const Minimum& o) { return same_minimum(problem, o, m); });
    if (new_one) out.others.push_back(m);
  }
  return out;
}

std::string values_in_words(const FitProblem& problem, const Eigen::VectorXd& values) {
  std::vector<std::string> items;
  for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
    const FitParameter& p = problem.parameters[k];
    items.push_back(p.name + " = " + with_unit(values[static_cast<Eigen::Index>(k)], p.unit));
  }
  return listed(items);
}

void report_starts(const FitProblem& problem, MultiStart runs, const Ranking& ranking, FitResult& result) {
  std::size_t failures = 0;
  std::string reason;
  for (std::size_t k = 0; k < runs.starts.size(); ++k) {
    if (runs.minimum_of[k] < 0) {
      if (failures++ == 0) reason = runs.starts[k].message;
      continue;
    }
    const Minimum& end = ranking.ends[static_cast<std::size_t>(runs.minimum_of[k])];
    if (!end.ok()) continue;
    runs.starts[k].end = end.values;
    runs.starts[k].cost = end.cost;
  }
  if (failures > 0) {
    result.warnings.push_back(std::to_string(failures) + " of " + std::to_string(runs.starts.size()) + " starts" +
                              (runs.minimum_of.front() < 0 ? ", the given one among them," : "") +
                              " gave no prediction (" + reason + ")");
  }
  result.starts = std::move(runs.starts);
  result.distinct_minima = 1 + static_cast<int>(ranking.others.size());
  for (const Minimum& m : ranking.others) {
    const double worse = m.cost - ranking.best.cost;
    if (worse > 5.0) continue;
    result.warnings.push_back("another minimum is nearly as good (" + number(std::exp(-worse)) +
                              " of the likelihood): " + values_in_words(problem, m.values) +
                              "; a prior, tighter bounds or further data decide between them");
  }
}

void report_bounds(const FitProblem& problem, const Minimum& m, FitResult& result) {
  for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
    if (m.bound[k] == 0) continue;
    (m.bound[k] < 0 ? result.at_lower_bound : result.at_upper_bound).push_back(static_cast<int>(k));
    const FitParameter& p = problem.parameters[k];
    const bool pressed = m.gradient[static_cast<Eigen::Index>(k)] * m.bound[k] < 0.0;
    result.warnings.push_back(
        p.name + " is at its " + (m.bound[k] < 0 ? "lower" : "upper") + " bound " +
        with_unit(m.bound[k] < 0 ? p.lower : p.upper, p.unit) +
        (pressed ? ": the fit would go on beyond it; move the bound if the material allows, or fix the parameter"
                 : ": the fit would not go beyond it") +
        ". It has no standard error, and those of the others hold for this value of it");
  }
}

void report_noise(const FitProblem& problem, const LeastSquares& solved, double change, FitResult& result) {
  for (std::size_t k = 0; k < problem.data.size(); ++k) {
    if (problem.data[k].deviation_known || solved.sets[k].estimated) continue;
    result.warnings.push_back("data set " + problem.data[k].name +
                              ": too few points to reveal their noise; its deviations are taken as they are given");
  }
  if (change > 1e-3) {
    result.warnings.push_back("the noise levels of the data sets did not settle (last change " +
                              number(100.0 * change) + " %): state the standard deviations of the smaller sets");
  }
}

void set_status(const Minimum& m, FitResult& result) {
  if (!m.converged) {
    result.status = FitStatus::not_converged;
    result.message =
        "not converged: " + m.message + "; start nearer to the solution, tighten the bounds or allow more iterations";
  } else if (!result.undetermined.empty()) {
    result.status = FitStatus::undetermined;
    result.message = "the data do not determine all parameters: ";
    for (std::size_t k = 0; k < result.undetermined.size(); ++k) {
      result.message += (k > 0 ? "; " : "") + result.undetermined[k].words;
    }
    result.message += ". Fix parameters, give priors, or add data that depend on them in another way";
  } else {
    result.status = FitStatus::ok;
    result.message = "converged";
  }
}

FitResult no_prediction(const MultiStart& runs) {
  FitResult result;
  result.status = FitStatus::failed;
  result.message = "no start gave a prediction; the given one failed with: " + runs.starts.front().message +
                   ". Correct the start values or the bounds";
  result.starts = runs.starts;
  result.values = runs.starts.front().start;
  return result;
}

/// Statistics and words for a minimum; without the profiles.
FitResult describe(const FitProblem& problem, const LeastSquares& solved, const MultiStart& runs,
                   const Ranking& ranking, const FitOptions& options) {
  FitResult result;
  add_statistics(solved, ranking.best, options.confidence, result);
  add_undetermined(solved, ranking.best, result);
  report_bounds(problem, ranking.best, result);
  report_noise(problem, solved, ranking.noise_change, result);
  report_starts(problem, runs, ranking, result);
  set_status(ranking.best, result);
  return result;
}

/// Adds the profiles; returns a better minimum if they met one.
std::optional<Minimum> add_profiles(const LeastSquares& solved, const Minimum& best, const FitOptions& options,
                                    FitResult& result) {
  std::optional<Minimum> better;
  for (std::size_t k = 0; k < options.profiles.size(); ++k) {
    if (options.progress) {
      const std::string& name = solved.parameters[static_cast<std::size_t>(options.profiles[k])].name;
      options.progress(
          {"profile of " + name, static_cast<double>(k) / static_cast<double>(options.profiles.size()), best.cost});
    }
    ProfileResult p = profile(solved, best, options.profiles[k], options);
    result.profiles.push_back(std::move(p.profile));
    if (!p.warning.empty()) result.warnings.push_back(std::move(p.warning));
    if (p.better && (!better || p.better->cost < better->cost)) better = std::move(p.better);
  }
  return better;
}

void require_valid_options(const FitProblem& problem, const FitOptions& options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(options.starts >= 1, "fit options: starts must be >= 1");
  require(options.max_iterations >= 1, "fit options: max_iterations must be >= 1");
  require(options.confidence > 0.0 && options.confidence < 1.0, "fit options: confidence must lie between 0 and 1");
  require(options.profile_points >= 5, "fit options: profile_points must be >= 5");
  for (const int k : options.profiles) {
    require(k >= 0 && static_cast<std::size_t>(k) < problem.parameters.size(),
            "fit options: profiles names a parameter that does not exist");
  }
}

}  // namespace

FitResult fit(const FitProblem& problem, const FitOptions& options) {
  require_valid(problem);
  require_valid_options(problem, options);
  LeastSquares solved(problem);
  assume_noise(solved);
  const MultiStart runs = multi_start(solved, options);
  if (runs.minima.empty()) return no_prediction(runs);
  Ranking ranking = rank(solved, problem, runs.minima, options);
  FitResult result;
  for (int attempt = 0; attempt < 3; ++attempt) {
    result = describe(problem, solved, runs, ranking, options);
    if (!ranking.best.converged) break;
    std::optional<Minimum> better = add_profiles(solved, ranking.best, options, result);
    if (!better) break;
    // A profile led to a deeper minimum than all starts: go there.
    ranking.others.push_back(ranking.best);
    ranking.best = continue_from(solved, *better, options);
    ranking.noise_change = settle_noise(solved, problem, ranking.best, options);
  }
  return result;
}

bool inside_confidence_region(const FitResult& result, const Eigen::VectorXd& truth, double confidence) {
  if (truth.size() != result.values.size() || result.information.rows() != truth.size()) {
    throw std::invalid_argument("inside_confidence_region: the result has " + std::to_string(result.values.size()) +
                                " fitted parameters, the point " + std::to_string(truth.size()));
  }
  const Eigen::VectorXd step = truth - result.values;
  double excess = step.dot(result.information * step);
  for (const auto& [bounds, beyond] : {std::pair{&result.at_lower_bound, -1.0}, {&result.at_upper_bound, 1.0}}) {
    for (const int k : *bounds) {
      if (beyond * step[k] > 1e-9 * std::abs(result.values[k])) return false;
      excess += 2.0 * result.gradient[k] * step[k];
    }
  }
  const int count = static_cast<int>(truth.size());
  return excess <= region_quantile(confidence, count, result.noise_degrees_of_freedom);
}

}  // namespace fpz::calibration
