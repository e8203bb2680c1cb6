// The paper's yield surface and flow rule (eq 48-50).
//
// Eq 48 is homogeneous of degree two in (t, w), w = 1 - D (docs/equations.md). With the scaled traction tau = t/w every
// damage level has the same surface, the hyperbola
//   sqrt(|tau_s|^2 + A^2) = c0 - tau_n tan(phi),  A = c0 - sigma_t0 tan(phi).
// All iterations run on scaled tractions, so that D -> 1 is no special case.
#pragma once

#include <cmath>

#include "fpz/parameters.hpp"

namespace fpz {

/// The point of the scaled surface at a shear magnitude |tau_s|, and the flow there.
template <class T>
struct SurfacePoint {
  T radius;  ///< sqrt(|tau_s|^2 + A^2), Pa: the slopes of the surface need its reciprocal
  T normal;  ///< tau_n on the surface, Pa
  T flow_n;  ///< normal part of the flow direction, tan(psi) (c0 - tau_n tan(psi)), Pa; the shear part is tau_s (eq
             ///< 49-50)
};

/// Angle theta in [0, 90) degrees between the normal of the critical plane and the largest principal direction.
template <class T>
struct Inclination {
  T cosine = T(1.0);
  T sine = T(0.0);
};

/// A surface is a plain struct of constants with the members below; the integrators know it through them. Requirements:
/// homogeneous of degree one in (t, w), convex, a function of t_n and |t_s|, monotone in t_n.
template <class P>
struct HyperbolicSurface {
  P tensile_strength{};  ///< sigma_t0, Pa
  P cohesion{};          ///< c0, Pa
  P tan_phi{};
  P tan_psi{};
  P sin_phi{};
  P cos_phi{};
  P apex{};  ///< A = c0 - sigma_t0 tan(phi), Pa: the scale of the hyperbola
  P cot_phi{};
  P inverse_apex{};  ///< 1/Pa
  P normal_0{};      ///< on the surface tau_n = normal_0 - cot(phi) R with R = sqrt(|tau_s|^2 + A^2)
  P flow_0{};        ///< on the surface m_n = tan(psi) (c0 - tau_n tan(psi)) = flow_0 + flow_1 R
  P flow_1{};

  [[nodiscard]] static HyperbolicSurface make(const BasicParameters<P>& p) {
    using std::cos;
    using std::sin;
    using std::tan;
    HyperbolicSurface y;
    y.tensile_strength = p.tensile_strength;
    y.cohesion = p.cohesion;
    y.tan_phi = tan(p.friction_angle_deg * degree);
    y.tan_psi = tan(p.dilation_angle_deg * degree);
    y.sin_phi = sin(p.friction_angle_deg * degree);
    y.cos_phi = cos(p.friction_angle_deg * degree);
    y.apex = p.cohesion - p.tensile_strength * y.tan_phi;
    y.cot_phi = 1.0 / y.tan_phi;
    y.inverse_apex = 1.0 / y.apex;
    y.normal_0 = y.cohesion * y.cot_phi;
    y.flow_0 = y.tan_psi * (y.cohesion - y.tan_psi * y.normal_0);
    y.flow_1 = y.tan_psi * y.tan_psi * y.cot_phi;
    return y;
  }

  /// The same in plain doubles.
  [[nodiscard]] HyperbolicSurface<double> values() const {
    return {value(tensile_strength), value(cohesion), value(tan_phi), value(tan_psi),
            value(sin_phi),          value(cos_phi),  value(apex),    value(cot_phi),
            value(inverse_apex),     value(normal_0), value(flow_0),  value(flow_1)};
  }

  /// f of eq 48 as printed (Pa^2): ts2 = |t_s|^2, w = 1 - D. Negative again on the spurious branch t_n > 2c/tan(phi) -
  /// s.
  template <class T, class W>
  [[nodiscard]] T printed_value(const T& tn, const T& ts2, const W& w) const {
    const T c = T(cohesion * w);
    const T s = T(tensile_strength * w);
    return ts2 - 2.0 * c * tan_phi * (s - tn) - tan_phi * tan_phi * (tn * tn - s * s);
  }

