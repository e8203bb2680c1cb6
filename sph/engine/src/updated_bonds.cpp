// Neighbour lists of the updated configuration: with a skin, made anew only when something moved far enough.
#include "engine.hpp"

namespace fpz::sph::detail {

template <int Dim>
void Engine<Dim>::rebuild_lists() {
  const double skin = setup.options.skin * setup.arrangement.spacing;
  lists = find_neighbours<Dim>(particles.position, particles.count, kernel_support * h + skin);
  separate<Dim>(lists, setup.arrangement.cuts, particles.start);
  bonds = pack<Dim>(lists, particles.padded(), true);
  built_at = particles.position;
  ++builds;
}

template <int Dim>
bool Engine<Dim>::lists_outdated() const {
  const double limit = 0.5 * setup.options.skin * setup.arrangement.spacing;
  bool outdated = false;
  for (std::size_t i = 0; i < particles.count; ++i) {
    double moved = 0.0;
    for (std::size_t c = 0; c < dimensions; ++c) {
      const double d = particles.position[c][i] - built_at[c][i];
      moved += d * d;
    }
    outdated |= moved > limit * limit;
  }
  return outdated;
}

template void Engine<2>::rebuild_lists();
template bool Engine<2>::lists_outdated() const;

}  // namespace fpz::sph::detail
