#include "fpz/calibration/notched_specimen.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "admissible.hpp"
#include "fpz/calibration/mid_line.hpp"
#include "fpz/calibration/monotonic_curve.hpp"
#include "words.hpp"

namespace fpz::calibration {
namespace {

class Checker {
 public:
  bool require(bool holds, const char* field, double value, const std::string& constraint) {
    if (!holds) result.errors.push_back({field, value, constraint});
    return holds;
  }

  bool positive(const char* field, double value) {
    return require(std::isfinite(value) && value > 0.0, field, value, "must be finite and > 0");
  }

  bool between(const char* field, double value, double least, double most) {
    return require(value >= least && value <= most, field, value,
                   "must be >= " + text(least) + " and <= " + text(most));
  }

  static std::string text(double value) { return detail::number(value, 6); }

  Validation result;
};

void check_mesh(const MeshDensity& mesh, Checker& check) {
  check.between("mesh.ligament_fraction", mesh.ligament_fraction, 0.0025, 0.25);
  check.between("mesh.tip_fraction", mesh.tip_fraction, 0.001, 1.0);
  check.between("mesh.support_fraction", mesh.support_fraction, 0.0025, 0.25);
  check.between("mesh.growth", mesh.growth, 0.05, 1.0);
}

/// Specimens that are pulled open.
void check_arm(const NotchedSpecimen& s, Checker& check) {
  const bool sizes = check.positive("length", s.length) & check.positive("depth", s.depth);
  check.positive("thickness", s.thickness);
  const auto length = [&](const char* field, double value) {
    return check.require(std::isfinite(value) && value >= 0.0, field, value, "must be finite and >= 0");
  };
  const bool places = check.positive("span", s.span) & check.positive("notch", s.notch) &
                      length("load_depth", s.load_depth) & length("hole", s.hole) &
                      length("roller_width", s.roller_width) & length("groove_width", s.groove_width) &
                      length("groove_depth", s.groove_depth);
  length("wedge_slope", s.wedge_slope);
  length("clip_gauge_distance", s.clip_gauge_distance);
  if (!sizes || !places) return;
  check.require(s.notch <= 0.98 * s.depth, "notch", s.notch,
                "must be <= 0.98 times the depth = " + Checker::text(0.98 * s.depth));
  const double mouth = std::max(s.load_depth, s.groove_depth);
  check.require(s.notch >= mouth + 0.05 * s.ligament(), "notch", s.notch,
                "its tip must lie below the forces and the groove, by 0.05 times the ligament, at >= " +
                    Checker::text((mouth + 0.05 * s.depth) / 1.05));
  check.require(s.span + s.hole < 0.95 * s.length, "span", s.span,
                "span + hole must be < 0.95 length = " + Checker::text(0.95 * s.length));
  check.require(
      s.hole <= 0.9 * s.span && s.hole <= 1.8 * s.load_depth, "hole", s.hole,
      "must be <= 0.9 span and <= 1.8 load_depth, " + Checker::text(std::min(0.9 * s.span, 1.8 * s.load_depth)));
  check.require(s.hole == 0.0 || s.roller_width == 0.0, "roller_width", s.roller_width,
                "must be 0 where there are holes");
  check.require(s.roller_width <= 2.0 * s.load_depth, "roller_width", s.roller_width,
                "must be <= 2 load_depth = " + Checker::text(2.0 * s.load_depth));
  check.require(s.load_depth + 0.5 * s.roller_width < s.depth, "load_depth", s.load_depth, "must be < depth");
  check.require((s.groove_width > 0.0) == (s.groove_depth > 0.0), "groove_width", s.groove_width,
                "groove_width and groove_depth go together");
  check.require(s.groove_width <= 0.99 * s.span, "groove_width", s.groove_width,
                "must be <= 0.99 span = " + Checker::text(0.99 * s.span));
}

Control control_of(Gauge gauge, const Eigen::VectorXd& nuisance) {
  if (is_opening(gauge)) return {gauge, nuisance[0], 0.0};
  return {gauge, nuisance[1], nuisance[0], nuisance[2], nuisance[3]};
}

/// Derivatives of a path in the columns of a prediction.
Prediction prediction_of(Gauge gauge, MonotonicCurve curve, Eigen::Index nuisances) {
  Prediction out;
  out.values = std::move(curve.load);
  if (curve.derivatives.size() == 0) return out;
  out.jacobian = Eigen::MatrixXd::Zero(out.values.size(), parameter_count + nuisances);
  const auto put = [&](int column, PathInput input) {
    out.jacobian.col(column) = curve.derivatives.col(static_cast<int>(input));
  };
  put(static_cast<int>(Parameter::young_modulus), PathInput::young_modulus);
  put(static_cast<int>(Parameter::poisson_ratio), PathInput::poisson_ratio);
  put(static_cast<int>(Parameter::tensile_strength), PathInput::tensile_strength);
  put(static_cast<int>(Parameter::delta0), PathInput::delta0);
  put(static_cast<int>(Parameter::normal_stiffness), PathInput::normal_stiffness);
  if (is_opening(gauge)) {
    put(parameter_count, PathInput::gauge_offset);
  } else {
    put(parameter_count, PathInput::machine_compliance);
    put(parameter_count + 1, PathInput::gauge_offset);
    if (curve.derivatives.cols() == curve_input_count) {
      out.jacobian.col(parameter_count + 2) = curve.derivatives.col(toe_column);
      out.jacobian.col(parameter_count + 3) = curve.derivatives.col(toe_load_column);
    }
  }
  return out;
}

std::string why_unusable(const NotchedSpecimenTest& test, const Parameters& parameters,
                         const Eigen::VectorXd& nuisance) {
  const Validation valid = validate(test);
  if (!valid.ok()) return valid.report();
  std::string inadmissible = why_inadmissible(parameters, test.specimen.setting);
  if (!inadmissible.empty()) return inadmissible;
  const auto info = nuisances(test.gauge);
  if (nuisance.size() != static_cast<Eigen::Index>(info.size())) {
    return "expected " + std::to_string(info.size()) + " nuisance parameters, got " + std::to_string(nuisance.size());
  }
  for (std::size_t k = 0; k < info.size(); ++k) {
    const double value = nuisance[static_cast<Eigen::Index>(k)];
    if (!std::isfinite(value) || (!info[k].any_sign && value < 0.0)) {
      return std::string(info[k].name) + " = " + Checker::text(value) + ": must be finite" +
             (info[k].any_sign ? "" : " and >= 0");
    }
  }
  const Control control = control_of(test.gauge, nuisance);
  if (control.toe > 0.0 && control.toe_load == 0.0) return "toe_load = 0: must be > 0 where there is a toe";
  if (control.toe_load > 0.0 && !std::is_sorted(test.readings.begin(), test.readings.end())) {
    return "a toe is not followed through unloading cycles: subtract it, or use the readings before the first one";
  }
  return {};
}

void require_valid(const NotchedSpecimen& specimen, double poisson_ratio) {
  Checker check;
  check.result = validate(specimen);
  check.require(poisson_ratio > -1.0 && poisson_ratio < 0.5, "poisson_ratio", poisson_ratio, "must be > -1 and < 0.5");
  if (!check.result.ok()) throw std::invalid_argument(check.result.report());
}

}  // namespace

double NotchedSpecimen::nominal_stress() const {
  const double area = thickness * ligament();
  if (!is_pulled_open(shape)) return 1.5 * arms() / (area * ligament());
  const double arm = notch - load_depth + 0.5 * ligament();
  return (1.0 + 6.0 * arm / ligament()) / area;
}

NotchedSpecimen compact_tension(double width, double notch, double thickness) {
  NotchedSpecimen s;
  s.shape = SpecimenShape::compact_tension;
  s.length = 1.2 * width;
  s.depth = 1.25 * width;
  s.thickness = thickness;
  s.span = 0.55 * width;
  s.load_depth = 0.25 * width;
  s.hole = 0.25 * width;
  s.notch = s.load_depth + notch;
  return s;
}

Validation validate(const NotchedSpecimen& s) {
  Checker check;
  check.require(s.setting != Setting::three_d, "setting", static_cast<double>(s.setting),
                "must be plane_strain or plane_stress");
  check_mesh(s.mesh, check);
  if (is_pulled_open(s.shape)) {
    check_arm(s, check);
    return std::move(check.result);
  }
  const bool beam = s.shape == SpecimenShape::beam;
  const bool height_ok = beam ? check.positive("depth", s.depth) : check.positive("radius", s.radius);
  const bool length_ok = beam ? check.positive("length", s.length) : height_ok;
  check.positive("thickness", s.thickness);
  const bool span_ok = check.positive("span", s.span);
  const bool roller_ok = check.require(std::isfinite(s.roller_width) && s.roller_width >= 0.0, "roller_width",
                                       s.roller_width, "must be finite and >= 0");
  if (length_ok && span_ok && roller_ok) {
    const double face = beam ? s.length : 2.0 * s.radius;
    const char* name = beam ? "length" : "2 radius";
    check.require(s.span + s.roller_width < face, "span", s.span,
                  "span + roller_width must be < " + std::string(name) + " = " + Checker::text(face));
    check.require(s.roller_width < 0.25 * s.span, "roller_width", s.roller_width,
                  "must be < span / 4 = " + Checker::text(0.25 * s.span));
    check.require(
        s.load_span == 0.0 || (beam && s.load_span >= 2.0 * s.roller_width && s.load_span <= 0.9 * s.span), "load_span",
        s.load_span,
        "must be 0 (one load) or, for a beam, >= 2 roller_width and <= 0.9 span = " + Checker::text(0.9 * s.span));
  }
  const bool unnotched = beam && s.notch == 0.0;
  if (height_ok && !unnotched && check.positive("notch", s.notch)) {
    const double height = s.height();
    check.require(s.notch >= 0.005 * height && s.notch <= 0.95 * height, "notch", s.notch,
                  "must be >= 0.005 and <= 0.95 times the " + std::string(beam ? "depth" : "radius") + " = " +
                      Checker::text(height));
  }
  check.require(std::isfinite(s.clip_gauge_distance) && s.clip_gauge_distance >= 0.0, "clip_gauge_distance",
                s.clip_gauge_distance, "must be finite and >= 0");
  return std::move(check.result);
}

Validation validate(const NotchedSpecimenTest& test) {
  Checker check;
  check.result = validate(test.specimen);
  check.require(test.readings.size() > 0, "readings", 0.0, "must not be empty");
  for (Eigen::Index k = 0; k < test.readings.size(); ++k) {
    if (!std::isfinite(test.readings[k])) {
      check.require(false, "readings", test.readings[k], "must be finite (point " + std::to_string(k + 1) + ")");
      break;
    }
  }
  const bool pulled_open = is_pulled_open(test.specimen.shape);
  check.require(
      test.gauge != Gauge::deflection_load_point || test.specimen.roller_width > 0.0 || test.specimen.hole > 0.0,
      "roller_width", test.specimen.roller_width,
      "must be > 0 for the deflection of the load point: under a point load it has no finite value");
  const bool known = pulled_open ? test.gauge != Gauge::deflection_mid_depth : test.gauge != Gauge::load_line_opening;
  check.require(
      known, "gauge", static_cast<double>(test.gauge),
      std::string(to_string(test.gauge)) + " does not exist on a specimen of shape " + to_string(test.specimen.shape));
  check.require(test.gauge != Gauge::cmod || test.specimen.notch > 0.0, "notch", test.specimen.notch,
                "must be > 0 for CMOD: a gauge across an unnotched face shows strain as well; use a deflection");
  check.require(test.cache != nullptr, "cache", 0.0, "must not be empty");
  return std::move(check.result);
}

Condensation condense(const NotchedSpecimen& specimen, double poisson_ratio, bool nu_derivative) {
  require_valid(specimen, poisson_ratio);
  return condense(make_mesh(specimen), specimen.setting, poisson_ratio, specimen.clip_gauge_distance, nu_derivative);
}

std::shared_ptr<const Condensation> CondensationCache::get(const NotchedSpecimen& specimen, double poisson_ratio,
                                                           bool nu_derivative) {
  constexpr std::size_t most_entries = 6;
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.poisson_ratio == poisson_ratio && e.specimen == specimen;
  });
  if (found != entries_.end() && (!nu_derivative || found->condensation->d_nu)) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front().condensation;
  }
  if (found != entries_.end()) entries_.erase(found);
  auto made = std::make_shared<const Condensation>(condense(specimen, poisson_ratio, nu_derivative));
  entries_.push_front({specimen, poisson_ratio, std::move(made)});
  if (entries_.size() > most_entries) entries_.pop_back();
  return entries_.front().condensation;
}

