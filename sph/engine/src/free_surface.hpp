// Where the body ends: the directions in which a particle near its surface needs no balance of the bonds' vectors.
//
// A stress that leaves the surface free has no traction there: only what the vectors of a particle sum to along the
// surface would be a force. The part along the normal is free. At corners and at the mouths of cuts both are.
#pragma once

#include <vector>

#include "run_data.hpp"

namespace fpz::sph::detail {

template <int Dim>
struct FreeDirections {
  int count = 0;                                        ///< 0: none, 1: `normal`, 2: all
  Vec<double, Dim> normal = Vec<double, Dim>::UnitX();  ///< unit vector, either way
  bool at_platen = false;                               ///< it is near particles of a group: all are free
};

/// For every particle. From the lines of the surface and the cuts where the arrangement has them; else the surface is
/// estimated from the particles. All directions are free where a motion is prescribed, and beside platens: how their
/// particles lie on the surface is rough, and balance imposed there goes at the cost of what lies around.
template <int Dim>
[[nodiscard]] std::vector<FreeDirections<Dim>> find_free_directions(const RunData<Dim>& run);

}  // namespace fpz::sph::detail
