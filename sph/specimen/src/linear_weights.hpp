// Weights of particles that stand for a place among them: exact for every linear field.
#pragma once

#include <vector>

#include "fpz/specimen/geometry.hpp"
#include "fpz/sph/arrangement.hpp"

namespace fpz::specimen::detail {

struct ParticleWeight {
  std::size_t particle;
  double weight;
};

/// Weights of some particles within `reach` (m) of a place whose sum is 1 and whose mean place is that place, even
/// where it lies beside all of them: linear in the place times (1 - q^2)^2 and the volume. Empty when there are too
/// few, or all on one line.
[[nodiscard]] std::vector<ParticleWeight> linear_weights(const Point& at, double reach,
                                                         const sph::Arrangement<2>& particles,
                                                         const std::vector<std::size_t>& near);

}  // namespace fpz::specimen::detail
