// The profile likelihood of one parameter.
#pragma once

#include "solver.hpp"

namespace fpz::calibration::detail {

struct ProfileResult {
  Profile profile;
  std::string warning;            ///< empty when all went well
  std::optional<Minimum> better;  ///< a point with clearly less cost than the minimum, if one was met
};

/// Fits the other parameters anew for a row of values of `parameter` on both sides of the minimum, starting each from
/// its neighbour. The row covers 4 standard errors (in the scaled variable) and goes on until the threshold is crossed
/// or the bound met. Ends of the interval: secant steps on the root of the excess, to 1e-4 of the threshold.
/// The noise is that of the minimum. Threshold: the squared quantile of Student's t (normal distribution when the noise
/// is known), times variance over inverse curvature where weights or losses make them differ.
[[nodiscard]] ProfileResult profile(const LeastSquares& problem, const Minimum& minimum, int parameter,
                                    const FitOptions& options);

}  // namespace fpz::calibration::detail
