// Forces that act on the surface of a body, as forces on its particles.
#pragma once

#include <vector>

#include "fpz/specimen/geometry.hpp"
#include "fpz/sph/arrangement.hpp"

namespace fpz::specimen {

struct PointForce {
  Point at = Point::Zero();     ///< on or near the body
  Point force = Point::Zero();  ///< N (per metre of thickness)
};

/// One force per particle of the arrangement, which do the work of the point forces in every linear field of
/// displacements: their sums and moments are those of the point forces. Each is shared out within three spacings, with
/// weights linear in the place times (1 - q^2)^2 and the volume. Particles of groups get nothing. Throws
/// std::invalid_argument when fewer than three particles are near a force.
[[nodiscard]] std::vector<Point> share_out(const std::vector<PointForce>& forces, const sph::Arrangement<2>& particles);

}  // namespace fpz::specimen