  /// F (Pa): same zero set as eq 48 on the physical branch, monotone in t_n, convex, homogeneous of degree one in
  /// (t, w): F = sqrt(|t_s|^2 + (w A)^2) - (w c0 - t_n tan(phi)). Negative inside, positive outside.
  template <class T, class W>
  [[nodiscard]] T value_at(const T& tn, const T& ts2, const W& w) const {
    using std::sqrt;
    const T a = T(apex * w);
    return sqrt(ts2 + a * a) - (cohesion * w - tn * tan_phi);
  }

  /// Rate of F at the undamaged traction t along dt (local frame), Pa.
  template <class T, int Dim>
  [[nodiscard]] double value_rate(const Vec<T, Dim>& t, const Vec<T, Dim>& dt) const {
    const double ts2 = value(squared_norm(Vec<T, Dim - 1>(t.template tail<Dim - 1>())));
    double s = value(dt[0]) * value(tan_phi);
    for (int k = 1; k < Dim; ++k) {
      s += value(t[k]) * value(dt[k]) / std::sqrt(ts2 + value(apex) * value(apex));
    }
    return s;
  }

  template <class T>
  [[nodiscard]] FPZ_INLINE SurfacePoint<T> point(const T& shear_squared) const {
    using std::sqrt;
    SurfacePoint<T> h;
    h.radius = sqrt(shear_squared + apex * apex);
    h.normal = normal_0 - cot_phi * h.radius;
    h.flow_n = flow_0 + flow_1 * h.radius;
    return h;
  }

