#include "linear_weights.hpp"

#include "fpz/sph/linear_fit.hpp"

namespace fpz::specimen::detail {

std::vector<ParticleWeight> linear_weights(const Point& at, double reach, const sph::Arrangement<2>& particles,
                                           const std::vector<std::size_t>& near) {
  std::vector<Point> seen;
  std::vector<double> volume;
  for (const std::size_t i : near) {
    seen.emplace_back((particles.position[i] - at) / reach);
    volume.push_back(particles.volume[i]);
  }
  const sph::LinearFit fit(seen, volume);
  if (!fit.is_determined()) return {};
  const std::vector<double> weight = fit.weights(Eigen::Vector3d::UnitX());
  std::vector<ParticleWeight> weights;
  for (std::size_t k = 0; k < near.size(); ++k) weights.push_back({near[k], weight[k]});
  return weights;
}

}  // namespace fpz::specimen::detail
