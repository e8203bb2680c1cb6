// Largest loads of bending specimens: what is left of a test that had no gauge, or was not stable.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "fpz/calibration/notched_specimen.hpp"

namespace fpz::calibration {

struct PeakLoadSpecimen {
  NotchedSpecimen specimen;
  std::shared_ptr<CondensationCache> cache = std::make_shared<CondensationCache>();
};

struct PeakLoadTest {
  std::vector<PeakLoadSpecimen> specimens;
};

[[nodiscard]] inline std::string_view unit_of_value(const PeakLoadTest& /*test*/, std::size_t /*k*/) { return "N"; }

/// Largest load of each specimen (N) under a growing opening of the notch, whether its deflection or CMOD would snap
/// back or not. Exact derivatives.
[[nodiscard]] Prediction predict(const PeakLoadTest& test, const Parameters& parameters, bool derivatives);

/// The specimens, for readings of their largest loads other than the cohesive model's.
[[nodiscard]] std::vector<NotchedSpecimen> peak_specimens(const PeakLoadTest& test);

}  // namespace fpz::calibration
