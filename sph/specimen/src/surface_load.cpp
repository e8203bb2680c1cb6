#include "fpz/specimen/surface_load.hpp"

#include <stdexcept>

#include "linear_weights.hpp"
#include "point_grid.hpp"

namespace fpz::specimen {

std::vector<Point> share_out(const std::vector<PointForce>& forces, const sph::Arrangement<2>& particles) {
  const double reach = 3.0 * particles.spacing;
  const detail::PointGrid grid(particles.position, reach);
  std::vector<Point> all(particles.size(), Point::Zero());
  for (const PointForce& f : forces) {
    std::vector<std::size_t> near;
    grid.near(f.at, reach, [&](std::size_t i) {
      if (particles.group[i] == sph::Arrangement<2>::specimen) near.push_back(i);
    });
    const std::vector<detail::ParticleWeight> weights = detail::linear_weights(f.at, reach, particles, near);
    if (weights.empty()) throw std::invalid_argument("a force acts where there are no particles to take it");
    for (const detail::ParticleWeight& w : weights) all[w.particle] += w.weight * f.force;
  }
  return all;
}

}  // namespace fpz::specimen
