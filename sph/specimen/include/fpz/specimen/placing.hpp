// Puts particles into a body and boundary particles on its surface.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fpz/specimen/geometry.hpp"
#include "fpz/sph/arrangement.hpp"
#include "fpz/words.hpp"

namespace fpz::specimen {

/// How the particles of the specimen lie.
struct Pattern {
  enum class Kind : std::uint8_t {
    lattice,   ///< squares, turned by `angle` about `origin` (a corner of a cell)
    sheared,   ///< rows parallel to x, each shifted so that columns follow a direction `angle` away from y
    rings,     ///< concentric rings of a disc, half disc or ring
    scattered  ///< even but without directions, half a spacing away from surfaces and cuts
  };
  Kind kind = Kind::lattice;
  double angle = 0.0;  ///< radian, counter-clockwise
  Point origin = Point::Zero();
  bool fit = false;        ///< lattice in a rectangle: cells stretched a little so that whole ones fill it (angle 0)
  double move = 0.0;       ///< lattice and rings: largest random displacement along x and along y, in spacings
  std::uint64_t seed = 1;  ///< of `scattered` and of `move`; the same seed gives the same bits
};

/// Particles of the specimen. The volume of each is the area of its cell, the part of the body that is nearest to it; a
/// lattice that fills its rectangle has one volume for all, rings one per ring. Their sum is the area of the body.
/// Particles of a lattice whose cells the surface cuts are in the middle of what is left of them. (Volumes that
/// do not follow the density of the particles would bend the vectors of the bonds over long ways.) `spacing` is the
/// wanted distance. Throws std::invalid_argument when the pattern does not suit the shape, or not all or none of the
/// particles fit.
[[nodiscard]] sph::Arrangement<2> place_specimen(const Body& body, const Pattern& pattern, double spacing);

/// A roller or platen: columns of particles on the surface.
struct Platen {
  Point at = Point::Zero();         ///< on the surface
  Point direction = Point::Zero();  ///< outward, any length but 0
  double width = 0.0;               ///< m; at least one column
  int layers = 3;
  enum class Fit : std::uint8_t {
    surface,  ///< every column begins on the surface
    flat,     ///< all begin where the outermost does
    jaw       ///< on a hollow arc of `jaw_radius` that touches the outermost
  };
  Fit fit = Fit::surface;
  double jaw_radius = 0.0;  ///< m
  /// Coefficient of Coulomb friction on the surface; none: the platen is bonded to it.
  std::optional<double> friction = std::nullopt;
};

/// Where the columns of a platen meet the surface of the shape from outside; nothing for one that misses it.
[[nodiscard]] std::vector<std::optional<Point>> platen_feet(const Shape& shape, const Platen& platen, double spacing);

/// A column of a platen: where it begins, and what of the surface is under it.
struct PlatenColumn {
  Point face = Point::Zero(), foot = Point::Zero();
};
/// Of the columns from left to right seen along -direction. Throws std::invalid_argument when one misses the body, or
/// is beyond the jaw.
[[nodiscard]] std::vector<PlatenColumn> platen_columns(const Shape& shape, const Platen& platen, double spacing);

/// The cuts on which the faces of a platen with friction and of the body meet: one for a platen that lies on a straight
/// surface, else one for each column.
[[nodiscard]] std::vector<sph::Cut<2>> contact_of(const Shape& shape, const Platen& platen, double spacing);

/// Adds the particles of a platen as group `group`. Throws std::invalid_argument when a column misses the body.
void place_platen(sph::Arrangement<2>& arrangement, const Shape& shape, const Platen& platen, int group);

}  // namespace fpz::specimen

namespace fpz {

template <>
struct Words<specimen::Platen::Fit> {
  static constexpr Word<specimen::Platen::Fit> list[] = {{specimen::Platen::Fit::surface, "surface"},
                                                         {specimen::Platen::Fit::flat, "flat"},
                                                         {specimen::Platen::Fit::jaw, "jaw"}};
};

}  // namespace fpz
