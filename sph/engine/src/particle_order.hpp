// The order in which the particles lie in memory.
#pragma once

#include <cstddef>
#include <vector>

#include "fpz/types.hpp"
#include "team.hpp"

namespace fpz::sph::detail {

/// order[slot] is the point's index. Where at least half of the points lie as on a square lattice of this spacing (m),
/// whatever its direction: by its rows, so that neighbours of points that follow one another do so too. Otherwise along
/// a Morton curve with cells of a spacing. Ties by index.
template <int Dim>
[[nodiscard]] std::vector<std::size_t> particle_order(Team& team, const std::vector<Vec<double, Dim>>& points,
                                                      double spacing);

}  // namespace fpz::sph::detail
