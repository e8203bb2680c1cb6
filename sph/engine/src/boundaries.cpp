// Which boundary a group or a load of the set-up gets: the one place where the kinds are chosen.
#include <stdexcept>

#include "applied_load.hpp"
#include "bonded_platen.hpp"
#include "hinged_platen.hpp"

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
std::vector<std::size_t> slots_of_group(const RunData<Dim>& run, std::size_t group) {
  std::vector<std::size_t> slots;
  for (std::size_t i = 0; i < run.particles.count; ++i) {
    if (run.setup.arrangement.group[run.particles.id[i]] == static_cast<int>(group)) slots.push_back(i);
  }
  return slots;
}

template <int Dim>
Boundaries<Dim> make_boundaries(RunData<Dim>& run) {
  Boundaries<Dim> all;
  for (std::size_t g = 0; g < run.setup.groups.size(); ++g) {
    if (run.setup.groups[g].hinge) {
      all.push_back(std::make_unique<HingedPlaten<Dim>>(run, g));
    } else {
      all.push_back(std::make_unique<BondedPlaten<Dim>>(run, g));
    }
  }
  for (std::size_t k = 0; k < run.setup.loads.size(); ++k) all.push_back(std::make_unique<AppliedLoad<Dim>>(run, k));
  return all;
}

template class Boundary<2>;
template std::vector<std::size_t> slots_of_group<2>(const RunData<2>&, std::size_t);
template Boundaries<2> make_boundaries<2>(RunData<2>&);

}  // namespace fpz::sph::detail
