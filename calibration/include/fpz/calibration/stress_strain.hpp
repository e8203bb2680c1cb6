// Stress-strain curves of an RVE along a loading path of the driver: any mixture of prescribed strains and stresses.
//
// SI, tension positive, tensor shear strains, as in path files.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "fpz/calibration/prediction.hpp"
#include "fpz/driver/path_file.hpp"

namespace fpz::calibration {

enum class TensorKind { strain, stress };

/// A component by its index into driver::component_names (xx, yy, zz, xy, xz, yz).
struct TensorComponent {
  TensorKind kind = TensorKind::stress;
  int component = 0;
};

/// Measured points of one test.
struct StressStrainTest {
  /// The path; its rve_length belongs to the specimen and stays, all other parameters are replaced.
  driver::Test path;
  TensorComponent ordinate;
  /// A strain component as abscissa. Nothing: the path time, which counts stages (1.5 is the middle of stage 2) and
  /// therefore also names points of unloading and reloading branches.
  std::optional<int> abscissa_strain;
  /// With a strain abscissa: the path times between which the points lie. There the strain must rise or fall all the
  /// way. Nothing: the whole path.
  std::optional<std::pair<double, double>> window;
  std::vector<double> points;  ///< abscissa of every point, in any order
};

/// One value per point. The model is evaluated at the very point, not interpolated between increments of the path: the
/// corner at the onset of fracture stays sharp, and each derivative is that of its own side. Derivatives are those of
/// the discrete run, its accepted steps being repeated with derivatives; where stresses are prescribed the strains
/// follow by the implicit function theorem. Fails with the message of the run where that stops before the last point
/// needed (snap-back, load limit), for points outside the path, for a strain abscissa that turns round, for jump
/// control, and for points behind a stage that a stop condition ended.
[[nodiscard]] Prediction predict(const StressStrainTest& test, const Parameters& parameters, bool derivatives);

}  // namespace fpz::calibration
