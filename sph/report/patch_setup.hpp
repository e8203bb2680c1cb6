// Runs of the engine for the patch tests.
#pragma once

#include "fpz/specimen/placing.hpp"
#include "fpz/sph/simulation.hpp"

namespace fpz::report {

/// A body of rock in plane strain, free all round, one thread.
[[nodiscard]] sph::RunSetup<2> patch_setup(const specimen::Body& body, const specimen::Pattern& pattern,
                                           double spacing);

}  // namespace fpz::report
