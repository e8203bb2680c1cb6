#include "fpz/calibration/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <variant>

#include "report/display.hpp"
#include "scene_fit.hpp"

namespace fpz::calibration {
namespace {

/// Which unknowns a data set's prediction depends on.
struct Unknowns {
  std::vector<int> material;  ///< index in `parameter_info` of each fitted material parameter, in order
  Eigen::Index first_nuisance = 0;
  Eigen::Index nuisances = 0;
};

std::vector<int> fitted_parameters(const Specification& spec) {
  std::vector<int> fitted;
  for (int k = 0; k < parameter_count; ++k) {
    if (spec.parameters[static_cast<std::size_t>(k)].fitted) fitted.push_back(k);
  }
  return fitted;
}

Parameters with_values(Parameters p, const std::vector<int>& fitted, const Eigen::VectorXd& x) {
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    p.*parameter_info[static_cast<std::size_t>(fitted[k])].member = x[static_cast<Eigen::Index>(k)];
  }
  return p;
}

/// The model as a function of all unknowns: picks the values out and puts the derivatives in their columns. Nuisances
/// that are not among the unknowns keep the values `held`.
Forward make_forward(const Parameters& base, const TestData& test, const Unknowns& which, const Eigen::VectorXd& held) {
  return [base, test, which, held](const Eigen::VectorXd& x, bool derivatives) {
    const Eigen::VectorXd own = x.segment(which.first_nuisance, which.nuisances);
    const Eigen::VectorXd& nuisance = held.size() > 0 ? held : own;
    const Parameters parameters = with_values(base, which.material, x);
    Prediction inner = std::visit([&](const auto& t) { return predict(t, parameters, nuisance, derivatives); }, test);
    if (!inner.ok() || !derivatives) return inner;
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(inner.values.size(), x.size());
    for (std::size_t k = 0; k < which.material.size(); ++k) {
      jacobian.col(static_cast<Eigen::Index>(k)) = inner.jacobian.col(which.material[k]);
    }
    jacobian.middleCols(which.first_nuisance, which.nuisances) = inner.jacobian.rightCols(which.nuisances);
    inner.jacobian = std::move(jacobian);
    return inner;
  };
}

FitParameter make_parameter(const Specification& spec, int index) {
  const ParameterSetting& s = spec.parameters[static_cast<std::size_t>(index)];
  const ParameterInfo<double>& which = parameter_info[static_cast<std::size_t>(index)];
  FitParameter p;
  p.name = which.name;
  p.symbol = which.symbol;
  p.unit = which.unit;
  p.start = s.value;
  p.lower = s.lower;
  p.upper = s.upper;
  p.prior = s.prior;
  return p;
}

/// Half width of a confidence interval in standard errors, as the fit used it; 0 when it gave none.
double interval_factor(const FitResult& r) {
  for (Eigen::Index k = 0; k < std::min(r.standard_error.size(), r.upper_limit.size()); ++k) {
    const double factor = (r.upper_limit[k] - r.lower_limit[k]) / (2.0 * r.standard_error[k]);
    if (r.standard_error[k] > 0.0 && std::isfinite(factor)) return factor;
  }
  return 0.0;
}

void measure(Comparison& c, const DataSet& set) {
  c.residuals = c.predicted - set.measured;
  c.measured_peak = set.measured.maxCoeff();
  c.predicted_peak = c.predicted.maxCoeff();
  c.peak_error = c.predicted_peak / c.measured_peak - 1.0;
  c.rms_over_peak = std::sqrt(c.residuals.squaredNorm() / static_cast<double>(c.residuals.size())) / c.measured_peak;
}

/// Unknowns of each data set. Those of sets that are not fitted have no nuisances among them.
std::vector<Unknowns> unknowns_of(const Specification& spec) {
  std::vector<Unknowns> list;
  Unknowns next;
  next.material = fitted_parameters(spec);
  next.first_nuisance = static_cast<Eigen::Index>(next.material.size());
  for (const DataSet& set : spec.data) {
    Unknowns which = next;
    if (set.role == Role::fit) which.nuisances = static_cast<Eigen::Index>(set.nuisances.size());
    next.first_nuisance += which.nuisances;
    list.push_back(which);
  }
  return list;
}

/// The test of a data set as a function of all unknowns. Nuisances of a set that is not fitted keep their start values.
Forward forward_of(const Specification& spec, const DataSet& set, const TestData& test, const Unknowns& which) {
  Eigen::VectorXd held;
  if (set.role != Role::fit) {
    held.resize(static_cast<Eigen::Index>(set.nuisances.size()));
    for (std::size_t k = 0; k < set.nuisances.size(); ++k) {
      held[static_cast<Eigen::Index>(k)] = set.nuisances[k].start;
    }
  }
  return make_forward(spec.start(), test, which, held);
}

/// The values of all unknowns that the comparisons are made with: the best ones, or the start where there are none.
Eigen::VectorXd unknowns_for_comparison(const Calibration& all) {
  const auto count = static_cast<Eigen::Index>(all.problem.parameters.size());
  if (all.result.values.size() == count) return all.result.values;
  Eigen::VectorXd start(count);
  for (Eigen::Index k = 0; k < count; ++k) start[k] = all.problem.parameters[static_cast<std::size_t>(k)].start;
  return start;
}

bool has_covariance(const Calibration& all) {
  return all.result.covariance.rows() == static_cast<Eigen::Index>(all.problem.parameters.size()) &&
         all.result.covariance.allFinite();
}

/// Half width of the confidence band of a prediction, allowing for correlated residuals: systematic ones would make the
/// band of independent errors far too narrow. Zero when the fit gave no covariance.
Eigen::VectorXd band_of(const Calibration& all, const Prediction& x) {
  if (x.jacobian.size() == 0) return Eigen::VectorXd::Zero(x.values.size());
  const FitResult& r = all.result;
  const Eigen::VectorXd widened =
      (r.standard_error.array() > 0.0).select(r.correlated_error.cwiseQuotient(r.standard_error), 1.0);
  const Eigen::MatrixXd j = x.jacobian * widened.asDiagonal();
  const Eigen::VectorXd variance = (j * r.covariance).cwiseProduct(j).rowwise().sum();
  return interval_factor(all.result) * variance.cwiseMax(0.0).cwiseSqrt();
}

Comparison predict_unfitted(const DataSet& set, const Calibration& all, const Unknowns& which) {
  Comparison c;
  const Forward forward = forward_of(all.specification, set, set.test, which);
  const Prediction x = forward(unknowns_for_comparison(all), has_covariance(all));
  c.failure = x.failure;
  if (!x.ok()) return c;
  c.predicted = x.values;
  c.deviation = set.deviation;
  c.band = band_of(all, x);
  measure(c, set);
  return c;
}

/// The measured abscissae and others between them, evenly spread; nothing where the measured ones go back and forth.
std::optional<Eigen::VectorXd> dense_abscissa(const Eigen::VectorXd& measured) {
  constexpr Eigen::Index more = 160;
  if (measured.size() < 2 || !std::is_sorted(measured.begin(), measured.end())) return std::nullopt;
  Eigen::VectorXd x(measured.size() + more);
  x << measured, Eigen::VectorXd::LinSpaced(more, measured[0], measured[measured.size() - 1]);
  std::sort(x.begin(), x.end());
  return x;
}

std::optional<SmoothCurve> smooth_curve(const DataSet& set, const Calibration& all, const Unknowns& which) {
  if (!set.is_curve()) return std::nullopt;
  const std::optional<Eigen::VectorXd> abscissa = dense_abscissa(set.abscissa);
  if (!abscissa) return std::nullopt;
  const auto moved = [&](const auto& test) -> std::optional<TestData> { return at_abscissa(test, *abscissa); };
  const std::optional<TestData> dense = std::visit(moved, set.test);
  if (!dense) return std::nullopt;
  const Forward forward = forward_of(all.specification, set, *dense, which);
  const Prediction x = forward(unknowns_for_comparison(all), has_covariance(all));
  if (!x.ok()) return std::nullopt;
  return SmoothCurve{*abscissa, x.values, band_of(all, x)};
}

/// Largest loads read in two more ways.
std::optional<SizeEffect> size_effect_of(const DataSet& set, const Comparison& c, const Parameters& parameters) {
  PeakLoads peaks;
  peaks.specimens = std::visit([](const auto& test) { return peak_specimens(test); }, set.test);
  peaks.load = set.measured;
  peaks.deviation = set.deviation;
  peaks.deviation_known = set.deviation_known;
  return size_effect(peaks, c.predicted, parameters);
}

std::vector<Comparison> compare_all(const Calibration& all) {
  const std::vector<Unknowns> unknowns = unknowns_of(all.specification);
  std::vector<Comparison> list;
  std::size_t next = 0;  // of the results, which follow the fitted sets
  for (std::size_t k = 0; k < all.specification.data.size(); ++k) {
    const DataSet& set = all.specification.data[k];
    Comparison c;
    if (set.role == Role::predict) {
      c = predict_unfitted(set, all, unknowns[k]);
    } else if (next < all.result.data.size()) {
      const DataSetResult& r = all.result.data[next++];
      if (r.predicted.size() == set.measured.size()) {
        c.predicted = r.predicted;
        c.deviation = r.deviation;
        const Prediction x = all.problem.data[next - 1].forward(all.result.values, has_covariance(all));
        c.band = x.ok() ? band_of(all, x) : r.band;
        measure(c, set);
      } else {
        c.failure = "the fit gave no prediction";
      }
    } else {
      c.failure = "the fit gave no prediction";
    }
    c.data_set = k;
    if (c.ok()) c.smooth = smooth_curve(set, all, unknowns[k]);
    if (c.ok()) c.size_effect = size_effect_of(set, c, all.parameters);
    list.push_back(std::move(c));
  }
  return list;
}

/// Values that follow from the parameters, with errors to first order from the covariance.
std::vector<Derived> derive(const Calibration& all, const std::vector<int>& fitted) {
  const Setting setting = all.specification.setting;
  struct Formula {
    const char* name;
    const char* symbol;
    const char* unit;
    std::function<double(const Parameters&)> value;
  };
  const std::vector<Formula> formulas = {
      {"mode I fracture energy", "G_I = sigma_t0 delta0", "N/m",
       [](const Parameters& p) { return p.tensile_strength * p.delta0; }},
      {"mode I toughness that goes with it", "K_Ic", "Pa.sqrt(m)",
       [setting](const Parameters& p) {
         return toughness_from_energy(p.tensile_strength * p.delta0, p.young_modulus, p.poisson_ratio, setting);
       }},
      {"characteristic length", "l_ch = E G_I/sigma_t0^2", "m",
       [](const Parameters& p) { return p.young_modulus * p.delta0 / p.tensile_strength; }},
      {"largest RVE length without snap-back in mode I", "H_max", "m",
       [setting](const Parameters& p) { return snap_back_length(p, setting); }},
      {"uniaxial tensile strength", "sigma_t", "Pa", [](const Parameters& p) { return uniaxial_tensile_strength(p); }},
  };
  const auto count = static_cast<Eigen::Index>(fitted.size());
  const bool certain = all.result.covariance.rows() >= count && all.result.covariance.allFinite();
  std::vector<Derived> list;
  for (const Formula& f : formulas) {
    Derived d{f.name, f.symbol, f.unit, f.value(all.parameters), NAN};
    if (certain) {
      Eigen::VectorXd slope(count);
      for (Eigen::Index k = 0; k < count; ++k) {  // smooth closed forms: central differences are good to 1e-9
        const auto member = parameter_info[static_cast<std::size_t>(fitted[static_cast<std::size_t>(k)])].member;
        const double step = 1e-5 * all.parameters.*member;
        Parameters up = all.parameters, down = all.parameters;
        up.*member += step;
        down.*member -= step;
        slope[k] = (f.value(up) - f.value(down)) / (2.0 * step);
      }
      d.standard_error = std::sqrt(std::max(0.0, slope.dot(all.result.covariance.topLeftCorner(count, count) * slope)));
    }
    list.push_back(std::move(d));
  }
  return list;
}

/// G_F of the curves for which it is wanted, beside that of the fit.
void add_work_of_fracture(Calibration& all) {
  for (const DataSet& set : all.specification.data) {
    const auto work = std::visit([&](const auto& test) { return measured_work(test, set.measured); }, set.test);
    if (!work || !work->failure.empty()) continue;
    const double whole = work->measured + work->weight + work->tail;
    all.derived.push_back({"fracture energy by the work of fracture, " + set.name, "G_F", "N/m", work->energy, NAN});
    if (work->measured > 0.7 * whole) continue;
    all.warnings.push_back(set.name + ": of the work of fracture only " + detail::percent(work->measured / whole) +
                           " was measured; weight and tail add the rest");
  }
}

std::optional<TwoEnergies> confront_energies(const Calibration& all) {
  const FractureEnergyData* one = nullptr;
  const FractureEnergyData* two = nullptr;
  for (const DataSet& set : all.specification.data) {
    const auto* energy = std::get_if<FractureEnergyData>(&set.test);
    if (energy == nullptr) continue;
    const FractureEnergyData*& place = energy->test.path == FracturePath::opening ? one : two;
    if (place == nullptr) place = energy;
  }
  if (one == nullptr || two == nullptr) return std::nullopt;
  Parameters p = all.parameters;
  p.rve_length = 1.0;
  return compare_energies(one->test, measured_energy(*one, p), two->test, measured_energy(*two, p), p,
                          default_ranges(p));
}

void add_warnings(Calibration& all) {
  all.warnings = all.specification.warnings;
  all.warnings.insert(all.warnings.end(), all.result.warnings.begin(), all.result.warnings.end());
  std::set<std::string> said;
  for (const DataSet& set : all.specification.data) {
    const std::string text =
        std::visit([&](const auto& test) { return model_warning(test, all.parameters); }, set.test);
    if (!text.empty() && said.insert(text).second) all.warnings.push_back(text);
  }
  if (all.energies && all.energies->ok() && !all.energies->consistent) {
    all.warnings.push_back("one delta0 cannot match both fracture energies: the mode I energy alone gives " +
                           detail::shown_value(all.energies->delta0_one, "m") + ", the other alone " +
                           detail::shown_value(all.energies->delta0_two, "m"));
  }
  for (const Comparison& c : all.comparisons) {
    if (!c.ok()) all.warnings.push_back(all.specification.data[c.data_set].name + ": no prediction: " + c.failure);
  }
}

}  // namespace

