// How the jump of a zone that does not yield follows its traction: the two forms of a cohesive zone, and all in which
// they differ (docs/equations.md).
//
//   published   t = P K (u + u0 - up), u0 = K^-1 t_onset, eq 44-46: springs preloaded at onset with an energy that
//               nobody has paid for; in compression (t_n < 0) the normal one keeps its stiffness
//   consistent  u - up = D K^-1 t: rigid at onset, 1/K when D = 1. Stores t.D K^-1.t/2 >= 0. The growth of its
//               compliance is reversible: dup = flow - K^-1 t dD/2, so that t.du = d(stored) + t.flow for any K
//
// In series with the compliance b of the bulk both are q = d + u0 - up = c(w) tau for the scaled traction tau = t/w:
//   c(w) = fixed + w (linear + bent (1 - w)).
#pragma once

#include "fpz/parameters.hpp"

namespace fpz {

/// Integrity below which the consistent zone does not fall: the tensile strength left is nothing, but the yield surface
/// keeps a size, and with it the friction of closed faces. Exponential softening is there after 23 delta0.
inline constexpr double least_integrity = 1e-10;

/// c(w) of one component, m/Pa.
template <class P>
struct ComplianceLaw {
  P fixed{};
  P linear{};
  P bent{};

  /// c(w).
  template <class T>
  [[nodiscard]] FPZ_INLINE T at(const T& w) const {
    return fixed + w * (linear + bent * (1.0 - w));
  }
  /// dc/dw.
  template <class T>
  [[nodiscard]] FPZ_INLINE T slope(const T& w) const {
    return linear + bent * (1.0 - 2.0 * w);
  }
  /// Coefficient of tau dw in dq - c dtau - flow: dc/dw and the reversible work.
  template <class T>
  [[nodiscard]] FPZ_INLINE T drag(const T& w) const {
    return linear + bent * (1.0 - 1.5 * w);
  }
  /// d(drag)/dw.
  [[nodiscard]] FPZ_INLINE P drag_slope() const { return -1.5 * bent; }

  /// What takes the place of c(w) in one step of backward Euler from w_old: the integral of the drag. Exact where tau
  /// is constant, as in pure opening. Beyond a loss of half the integrity the reversible work counts less, which keeps
  /// it positive, unless it is a pure opening (`whole`).
  template <class T>
  [[nodiscard]] FPZ_INLINE T over_step(const T& w_old, const T& w, bool whole) const {
    const T span = whole || value(w) * 2.0 >= value(w_old) ? T(w_old + w) : T(3.0 * w);
    return at(w) - 0.25 * bent * (w_old - w) * span;
  }
  /// Its derivative with respect to w.
  template <class T>
  [[nodiscard]] FPZ_INLINE T over_step_slope(const T& w_old, const T& w, bool whole) const {
    return whole || value(w) * 2.0 >= value(w_old) ? drag(w) : T(slope(w) + 0.75 * bent * (2.0 * w - w_old));
  }
};

/// The normal component. `flexibility` is 1/Kn, `bulk` the compliance in series (m/Pa).
template <class P>
[[nodiscard]] FPZ_INLINE ComplianceLaw<P> normal_compliance(CohesiveZone form, const P& flexibility, const P& bulk,
                                                            bool tension) {
  if (form == CohesiveZone::consistent) return {P(0.0), bulk, flexibility};
  return tension ? ComplianceLaw<P>{flexibility, bulk, P(0.0)}
                 : ComplianceLaw<P>{P(0.0), P(flexibility + bulk), P(0.0)};
}

/// A shear component, with 1/Ks.
template <class P>
[[nodiscard]] FPZ_INLINE ComplianceLaw<P> shear_compliance(CohesiveZone form, const P& flexibility, const P& bulk) {
  if (form == CohesiveZone::consistent) return {P(0.0), bulk, flexibility};
  return {flexibility, bulk, P(0.0)};
}

/// Whether the compliance has a kink where the normal traction changes its sign.
[[nodiscard]] FPZ_INLINE bool has_contact_kink(CohesiveZone form) { return form == CohesiveZone::published; }

/// The softening of a zone ends at this integrity; 0: where the softening law itself does, if it does.
[[nodiscard]] inline double integrity_floor(CohesiveZone form) {
  return form == CohesiveZone::consistent ? least_integrity : 0.0;
}

/// The stiffnesses of unloading and contact in use (Pa/m).
template <class P>
struct UnloadingStiffness {
  P normal{};
  P shear{};
};

/// Those of the published zone are Kn and Ks. The consistent zone never unloads softer than to the origin of the curve
/// that is as brittle as it: at least sigma_t0/delta0 and c0/delta0. A softer one would snap back by itself.
template <class P>
[[nodiscard]] UnloadingStiffness<P> unloading_stiffness(const BasicParameters<P>& p) {
  if (p.choices.cohesive_zone == CohesiveZone::published) return {p.normal_stiffness, p.shear_stiffness};
  const auto larger = [](const P& a, const P& b) { return value(a) < value(b) ? b : a; };
  return {larger(p.normal_stiffness, P(p.tensile_strength / p.delta0)),
          larger(p.shear_stiffness, P(p.cohesion / p.delta0))};
}

}  // namespace fpz
