#include "linear_weights.hpp"

#include <Eigen/LU>

namespace fpz::specimen::detail {

std::vector<ParticleWeight> linear_weights(const Point& at, double reach, const sph::Arrangement<2>& particles,
                                           const std::vector<std::size_t>& near) {
  std::vector<Eigen::Vector3d> terms;  // weight times (1, x, y), seen from the place in units of the reach
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::size_t i : near) {
    const Point x = (particles.position[i] - at) / reach;
    const double bell = 1.0 - x.squaredNorm();
    const Eigen::Vector3d place(1.0, x[0], x[1]);
    terms.emplace_back(bell * bell * particles.volume[i] / (reach * reach) * place);
    moments += terms.back() * place.transpose();
  }
  Eigen::FullPivLU<Eigen::Matrix3d> factors(moments);
  factors.setThreshold(1e-9);
  if (near.size() < 3 || !factors.isInvertible()) return {};
  const Eigen::Vector3d constants = factors.solve(Eigen::Vector3d::UnitX());
  std::vector<ParticleWeight> weights;
  for (std::size_t k = 0; k < near.size(); ++k) weights.push_back({near[k], terms[k].dot(constants)});
  return weights;
}

}  // namespace fpz::specimen::detail
