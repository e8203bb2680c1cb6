// The check every forward model makes before it computes anything.
#pragma once

#include <string>

#include "fpz/parameters.hpp"

namespace fpz::calibration {

/// Why the parameters break a constraint of the model, in words; empty when they do not. Density is not looked at, and
/// the RVE length only `with_length`: no test of a single zone depends on them.
[[nodiscard]] std::string why_inadmissible(Parameters p, Setting setting = Setting::plane_strain,
                                           bool with_length = false);

}  // namespace fpz::calibration
