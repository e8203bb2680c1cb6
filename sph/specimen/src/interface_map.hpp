// Which particles are beside the interfaces of a scene.
#pragma once

#include "fpz/specimen/scene.hpp"
#include "fpz/sph/simulation.hpp"

namespace fpz::specimen::detail {

/// Particles that may crack on the plane of an interface are no further from it, in spacings: with fewer the material
/// beside it cracks too, which shares the opening whatever its strength (docs/method-materials.md).
inline constexpr double interface_reach = 1.5;

/// Gives particles of the specimen the planes of the interfaces beside them; later ones go before earlier ones. Throws
/// std::invalid_argument for an interface without particles.
void assign_interfaces(const Scene& scene, sph::RunSetup<2>& setup);

/// The pieces of an interface that are in the body, for drawing.
[[nodiscard]] std::vector<std::vector<Point>> lines_in_body(const Interface& interface, const Body& body, double step);

/// Particles that each of them has.
[[nodiscard]] std::vector<std::size_t> interface_particles(const Scene& scene, const sph::RunSetup<2>& setup);

}  // namespace fpz::specimen::detail
