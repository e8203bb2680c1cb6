// Synthetic beams with known parameters, fitted as a laboratory would: is the verdict of the fit the right one?
#pragma once

#include <cstdint>
#include <string>

#include "fpz/calibration/calibration.hpp"

namespace fpz::calibration::test {

/// One beam of the study; all follows from its number.
struct StudyBeam {
  NotchedSpecimen specimen;
  Parameters truth;
  double noise = 0.0;  ///< standard deviation over the peak load: 0, 0.003, 0.01 or 0.03
  Eigen::VectorXd cmod;
  Eigen::VectorXd load;  ///< measured, with the noise
};

/// Notched beams of 40 to 200 mm depth, E 15 to 60 GPa, tensile strengths of 1.5 to 6 MPa, process zones from a tenth
/// of the ligament to five ligaments, every fourth with bilinear softening; 8 to 100 points down to 10 to 30 % of the
/// peak, evenly spread over the CMOD or denser on the rise. The loads are made by MidLine's steps on elements of half
/// the fit's size, so that they share neither mesh nor interpolation with the model that is fitted.
[[nodiscard]] StudyBeam study_beam(std::uint64_t number);

struct StudyOutcome {
  FitStatus status = FitStatus::failed;
  Eigen::Vector3d fitted = Eigen::Vector3d::Zero();  ///< E, sigma_t0, delta0, SI
  Eigen::Vector3d error = Eigen::Vector3d::Zero();   ///< standard errors, the larger of plain and correlated ones
  /// Largest deviation from the truth in standard errors; what the meshes differ by (0.2 %) counts as a further error.
  double deviation = 0.0;
  bool right = false;  ///< the deviation is below the two-sided 1e-3 quantile of Student's t
  std::string message;
};

/// Fits E, sigma_t0 and delta0 from a start that is off by a factor and starts - 1 others within a factor of 8.
[[nodiscard]] StudyOutcome study_fit(const StudyBeam& beam, double off, int starts);

}  // namespace fpz::calibration::test
