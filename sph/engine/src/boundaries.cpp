// Which boundary a group of the set-up gets: the one place where the kinds are chosen.
#include "bonded_platen.hpp"

namespace fpz::sph::detail {

template <int Dim>
Boundaries<Dim> make_boundaries(RunData<Dim>& run) {
  Boundaries<Dim> all;
  for (std::size_t g = 0; g < run.setup.groups.size(); ++g) {
    all.push_back(std::make_unique<BondedPlaten<Dim>>(run, g));
  }
  return all;
}

template Boundaries<2> make_boundaries<2>(RunData<2>&);

}  // namespace fpz::sph::detail
