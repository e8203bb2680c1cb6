// One set of measured values as the fit, the report and the pictures see it, whatever kind of test it comes from.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fpz/calibration/fit.hpp"
#include "fpz/calibration/fracture_energy.hpp"
#include "fpz/calibration/prediction.hpp"

namespace fpz::calibration {

/// Predictions of a data set for given material parameters and its own nuisance parameters. Columns of the Jacobian:
/// the material parameters, then the nuisances.
using Model = std::function<Prediction(const Parameters&, const Eigen::VectorXd& nuisance, bool derivatives)>;

/// What an axis of a picture shows: `label` with the unit, and the factor that turns the shown number into SI.
struct Axis {
  std::string label;
  std::string unit;
  double factor = 1.0;
};

/// A modulus read off the rise of a curve.
struct ModulusEstimate {
  double value = 0.0;           ///< E, Pa
  double standard_error = 0.0;  ///< Pa
  std::string words;            ///< which points were used, and how good the straight line is
  std::string failure;          ///< empty when there is a value
};

enum class Role {
  fit,     ///< its values take part in the fit
  predict  ///< predicted from the parameters that the others give, and compared
};

}  // namespace fpz::calibration

template <>
struct fpz::Words<fpz::calibration::Role> {
  using K = calibration::Role;
  static constexpr Word<K> list[] = {{K::fit, "fit"}, {K::predict, "predict"}};
};

namespace fpz::calibration {

struct DataSet {
  std::string name;
  std::string kind;    ///< as in the specification
  std::string source;  ///< where the values come from
  std::string file;    ///< as the specification names it; empty for values that stand in the specification
  Role role = Role::fit;

  Axis abscissa_axis;
  Axis value_axis;
  Eigen::VectorXd abscissa;         ///< SI; for single values 1, 2, ...
  std::vector<std::string> labels;  ///< of single values; empty for curves
  Eigen::VectorXd measured;         ///< SI
  Eigen::VectorXd deviation;        ///< standard deviation of each value, SI
  bool deviation_known = true;      ///< false: only ratios are, see Observations
  std::string deviation_words;      ///< where it comes from
  double weight = 1.0;
  Loss loss;

  std::vector<FitParameter> nuisances;
  Model model;
  /// The same test at other abscissae, in growing order, for drawing; empty where the kind has none.
  std::function<Model(const Eigen::VectorXd& abscissa)> model_at;

  std::optional<FractureEnergyTest> fracture_energy;
  std::optional<double> energy;                                       ///< measured with it, J/m^2
  std::optional<double> toughness;                                    ///< or this, Pa sqrt(m)
  std::function<ModulusEstimate(const Parameters&)> initial_modulus;  ///< empty where the kind has none

  bool is_notched = false;  ///< assumes a straight crack in mode I

  [[nodiscard]] bool is_curve() const { return labels.empty(); }
};

}  // namespace fpz::calibration
