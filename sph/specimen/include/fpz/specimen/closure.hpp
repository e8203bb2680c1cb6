// Faces of notches that have met, where nothing keeps them apart, or not enough.
#pragma once

#include <string>
#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen {

/// How far the two faces of a notch are inside each other where they are farthest, m; 0 where they have not met. From
/// the places of the particles at the start and their displacements (m): each of the row beside one face against the
/// one opposite, along the normal at the start, less the width that the notch was asked to have.
[[nodiscard]] double face_overlap(const Notch& notch, const std::vector<Point>& start,
                                  const std::vector<Point>& displacement, double spacing);

/// What a person must know when faces overlap by more than a thousandth of the spacing: rock under a compression of
/// that would be near its strength. Empty otherwise. `overlap`: of each notch.
[[nodiscard]] std::string warning_of_closure(const std::vector<double>& overlap, double spacing);

/// The same of faces in contact (m, the largest overlap): above a hundredth of the spacing their contact is too soft.
[[nodiscard]] std::string warning_of_overlap(double overlap, double spacing);

}  // namespace fpz::specimen
