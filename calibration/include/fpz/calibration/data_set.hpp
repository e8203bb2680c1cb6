// One set of measured values as the fit, the report and the pictures see it, whatever kind of test it comes from.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fpz/calibration/fit.hpp"
#include "fpz/calibration/fracture_energy_data.hpp"
#include "fpz/calibration/notched_data.hpp"
#include "fpz/calibration/peak_load.hpp"
#include "fpz/calibration/scene_data.hpp"
#include "fpz/calibration/strength.hpp"
#include "fpz/calibration/stress_strain.hpp"
#include "fpz/calibration/traction_separation.hpp"

namespace fpz::calibration {

/// What an axis of a picture shows: `label` with the unit, and the factor that turns the shown number into SI.
struct Axis {
  std::string label;
  std::string unit;
  double factor = 1.0;
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

/// What was tested: one struct per kind of test, from a header of its own.
using TestData = std::variant<FractureEnergyData, StrengthTest, TractionSeparationTest, StressStrainTest, NotchedData,
                              PeakLoadTest, SceneData>;

// What the kinds answer. Here are the answers of a kind that has none of its own; NotchedData and others that have
// overload them in their headers.

/// Predictions for given material parameters and the set's own nuisance parameters. Columns of the Jacobian: the
/// material parameters, then the nuisances.
template <class Test>
[[nodiscard]] Prediction predict(const Test& test, const Parameters& parameters, const Eigen::VectorXd& /*nuisance*/,
                                 bool derivatives) {
  return predict(test, parameters, derivatives);
}

/// The same test at other abscissae, in growing order, for drawing; nothing where the kind cannot.
template <class Test>
[[nodiscard]] std::optional<Test> at_abscissa(const Test& /*test*/, const Eigen::VectorXd& /*abscissa*/) {
  return std::nullopt;
}

/// Young's modulus from the initial slope; nothing where the kind has none.
template <class Test>
[[nodiscard]] std::optional<ModulusEstimate> modulus_from_slope(const Test& /*test*/,
                                                                const Eigen::VectorXd& /*measured*/,
                                                                const Parameters& /*parameters*/) {
  return std::nullopt;
}

/// Fracture energy from the area under a measured curve; nothing where the kind has none, or it is not wanted.
template <class Test>
[[nodiscard]] std::optional<WorkOfFracture> measured_work(const Test& /*test*/, const Eigen::VectorXd& /*measured*/) {
  return std::nullopt;
}

/// The specimens whose largest loads the values are; none where the kind is another.
template <class Test>
[[nodiscard]] std::vector<NotchedSpecimen> peak_specimens(const Test& /*test*/) {
  return {};
}

/// What the kind assumes that the model would not do with these parameters; empty when there is nothing to say.
template <class Test>
[[nodiscard]] std::string model_warning(const Test& /*test*/, const Parameters& /*parameters*/) {
  return {};
}

/// SI unit of value k, for kinds whose values have several.
template <class Test>
[[nodiscard]] std::string_view unit_of_value(const Test& /*test*/, std::size_t /*k*/) {
  return {};
}

/// What all kinds have in common, and the test itself.
struct DataSet {
  std::string name;
  std::string kind;      ///< as in the specification
  std::string source;    ///< where the values come from
  std::string file;      ///< as the specification names it; empty for values that stand in the specification
  std::string notation;  ///< how the file was read, in words
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
  TestData test;

  [[nodiscard]] bool is_curve() const { return labels.empty(); }
};

}  // namespace fpz::calibration
