// Checks of the particles themselves, wherever they come from.
#pragma once

#include <string>
#include <vector>

#include "fpz/specimen/scene.hpp"
#include "fpz/sph/arrangement.hpp"

namespace fpz::specimen::detail {

/// What is senseless (the problems) and what is doubtful about the particles of a scene, one text each.
struct ParticleFindings {
  std::vector<std::string> problems, warnings;
};

/// Distances against the spacing, particles on top of each other, particles and boundaries without neighbours; of
/// particles from a file also volumes against distances, and gauges that are far from all of them.
[[nodiscard]] ParticleFindings check_particles(const Scene& scene, const sph::Arrangement<2>& particles);

}  // namespace fpz::specimen::detail
