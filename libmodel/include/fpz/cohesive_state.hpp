// State of a cohesive zone and its elastic law (eq 43-46), shared by all stress returns.
#pragma once

#include <algorithm>
#include <cmath>

#include "fpz/softening.hpp"
#include "fpz/types.hpp"
#include "fpz/yield.hpp"

namespace fpz {

/// Cohesive zone in its local frame: component 0 is normal (opening positive), the others are shear. Dim is the number
/// of traction components: 1 (pure opening), 2 or 3.
template <class T, int Dim>
struct CohesiveState {
  Vec<T, Dim> traction = Vec<T, Dim>::Constant(T(0.0));      ///< t, Pa
  Vec<T, Dim> jump = Vec<T, Dim>::Constant(T(0.0));          ///< u, displacement jump since onset, m
  Vec<T, Dim> plastic_jump = Vec<T, Dim>::Constant(T(0.0));  ///< up, m
  Vec<T, Dim> offset = Vec<T, Dim>::Constant(T(0.0));        ///< u0 = K^-1 t_onset, m (docs/equations.md)
  T slip = T(0.0);                                           ///< up_s of eq 47: accumulated plastic slip, m
  T integrity = T(1.0);                                      ///< w = 1 - D
  T dissipated = T(0.0);                                     ///< energy dissipated since onset per crack area, J/m^2
};

/// The same state with another scalar type (constants lifted to duals, or plain values taken from them).
template <class To, class From, int Dim>
[[nodiscard]] CohesiveState<To, Dim> lift(const CohesiveState<From, Dim>& c) {
  CohesiveState<To, Dim> z;
  z.traction = convert<To>(c.traction);
  z.jump = convert<To>(c.jump);
  z.plastic_jump = convert<To>(c.plastic_jump);
  z.offset = convert<To>(c.offset);
  if constexpr (std::floating_point<To>) {
    z.slip = value(c.slip);
    z.integrity = value(c.integrity);
    z.dissipated = value(c.dissipated);
  } else {
    z.slip = To(c.slip);
    z.integrity = To(c.integrity);
    z.dissipated = To(c.dissipated);
  }
  return z;
}

/// False when any field is NaN or infinite.
template <class T, int Dim>
[[nodiscard]] bool is_finite(const CohesiveState<T, Dim>& c) {
  double sum = value(c.slip) + value(c.integrity) + value(c.dissipated);
  for (int k = 0; k < Dim; ++k) {
    sum += value(c.traction[k]) + value(c.jump[k]) + value(c.plastic_jump[k]) + value(c.offset[k]);
  }
  return std::isfinite(sum);
}

/// D of eq 47.

template <class T, int Dim>
[[nodiscard]] T damage(const CohesiveState<T, Dim>& c) {
  return 1.0 - c.integrity;
}

/// Compliances that multiply the scaled traction tau = t/w once traction continuity is eliminated: q = u_drive + u0 -
/// up = c(w) tau, with c_n = 1/Kn + w b_n in tension and w (1/Kn + b_n) in compression (eq 46: P = 1 there).
template <class T>
struct ScaledCompliance {
  T normal;
  T shear;
  T normal_slope;  ///< d c_n / d w
  T shear_slope;   ///< d c_s / d w
};

template <class T, class P>
[[nodiscard]] FPZ_INLINE ScaledCompliance<T> scaled_compliance(const CohesiveLaw<P>& law,
                                                               const SeriesCompliance<P>& series, const T& w,
                                                               bool tension) {
  const T flexibility = T(law.flexibility_n);
  ScaledCompliance<T> c;
  c.normal = tension ? T(flexibility + w * series.normal) : T(w * (flexibility + series.normal));
  c.normal_slope = tension ? T(series.normal) : T(flexibility + series.normal);
  c.shear = law.flexibility_s + w * series.shear;
  c.shear_slope = T(series.shear);
  return c;
}

/// Elastic traction t = P K (u + u0 - up) with traction continuity satisfied, for the drive-side jump q = u_drive + u0
/// - up (eq 40, 44-46). Every operation is diagonal in the local frame.
template <class T, int Dim, class P>
[[nodiscard]] FPZ_INLINE Vec<T, Dim> elastic_traction(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series,
                                                      const T& w, const Vec<T, Dim>& q) {
  Vec<T, Dim> t;
  t[0] = value(q[0]) >= 0.0 ? T(w * q[0] / (law.flexibility_n + w * series.normal))
                            : T(q[0] / (law.flexibility_n + series.normal));
  const T shear = w / (law.flexibility_s + w * series.shear);
  for (int k = 1; k < Dim; ++k) t[k] = shear * q[k];
  return t;
}

/// Energy release per unit of damage, Y = -d(psi)/dD >= 0, for a scaled traction (J/m^2). In compression only shear
/// counts.
template <class T, class P>
[[nodiscard]] T damage_energy(const CohesiveLaw<P>& law, const T& scaled_normal, const T& scaled_shear_squared) {
  const T shear = 0.5 * law.flexibility_s * scaled_shear_squared;
  return value(scaled_normal) > 0.0 ? T(shear + 0.5 * law.flexibility_n * scaled_normal * scaled_normal) : shear;
}

/// Free energy of the zone per area, psi = w' P K w'/2 with w' = u + u0 - up, minus its value at onset (J/m^2). Only
/// differences have meaning: the offset u0 preloads the springs K with an energy that no work has paid for.
template <class T, int Dim, class P>
[[nodiscard]] T free_energy(const CohesiveLaw<P>& law, const CohesiveState<T, Dim>& c) {
  const Vec<T, Dim> e = c.jump + c.offset - c.plastic_jump;
  const T normal = value(e[0]) > 0.0 ? T(c.integrity * e[0] * e[0]) : T(e[0] * e[0]);
  T shear = T(0.0);
  T shear_onset = T(0.0);
  for (int k = 1; k < Dim; ++k) {
    shear += e[k] * e[k];
    shear_onset += c.offset[k] * c.offset[k];
  }
  return 0.5 * (law.kn * (normal - c.offset[0] * c.offset[0]) + law.ks * (c.integrity * shear - shear_onset));
}

/// Dissipation per unit of (w d kappa) on the yield surface: t.dup + Y dD, all scaled by w (Pa; always >= 0). `shear`
/// is |tau_s|, `inv` is 1/(m_n + |tau_s|) or 0 without flow.
template <class T, class P>
[[nodiscard]] FPZ_INLINE T dissipation_density(const CohesiveLaw<P>& law, const HyperbolaPoint<T>& h, const T& shear,
                                               const T& inv) {
  const T shear_squared = shear * shear;
  return (h.normal * h.flow_n + shear_squared) * inv + damage_energy(law, h.normal, shear_squared) * law.inverse_delta0;
}

}  // namespace fpz
