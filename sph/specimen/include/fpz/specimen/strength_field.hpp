// Strength that varies from place to place: Weibull's distribution with a length over which it is alike.
#pragma once

#include <cstdint>
#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen {

/// The strength of a place is its factor times that of its material: tensile strength and cohesion together, so that
/// the onset surface keeps its form; delta0 stays, and G changes with the strength.
struct StrengthField {
  double weibull_modulus = 10.0;    ///< m of P(f) = 1 - exp(-(f/f0)^m); f0 gives the factor a mean of 1
  double correlation_length = 0.0;  ///< l, m: normal values at a distance r have the correlation exp(-(r/l)^2)
  std::uint64_t seed = 1;
};

/// The factors at these places, > 0. A sum of waves makes a normal field, whose values are turned into Weibull's at
/// equal probability (the copula of a normal field). It is a function of the place alone: the same seed gives the same
/// strengths on every arrangement and spacing.
[[nodiscard]] std::vector<double> strength_factors(const StrengthField& field, const std::vector<Point>& places);

/// Standard deviation of the factor, its mean being 1.
[[nodiscard]] double strength_deviation(double weibull_modulus);

}  // namespace fpz::specimen
