// What the arrays of the particles and the inner loops must agree on. The loops are compiled once per instruction set,
// so nothing here (nor in what is included) emits code.
#pragma once

#include <cstddef>

namespace fpz::sph {

/// Particles are handled in blocks of this many: one SIMD lane, one particle.
inline constexpr std::size_t lanes = 8;

/// How a particle responds; a double because it is a mask of the lane loops.
namespace kind {
inline constexpr double intact = 0.0;
inline constexpr double cracked = 1.0;
inline constexpr double elastic = 2.0;  ///< never cracks: boundary particles and padding
}  // namespace kind

}  // namespace fpz::sph
