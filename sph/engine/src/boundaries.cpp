// Which boundary a group or a load of the set-up gets: the one place where the kinds are chosen.
#include <stdexcept>

#include "applied_load.hpp"
#include "bonded_platen.hpp"

namespace fpz::sph::detail {

template <int Dim>
void Boundary<Dim>::set_drive(std::size_t, const Drive&) {
  throw std::invalid_argument("this boundary has no drive");
}
template <int Dim>
void Boundary<Dim>::steer(std::size_t, double) {
  throw std::invalid_argument("this boundary cannot be steered");
}
template <int Dim>
void Boundary<Dim>::set_factor(const TimeTable&) {
  throw std::invalid_argument("this boundary is no load");
}

template <int Dim>
Boundaries<Dim> make_boundaries(RunData<Dim>& run) {
  Boundaries<Dim> all;
  for (std::size_t g = 0; g < run.setup.groups.size(); ++g) {
    all.push_back(std::make_unique<BondedPlaten<Dim>>(run, g));
  }
  for (std::size_t k = 0; k < run.setup.loads.size(); ++k) all.push_back(std::make_unique<AppliedLoad<Dim>>(run, k));
  return all;
}

template class Boundary<2>;
template Boundaries<2> make_boundaries<2>(RunData<2>&);

}  // namespace fpz::sph::detail