std::span<const NuisanceInfo> nuisances(Gauge gauge) {
  static constexpr std::array<NuisanceInfo, 1> cmod = {{{"cmod_offset", "CMOD_0", "m", true}}};
  static constexpr std::array<NuisanceInfo, 4> deflection = {{{"machine_compliance", "C_m", "m/N", false},
                                                              {"deflection_offset", "d_0", "m", true},
                                                              {"toe", "d_toe", "m", false},
                                                              {"toe_load", "P_toe", "N", false}}};
  if (is_opening(gauge)) return cmod;
  return deflection;
}

Prediction predict(const NotchedSpecimenTest& test, const Parameters& parameters, const Eigen::VectorXd& nuisance,
                   bool derivatives) {
  if (std::string why = why_unusable(test, parameters, nuisance); !why.empty()) return failed(std::move(why));
  const auto body = test.cache->get(test.specimen, parameters.poisson_ratio, derivatives);
  const Control control = control_of(test.gauge, nuisance);
  if (std::is_sorted(test.readings.begin(), test.readings.end())) {
    MonotonicCurve curve = monotonic_curve(*body, parameters, control, test.readings, derivatives);
    if (curve.failure.empty()) return prediction_of(test.gauge, std::move(curve), nuisance.size());
    if (control.toe_load > 0.0) return failed(std::move(curve.failure));
  }
  // Unloading cycles need the history; and where the smooth curve ends, the path says why.
  MidLine path(*body, parameters, control, derivatives);
  MonotonicCurve curve;
  curve.load.resize(test.readings.size());
  if (derivatives) curve.derivatives.resize(test.readings.size(), path_input_count);
  for (Eigen::Index k = 0; k < test.readings.size(); ++k) {
    if (std::string why = path.advance(test.readings[k]); !why.empty()) return failed(std::move(why));
    curve.load[k] = path.load();
    if (derivatives) curve.derivatives.row(k) = path.load_derivatives().transpose();
  }
  return prediction_of(test.gauge, std::move(curve), nuisance.size());
}

