// Particles as squares coloured by classes of a value.
#pragma once

#include <string>
#include <vector>

#include "fpz/io/picture.hpp"
#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen::detail {

struct ColourClass {
  std::string title, colour;
};

/// One map: which class every particle has.
struct ParticleMap {
  std::string title;
  std::vector<Point> at;
  std::vector<std::size_t> colour;  ///< index of the class
  std::vector<io::Series> lines;    ///< on top, in mm
};

/// A picture of maps below (wide bodies) or beside each other, equal scales, coordinates in mm, with a legend. Squares
/// are `size` wide, m.
[[nodiscard]] io::Picture map_picture(const std::string& name, const std::vector<ParticleMap>& maps,
                                      const std::vector<ColourClass>& classes, double size, int legend_columns);

}  // namespace fpz::specimen::detail