  /// d(tau_n)/d(tau_s) = slope tau_s, where d(slope)/d(tau_s) = -slope bend tau_s; both from 1/radius.
  template <class T>
  [[nodiscard]] FPZ_INLINE T slope(const T& inverse_radius) const {
    return -cot_phi * inverse_radius;
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T bend(const T& inverse_radius) const {
    return inverse_radius * inverse_radius;
  }
  /// d(tau_n)/d|tau_s| at the shear magnitude s.
  template <class T, class X>
  [[nodiscard]] FPZ_INLINE T slope_along(const X& s, const T& inverse_radius) const {
    return -s * cot_phi * inverse_radius;
  }
  /// Bound of |d(tau_n)/d|tau_s||.
  [[nodiscard]] P steepest_slope() const { return cot_phi; }
  /// d(m_n)/d(tau_n) along the surface.
  [[nodiscard]] P flow_slope() const { return -tan_psi * tan_psi; }
  /// Whether an opening can be relaxed at all: without dilation the flow has no normal part.
  [[nodiscard]] bool dilates() const { return value(tan_psi) != 0.0; }

  /// Whether a traction (n, s) lies inside the surface scaled by `scale`, or on it.
  template <int NS>
  [[nodiscard]] FPZ_INLINE bool contains(double scale, double n, const Vec<double, NS>& s) const {
    const double l = scale * value(cohesion) - n * value(tan_phi);
    const double a = scale * value(apex);
    double outside = a * a - l * l;
    for (int k = 0; k < NS; ++k) outside += s[k] * s[k];
    return l > 0.0 && outside <= 0.0;
  }
  /// The same for a traction without a normal part, undamaged.
  [[nodiscard]] FPZ_INLINE bool contains_shear(double shear_squared) const {
    return shear_squared + value(apex) * value(apex) <= value(cohesion) * value(cohesion);
  }

  /// Fraction x >= 0 at which the straight path (n, s) + x (dn, ds) leaves the surface scaled by `scale`,
  /// |s|^2 + a^2 <= (c - n tan(phi))^2 on the physical branch, started inside (or on it, to rounding). Negative: it
  /// never leaves. Closed form.
  template <int NS, class T>
  [[nodiscard]] FPZ_INLINE T exit_fraction(const T& scale, const T& n, const Vec<T, NS>& s, const T& dn,
                                           const Vec<T, NS>& ds) const {
    using std::sqrt;
    const T c = scale * cohesion;
    const T a = scale * apex;
    const T l = c - n * tan_phi;
    const T dl = -dn * tan_phi;
    T ss = T(0.0);
    T sd = T(0.0);
    T dd = T(0.0);
    T cross = T(0.0);
    for (int k = 0; k < NS; ++k) {
      ss += s[k] * s[k];
      sd += s[k] * ds[k];
      dd += ds[k] * ds[k];
      const T twist = l * ds[k] - dl * s[k];
      cross += twist * twist;
    }
    // qa x^2 + 2 qb x + qc = 0. For qa < 0 the leading terms of the discriminant cancel and are left out; otherwise it
    // is a sum of non-negative terms.
    const T qa = dd - dl * dl;
    const T qb = sd - l * dl;
    T qc = ss + a * a - l * l;
    if (value(qc) > 0.0) qc = T(0.0);  // outside by rounding: the start is on the surface
    T disc = qb * qb - qa * qc;
    if (value(qa) < 0.0 && value(qc) < 0.0) {
      disc = cross - a * a * qa;
      if constexpr (NS > 1) disc -= ss * dd - sd * sd;
    }
    if (value(disc) < 0.0) return T(-1.0);
    if (value(qb) > 0.0) return -qc / (qb + sqrt(disc));
    if (value(qa) <= 0.0) return T(-1.0);
    return value(disc) > 0.0 ? T((sqrt(disc) - qb) / qa) : T(-qb / qa);
  }

  // The critical plane of a Mohr circle with centre p and radius r (docs/equations.md). It is inclined while the
  // tangent point lies on the circle, else normal to the largest principal stress.

  /// Largest F over all planes of the circle, undamaged (Pa).
  template <class T>
  [[nodiscard]] T largest_value(const T& p, const T& r) const {
    using std::sqrt;
    if (value(r) > value(apex) * value(tan_phi)) {
      return sqrt(r * r + apex * apex) / cos_phi + p * tan_phi - cohesion;
    }
    return (p + r - tensile_strength) * tan_phi;
  }

  template <class T>
  [[nodiscard]] Inclination<T> critical_inclination(const T& r) const {
    using std::sqrt;
    Inclination<T> i;
    if (value(r) > value(apex) * value(tan_phi)) {
      const T c = sin_phi * sqrt(r * r + apex * apex) / r;  // cos 2 theta
      if (value(c) < 1.0) {
        i.cosine = sqrt((1.0 + c) * 0.5);
        i.sine = sqrt((1.0 - c) * 0.5);
      }
    }
    return i;
  }

  /// Cheap test that a stress is inside the onset surface. False means "look closer", true is certain.
  template <int Dim>
  [[nodiscard]] FPZ_INLINE bool surely_intact(const Tensor<double, Dim>& s) const {
    const double sin = value(sin_phi);
    const double strength = value(cohesion) * value(cos_phi);
    const double a = value(apex);
    if constexpr (Dim == 2) {
      const double p = 0.5 * (s[0] + s[1]);
      const double d = 0.5 * (s[0] - s[1]);
      const double room = strength - p * sin;
      return room > 0.0 && d * d + s[2] * s[2] + a * a < room * room;
    } else {
      // r <= sqrt(J2) and centre <= mean + sqrt(J2)/(2 sqrt 3) for the outer Mohr circle.
      const double mean = (s[0] + s[1] + s[2]) / 3.0;
      const double x = s[0] - mean;
      const double y = s[1] - mean;
      const double z = s[2] - mean;
      const double j2 = 0.5 * (x * x + y * y + z * z) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
      constexpr double k = 0.28867513459481287;  // 1/(2 sqrt 3)
      const double room = strength - mean * sin;
      const double shape = 1.0 + k * sin;
      if (room > 0.0 && (j2 + a * a) * shape * shape < room * room) return true;  // without the root below
      const double less = room - k * std::sqrt(j2) * sin;
      return less > 0.0 && j2 + a * a < less * less;
    }
  }
};

}  // namespace fpz
