// Data of the kinds "notched_beam" and "semicircular_bend": loads at the readings of a gauge.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fpz/calibration/notched_specimen.hpp"
#include "fpz/calibration/work_of_fracture.hpp"

namespace fpz::calibration {

/// A modulus read off the rise of a curve.
struct ModulusEstimate {
  double value = 0.0;           ///< E, Pa
  double standard_error = 0.0;  ///< Pa
  std::string words;            ///< which points were used, and how good the straight line is
  std::string failure;          ///< empty when there is a value
};

struct NotchedData {
  NotchedSpecimenTest test;
  std::vector<Eigen::Index> fitted;  ///< places in nuisances(test.gauge) of those that are fitted
  Eigen::VectorXd held;              ///< values of the others, all places; empty: zero
  double slope_from = 0.1;           ///< part of the rise, over the peak load, that gives the initial slope
  double slope_to = 0.4;
  std::optional<double> weight;  ///< N; where the work of fracture is wanted: see work_of_fracture()
  /// The load that bends the ligament as the weight of the beam does, N: it was there when load and gauge were zeroed.
  double dead_load = 0.0;
};

/// Loads at the readings; `nuisance` has the fitted ones.
[[nodiscard]] Prediction predict(const NotchedData& data, const Parameters& parameters, const Eigen::VectorXd& nuisance,
                                 bool derivatives);

/// The same test at other readings, in growing order.
[[nodiscard]] std::optional<NotchedData> at_abscissa(const NotchedData& data, const Eigen::VectorXd& readings);

/// Young's modulus from the measured loads.
[[nodiscard]] std::optional<ModulusEstimate> modulus_from_slope(const NotchedData& data, const Eigen::VectorXd& loads,
                                                                const Parameters& parameters);

/// G_F from the area under the measured curve, where it is wanted.
[[nodiscard]] std::optional<WorkOfFracture> measured_work(const NotchedData& data, const Eigen::VectorXd& loads);

/// See mode_one_warning().
[[nodiscard]] std::string model_warning(const NotchedData& data, const Parameters& parameters);

}  // namespace fpz::calibration
