#include "fpz/calibration/size_effect.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fpz/calibration/fit.hpp"
#include "fpz/calibration/fracture_energy.hpp"
#include "fpz/calibration/peak_load.hpp"
#include "fpz/law/softening.hpp"

namespace fpz::calibration {
namespace {

constexpr double same = 1e-3;  // relative differences of geometry that do not count

double brittleness(const NotchedSpecimen& s, const GeometryFunction& f) { return s.height() * f.g() / f.g_slope(); }

/// G_f and c_f from the line (thickness D/P)^2 = (g D + g' c_f)/(E' G_f), or what is of the right size where it falls.
Eigen::Vector2d start_of(const PeakLoads& peaks, const std::vector<GeometryFunction>& geometry, double plane_modulus) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double largest_size = 0.0, energy = 0.0;
  for (std::size_t k = 0; k < geometry.size(); ++k) {
    const NotchedSpecimen& s = peaks.specimens[k];
    const double load = peaks.load[static_cast<Eigen::Index>(k)];
    const double y = std::pow(s.thickness * s.height() / load, 2);
    const Eigen::Vector2d x = {geometry[k].g() * s.height() / y, geometry[k].g_slope() / y};
    normal += x * x.transpose();
    right += x;
    largest_size = std::max(largest_size, s.height());
    energy = std::max(energy, std::pow(stress_intensity(s, geometry[k], load), 2) / plane_modulus);
  }
  const Eigen::Vector2d line = normal.fullPivLu().solve(right);
  if (line.allFinite() && line.minCoeff() > 0.0) return {1.0 / (plane_modulus * line[0]), line[1] / line[0]};
  return {energy, 0.05 * largest_size};
}

SizeEffectLaw without_law(std::string why) {
  SizeEffectLaw out;
  out.failure = std::move(why);
  return out;
}

Prediction predict_law(const PeakLoads& peaks, const std::vector<GeometryFunction>& geometry, double plane_modulus,
                       const Eigen::VectorXd& x, bool derivatives) {
  Prediction out;
  const auto n = static_cast<Eigen::Index>(geometry.size());
  out.values.resize(n);
  if (derivatives) out.jacobian.resize(n, 2);
  for (Eigen::Index k = 0; k < n; ++k) {
    const GeometryFunction& f = geometry[static_cast<std::size_t>(k)];
    const NotchedSpecimen& s = peaks.specimens[static_cast<std::size_t>(k)];
    const double load = size_effect_load(s, f, plane_modulus, x[0], x[1]);
    out.values[k] = load;
    if (!derivatives) continue;
    out.jacobian(k, 0) = 0.5 * load / x[0];
    out.jacobian(k, 1) = -0.5 * load * f.g_slope() / (f.g_slope() * x[1] + f.g() * s.height());
  }
  return out;
}

/// Nominal stresses of the cohesive model from half the least to twice the largest size, as far as the mesh resolves
/// the process zone.
SizeEffectCurve curve_of(const NotchedSpecimen& shape, double least, double largest, const Parameters& p) {
  constexpr int count = 13;
  SizeEffectCurve out;
  for (int k = 0; k < count; ++k) {
    NotchedSpecimen s = shape;
    const double size = 0.5 * least * std::pow(4.0 * largest / least, static_cast<double>(k) / (count - 1));
    for (double NotchedSpecimen::*length : in_plane_lengths) s.*length *= size / shape.height();
    if (!mesh_warning(s, p).empty()) break;
    const Prediction x = predict(PeakLoadTest{{{s}}}, p, false);
    if (!x.ok()) continue;
    out.size.push_back(size);
    out.model_stress.push_back(x.values[0] / (s.thickness * s.height()));
  }
  return out;
}

bool alike(const std::vector<GeometryFunction>& geometry) {
  return std::all_of(geometry.begin(), geometry.end(), [&](const GeometryFunction& f) {
    return std::abs(f.k / geometry.front().k - 1.0) < same && std::abs(f.slope / geometry.front().slope - 1.0) < same;
  });
}

}  // namespace

double size_effect_load(const NotchedSpecimen& s, const GeometryFunction& f, double plane_modulus, double energy,
                        double length) {
  return s.thickness * s.height() * std::sqrt(plane_modulus * energy / (f.g_slope() * length + f.g() * s.height()));
}

