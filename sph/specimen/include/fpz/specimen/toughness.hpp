// Fracture toughness of the semicircular bending specimen from its peak load.
#pragma once

#include <utility>
#include <vector>

namespace fpz::specimen {

/// Stress intensity factors of the specimen, made dimensionless by eqs 68-69, over the angle of its notch.
struct IntensityFactors {
  double notch_ratio = 0.0;       ///< notch length over radius for which they hold
  double span_ratio = 0.0;        ///< half the span over radius
  std::vector<double> angle_deg;  ///< of the notch from the vertical, ascending
  std::vector<double> Y_I, Y_II;  ///< Y_I < 0: the notch closes

  /// Both at an angle of the table, linear between its entries.
  [[nodiscard]] std::pair<double, double> at(double angle) const;
};

/// What the toughness of a specimen follows from, besides its load.
struct SemicircularBending {
  double radius = 0.0, notch_length = 0.0;  ///< m
  double Y_I = 0.0, Y_II = 0.0;             ///< at the angle of its notch
};

struct StressIntensity {
  double K_I = 0.0, K_II = 0.0;  ///< Pa sqrt(m)
};

/// K = P / (2 r t) sqrt(pi a) Y (eqs 68-69), for a load P in N on a thickness t in m.
[[nodiscard]] StressIntensity stress_intensity(const SemicircularBending& specimen, double thickness, double load);

}  // namespace fpz::specimen
