// Onset on a plane of its own strength that a particle has.
#pragma once

#include <optional>

#include "fpz/state.hpp"
#include "particle_materials.hpp"

namespace fpz::sph::detail {

/// A point that has just cracked on its weak plane, and the strain that is left of its increment.
template <int Dim>
struct OpenedPlane {
  State<double, Dim> state;
  Tensor<double, Dim> rest;
};

/// Follows the elastic stress of particle i along its strain increment from `begin`, uncracked: its state where the
/// weak plane fails, if it does and no plane of the material itself fails before. Nothing for other particles.
template <int Dim>
[[nodiscard]] std::optional<OpenedPlane<Dim>> opened_weak_plane(const ParticleMaterials<Dim>& materials, std::size_t i,
                                                                const State<double, Dim>& begin,
                                                                const Tensor<double, Dim>& increment);

}  // namespace fpz::sph::detail
