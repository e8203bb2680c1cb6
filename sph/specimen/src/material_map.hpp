// Which particle is of which material of a scene.
#pragma once

#include "fpz/specimen/scene.hpp"
#include "fpz/sph/simulation.hpp"

namespace fpz::specimen::detail {

/// Of a place of the body: the material of the last region that covers it.
[[nodiscard]] std::size_t material_at(const Scene& scene, const Point& x);
[[nodiscard]] const Parameters& parameters_at(const Scene& scene, const Point& x);

/// Gives the particles of the arrangement their materials: those of their boundaries and regions; of particles from a
/// file that names them, the ones that it says where no region with a shape covers them. Throws std::invalid_argument
/// for a region without particles and for numbers that are no region's.
void assign_materials(const Scene& scene, sph::RunSetup<2>& setup);

/// What a material has become.
struct MaterialShare {
  std::string name;
  const Parameters* parameters = nullptr;
  std::size_t particles = 0;
  double area = 0.0;  ///< m^2
};
/// Of all materials of a scene, the first one included.
[[nodiscard]] std::vector<MaterialShare> material_shares(const Scene& scene, const sph::RunSetup<2>& setup);

}  // namespace fpz::specimen::detail