FitProblem make_problem(const Specification& spec) {
  FitProblem problem;
  for (const int k : fitted_parameters(spec)) problem.parameters.push_back(make_parameter(spec, k));
  const std::vector<Unknowns> unknowns = unknowns_of(spec);
  for (std::size_t k = 0; k < spec.data.size(); ++k) {
    const DataSet& set = spec.data[k];
    if (set.role != Role::fit) continue;
    problem.parameters.insert(problem.parameters.end(), set.nuisances.begin(), set.nuisances.end());
    Observations o;
    o.name = set.name;
    o.measured = set.measured;
    o.deviation = set.deviation;
    o.deviation_known = set.deviation_known;
    o.weight = set.weight;
    o.loss = set.loss;
    o.forward = forward_of(spec, set, set.test, unknowns[k]);
    problem.data.push_back(std::move(o));
  }
  return problem;
}

FitOptions fit_options(const Specification& spec) {
  FitOptions options = spec.options;
  const FitProblem problem = make_problem(spec);
  for (const std::string& name : spec.profiles) {
    for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
      if (problem.parameters[k].name == name) options.profiles.push_back(static_cast<int>(k));
    }
  }
  return options;
}

Parameters parameters_at(const Specification& spec, const Eigen::VectorXd& unknowns) {
  return with_values(spec.start(), fitted_parameters(spec), unknowns);
}

