// What the particles of a body are made of, where it is not one material alone.
#pragma once

#include <vector>

#include "fpz/parameters.hpp"
#include "fpz/types.hpp"

namespace fpz::sph {

/// Materials besides that of RunSetup::parameters, which is material 0, and who has them.
struct Materials {
  std::vector<Parameters> further;  ///< materials 1, 2, ...; rve_length is ignored
  std::vector<int> of_particle;     ///< in the order of the arrangement; empty: all have material 0
  /// Of the tensile strength and the cohesion of the particle's material, likewise; empty: 1.
  std::vector<double> strength_factor;

  [[nodiscard]] std::size_t count() const { return 1 + further.size(); }
  [[nodiscard]] std::size_t of(std::size_t id) const {
    return of_particle.empty() ? 0 : static_cast<std::size_t>(of_particle[id]);
  }
  [[nodiscard]] double strength(std::size_t id) const { return strength_factor.empty() ? 1.0 : strength_factor[id]; }
};

/// Planes through particles that have a strength of their own: bedding, mortar joints. A particle cracks on its plane
/// or on the critical one of its material, whichever fails first. In `reference`.
template <int Dim>
struct WeakPlanes {
  std::vector<Parameters> parameters;    ///< of kinds of planes; elasticity and density are those of the particles
  std::vector<int> of_particle;          ///< kind, in the order of the arrangement; -1: none; empty: nowhere
  std::vector<Vec<double, Dim>> normal;  ///< unit, likewise

  static constexpr int none = -1;
};

}  // namespace fpz::sph
