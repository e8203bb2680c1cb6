// From a specification to fitted parameters: the fit problem, its solution, and what follows from it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fpz/calibration/fit.hpp"
#include "fpz/calibration/fracture_energy.hpp"
#include "fpz/calibration/size_effect.hpp"
#include "fpz/calibration/specification.hpp"

namespace fpz::calibration {

/// The unknowns are the fitted material parameters in the order of `Parameter`, then the nuisance parameters of the
/// fitted data sets in their order. One set of observations per fitted data set.
[[nodiscard]] FitProblem make_problem(const Specification& specification);

/// Options of the fit with the profiles numbered as in make_problem().
[[nodiscard]] FitOptions fit_options(const Specification& specification);

/// All material parameters when the unknowns of make_problem() have these values; rve_length is 0.
[[nodiscard]] Parameters parameters_at(const Specification& specification, const Eigen::VectorXd& unknowns);

/// A prediction between the measured points.
struct SmoothCurve {
  Eigen::VectorXd abscissa;
  Eigen::VectorXd predicted;
  Eigen::VectorXd band;  ///< half width of the confidence band
};

/// How the fitted material does on one data set, whether that was fitted or not.
struct Comparison {
  std::size_t data_set = 0;           ///< index in Specification::data
  Eigen::VectorXd predicted;          ///< SI
  Eigen::VectorXd residuals;          ///< predicted - measured
  Eigen::VectorXd deviation;          ///< standard deviation of the single values, estimated where it was not known
  Eigen::VectorXd band;               ///< half width of the confidence band of the prediction
  std::optional<SmoothCurve> smooth;  ///< where the kind of test allows it
  double measured_peak = 0.0;         ///< largest measured value
  double predicted_peak = 0.0;
  double peak_error = 0.0;                ///< relative
  double rms_over_peak = 0.0;             ///< root mean square of the residuals over the largest measured value
  std::optional<SizeEffect> size_effect;  ///< of largest loads of notched specimens
  std::string failure;                    ///< why there is no prediction; empty when there is one

  [[nodiscard]] bool ok() const { return failure.empty(); }
};

/// A number that follows from the parameters, with its standard error from theirs.
struct Derived {
  std::string name;
  std::string symbol;
  std::string unit;
  double value = 0.0;
  double standard_error = 0.0;
};

struct ReferenceComparison {
  ReferenceValue reference;
  double fitted = 0.0;    ///< SI
  double relative = 0.0;  ///< fitted over reference, less 1
};

/// How the runs of scenes went.
struct SceneFitSummary {
  std::size_t runs = 0;       ///< parameter sets at which the scenes were run
  std::size_t used = 0;       ///< of them, those that the last surface goes through
  std::size_t failed = 0;     ///< those without a prediction
  std::string first_failure;  ///< with its parameters
  int rounds = 0;
  std::size_t noise_runs = 0;         ///< runs that hardly differ
  double scatter = 0.0;               ///< their standard deviation over the values, root mean squares
  Eigen::VectorXd error;              ///< part of each unknown's standard error that comes from the runs
  std::vector<std::string> words;     ///< a line per round
  std::vector<std::string> warnings;  ///< what the particle program says of the run at the best values
};

struct Calibration {
  Specification specification;
  FitProblem problem;
  FitResult result;
  Parameters parameters;                ///< best values; rve_length is 0
  std::vector<Comparison> comparisons;  ///< in the order of the data sets
  std::vector<Derived> derived;
  std::vector<ReferenceComparison> references;
  std::optional<TwoEnergies> energies;    ///< when a mode I and another fracture energy are given
  std::optional<SceneFitSummary> scenes;  ///< where data sets are scenes
  std::vector<std::string> warnings;      ///< of reading, fit and model; one line each
};

/// Fits and evaluates; `run` makes the runs of scenes. Throws std::invalid_argument for a problem that require_valid()
/// refuses, and for scenes without `run`.
[[nodiscard]] Calibration calibrate(const Specification& specification,
                                    const std::function<void(const FitProgress&)>& progress = {},
                                    const RunScenes& run = {});

}  // namespace fpz::calibration
