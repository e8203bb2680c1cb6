// What the cracked particles of a specimen say about its cracks: area, paths, pieces.
#pragma once

#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen {

/// A particle of the specimen in the undeformed body.
struct Spot {
  Point at = Point::Zero();
  double volume = 0.0;             ///< m^2
  double damage = 0.0;             ///< D, 0 to 1
  Point normal = Point(1.0, 0.0);  ///< of the crack plane, unit
};

/// Length of all cracks, m: the projection of the band of cracked particles on the crack. Through each particle passes
/// a strip along its normal, two spacings to either side along the crack (a hat function) and 4.5 spacings long on
/// either side; all cracked particles in the strip make up one crack, which counts with the damage of those that opened
/// most (the mean with the weights D^2; the largest would be that of an outlier).
/// So a fully open crack counts with its length however many columns it takes (within 4 % in any direction of a
/// lattice), and one that is still opening with D of it, because the cohesive law has then dissipated the part D of G
/// (mode I).
[[nodiscard]] double opened_length(const std::vector<Spot>& spots, double spacing);

/// Middle lines of the bands of particles with a damage of at least `threshold`, longest first; each from end to end.
struct CrackPath {
  std::vector<Point> points;
  std::vector<double> damage;
  [[nodiscard]] double length() const;
};
[[nodiscard]] std::vector<CrackPath> crack_paths(const std::vector<Spot>& spots, double spacing,
                                                 double threshold = 0.5);

/// Areas of the pieces into which particles with a damage above `threshold`, and notches, divide the specimen; largest
/// first, m^2.
[[nodiscard]] std::vector<double> piece_areas(const std::vector<Spot>& spots, const std::vector<Notch>& notches,
                                              double spacing, double threshold = 0.99);

}  // namespace fpz::specimen
