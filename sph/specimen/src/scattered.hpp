// Particles without directions, and particles that are moved a little at random.
#pragma once

#include <cstdint>

#include "fpz/specimen/geometry.hpp"
#include "fpz/sph/arrangement.hpp"

namespace fpz::specimen::detail {

/// Positions that are even but have no directions: round(area / spacing^2) particles, none nearer than half a spacing
/// to the surface or to a notch of width 0. Volumes are spacing^2. The same seed gives the same bits. Throws
/// std::invalid_argument when the body is too thin for them.
[[nodiscard]] sph::Arrangement<2> scatter(const Body& body, std::uint64_t seed, double spacing);

/// Moves every particle by at most `distance` (m) along x and along y, uniformly at random, within the body and not
/// across or onto a notch of width 0. The same seed gives the same bits.
void move_at_random(sph::Arrangement<2>& arrangement, const Body& body, double distance, std::uint64_t seed);

}  // namespace fpz::specimen::detail