FractureCurve fracture_curve(const NotchedSpecimen& specimen, const Parameters& parameters, double end_load,
                             double step) {
  constexpr std::size_t most_points = 5000;
  FractureCurve curve;
  curve.failure = why_inadmissible(parameters, specimen.setting);
  if (!curve.failure.empty()) return curve;
  const Condensation body = condense(specimen, parameters.poisson_ratio);
  const Gauge gauge = specimen.notch > 0.0 ? Gauge::cmod : Gauge::deflection_mid_depth;
  MidLine path(body, parameters, {gauge}, false);
  double peak = 0.0;
  double next = 0.0;
  while (curve.load.size() < most_points) {
    curve.failure = path.advance(next);
    if (!curve.failure.empty()) return curve;
    curve.load.push_back(path.load());
    curve.cmod.push_back(path.gauge(Gauge::cmod));
    curve.deflection_mid_depth.push_back(path.gauge(Gauge::deflection_mid_depth));
    curve.deflection_load_point.push_back(path.gauge(Gauge::deflection_load_point));
    curve.load_line_opening.push_back(path.gauge(Gauge::load_line_opening));
    curve.crack_length.push_back(path.crack_length());
    curve.fracture_work.push_back(path.fracture_work());
    curve.elastic_energy.push_back(path.elastic_energy());
    peak = std::max(peak, path.load());
    if (peak > 0.0 && path.load() <= end_load * peak) return curve;
    // The first step goes to the first crack; then the tip opens by a set fraction, the gauge by a tenth at most.
    const double opening = step * (parameters.delta0 + path.jump()[0]);
    const double rate = path.jump_rate()[0];
    const double increment = rate * next > 10.0 * opening ? opening / rate : 0.1 * next;
    next = next == 0.0 ? path.elastic_limit() : next + increment;
  }
  curve.failure = "the load had not fallen to the wanted value after " + std::to_string(most_points) + " steps";
  return curve;
}

