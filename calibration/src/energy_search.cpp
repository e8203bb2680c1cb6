// Inverse problems of the fracture energy: one parameter from one energy, and what two energies leave open.
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "fpz/calibration/fracture_energy.hpp"
#include "words.hpp"

namespace fpz::calibration {
namespace {

/// Enough digits to find the value again in the input.
std::string number(double x) { return detail::number(x, 5); }

Parameters with(Parameters p, Parameter which, double value) {
  p.*info(which).member = value;
  return p;
}

/// Energy as a function of one number; NaN where the model gives none.
using Energy = std::function<double(double)>;

double energy_or_nan(const FractureEnergyTest& test, const Parameters& p) {
  const Prediction x = predict(test, p, false);
  return x.ok() ? x.values[0] : std::numeric_limits<double>::quiet_NaN();
}

/// The root of energy(exp(x)) = target between two x that bracket it.
double refine(const Energy& energy, double target, double lo, double hi) {
  const auto excess = [&](double x) { return energy(std::exp(x)) - target; };
  std::uintmax_t evaluations = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      excess, lo, hi, boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits), evaluations);
  return std::exp(0.5 * (below + above));
}

/// Samples the range in equal ratios and refines the bracket closest to `present`.
ParameterForEnergy search(const Energy& energy, double target, double present, double lower, double upper) {
  constexpr int samples = 33;
  ParameterForEnergy out;
  out.least = std::numeric_limits<double>::infinity();
  out.largest = -out.least;
  double last_x = 0.0;
  double last_g = std::numeric_limits<double>::quiet_NaN();
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < samples; ++k) {
    const double x = std::log(lower) + (std::log(upper) - std::log(lower)) * k / (samples - 1);
    const double g = energy(std::exp(x));
    if (!std::isnan(g)) {
      out.least = std::min(out.least, g);
      out.largest = std::max(out.largest, g);
      const bool bracket = !std::isnan(last_g) && (last_g - target) * (g - target) <= 0.0 && last_g != g;
      if (bracket) {
        const double root = refine(energy, target, last_x, x);
        const double distance = std::abs(std::log(root / present));
        if (distance < nearest) {
          nearest = distance;
          out.value = root;
        }
      }
    }
    last_x = x;
    last_g = g;
  }
  if (out.value) return out;
  if (!(out.least <= out.largest)) {
    out = {};
    out.failure = "the model admits no value between " + number(lower) + " and " + number(upper);
  } else {
    out.failure = "no value between " + number(lower) + " and " + number(upper) + " gives " + number(target) +
                  " J/m2: the model reaches " + number(out.least) + " to " + number(out.largest) + " J/m2";
  }
  return out;
}

/// delta0 that gives energy_one, or NaN.
double delta0_of(const FractureEnergyTest& one, const Parameters& p, double energy_one) {
  if (one.path == FracturePath::opening && !one.end && !one.onset_angle_deg) {
    return mode_one_delta0(energy_one, p.tensile_strength);
  }
  const ParameterForEnergy found = delta0_for_energy(one, p, energy_one);
  return found.value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string in_words(const FreedParameter& f, double energy_two) {
  const ParameterInfo<double>& which = info(f.range.parameter);
  const std::string name(which.symbol);
  std::string unit;
  if (!which.unit.empty()) unit.append(1, ' ').append(which.unit);
  const std::string range = number(f.range.lower) + " to " + number(f.range.upper) + unit;
  if (f.match.value) {
    return "Freeing " + name + ": " + name + " = " + number(*f.match.value) + unit +
           " with delta0 = " + number(*f.delta0) + " m matches both energies.";
  }
  if (f.match.least > f.match.largest || !(f.match.largest > 0.0)) {
    return "Freeing " + name + " cannot match both energies: " + f.match.failure + ".";
  }
  if (f.match.largest - f.match.least <= 1e-9 * f.match.largest) {
    return "Freeing " + name + " cannot match both energies: G_II = " + number(f.match.largest) +
           " J/m2 does not depend on it in this test.";
  }
  return "Freeing " + name + " cannot match both energies: between " + range +
         " the model reaches G_II = " + number(f.match.least) + " to " + number(f.match.largest) +
         " J/m2, measured are " + number(energy_two) + " J/m2.";
}

void check(const ParameterRange& r) {
  if (!(r.lower > 0.0 && r.lower < r.upper && std::isfinite(r.upper))) {
    throw std::invalid_argument("the range of " + std::string(info(r.parameter).name) + " must have 0 < lower < upper");
  }
}

}  // namespace

