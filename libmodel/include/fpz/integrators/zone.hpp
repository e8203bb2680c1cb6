// A cohesive zone in series with its bulk, once traction continuity is eliminated: what every integrator works on.
//
// In the local frame bulk and cohesive stiffness are diagonal, so u = d - b t (eq 40, 58) removes the jump: a drive d
// moves the zone, and q = d + u0 - up = c(w) tau holds for the scaled traction tau = t/w.
#pragma once

#include "fpz/energy.hpp"
#include "fpz/law/cohesive_law.hpp"
#include "fpz/state.hpp"

namespace fpz {

/// The law of a zone and the compliance of the bulk around it. Refers to both; they must outlive it.
template <class LawOf>
struct Zone {
  using Law = LawOf;
  using P = typename Law::Scalar;
  const Law& law;
  const SeriesCompliance<P>& series;

  Zone(const Law& l, const SeriesCompliance<P>& s) : law(l), series(s) {}

  /// c_s(w), m/Pa.
  template <class T>
  [[nodiscard]] FPZ_INLINE T shear_compliance(const T& w) const {
    return law.flexibility_s + w * series.shear;
  }
};

/// A straight motion of the drive over one increment (local frame, m).
template <class T, int Dim>
struct Drive {
  Vec<T, Dim> from;
  Vec<T, Dim> to;
};

namespace detail {

/// Compliances that multiply the scaled traction: c_n = 1/Kn + w b_n in tension and w (1/Kn + b_n) in compression
/// (eq 46: P = 1 there), c_s = 1/Ks + w b_s.
template <class T>
struct ScaledCompliance {
  T normal;
  T shear;
  T normal_slope;  ///< d c_n / d w
  T shear_slope;   ///< d c_s / d w
};

template <class T, class Law>
[[nodiscard]] FPZ_INLINE ScaledCompliance<T> scaled_compliance(const Zone<Law>& zone, const T& w, bool tension) {
  const T flexibility = T(zone.law.flexibility_n);
  ScaledCompliance<T> c;
  c.normal = tension ? T(flexibility + w * zone.series.normal) : T(w * (flexibility + zone.series.normal));
  c.normal_slope = tension ? T(zone.series.normal) : T(flexibility + zone.series.normal);
  c.shear = zone.shear_compliance(w);
  c.shear_slope = T(zone.series.shear);
  return c;
}

/// Elastic traction t = P K (u + u0 - up) with traction continuity satisfied, for q = d + u0 - up (eq 40, 44-46). Every
/// operation is diagonal in the local frame.
template <class T, int Dim, class Law>
[[nodiscard]] FPZ_INLINE Vec<T, Dim> elastic_traction(const Zone<Law>& zone, const T& w, const Vec<T, Dim>& q) {
  Vec<T, Dim> t;
  t[0] = value(q[0]) >= 0.0 ? T(w * q[0] / (zone.law.flexibility_n + w * zone.series.normal))
                            : T(q[0] / (zone.law.flexibility_n + zone.series.normal));
  const T shear = w / zone.shear_compliance(w);
  for (int k = 1; k < Dim; ++k) t[k] = shear * q[k];
  return t;
}

/// The jump u = d - b t that belongs to a drive and a traction (eq 40).
template <class T, int Dim, class P>
[[nodiscard]] FPZ_INLINE Vec<T, Dim> continuous_jump(const SeriesCompliance<P>& series, const Vec<T, Dim>& drive,
                                                     const Vec<T, Dim>& traction) {
  Vec<T, Dim> u;
  for (int k = 0; k < Dim; ++k) u[k] = drive[k] - (k == 0 ? series.normal : series.shear) * traction[k];
  return u;
}

}  // namespace detail
}  // namespace fpz
