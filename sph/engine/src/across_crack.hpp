// Which neighbours of a cracked particle are beyond its crack.
#pragma once

#include "fpz/sph/particles.hpp"

namespace fpz::sph::detail {

/// Steps between two searches for bonds across open cracks: openings grow slowly.
inline constexpr long long release_interval = 16;

/// Whether the particle in slot j is beyond the open crack of the one in slot i: seen from i, it has moved away along
/// the crack's normal by half of the opening at least.
template <int Dim>
[[nodiscard]] bool is_across_crack(const Particles<Dim>& p, std::size_t i, std::size_t j) {
  const double jump = p.point[i].crack.jump[0];
  if (!(jump > 0.0)) return false;
  // The crack's normal in the undeformed body.
  const double nx = p.point[i].frame(0, 0);
  const double ny = p.point[i].frame(0, 1);
  const double rx = p.start[0][j] - p.start[0][i];
  const double ry = p.start[1][j] - p.start[1][i];
  // Displacement of j seen from i, turned back by the rotation of i.
  const double gx = p.position[0][j] - p.position[0][i];
  const double gy = p.position[1][j] - p.position[1][i];
  const double ux = p.rotation[0][i] * gx + p.rotation[1][i] * gy - rx;
  const double uy = p.rotation[0][i] * gy - p.rotation[1][i] * gx - ry;
  const double along = nx * rx + ny * ry;
  return (nx * ux + ny * uy) * (along < 0.0 ? -1.0 : 1.0) >= 0.5 * jump;
}

}  // namespace fpz::sph::detail
