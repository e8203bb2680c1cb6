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

}  // namespace fpz::sph::detail
