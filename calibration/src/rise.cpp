#include "fpz/calibration/rise.hpp"

#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <utility>

namespace fpz::calibration {
namespace {

struct Line {
  RiseIntercept intercept;
  double per_load = 0.0;
};

/// Reading = intercept + per_load * load, by least squares.
std::optional<Line> line_through(const Eigen::VectorXd& readings, const Eigen::VectorXd& loads, double from,
                                 double to) {
  constexpr Eigen::Index least_points = 4;
  Eigen::Index top = 0;
  const double peak = loads.maxCoeff(&top);
  const auto inside = [&](Eigen::Index k) { return loads[k] >= from * peak && loads[k] <= to * peak; };
  Eigen::Index used = 0;
  for (Eigen::Index k = 0; k <= top; ++k) used += inside(k) ? 1 : 0;
  if (used < least_points) return std::nullopt;
  Eigen::ArrayXd x(used), y(used);
  for (Eigen::Index k = 0, row = 0; k <= top; ++k) {
    if (!inside(k)) continue;
    x[row] = loads[k];
    y[row++] = readings[k];
  }
  const double count = static_cast<double>(used);
  const Eigen::ArrayXd dx = x - x.mean();
  const double square = dx.square().sum();
  if (!(square > 0.0)) return std::nullopt;
  Line line;
  line.per_load = (dx * (y - y.mean())).sum() / square;
  if (!(line.per_load > 0.0)) return std::nullopt;
  const double scatter = (y - y.mean() - line.per_load * dx).square().sum() / (count - 2.0);
  RiseIntercept& i = line.intercept;
  i.reading = y.mean() - line.per_load * x.mean();
  i.standard_error = std::sqrt(scatter * (1.0 / count + x.mean() * x.mean() / square));
  i.from = from;
  i.to = to;
  i.points = static_cast<int>(used);
  const boost::math::students_t chance(count - 2.0);
  i.beyond_zero =
      i.reading > quantile(complement(chance, 1e-4)) * i.standard_error && i.reading > 0.03 * std::abs(readings[top]);
  return line;
}

}  // namespace

std::optional<RiseIntercept> rise_intercept(const Eigen::VectorXd& readings, const Eigen::VectorXd& loads) {
  constexpr std::array<std::pair<double, double>, 4> parts = {{{0.1, 0.4}, {0.2, 0.5}, {0.3, 0.6}, {0.2, 0.7}}};
  if (readings.size() != loads.size() || loads.size() == 0 || !(loads.maxCoeff() > 0.0)) return std::nullopt;
  std::optional<Line> steepest;
  for (const auto& [from, to] : parts) {
    const std::optional<Line> line = line_through(readings, loads, from, to);
    if (line && (!steepest || line->per_load < steepest->per_load)) steepest = line;
  }
  if (!steepest) return std::nullopt;
  return steepest->intercept;
}

}  // namespace fpz::calibration