ParameterForEnergy parameter_for_energy(const FractureEnergyTest& test, const Parameters& parameters, Parameter which,
                                        double energy, double lower, double upper) {
  check({which, lower, upper});
  if (!(energy > 0.0 && std::isfinite(energy))) {
    throw std::invalid_argument("the fracture energy must be above zero, not " + number(energy));
  }
  const auto at = [&](double x) { return energy_or_nan(test, with(parameters, which, x)); };
  ParameterForEnergy out = search(at, energy, parameters.*info(which).member, lower, upper);
  if (!out.value && std::isnan(at(lower)) && std::isnan(at(upper))) {
    const Prediction x = predict(test, parameters, false);
    if (!x.ok()) out.failure += " (at the given parameters: " + x.failure + ")";
  }
  return out;
}

ParameterForEnergy delta0_for_energy(const FractureEnergyTest& test, const Parameters& parameters, double energy) {
  const double guess = energy / parameters.tensile_strength;
  return parameter_for_energy(test, with(parameters, Parameter::delta0, guess), Parameter::delta0, energy, 1e-4 * guess,
                              1e4 * guess);
}

std::vector<ParameterRange> default_ranges(const Parameters& p) {
  const double tan_phi = std::tan(p.friction_angle_deg * degree);
  return {{Parameter::shear_stiffness, 1e-2 * p.shear_stiffness, 1e2 * p.shear_stiffness},
          {Parameter::cohesion, p.tensile_strength * tan_phi * (1.0 + 1e-6), 10.0 * p.cohesion},
          {Parameter::dilation_angle_deg, 1e-3 * p.friction_angle_deg, p.friction_angle_deg}};
}

TwoEnergies compare_energies(const FractureEnergyTest& one, double energy_one, const FractureEnergyTest& two,
                             double energy_two, const Parameters& parameters,
                             const std::vector<ParameterRange>& ranges) {
  TwoEnergies out;
  const ParameterForEnergy from_one = delta0_for_energy(one, parameters, energy_one);
  const ParameterForEnergy from_two = delta0_for_energy(two, parameters, energy_two);
  if (!from_one.value || !from_two.value) {
    out.failure =
        "no delta0 from " + (from_one.value ? "G_II alone: " + from_two.failure : "G_I alone: " + from_one.failure);
    return out;
  }
  out.delta0_one = *from_one.value;
  out.delta0_two = *from_two.value;
  out.two_at_one = energy_or_nan(two, with(parameters, Parameter::delta0, out.delta0_one));
  out.one_at_two = energy_or_nan(one, with(parameters, Parameter::delta0, out.delta0_two));
  out.consistent = std::abs(std::log(out.delta0_one / out.delta0_two)) < 1e-6;
  out.statements.push_back("delta0 = " + number(out.delta0_one) + " m from G_I = " + number(energy_one) +
                           " J/m2 alone, " + number(out.delta0_two) + " m from G_II = " + number(energy_two) +
                           " J/m2 alone.");
  out.statements.push_back("With delta0 from G_I the model has G_II = " + number(out.two_at_one) + " J/m2, " +
                           number(out.two_at_one / energy_two) +
                           " times the measured one; with delta0 from G_II it has "
                           "G_I = " +
                           number(out.one_at_two) + " J/m2, " + number(out.one_at_two / energy_one) +
                           " times the measured one.");
  if (out.consistent) {
    out.statements.emplace_back("One delta0 matches both energies.");
  } else {
    out.statements.emplace_back("One delta0 cannot match both energies with the other parameters as they are.");
  }
  for (const ParameterRange& range : ranges) {
    check(range);
    const auto refitted = [&](double x) {
      Parameters p = with(parameters, range.parameter, x);
      p.delta0 = delta0_of(one, p, energy_one);
      return p;
    };
    const auto energy = [&](double x) { return energy_or_nan(two, refitted(x)); };
    const double present = parameters.*info(range.parameter).member;
    FreedParameter f;
    f.range = range;
    f.match = search(energy, energy_two, present, range.lower, range.upper);
    if (f.match.value) f.delta0 = refitted(*f.match.value).delta0;
    // d ln G_II at constant G_I: delta0 follows the parameter.
    const Parameters p = with(parameters, Parameter::delta0, out.delta0_one);
    const Prediction g1 = predict(one, p, true);
    const Prediction g2 = predict(two, p, true);
    if (g1.ok() && g2.ok()) {
      const auto k = static_cast<Eigen::Index>(range.parameter);
      const auto d = static_cast<Eigen::Index>(Parameter::delta0);
      const double follow = -g1.jacobian(0, k) / g1.jacobian(0, d);
      f.sensitivity = (g2.jacobian(0, k) + g2.jacobian(0, d) * follow) * present / g2.values[0];
    }
    f.words = in_words(f, energy_two);
    out.statements.push_back(f.words);
    out.freed.push_back(std::move(f));
  }
  return out;
}

}  // namespace fpz::calibration
