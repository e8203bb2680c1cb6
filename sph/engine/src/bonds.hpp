// Neighbour lists as the inner loops want them, and the search that fills them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fpz/sph/cut.hpp"
#include "fpz/sph/particles.hpp"
#include "team.hpp"
#include "view.hpp"

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

/// Lines between particles that are the same but for the rounding of positions get the same bits; as many kinds as a
/// lattice has. The opposite line gets the opposite.
class AlikeBonds {
 public:
  explicit AlikeBonds(double spacing) : near_(1e-11 * spacing) {}
  [[nodiscard]] Vec<double, 2> operator()(const Vec<double, 2>& line);

 private:
  static constexpr std::size_t most_kinds = 64;
  double near_;  ///< m
  std::vector<Vec<double, 2>> kinds_;
};

/// What a bond has besides its vector.
enum class Beside : bool { nothing, a_number };

/// Sliced ELLPACK: per block of lanes as many columns as its longest list; padding refers to the particle itself. Where
/// the neighbours of a column follow one another, as on a lattice in the order of its rows, they are loaded at once.
/// Blocks whose lanes all have the same bonds share one table of them (a stencil) with all blocks alike.
template <int Dim>
struct Bonds {
  std::vector<int> column;     ///< first column of each block, and the end
  std::vector<int> neighbour;  ///< (column, lane)
  std::vector<int> run;        ///< of each column: its first neighbour, where those of all lanes follow it; else -1
  Fields<Dim> weight;          ///< (column, lane)
  Field beside;                ///< (column, lane), or empty
  std::vector<int> shared;     ///< of each block: first entry of its stencil, -1: none
  Fields<Dim> stencil_weight;  ///< the columns of one stencil after those of another
  Field stencil_beside;

  /// Finds the stencils; after all weights were written.
  void share();
  /// Of a block of which a row was written anew: finds its runs again, its weights are its own from now on.
  void own(std::size_t block);
  [[nodiscard]] BondView<Dim> view();
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

/// Lays the lists out; weights are zero.
template <int Dim>
[[nodiscard]] Bonds<Dim> pack(const NeighbourLists& lists, std::size_t padded, Beside beside);

}  // namespace fpz::sph::detail