double initial_stiffness(const NotchedSpecimen& specimen, double poisson_ratio, Gauge gauge) {
  return 1.0 / condense(specimen, poisson_ratio).body.gauge_load[static_cast<int>(gauge)];
}

InitialModulus initial_modulus(const NotchedSpecimen& specimen, double poisson_ratio, const Eigen::VectorXd& readings,
                               const Eigen::VectorXd& loads, double from, double to, Gauge gauge) {
  if (readings.size() != loads.size() || loads.size() == 0)
    throw std::invalid_argument("initial modulus: readings and loads must be as many, and at least one");
  if (!(from >= 0.0 && from < to && to <= 1.0))
    throw std::invalid_argument("initial modulus: 0 <= from < to <= 1 is required");
  Eigen::Index top = 0;
  const double peak = loads.maxCoeff(&top);
  std::vector<Eigen::Index> used;
  for (Eigen::Index k = 0; k <= top; ++k) {
    if (loads[k] >= from * peak && loads[k] <= to * peak) used.push_back(k);
  }
  if (used.size() < 3)
    throw std::invalid_argument("initial modulus: only " + std::to_string(used.size()) +
                                " points between the given fractions of the peak; three are needed");
  const Eigen::ArrayXd x = readings(used);
  const Eigen::ArrayXd y = loads(used);
  const Eigen::ArrayXd dx = x - x.mean();
  const double square = dx.square().sum();
  if (!(square > 0.0)) throw std::invalid_argument("initial modulus: all readings are the same");
  const double slope = (dx * (y - y.mean())).sum() / square;
  const Eigen::ArrayXd residual = y - y.mean() - slope * dx;
  const double per_stiffness = 1.0 / initial_stiffness(specimen, poisson_ratio, gauge);
  InitialModulus out;
  out.points = static_cast<int>(used.size());
  out.value = slope * per_stiffness;
  out.standard_error = per_stiffness * std::sqrt(residual.square().sum() / (out.points - 2.0) / square);
  out.offset = x.mean() - y.mean() / slope;
  return out;
}

