#include "sweep.hpp"

#include <algorithm>

#include "sort_unique.hpp"

namespace fpz::sph::detail {

namespace {

/// Calls f(block) for the neighbours of a block, some several times; the block itself is among them.
template <int Dim, class F>
void for_neighbours(const BondView<Dim>& bonds, std::size_t block, F&& f) {
  constexpr auto n = static_cast<int>(lanes);
  for (int k = bonds.column[block]; k < bonds.column[block + 1]; ++k) {
    if (const int first = bonds.run[k]; first >= 0) {
      f(static_cast<std::size_t>(first / n));
      f(static_cast<std::size_t>((first + n - 1) / n));
    } else {
      for (int m = k * n; m < (k + 1) * n; ++m) f(static_cast<std::size_t>(bonds.neighbour[m] / n));
    }
  }
}

}  // namespace

template <int Dim>
void Sweep<Dim>::plan(const View<Dim>& view, std::size_t blocks, Index chunk_blocks) {
  const auto size = static_cast<std::size_t>(chunk_blocks);
  const std::size_t chunks = (blocks + size - 1) / size;
  blocks_ = static_cast<Index>(blocks);
  chunk_blocks_ = chunk_blocks;
  needs_ = {{0}, {}};
  std::vector<std::vector<int>> following(chunks);
  std::vector<std::size_t> near;
  for (std::size_t c = 0; c < chunks; ++c) {
    near = {c};
    const auto add = [&](std::size_t block) {
      if (block / size != near.back()) near.push_back(block / size);
    };
    for (std::size_t b = c * size; b < std::min((c + 1) * size, blocks); ++b) {
      for_neighbours(view.bonds, b, add);
      if (view.controlled) for_neighbours(view.control_bonds, b, add);
    }
    sort_unique(near);
    for (const std::size_t k : near) needs_.chunk.push_back(static_cast<int>(k));
    needs_.first.push_back(static_cast<int>(needs_.chunk.size()));
    following[near.back()].push_back(static_cast<int>(c));
  }
  follows_ = {{0}, {}};
  for (const std::vector<int>& list : following) {
    follows_.chunk.insert(follows_.chunk.end(), list.begin(), list.end());
    follows_.first.push_back(static_cast<int>(follows_.chunk.size()));
  }
  if (early_.size() == chunks) return;
  held_ = std::make_unique<std::atomic<Step>[]>(blocks);
  done_ = std::make_unique<std::atomic<Step>[]>(chunks);
  early_.assign(chunks, 0);
}

template <int Dim>
void Sweep<Dim>::hold_around(const View<Dim>& view, std::size_t i) {
  const auto mark = [this](std::size_t block) { hold(block * lanes); };
  mark(i / lanes);
  for_neighbours(view.bonds, i / lanes, mark);
  if (view.controlled) for_neighbours(view.control_bonds, i / lanes, mark);
}

template <int Dim>
double Sweep<Dim>::early_part() const {
  if (!in_one_) return 0.0;
  Index early = 0;
  for (Index b = 0; b < blocks_; ++b) {
    early += early_[static_cast<std::size_t>(b / chunk_blocks_)] == step_ && !is_held(b) ? 1 : 0;
  }
  return static_cast<double>(early) / static_cast<double>(blocks_);
}

template class Sweep<2>;

}  // namespace fpz::sph::detail