Calibration calibrate(const Specification& spec, const std::function<void(const FitProgress&)>& progress,
                      const RunScenes& run) {
  Calibration all;
  all.specification = spec;
  all.problem = make_problem(spec);
  FitOptions options = fit_options(spec);
  options.progress = progress;
  if (detail::has_scenes(spec)) {
    if (!run) throw std::invalid_argument("calibrate: the data have scenes, and nothing that runs them was given");
    detail::SceneFit fitted = detail::fit_with_runs(spec, options, run);
    all.specification = std::move(fitted.specification);
    all.problem = make_problem(all.specification);
    all.result = std::move(fitted.result);
    all.scenes = std::move(fitted.summary);
  } else {
    all.result = fit(all.problem, options);
  }
  const bool any = all.result.values.size() == static_cast<Eigen::Index>(all.problem.parameters.size());
  all.parameters = any ? parameters_at(spec, all.result.values) : spec.start();
  const std::vector<int> fitted = fitted_parameters(spec);
  all.comparisons = compare_all(all);
  all.derived = derive(all, fitted);
  for (const ReferenceValue& r : spec.references) {
    for (const ParameterInfo<double>& p : parameter_info) {
      if (p.name != r.parameter) continue;
      const double value = all.parameters.*p.member;
      all.references.push_back({r, value, value / r.value - 1.0});
    }
  }
  all.energies = confront_energies(all);
  add_warnings(all);
  add_work_of_fracture(all);
  return all;
}

}  // namespace fpz::calibration