SizeEffectLaw fit_size_effect(const PeakLoads& peaks, const std::vector<GeometryFunction>& geometry,
                              double plane_modulus) {
  if (geometry.size() < 3) return without_law("three specimens at least are needed");
  double low = brittleness(peaks.specimens[0], geometry[0]);
  double high = low;
  for (std::size_t k = 1; k < geometry.size(); ++k) {
    low = std::min(low, brittleness(peaks.specimens[k], geometry[k]));
    high = std::max(high, brittleness(peaks.specimens[k], geometry[k]));
  }
  if (high < low * (1.0 + 10.0 * same))
    return without_law("the specimens have one size: G_f and c_f cannot be told apart");
  constexpr double range = 1e3;  // of the bounds, either way
  const Eigen::Vector2d start = start_of(peaks, geometry, plane_modulus);
  FitProblem problem;
  problem.parameters = {{"G_f", "G_f", "N/m", start[0], start[0] / range, start[0] * range, {}},
                        {"c_f", "c_f", "m", start[1], start[1] / range, start[1] * range, {}}};
  Observations o;
  o.name = "largest loads";
  o.measured = peaks.load;
  o.deviation = peaks.deviation;
  o.deviation_known = peaks.deviation_known;
  o.forward = [&](const Eigen::VectorXd& x, bool derivatives) {
    return predict_law(peaks, geometry, plane_modulus, x, derivatives);
  };
  problem.data.push_back(std::move(o));
  FitOptions options;
  options.starts = 1;
  const FitResult r = fit(problem, options);
  if (!r.usable() || !r.at_lower_bound.empty() || !r.at_upper_bound.empty()) {
    return without_law(
        "the loads determine no G_f and c_f: they follow strength or toughness alone, or scatter too much");
  }
  SizeEffectLaw out;
  out.energy = r.values[0];
  out.length = r.values[1];
  out.energy_error = r.standard_error[0];
  out.length_error = r.standard_error[1];
  out.correlation = r.correlation(0, 1);
  out.load = r.data[0].predicted;
  return out;
}

std::optional<SizeEffect> size_effect(const PeakLoads& peaks, const Eigen::VectorXd& model_load, const Parameters& p) {
  if (peaks.specimens.empty() || model_load.size() != peaks.load.size()) return std::nullopt;
  SizeEffect out;
  std::vector<GeometryFunction> geometry;
  for (const NotchedSpecimen& s : peaks.specimens) {
    if (!(s.notch >= least_notch * s.height())) return std::nullopt;  // type 1: another law
    const auto known = std::find(peaks.specimens.begin(), peaks.specimens.end(), s) - peaks.specimens.begin();
    geometry.push_back(static_cast<std::size_t>(known) < geometry.size() ? geometry[static_cast<std::size_t>(known)]
                                                                         : geometry_function(s, p.poisson_ratio));
  }
  const Setting setting = peaks.specimens.front().setting;
  out.total_energy = p.tensile_strength * p.delta0;
  out.initial_energy = 0.5 * p.tensile_strength * Softening<double>::make(p).shortest_length();
  out.toughness = toughness_from_energy(out.total_energy, p.young_modulus, p.poisson_ratio, setting);
  out.plane_modulus = out.toughness * out.toughness / out.total_energy;
  double least = INFINITY, largest = 0.0;
  out.brittleness_low = INFINITY;
  for (std::size_t k = 0; k < geometry.size(); ++k) {
    const NotchedSpecimen& s = peaks.specimens[k];
    const auto row = static_cast<Eigen::Index>(k);
    const double area = s.thickness * s.height();
    out.points.push_back({geometry[k], s.height(), peaks.load[row] / area, model_load[row] / area,
                          stress_intensity(s, geometry[k], peaks.load[row]),
                          stress_intensity(s, geometry[k], model_load[row])});
    out.brittleness_low = std::min(out.brittleness_low, brittleness(s, geometry[k]));
    out.brittleness_high = std::max(out.brittleness_high, brittleness(s, geometry[k]));
    least = std::min(least, s.height());
    largest = std::max(largest, s.height());
  }
  out.law = fit_size_effect(peaks, geometry, out.plane_modulus);
  PeakLoads of_model = peaks;
  of_model.load = model_load;
  of_model.deviation_known = true;  // no scatter to estimate it from
  out.of_model = fit_size_effect(of_model, geometry, out.plane_modulus);
  out.similar = alike(geometry);
  if (out.similar && out.law.ok()) out.curve = curve_of(peaks.specimens.front(), least, largest, p);
  return out;
}

}  // namespace fpz::calibration
