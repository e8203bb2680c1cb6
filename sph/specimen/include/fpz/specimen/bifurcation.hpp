// Several cracks where a person may think of one.
#pragma once

#include <string>
#include <vector>

#include "fpz/specimen/crack.hpp"

namespace fpz::specimen {

/// Says how many cracks are at least half as long as the longest, and no shorter than six spacings, if it is not the
/// only one: a symmetric specimen has bifurcated, its load and energies are those of all of them. Empty otherwise.
[[nodiscard]] std::string warning_of_bifurcation(const std::vector<CrackPath>& longest_first, double spacing);

}  // namespace fpz::specimen
