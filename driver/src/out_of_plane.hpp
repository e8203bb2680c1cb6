// Whether a 2-D path goes beyond the onset on planes that its setting does not see.
#pragma once

#include <string>

#include "fpz/driver/run.hpp"

namespace fpz::driver {

/// What a person must know when an uncracked state of the path would have cracked in 3-D, on a plane inclined out of
/// the plane of the setting: where, and the stresses there. Empty otherwise, and in 3-D.
[[nodiscard]] std::string warning_out_of_plane(const Test& test, const Result& result);

}  // namespace fpz::driver