std::string mesh_warning(const NotchedSpecimen& s, const Parameters& p) {
  const bool strain = s.setting == Setting::plane_strain;
  const double modulus = strain ? p.young_modulus / (1.0 - p.poisson_ratio * p.poisson_ratio) : p.young_modulus;
  const double allowed = 0.1 * modulus * p.delta0 / p.tensile_strength;
  const double element = s.mesh.ligament_fraction * s.ligament();
  if (element <= allowed * (1.0 + 1e-9)) return {};
  return "mesh.ligament_fraction = " + Checker::text(s.mesh.ligament_fraction) + " gives elements of " +
         Checker::text(element) + " m, longer than a tenth of E' delta0/sigma_t0 = " + Checker::text(10.0 * allowed) +
         " m: use " + Checker::text(allowed / s.ligament());
}

std::string mode_one_warning(const Parameters& p) {
  const double strength = uniaxial_tensile_strength(p);
  if (strength >= p.tensile_strength) return {};
  return "with cohesion = " + Checker::text(p.cohesion) + " Pa, tension cracks on an inclined plane at " +
         Checker::text(strength) + " Pa, below tensile_strength = " + Checker::text(p.tensile_strength) +
         " Pa; the straight mode I crack of this prediction needs a higher cohesion";
}

}  // namespace fpz::calibration
