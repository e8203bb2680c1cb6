#include "fpz/specimen/toughness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fpz::specimen {

std::pair<double, double> IntensityFactors::at(double angle) const {
  const auto above = std::lower_bound(angle_deg.begin() + 1, angle_deg.end() - 1, angle) - angle_deg.begin();
  const auto k = static_cast<std::size_t>(above);
  const double w = (angle - angle_deg[k - 1]) / (angle_deg[k] - angle_deg[k - 1]);
  return {std::lerp(Y_I[k - 1], Y_I[k], w), std::lerp(Y_II[k - 1], Y_II[k], w)};
}

StressIntensity stress_intensity(const SemicircularBending& s, double thickness, double load) {
  const double unit = load / (2.0 * s.radius * thickness) * std::sqrt(std::numbers::pi * s.notch_length);
  return {unit * s.Y_I, unit * s.Y_II};
}

}  // namespace fpz::specimen
