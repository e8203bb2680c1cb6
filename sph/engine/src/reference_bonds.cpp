// Bonds of the reference configuration: built once from the undeformed body, cut where a crack has fully opened.
#include <algorithm>
#include <cmath>

#include "engine.hpp"
#include "plane.hpp"

namespace fpz::sph::detail {

template <int Dim>
void Engine<Dim>::build_reference_bonds() {
  lists = find_neighbours<Dim>(particles.start, particles.count, kernel_support * h);
  separate<Dim>(lists, setup.arrangement.cuts, particles.start);
  bonds = pack<Dim>(lists, particles.padded(), false);
  builds = 1;
  for (std::size_t i = 0; i < particles.count; ++i) write_row(i);
}

template <int Dim>
void Engine<Dim>::write_row(std::size_t i) {
  static_assert(Dim == 2, "the correction of plane.hpp");
  Particles<Dim>& p = particles;
  const std::size_t block = i / lanes;
  const auto first = static_cast<std::size_t>(bonds.column[block]);
  const auto width = static_cast<std::size_t>(bonds.column[block + 1]) - first;
  const double norm = kernel_norm<Dim>(setup.options.kernel, h) / (h * h);
  const auto entry = [&](std::size_t k) { return (first + k) * lanes + i % lanes; };
  Symmetric moment = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < width; ++k) {
    const bool real = k < lists[i].size();
    const std::size_t j = real ? static_cast<std::size_t>(lists[i][k]) : i;
    const double rx = p.start[0][j] - p.start[0][i];
    const double ry = p.start[1][j] - p.start[1][i];
    const double q = std::sqrt(rx * rx + ry * ry) / h;
    const double slope = real ? norm * (p.volume[i] * p.volume[j]) * kernel_slope(setup.options.kernel, q) : 0.0;
    bonds.neighbour[entry(k)] = static_cast<int>(j);
    bonds.weight[0][entry(k)] = slope * rx;
    bonds.weight[1][entry(k)] = slope * ry;
    moment.xx += slope * rx * rx;
    moment.yy += slope * ry * ry;
    moment.xy += slope * rx * ry;
  }
  const double inverse = 1.0 / p.volume[i];
  Symmetric c = correction_of({moment.xx * inverse, moment.yy * inverse, moment.xy * inverse});
  if (setup.options.momentum == MomentumForm::paper) {
    // L_i is on both stresses and on the velocity gradient alike: it goes into the weights of the row.
    for (std::size_t k = 0; k < width; ++k) {
      const double wx = bonds.weight[0][entry(k)];
      const double wy = bonds.weight[1][entry(k)];
      bonds.weight[0][entry(k)] = c.xx * wx + c.xy * wy;
      bonds.weight[1][entry(k)] = c.xy * wx + c.yy * wy;
    }
    c = {1.0, 1.0, 0.0};
  }
  p.correction[0][i] = c.xx;
  p.correction[1][i] = c.yy;
  p.correction[2][i] = c.xy;
}

template <int Dim>
void Engine<Dim>::release_bonds() {
  Particles<Dim>& p = particles;
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] != kind::cracked || p.point[i].crack.integrity >= setup.options.release_integrity) continue;
    const CohesiveState<double, Dim>& crack = p.point[i].crack;
    if (!(crack.jump[0] > 0.0)) continue;
    // The crack's normal in the undeformed body.
    const double nx = p.point[i].frame(0, 0);
    const double ny = p.point[i].frame(0, 1);
    std::vector<int> cut;
    for (const int neighbour : lists[i]) {
      const auto j = static_cast<std::size_t>(neighbour);
      const double rx = p.start[0][j] - p.start[0][i];
      const double ry = p.start[1][j] - p.start[1][i];
      // Displacement of j seen from i, turned back by the rotation of i.
      const double gx = p.position[0][j] - p.position[0][i];
      const double gy = p.position[1][j] - p.position[1][i];
      const double ux = p.rotation[0][i] * gx + p.rotation[1][i] * gy - rx;
      const double uy = p.rotation[0][i] * gy - p.rotation[1][i] * gx - ry;
      const double along = nx * rx + ny * ry;
      const double opening = (nx * ux + ny * uy) * (along < 0.0 ? -1.0 : 1.0);
      if (opening >= 0.5 * crack.jump[0]) cut.push_back(neighbour);
    }
    for (const int j : cut) {
      std::erase(lists[i], j);
      std::erase(lists[static_cast<std::size_t>(j)], static_cast<int>(i));
      changed.push_back(i);
      changed.push_back(static_cast<std::size_t>(j));
      ++released;
    }
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const std::size_t i : changed) write_row(i);
}

template void Engine<2>::build_reference_bonds();
template void Engine<2>::write_row(std::size_t);
template void Engine<2>::release_bonds();

}  // namespace fpz::sph::detail
