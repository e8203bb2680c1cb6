#include "verdict_study.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "fpz/calibration/mid_line.hpp"

namespace fpz::calibration::test {
namespace {

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed * 0x9E3779B97F4A7C15U + 1) {}
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
  double between(double a, double b) { return a + (b - a) * uniform(); }
  double spread(double a, double b) { return a * std::pow(b / a, uniform()); }  ///< evenly in the logarithm
  double normal() { return std::sqrt(-2.0 * std::log(1.0 - uniform())) * std::cos(2.0 * std::numbers::pi * uniform()); }

 private:
  std::mt19937_64 generator_;
};

NotchedSpecimen random_specimen(Random& random) {
  NotchedSpecimen s;
  s.depth = random.spread(0.04, 0.2);
  s.span = s.depth * random.between(2.5, 4.0);
  s.length = s.span + s.depth;
  s.notch = s.depth * random.between(0.1, 0.5);
  s.thickness = s.depth * random.between(0.3, 1.0);
  return s;
}

Parameters random_material(Random& random, double ligament) {
  Parameters p;
  p.young_modulus = random.spread(15e9, 60e9);
  p.poisson_ratio = 0.2;
  p.density = 2400.0;
  p.tensile_strength = random.spread(1.5e6, 6e6);
  const double zone = ligament * random.spread(0.3, 5.0);  // E delta0/sigma_t0
  p.delta0 = zone * p.tensile_strength / p.young_modulus;
  p.cohesion = 5.0 * p.tensile_strength;
  p.friction_angle_deg = 35.0;
  p.dilation_angle_deg = 5.0;
  p.normal_stiffness = 1e3 * p.tensile_strength / p.delta0;
  p.shear_stiffness = p.normal_stiffness;
  return p;
}

/// CMOD at which the load has fallen to a part of its peak.
double cmod_at(const FractureCurve& curve, double part) {
  const double peak = *std::max_element(curve.load.begin(), curve.load.end());
  std::size_t k = curve.load.size() - 1;
  while (k > 0 && curve.load[k] < part * peak) --k;
  return curve.cmod[k];
}

}  // namespace

StudyBeam study_beam(std::uint64_t number) {
  Random random(number);
  StudyBeam beam;
  beam.specimen = random_specimen(random);
  beam.truth = random_material(random, beam.specimen.ligament());
  if (number % 4 == 3) beam.truth.choices.softening = softening_kind<BilinearSoftening>;
  constexpr std::array<double, 4> noises = {0.0, 0.003, 0.01, 0.03};
  beam.noise = noises[number / 4 % 4];

  NotchedSpecimen fine = beam.specimen;
  fine.mesh.ligament_fraction *= 0.5;
  fine.mesh.tip_fraction *= 0.5;
  const FractureCurve curve = fracture_curve(fine, beam.truth, 0.08, 0.08);
  if (!curve.failure.empty()) throw std::runtime_error("study beam: " + curve.failure);
  const double end = cmod_at(curve, random.between(0.1, 0.3));
  const auto points = static_cast<Eigen::Index>(std::lround(random.spread(8.0, 100.0)));
  const double power = random.uniform() < 0.5 ? 1.0 : 2.0;
  beam.cmod = end * Eigen::VectorXd::LinSpaced(points, 1.0 / static_cast<double>(points), 1.0).array().pow(power);

  const Condensation body = condense(fine, beam.truth.poisson_ratio);
  MidLine path(body, beam.truth, {}, false);
  const double peak = *std::max_element(curve.load.begin(), curve.load.end());
  beam.load.resize(points);
  for (Eigen::Index k = 0; k < points; ++k) {
    if (const std::string why = path.advance(beam.cmod[k]); !why.empty()) throw std::runtime_error(why);
    beam.load[k] = path.load() + beam.noise * peak * random.normal();
  }
  return beam;
}

namespace {

Specification specification_of(const StudyBeam& beam, double off, int starts) {
  Specification spec;
  spec.options.starts = starts;
  for (int k = 0; k < parameter_count; ++k) {
    spec.parameters[static_cast<std::size_t>(k)].value = beam.truth.*parameter_info[static_cast<std::size_t>(k)].member;
  }
  for (const Parameter p : {Parameter::young_modulus, Parameter::tensile_strength, Parameter::delta0}) {
    ParameterSetting& s = spec.parameters[static_cast<std::size_t>(p)];
    s.fitted = true;
    s.lower = s.value / 8.0;
    s.upper = s.value * 8.0;
    s.value *= off;
    off = 1.0 / off;
  }
  spec.choices = beam.truth.choices;
  spec.density = beam.truth.density;
  DataSet set;
  set.name = "beam";
  set.kind = "notched_beam";
  set.abscissa = beam.cmod;
  set.measured = beam.load;
  set.deviation = Eigen::VectorXd::Ones(beam.load.size());
  set.deviation_known = false;
  NotchedData data;
  data.test.specimen = beam.specimen;
  data.test.readings = beam.cmod;
  set.test = std::move(data);
  spec.data.push_back(std::move(set));
  return spec;
}

}  // namespace

StudyOutcome study_fit(const StudyBeam& beam, double off, int starts) {
  const Specification spec = specification_of(beam, off, starts);
  const FitResult fitted = fit(make_problem(spec), fit_options(spec));
  StudyOutcome out;
  out.status = fitted.status;
  out.message = fitted.message;
  if (fitted.status == FitStatus::failed) return out;
  const Eigen::Vector3d truth(beam.truth.young_modulus, beam.truth.tensile_strength, beam.truth.delta0);
  out.fitted = fitted.values;
  out.error = fitted.standard_error.cwiseMax(fitted.correlated_error);
  constexpr double meshes = 0.002;
  const Eigen::Array3d errors = (out.error.array().square() + (meshes * truth.array()).square()).sqrt();
  out.deviation = ((out.fitted - truth).array().abs() / errors).maxCoeff();
  const boost::math::students_t distribution(static_cast<double>(beam.load.size()) - 3.0);
  out.right = out.deviation < quantile(complement(distribution, 0.5e-3));
  return out;
}

}  // namespace fpz::calibration::test
