// The order in which a step goes over the blocks. The force of a block reads the strains of its neighbours, so a pass
// for each would do; in bodies that are larger than the caches both then wait for memory. In one sweep the force of a
// chunk of blocks follows the strain of the last chunk that neighbours it, while these are still at hand. What happens
// between the passes (cracks, contact, pushes) changes the forces of few blocks: those are held until it is done. The
// same functions run on the same numbers: no bit changes with the order.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "run_data.hpp"

namespace fpz::sph::detail {

template <int Dim>
class Sweep {
 public:
  /// Finds which chunks neighbour each other, by the bonds of the body and of the zero-energy control; whenever a block
  /// has got new neighbours.
  void plan(const View<Dim>& view, std::size_t blocks, Index chunk_blocks);

  /// A new step, in one sweep or in two passes.
  void begin(bool in_one) {
    in_one_ = in_one;
    ++step_;
  }
  [[nodiscard]] bool in_one() const { return in_one_; }
  /// Part of the blocks that had their force before finish() in this step.
  [[nodiscard]] double early_part() const;

  /// Leaves the force of a particle's block to finish(); before its step's strains.
  void hold(std::size_t particle) { held_[particle / lanes].store(step_, std::memory_order_relaxed); }
  /// The same for the blocks that neighbour the block of particle i too; before strained() of its chunk.
  void hold_around(const View<Dim>& view, std::size_t i);

  /// The chunk has its strains: calls force(first, last) for blocks that have all they need now. On any thread.
  template <class Force>
  void strained(Index chunk, Force&& force);
  /// Calls force(first, last) for the blocks of a chunk that have not had theirs, after all strains; in one sweep.
  template <class Force>
  void finish(Index chunk, Force&& force) const;

 private:
  using Step = std::uint32_t;
  using Marks = std::unique_ptr<std::atomic<Step>[]>;
  /// Chunks of each chunk, one after the other.
  struct Lists {
    std::vector<int> first, chunk;
  };

  [[nodiscard]] bool is_held(Index block) const {
    return held_[static_cast<std::size_t>(block)].load(std::memory_order_relaxed) == step_;
  }
  [[nodiscard]] bool has_all(std::size_t chunk) const;
  [[nodiscard]] Index end_of(Index chunk) const { return std::min((chunk + 1) * chunk_blocks_, blocks_); }

  Index blocks_ = 0, chunk_blocks_ = 1;
  Lists needs_;    ///< whose strains the force of a chunk needs
  Lists follows_;  ///< whose last need a chunk is
  bool in_one_ = false;
  Step step_ = 0;
  Marks held_;  ///< the last step in which a block was held
  Marks done_;  ///< the last step in which the strains of a chunk were made early enough for others to go on
  std::vector<Step> early_;  ///< the last step in which a chunk had its force, held blocks excepted, before finish()
};

template <int Dim>
bool Sweep<Dim>::has_all(std::size_t chunk) const {
  for (int k = needs_.first[chunk]; k < needs_.first[chunk + 1]; ++k) {
    const auto need = static_cast<std::size_t>(needs_.chunk[static_cast<std::size_t>(k)]);
    if (done_[need].load(std::memory_order_acquire) != step_) return false;
  }
  return true;
}

template <int Dim>
template <class Force>
void Sweep<Dim>::strained(Index chunk, Force&& force) {
  const auto c = static_cast<std::size_t>(chunk);
  done_[c].store(step_, std::memory_order_release);
  for (int k = follows_.first[c]; k < follows_.first[c + 1]; ++k) {
    const int ready = follows_.chunk[static_cast<std::size_t>(k)];
    if (!has_all(static_cast<std::size_t>(ready))) continue;
    early_[static_cast<std::size_t>(ready)] = step_;
    const Index end = end_of(ready);
    for (Index b = Index{ready} * chunk_blocks_; b < end; ++b) {
      const Index first = b;
      while (b < end && !is_held(b)) ++b;
      if (b > first) force(first, b);
    }
  }
}

template <int Dim>
template <class Force>
void Sweep<Dim>::finish(Index chunk, Force&& force) const {
  const Index begin = chunk * chunk_blocks_, end = end_of(chunk);
  if (early_[static_cast<std::size_t>(chunk)] != step_) {
    force(begin, end);
    return;
  }
  for (Index b = begin; b < end; ++b) {
    const Index first = b;
    while (b < end && is_held(b)) ++b;
    if (b > first) force(first, b);
  }
}

}  // namespace fpz::sph::detail
