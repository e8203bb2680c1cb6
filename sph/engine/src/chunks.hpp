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
  const int team = team_size(setup.options.threads);
#pragma omp parallel for schedule(dynamic, 1) num_threads(team) if (team > 1 && chunks > 1)
  for (Index c = 0; c < chunks; ++c) f(c * chunk_blocks, std::min((c + 1) * chunk_blocks, blocks));
}

}  // namespace fpz::sph::detail
