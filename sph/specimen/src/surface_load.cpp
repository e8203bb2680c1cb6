#include "fpz/specimen/surface_load.hpp"

#include <Eigen/LU>
#include <stdexcept>

#include "point_grid.hpp"

namespace fpz::specimen {

std::vector<Point> share_out(const std::vector<PointForce>& forces, const sph::Arrangement<2>& particles) {
  struct Share {
    std::size_t particle;
    Eigen::Vector3d terms;  ///< weight times (1, x, y), seen from the force in units of the reach
  };
  const double reach = 3.0 * particles.spacing;
  const detail::PointGrid grid(particles.position, reach);
  std::vector<Point> all(particles.size(), Point::Zero());
  for (const PointForce& f : forces) {
    std::vector<Share> shares;
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    grid.near(f.at, reach, [&](std::size_t i) {
      if (particles.group[i] != sph::Arrangement<2>::specimen) return;
      const Point x = (particles.position[i] - f.at) / reach;
      const double bell = 1.0 - x.squaredNorm();
      const Eigen::Vector3d place(1.0, x[0], x[1]);
      shares.push_back({i, bell * bell * particles.volume[i] / (reach * reach) * place});
      moments += shares.back().terms * place.transpose();
    });
    const Eigen::FullPivLU<Eigen::Matrix3d> factors(moments);
    if (shares.size() < 3 || !factors.isInvertible()) {
      throw std::invalid_argument("a force acts where there are no particles to take it");
    }
    const Eigen::Vector3d constants = factors.solve(Eigen::Vector3d::UnitX());
    for (const Share& s : shares) all[s.particle] += s.terms.dot(constants) * f.force;
  }
  return all;
}

}  // namespace fpz::specimen
