// Numbers with their derivatives with respect to all calibrated parameters. Only sources that evaluate a model with
// them include this header: it makes every template of the law twice as expensive to compile.
#pragma once

#include <ceres/jet.h>

#include <cstddef>

#include "fpz/calibration/parameter.hpp"

namespace fpz::calibration {

using Jet = ceres::Jet<double, parameter_count>;

/// The parameters, each the seed of its own derivative.
[[nodiscard]] inline BasicParameters<Jet> seeded(const Parameters& p) {
  BasicParameters<Jet> out;
  out.density = Jet(p.density);
  out.rve_length = Jet(p.rve_length);
  out.choices = p.choices;
  for (int k = 0; k < parameter_count; ++k) {
    const auto row = static_cast<std::size_t>(k);
    out.*calibrated_parameters<Jet>[row].member = Jet(p.*parameter_info[row].member, k);
  }
  return out;
}

}  // namespace fpz::calibration
