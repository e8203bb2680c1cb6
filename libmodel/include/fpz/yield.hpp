// Yield surface and flow rule (eq 48-50) of the cohesive zone.
//
// Eq 48 is homogeneous of degree two in (t, w), w = 1 - D (docs/equations.md). With the scaled traction tau = t/w every
// damage level has the same surface, the
// hyperbola  sqrt(|tau_s|^2 + A^2) = c0 - tau_n tan(phi),  A = c0 - sigma_t0
// tan(phi). All iterations run on scaled tractions, so that D -> 1 is no special case.
#pragma once

#include <cmath>

#include "fpz/material.hpp"
#include "fpz/types.hpp"

namespace fpz {

/// f of eq 48 as printed (Pa^2): ts2 = |t_s|^2, w = 1 - D. Negative again on the spurious branch t_n > 2c/tan(phi) - s.
template <class T, class W, class P>
[[nodiscard]] T yield_paper(const CohesiveLaw<P>& law, const T& tn, const T& ts2, const W& w) {
  const T c = T(law.cohesion * w);
  const T s = T(law.tensile_strength * w);
  return ts2 - 2.0 * c * law.tan_phi * (s - tn) - law.tan_phi * law.tan_phi * (tn * tn - s * s);
}

/// F (Pa): same zero set as eq 48 on the physical branch, monotone in t_n, convex, homogeneous of degree one in (t, w):
/// F = sqrt(|t_s|^2 + (w A)^2) - (w c0 - t_n tan(phi)). Negative inside, positive outside.
template <class T, class W, class P>
[[nodiscard]] T yield_value(const CohesiveLaw<P>& law, const T& tn, const T& ts2, const W& w) {
  using std::sqrt;
  const T a = T(law.apex * w);
  return sqrt(ts2 + a * a) - (law.cohesion * w - tn * law.tan_phi);
}

/// The point of the scaled yield hyperbola at shear magnitude |tau_s|, and the flow there.
template <class T>
struct HyperbolaPoint {
  T radius;  ///< sqrt(|tau_s|^2 + A^2), Pa
  T normal;  ///< tau_n on the surface, Pa
  T flow_n;  ///< normal part of the flow direction, tan(psi) (c0 - tau_n
             ///< tan(psi)), Pa; the shear part is tau_s (eq 49-50)
};

template <class T, class P>
[[nodiscard]] FPZ_INLINE HyperbolaPoint<T> hyperbola(const CohesiveLaw<P>& law, const T& shear_squared) {
  using std::sqrt;
  HyperbolaPoint<T> h;
  h.radius = sqrt(shear_squared + law.apex * law.apex);
  h.normal = law.normal_0 - law.cot_phi * h.radius;
  h.flow_n = law.flow_0 + law.flow_1 * h.radius;
  return h;
}

}  // namespace fpz
