// Tractions on parts of a surface, as forces on particles.
#pragma once

#include <functional>
#include <vector>

#include "fpz/specimen/geometry.hpp"
#include "fpz/specimen/loading.hpp"
#include "fpz/sph/arrangement.hpp"

namespace fpz::specimen {

/// A straight piece of the surface, shorter than a spacing, and the particles that take what acts on it.
struct SurfacePiece {
  struct Share {
    std::size_t particle;
    double weight;  ///< of all particles of the piece: 1 in sum
  };
  Point from = Point::Zero(), to = Point::Zero();
  Point normal = Point::Zero();  ///< outward, unit length
  bool covered = false;          ///< particles of a group are bonded to it
  std::vector<Share> shares;     ///< none where it is covered

  [[nodiscard]] double length() const { return (to - from).norm(); }
  [[nodiscard]] Point middle() const { return 0.5 * (from + to); }
};

/// The surface of the body of an arrangement (Arrangement::surface) in pieces. The forces of any tractions on them have
/// the sum of the tractions times the lengths and their moment, and one pressure on all pieces that are not covered is
/// in balance with an even stress: the shares of a particle, times normals and lengths, sum up to its area vector
/// (area_vectors.hpp), except beside groups and cuts. Among such shares they are those nearest to weights that fall off
/// within three spacings, in least squares.
[[nodiscard]] std::vector<SurfacePiece> share_surface(const Body& body, const sph::Arrangement<2>& particles,
                                                      const std::vector<Point>& area_vectors);

/// Which part of a piece, from 0 to 1, is where `inside` holds; it may begin and end within the piece.
[[nodiscard]] double part_inside(const SurfacePiece& piece, const std::function<bool(const Point&)>& inside);

/// Which part of each piece, from 0 to 1, is on one of the parts of the surface.
[[nodiscard]] std::vector<double> loaded_parts(const Body& body, const std::vector<SurfacePart>& on,
                                               const std::vector<SurfacePiece>& pieces, double spacing);

/// One force per particle, N (per metre of thickness): `traction` is that on a piece (Pa), `part` what it acts on.
[[nodiscard]] std::vector<Point> forces_of(const std::vector<SurfacePiece>& pieces, std::size_t particles,
                                           const std::function<Point(const SurfacePiece&)>& traction,
                                           const std::vector<double>& part);

}  // namespace fpz::specimen
