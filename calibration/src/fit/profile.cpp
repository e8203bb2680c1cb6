#include "profile.hpp"

#include <algorithm>
#include <cmath>

#include "statistics.hpp"
#include "words.hpp"

namespace fpz::calibration::detail {
namespace {

struct ProfilePoint {
  double z = 0.0;
  double excess = 0.0;
  Minimum fit;
};

/// The profile as a function of z.
class Profiler {
 public:
  Profiler(const LeastSquares& problem, const Minimum& minimum, int parameter, const FitOptions& options)
      : problem_(problem), minimum_(minimum), parameter_(parameter) {
    run_.fixed.assign(static_cast<std::size_t>(problem.size()), false);
    run_.fixed[static_cast<std::size_t>(parameter)] = true;
    run_.max_iterations = options.max_iterations;
  }

  [[nodiscard]] ProfilePoint best() const { return {minimum_.z[parameter_], 0.0, minimum_}; }

  /// The others refitted at z, from those of the neighbour; nothing where there is no prediction or no convergence.
  [[nodiscard]] std::optional<ProfilePoint> at(double z, const ProfilePoint& neighbour) {
    Eigen::VectorXd start = neighbour.fit.values;
    start[parameter_] = problem_.variable(parameter_).value(z);
    ProfilePoint out{z, 0.0, minimise(problem_, start, run_)};
    if (!out.fit.ok() || !out.fit.converged) {
      failure = out.fit.message;
      return std::nullopt;
    }
    out.excess = 2.0 * (out.fit.cost - minimum_.cost);
    if (out.excess < -0.01 && (!better || out.fit.cost < better->cost)) better = out.fit;
    return out;
  }

  /// The same, coming nearer by halves where the way from the neighbour is too far.
  [[nodiscard]] std::optional<ProfilePoint> reach(double z, const ProfilePoint& neighbour) {
    ProfilePoint from = neighbour;
    double target = z;
    for (int attempt = 0; attempt < 12; ++attempt) {
      std::optional<ProfilePoint> point = at(target, from);
      if (point && target == z) return point;
      if (point) from = *point;
      target = point ? z : 0.5 * (from.z + target);
    }
    return std::nullopt;
  }

  std::string failure;
  std::optional<Minimum> better;

 private:
  const LeastSquares& problem_;
  const Minimum& minimum_;
  int parameter_;
  SolverRun run_;
};

double root(double excess) { return std::sqrt(std::max(0.0, excess)); }

/// Where the excess crosses the threshold between two points: secant steps on its root, which is nearly linear, kept
/// inside the bracket.
double crossing(Profiler& profiler, ProfilePoint inside, ProfilePoint outside, double threshold) {
  const double level = std::sqrt(threshold);
  double z = outside.z;
  for (int k = 0; k < 20; ++k) {
    const double a = root(inside.excess) - level;
    const double b = root(outside.excess) - level;
    double fraction = a / (a - b);
    if (k % 4 == 3) fraction = 0.5;  // the secant may creep from one side
    z = inside.z + fraction * (outside.z - inside.z);
    const std::optional<ProfilePoint> point = profiler.at(z, inside);
    if (!point || std::abs(root(point->excess) - level) < 1e-4 * level) break;
    (point->excess < threshold ? inside : outside) = *point;
  }
  return z;
}

struct Side {
  std::vector<ProfilePoint> points;  ///< outwards, without the minimum
  std::optional<double> crossing;    ///< in z
  std::string warning;
};

/// One side of the profile: `count` steps of `step` towards `bound`, and on with growing ones until the threshold is
/// crossed.
Side walk(Profiler& profiler, double bound, double step, int count, double threshold) {
  Side out;
  ProfilePoint last = profiler.best();
  const double direction = bound > last.z ? 1.0 : -1.0;
  const double room = std::abs(bound - last.z);
  if (room < 1e-10) return out;
  step = std::min(step, room / static_cast<double>(count));
  const double start = last.z;
  double distance = 0.0;
  for (int k = 0; k < 200; ++k) {
    if (k >= count && (last.excess > threshold || out.crossing)) break;
    if (k >= count) step *= 1.5;
    distance = std::min(room, distance + step);
    if (room - distance < 1e-9 * room) distance = room;
    const double z = distance == room ? bound : start + direction * distance;
    const std::optional<ProfilePoint> next = profiler.reach(z, last);
    if (!next) {
      out.warning = profiler.failure;
      break;
    }
    if (!out.crossing && last.excess <= threshold && next->excess > threshold) {
      out.crossing = crossing(profiler, last, *next, threshold);
    }
    last = *next;
    out.points.push_back(last);
    if (distance == room) break;
  }
  return out;
}

}  // namespace

ProfileResult profile(const LeastSquares& problem, const Minimum& minimum, int parameter, const FitOptions& options) {
  const Variable& v = problem.variable(parameter);
  const Linearised lin = linearise(problem, minimum);
  const Certainty c = certainty(problem, lin, {});
  const double z = minimum.z[parameter];
  double error = v.upper() - v.lower();  // where there is none: the range
  double quantile = t_quantile(options.confidence, region_freedom(c));
  double ratio = 1.0;
  for (std::size_t j = 0; j < lin.free.size(); ++j) {
    if (lin.free[j] != parameter) continue;
    const Eigen::Index k = static_cast<Eigen::Index>(j);
    if (c.covariance(k, k) <= 0.0) continue;
    error = std::min(error, std::sqrt(c.covariance(k, k)) * lin.size[parameter] / v.slope(z));
    ratio = c.covariance(k, k) / c.inverse(k, k);
    quantile = t_quantile(options.confidence, freedom(c, Eigen::VectorXd::Unit(c.covariance.rows(), k)));
  }
  ProfileResult out;
  out.profile.parameter = parameter;
  out.profile.threshold = quantile * quantile * ratio;
  const int count = std::max(2, (options.profile_points - 1) / 2);
  const double step = std::max(4.0, 1.3 * quantile) * error / static_cast<double>(count);
  Profiler profiler(problem, minimum, parameter, options);
  const Side below = walk(profiler, v.lower(), step, count, out.profile.threshold);
  const Side above = walk(profiler, v.upper(), step, count, out.profile.threshold);
  std::vector<ProfilePoint> points(below.points.rbegin(), below.points.rend());
  points.push_back(profiler.best());
  points.insert(points.end(), above.points.begin(), above.points.end());
  out.profile.values.resize(static_cast<Eigen::Index>(points.size()));
  out.profile.excess.resize(static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    out.profile.values[static_cast<Eigen::Index>(k)] = v.value(points[k].z);
    out.profile.excess[static_cast<Eigen::Index>(k)] = points[k].excess;
  }
  if (below.crossing) out.profile.lower = v.value(*below.crossing);
  if (above.crossing) out.profile.upper = v.value(*above.crossing);
  const FitParameter& p = problem.parameters[static_cast<std::size_t>(parameter)];
  for (const Side* side : {&below, &above}) {
    if (side->warning.empty() || side->crossing) continue;
    const double end = side->points.empty() ? minimum.values[parameter] : v.value(side->points.back().z);
    out.warning += (out.warning.empty() ? "the profile of " : "; the profile of ") + p.name + " ends at " +
                   with_unit(end, p.unit) + " before its interval does: " + side->warning;
  }
  out.better = profiler.better;
  return out;
}

}  // namespace fpz::calibration::detail
