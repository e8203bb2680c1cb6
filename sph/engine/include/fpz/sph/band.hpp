// Width of the band of particles over which a crack opens: the length H that makes the energy dissipated per crack area
// equal to G.
//
// A crack opens the particles on its two sides that have a nearest neighbour on the other side: two rows along a
// lattice direction, also two, but closer ones, along a diagonal. Let a crack with the jump [u] and the normal n pass
// beside a particle. The nearest neighbours beyond it, at r_j with s_j = n.r_j, move by [u]; the least-squares gradient
// over all nearest neighbours is then n.(grad u).n = [u] (sum over one side of s_j)/(sum of s_j^2), on average of the
// two sides [u] sum|s_j| / (2 sum s_j^2). The particle's own jump is H times this strain, and it is [u] for
//
//   H = 2 sum w_j s_j^2 / sum w_j |s_j|.
//
// On a square lattice of spacing d this is 2 d / (|cos a| + |sin a|) at the angle a between crack and lattice: 2 d
// along it, sqrt(2) d at 45 degrees, just the widths of the two rows that open there.
#pragma once

#include <cmath>
#include <span>

#include "fpz/types.hpp"

namespace fpz::sph {

/// H, m, of a particle of size `size` = V^(1/Dim) (m), which cracks with the unit normal `normal`, from the offsets of
/// its neighbours (m, any order; those beyond sqrt(2) sizes have no influence). Nearest means the weight w = max(0, 2 -
/// r^2/size^2): one at one size, zero at the diagonal of a lattice, continuous for irregular arrangements. Without a
/// neighbour off the crack plane: two sizes.
template <int Dim>
[[nodiscard]] double band_width(double size, const Vec<double, Dim>& normal,
                                std::span<const Vec<double, Dim>> offsets) {
  double squares = 0.0;
  double extents = 0.0;
  for (const Vec<double, Dim>& r : offsets) {
    const double weight = 2.0 - r.squaredNorm() / (size * size);
    if (weight <= 0.0) continue;
    const double s = normal.dot(r);
    squares += weight * s * s;
    extents += weight * std::abs(s);
  }
  const double width = extents > 0.0 ? squares / extents : size;
  return 2.0 * width;
}

}  // namespace fpz::sph
