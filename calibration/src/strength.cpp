#include "fpz/calibration/strength.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "admissible.hpp"
#include "fpz/calibration/onset_traction.hpp"
#include "fpz/material.hpp"
#include "jet.hpp"

namespace fpz::calibration {
namespace {

/// What the criterion needs of the parameters.
template <class T>
struct Criterion {
  T strength;  ///< sigma_t0
  T cohesion;  ///< c0
  T apex;      ///< A
  T sine;      ///< of phi
  T cosine;
  T tangent;
};

template <class T>
Criterion<T> criterion(const BasicParameters<T>& p) {
  using std::cos;
  using std::sin;
  const T phi = p.friction_angle_deg * degree;
  Criterion<T> c{p.tensile_strength, p.cohesion, T(0.0), sin(phi), cos(phi), T(0.0)};
  c.tangent = c.sine / c.cosine;
  c.apex = c.cohesion - c.strength * c.tangent;
  return c;
}

/// The load factor x at which a stress whose outer Mohr circle has centre x p1 and radius x r1 (p1 + r1 = 1)
/// meets the criterion. Either the plane normal to the largest principal stress fails at sigma_t0, or
/// sqrt(r^2 + A^2) = c0 cos(phi) - p sin(phi), squared.
template <class T>
T proportional_peak(const Criterion<T>& c, double p1, double r1) {
  using std::sqrt;
  if (r1 * value(c.strength) <= value(c.apex) * value(c.tangent)) return c.strength;
  const T k = c.cohesion * c.cosine;
  const T a = r1 * r1 - p1 * p1 * c.sine * c.sine;
  const T b = p1 * c.sine * k;
  const T free = k * k - c.apex * c.apex;
  return (sqrt(b * b + a * free) - b) / a;
}

/// Radius of the Mohr circle at the peak of compression under a confining pressure: the larger root of
/// cos^2(phi) r^2 - 2 k sin(phi) r + A^2 - k^2 = 0, k = c0 cos(phi) + pressure sin(phi).
template <class T>
T compression_radius(const Criterion<T>& c, double pressure) {
  using std::sqrt;
  const T k = c.cohesion * c.cosine + pressure * c.sine;
  const T a = c.apex * c.cosine;
  return (k * c.sine + sqrt(k * k - a * a)) / (c.cosine * c.cosine);
}

/// F = 0 on the plane of a shear box.
template <class T>
T shear_peak(const Criterion<T>& c, double pressure) {
  return surface_shear(T(c.cohesion + pressure * c.tangent), c.apex);
}

template <class T>
T peak(const Criterion<T>& c, const StrengthPoint& x) {
  switch (x.kind) {
    case StrengthKind::uniaxial_tension:
      return proportional_peak(c, 0.5, 0.5);
    case StrengthKind::uniaxial_compression:
      return 2.0 * compression_radius(c, 0.0);
    case StrengthKind::direct_shear:
      return shear_peak(c, x.pressure);
    case StrengthKind::triaxial_axial:
      return x.pressure + 2.0 * compression_radius(c, x.pressure);
    case StrengthKind::triaxial_deviator:
      return 2.0 * compression_radius(c, x.pressure);
    case StrengthKind::brazilian_stress:
      return proportional_peak(c, -1.0, 2.0);
    case StrengthKind::brazilian_load:
      return proportional_peak(c, -1.0, 2.0) / splitting_stress(1.0, x.diameter, x.thickness);
  }
  return T(0.0);
}

/// What is wrong with a specimen, or nothing.
std::string problem(const StrengthPoint& x, const Parameters& p) {
  std::ostringstream text;
  const bool triaxial = x.kind == StrengthKind::triaxial_axial || x.kind == StrengthKind::triaxial_deviator;
  if (!std::isfinite(x.pressure)) {
    text << "the pressure is not a number";
  } else if (triaxial && x.pressure < 0.0) {
    text << "the confining pressure " << x.pressure << " Pa is negative; compression counts positive here";
  } else if (x.kind == StrengthKind::direct_shear && -x.pressure >= p.tensile_strength) {
    text << "a normal stress of " << x.pressure << " Pa (compression positive) pulls the plane apart without shear: "
         << "the tensile strength is " << p.tensile_strength << " Pa";
  } else if (x.kind == StrengthKind::brazilian_load && !(x.diameter > 0.0 && x.thickness > 0.0)) {
    text << "the disc needs a diameter and a thickness above zero (m), not " << x.diameter << " and " << x.thickness;
  }
  return text.str();
}

}  // namespace

double splitting_stress(double load, double diameter, double thickness) {
  return 2.0 * load / (std::numbers::pi * diameter * thickness);
}

Prediction predict(const StrengthTest& test, const Parameters& parameters, bool derivatives) {
  if (std::string why = why_inadmissible(parameters); !why.empty()) return failed(std::move(why));
  const auto n = static_cast<Eigen::Index>(test.points.size());
  Prediction out;
  out.values.resize(n);
  if (derivatives) out.jacobian.resize(n, parameter_count);
  const Criterion<double> plain = criterion(parameters);
  for (Eigen::Index i = 0; i < n; ++i) {
    const StrengthPoint& x = test.points[static_cast<std::size_t>(i)];
    if (const std::string why = problem(x, parameters); !why.empty()) {
      return failed("specimen " + std::to_string(i + 1) + " (" + std::string(to_string(x.kind)) + "): " + why);
    }
    out.values[i] = peak(plain, x);
  }
  if (!derivatives) return out;
  const Criterion<Jet> lifted = criterion(seeded(parameters));
  for (Eigen::Index i = 0; i < n; ++i) {
    out.jacobian.row(i) = peak(lifted, test.points[static_cast<std::size_t>(i)]).v.transpose();
  }
  return out;
}

}  // namespace fpz::calibration
