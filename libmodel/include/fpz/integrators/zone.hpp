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

  /// c_n(w) and c_s(w), m/Pa.
  [[nodiscard]] FPZ_INLINE ComplianceLaw<P> normal_law(bool tension) const {
    return normal_compliance(law.zone, law.flexibility_n, series.normal, tension);
  }
  [[nodiscard]] FPZ_INLINE ComplianceLaw<P> shear_law() const {
    return fpz::shear_compliance(law.zone, law.flexibility_s, series.shear);
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T shear_compliance(const T& w) const {
    return shear_law().at(w);
  }
};

/// A straight motion of the drive over one increment (local frame, m).
template <class T, int Dim>
struct Drive {
  Vec<T, Dim> from;
  Vec<T, Dim> to;
};

namespace detail {

/// Compliances that multiply the scaled traction (law/unloading.hpp; eq 46: in compression P = 1).
template <class T>
struct ScaledCompliance {
  T normal;
  T shear;
  T normal_slope;  ///< d c_n / d w
  T shear_slope;   ///< d c_s / d w
  T normal_drag;   ///< coefficients of tau dw: the slopes, but for the reversible work of the consistent zone
  T shear_drag;
};

template <class T, class Law>
[[nodiscard]] FPZ_INLINE ScaledCompliance<T> scaled_compliance(const Zone<Law>& zone, const T& w, bool tension) {
  const auto n = zone.normal_law(tension);
  const auto s = zone.shear_law();
  return {n.at(w), s.at(w), n.slope(w), s.slope(w), n.drag(w), s.drag(w)};
}

/// t = q/e(w) of the consistent zone: e = b + (1 - w)/K, m/Pa.
template <class T, int Dim, class Law>
[[nodiscard]] FPZ_INLINE Vec<T, Dim> elastic_compliance(const Zone<Law>& zone, const T& w) {
  Vec<T, Dim> e;
  e[0] = zone.series.normal + (1.0 - w) * zone.law.flexibility_n;
  for (int k = 1; k < Dim; ++k) e[k] = zone.series.shear + (1.0 - w) * zone.law.flexibility_s;
  return e;
}

/// Elastic traction with continuity satisfied, for q = d + u0 - up (eq 40): t = P K (u + u0 - up) of eq 44-46, or of
/// u - up = D K^-1 t. Every operation is diagonal in the local frame.
template <class T, int Dim, class Law>
[[nodiscard]] FPZ_INLINE Vec<T, Dim> elastic_traction(const Zone<Law>& zone, const T& w, const Vec<T, Dim>& q) {
  Vec<T, Dim> t;
  if (zone.law.zone == CohesiveZone::consistent) {
    const Vec<T, Dim> e = elastic_compliance<T, Dim>(zone, w);
    for (int k = 0; k < Dim; ++k) t[k] = q[k] / e[k];
    return t;
  }
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
