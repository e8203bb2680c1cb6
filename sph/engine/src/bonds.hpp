// Neighbour lists as the inner loops want them, and the search that fills them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fpz/sph/cut.hpp"
#include "fpz/sph/particles.hpp"
#include "team.hpp"

namespace fpz::sph::detail {

/// Neighbours of every particle in ascending order, without itself.
using NeighbourLists = std::vector<std::vector<int>>;

/// All pairs closer than `reach`, by a cell list over sorted cell keys (memory does not grow with the empty space
/// between pieces). Non-finite positions find nothing.
template <int Dim>
[[nodiscard]] NeighbourLists find_neighbours(Team& team, const Fields<Dim>& position, std::size_t count, double reach);

/// Drops the pairs whose connecting line at the start crosses a cut.
template <int Dim>
void separate(NeighbourLists& lists, const std::vector<Cut<Dim>>& cuts, const Fields<Dim>& start);

/// Drops the pairs of which the cuts leave nothing (share_of_bond).
template <int Dim>
void drop_without_share(NeighbourLists& lists, const std::vector<Cut<Dim>>& cuts, const Fields<Dim>& start,
                        double spacing);

/// Order of points along a Morton curve with cells of the given size: order[slot] is the point's index. Ties by index.
template <int Dim>
[[nodiscard]] std::vector<std::size_t> curve_order(const std::vector<Vec<double, Dim>>& points, double cell);

/// Sliced ELLPACK: per block of lanes as many columns as its longest list; padding refers to the particle itself.
template <int Dim>
struct Bonds {
  std::vector<int> column;     ///< first column of each block, and the end
  std::vector<int> neighbour;  ///< (column, lane)
  Fields<Dim> weight;
  Field closeness;

  [[nodiscard]] std::size_t entries() const { return neighbour.size(); }
  /// Place of the k-th neighbour of particle i.
  [[nodiscard]] std::size_t entry(std::size_t i, std::size_t k) const {
    return (static_cast<std::size_t>(column[i / lanes]) + k) * lanes + i % lanes;
  }
};

/// A bond that a crack has cut.
template <int Dim>
struct ReleasedBond {
  std::size_t from, to;     ///< slots
  Vec<double, Dim> normal;  ///< of the crack in the undeformed body, unit, from one to the other
  bool pressed;             ///< the crack was under pressure: its faces touch, however far they have been moved apart
};

/// Lays the lists out; weights are zero, `with_closeness` allocates that field too.
template <int Dim>
[[nodiscard]] Bonds<Dim> pack(const NeighbourLists& lists, std::size_t padded, bool with_closeness);

}  // namespace fpz::sph::detail
