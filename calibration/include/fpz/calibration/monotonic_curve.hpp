// The load of a monotonic test as a smooth function of the reading and of the parameters.
//
// MidLine's loads have a kink in their slope wherever a node of the mesh cracks, and with the parameters these places
// move past the measured readings. The kinks are the mesh's and not the material's, but a least-squares fit comes to
// rest in them. Here the states of equilibrium are those in which the tip of the process zone is at a corner of an
// element: loads and readings of these states are smooth functions of the parameters, and a cubic spline goes through
// them (docs/method-verdict.md).
#pragma once

#include <Eigen/Core>
#include <string>

#include "fpz/calibration/elastic_body.hpp"
#include "fpz/calibration/mid_line.hpp"
#include "fpz/parameters.hpp"

namespace fpz::calibration {

/// Columns of the derivatives: each PathInput, then these.
inline constexpr int toe_column = path_input_count;
inline constexpr int toe_load_column = path_input_count + 1;
inline constexpr int curve_input_count = path_input_count + 2;

struct MonotonicCurve {
  Eigen::VectorXd load;         ///< at each reading, N
  Eigen::MatrixXd derivatives;  ///< one row per reading, curve_input_count columns; empty when not asked for
  std::string failure;          ///< why there is no such curve, e.g. a snap-back; empty when there is one
};

/// Loads at `readings` (m, in any order) on the way of a first loading. `derivatives` needs condensation.d_nu.
[[nodiscard]] MonotonicCurve monotonic_curve(const Condensation& condensation, const Parameters& parameters,
                                             const Control& control, const Eigen::VectorXd& readings, bool derivatives);

/// The largest load of a first loading, as the one entry of the curve; a snap-back is no failure here.
[[nodiscard]] MonotonicCurve peak_of_curve(const Condensation& condensation, const Parameters& parameters,
                                           bool derivatives);

}  // namespace fpz::calibration
