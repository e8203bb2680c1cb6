// Work dealt out to the threads.
#pragma once

#include <algorithm>

#include "run_data.hpp"

namespace fpz::sph::detail {

template <int Dim>
template <class F>
void RunData<Dim>::for_chunks(F&& f) const {
  const auto blocks = static_cast<Index>(particles.blocks());
  const Index chunks = (blocks + chunk_blocks - 1) / chunk_blocks;
  team.run(chunks, [&](std::int64_t c) {
    const auto first = static_cast<Index>(c) * chunk_blocks;
    f(first, std::min(first + chunk_blocks, blocks));
  });
}

template <int Dim>
template <class F>
void RunData<Dim>::for_cracked(F&& f) const {
  constexpr std::size_t at_once = 16;
  team.run(static_cast<std::int64_t>((cracked.size() + at_once - 1) / at_once), [&](std::int64_t k) {
    const std::size_t first = static_cast<std::size_t>(k) * at_once;
    for (std::size_t c = first; c < std::min(first + at_once, cracked.size()); ++c) f(cracked[c]);
  });
}

}  // namespace fpz::sph::detail
