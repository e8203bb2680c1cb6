// The rate problem of a cracked point on its yield surface, as an autonomous ODE.
//
// With the drive q moving at a constant rate q' (per unit of the increment), y = (tau_s, a) obeys (docs/equations.md,
// eq 63-67)
//   c_n dtau_n/dtau_s . tau_s' + (m_n/D + w_a tau_n k_n) a' = q_n'
//   c_s tau_s'                 + (tau_s/D + w_a tau_s k_s) a' = q_s',      D = m_n + |tau_s|, w_a = dw/da,
// with the drag k(w) of the zone (law/unloading.hpp; dc/dw in the published one). Eliminating tau_s' leaves  h a' =
// numerator;  h > 0 is exactly uniqueness of the rate problem (no snap-back), numerator > 0 is loading.
#pragma once

#include "fpz/integrators/zone.hpp"

namespace fpz::detail {

/// Which smooth piece of the rate equations holds.
struct Branch {
  bool tension = true;
  double shear_sign = 1.0;  ///< sign of tau_s, with one shear component
  bool shear = true;        ///< false: tau_s is zero to rounding and stays so, and |tau_s| counts as constant
  int piece = 0;            ///< of the softening law
};

/// Shear tractions below this fraction of A are rounding.
inline constexpr double negligible_shear = 1e-12;

template <class T, int NS>
struct RatePoint {
  using Shear = Vec<T, NS>;
  T w;
  SurfacePoint<T> hyp;
  ScaledCompliance<T> c;
  T shear;         ///< |tau_s| (signed continuation of it with one component)
  T inv;           ///< 1/(m_n + |tau_s|)
  Shear unit;      ///< d|tau_s|/dtau_s
  Shear normal_s;  ///< dtau_n/dtau_s
  T m12;           ///< coefficient of a' in the normal equation
  Shear m22;       ///< coefficient of a' in the shear equation
  T h;             ///< rate modulus: > 0 where the rate problem has one solution
  T inverse_cs;
  T inverse_radius;
  T ratio;  ///< c_n / c_s
};

/// Coefficients of the rate equations at (tau_s, w). `direction`: where tau_s heads, used only at tau_s = 0.
template <int NS, class T, class Law>
[[nodiscard]] FPZ_INLINE RatePoint<T, NS> rate_point(const Zone<Law>& zone, const Branch& branch,
                                                     const Vec<T, NS>& tau_s, const T& w, const Vec<T, NS>& direction) {
  using std::sqrt;
  RatePoint<T, NS> r;
  r.w = w;
  const T s2 = squared_norm(tau_s);
  r.hyp = zone.law.surface.point(s2);
  r.c = scaled_compliance(zone, w, branch.tension);
  if (!branch.shear) {
    r.shear = T(0.0);
    r.unit = Vec<T, NS>::Constant(T(0.0));
  } else if constexpr (NS == 1) {
    r.unit[0] = T(branch.shear_sign);
    r.shear = branch.shear_sign * tau_s[0];
  } else if (value(s2) > 0.0) {
    r.shear = sqrt(s2);
    r.unit = tau_s / r.shear;
  } else {
    const T d2 = squared_norm(direction);
    r.shear = T(0.0);
    r.unit = value(d2) > 0.0 ? Vec<T, NS>(direction / T(sqrt(d2))) : Vec<T, NS>(Vec<T, NS>::Constant(T(0.0)));
  }
  const T sum = r.hyp.flow_n + r.shear;
  const bool flows = value(sum) > 0.0;
  // One division for the three reciprocals that the rates need.
  const T radius_shear = r.hyp.radius * r.c.shear;
  const T joint = 1.0 / (flows ? T(radius_shear * sum) : radius_shear);
  r.inv = flows ? T(joint * radius_shear) : T(0.0);
  const T rest = flows ? T(joint * sum) : joint;
  r.inverse_cs = rest * r.hyp.radius;
  r.inverse_radius = rest * r.c.shear;
  r.normal_s = tau_s * zone.law.surface.slope(r.inverse_radius);
  const T w_a = zone.law.softening.slope(branch.piece, w);
  r.m12 = r.hyp.flow_n * r.inv + w_a * r.c.normal_drag * r.hyp.normal;
  r.m22 = tau_s * T(r.inv + w_a * r.c.shear_drag);
  r.ratio = r.c.normal * r.inverse_cs;
  r.h = r.m12;
  for (int k = 0; k < NS; ++k) r.h -= r.ratio * r.normal_s[k] * r.m22[k];
  return r;
}

/// h a' for a drive rate; positive means plastic loading.
template <class T, int NS>
[[nodiscard]] FPZ_INLINE T loading(const RatePoint<T, NS>& r, const T& rate_n, const Vec<T, NS>& rate_s) {
  T n = rate_n;
  for (int k = 0; k < NS; ++k) n -= r.ratio * r.normal_s[k] * rate_s[k];
  return n;
}

template <class T, int NS>
struct Rates {
  Vec<T, NS> tau_s;
  T a;
};

/// Solves the 1+NS rate equations for a right-hand side (normal, shear).
template <class T, int NS>
[[nodiscard]] Rates<T, NS> solve_rates(const RatePoint<T, NS>& r, const T& rhs_n, const Vec<T, NS>& rhs_s) {
  Rates<T, NS> f;
  f.a = loading(r, rhs_n, rhs_s) / r.h;
  for (int k = 0; k < NS; ++k) f.tau_s[k] = (rhs_s[k] - r.m22[k] * f.a) * r.inverse_cs;
  return f;
}

/// Jacobian d(f)/d(tau_s, a) of the rates f: J = -M^-1 (dM/dy . f) with the coefficient matrix M of the rate equations.
template <class T, int NS, class Law>
[[nodiscard]] Mat<T, NS + 1, NS + 1> rate_jacobian(const Zone<Law>& zone, const Branch& branch,
                                                   const RatePoint<T, NS>& r, const Vec<T, NS>& tau_s,
                                                   const Rates<T, NS>& f) {
  const Law& law = zone.law;
  const T w_a = law.softening.slope(branch.piece, r.w);
  const T w_aa = law.softening.curvature(branch.piece, r.w);
  const T drag_n = w_a * w_a * zone.normal_law(branch.tension).drag_slope();  // w_a d(drag)/da
  const T drag_s = w_a * w_a * zone.shear_law().drag_slope();
  const typename Law::Scalar flow_slope = law.surface.flow_slope();
  T s_dot = T(0.0);
  T g_dot = T(0.0);
  for (int k = 0; k < NS; ++k) {
    s_dot += tau_s[k] * f.tau_s[k];
    g_dot += r.normal_s[k] * f.tau_s[k];
  }
  const T inv2 = r.inv * r.inv;
  const T bend = law.surface.bend(r.inverse_radius);
  const T slope = law.surface.slope(r.inverse_radius);
  Mat<T, NS + 1, NS + 1> jac;
  for (int j = 0; j <= NS; ++j) {  // column j: derivative with respect to y_j of the products M(y) f
    T dn;
    Vec<T, NS> ds;
    if (j < NS) {
      const T flow_j = flow_slope * r.normal_s[j];
      const T fraction_j = (flow_j * r.shear - r.hyp.flow_n * r.unit[j]) * inv2;
      const T inv_j = -(flow_j + r.unit[j]) * inv2;
      dn = r.c.normal * slope * (f.tau_s[j] - tau_s[j] * s_dot * bend) +
           f.a * (fraction_j + w_a * r.c.normal_drag * r.normal_s[j]);
      for (int k = 0; k < NS; ++k) {
        ds[k] = f.a * tau_s[k] * inv_j;
        if (k == j) ds[k] += f.a * (r.inv + w_a * r.c.shear_drag);
      }
    } else {
      dn = r.c.normal_slope * w_a * g_dot + f.a * w_aa * r.c.normal_drag * r.hyp.normal + f.a * drag_n * r.hyp.normal;
      for (int k = 0; k < NS; ++k) {
        ds[k] = w_a * r.c.shear_slope * f.tau_s[k] + f.a * w_aa * r.c.shear_drag * tau_s[k] + f.a * drag_s * tau_s[k];
      }
    }
    const Rates<T, NS> column = solve_rates<T, NS>(r, T(-dn), Vec<T, NS>(-ds));
    for (int k = 0; k < NS; ++k) jac(k, j) = column.tau_s[k];
    jac(NS, j) = column.a;
  }
  return jac;
}

/// yield_entry() of the consistent zone: the traction goes straight on, tension or not.
template <int Dim, class T, class Law>
[[nodiscard]] FPZ_INLINE T yield_entry_without_kink(const Zone<Law>& zone, const T& w, const Vec<T, Dim>& q0,
                                                    const Vec<T, Dim>& dq) {
  constexpr int NS = Dim - 1;
  const Vec<T, Dim> e = elastic_compliance<T, Dim>(zone, w);
  const T n = q0[0] / e[0];
  const T dn = dq[0] / e[0];
  Vec<T, NS> s, ds;
  Vec<double, NS> s_end;
  for (int k = 0; k < NS; ++k) {
    s[k] = q0[k + 1] / e[k + 1];
    ds[k] = dq[k + 1] / e[k + 1];
    s_end[k] = value(s[k]) + value(ds[k]);
  }
  const auto& surface = zone.law.surface;
  const double n_end = value(n) + value(dn);
  if (surface.template contains<NS>(value(w), n_end, s_end)) return T(-1.0);
  T x = surface.template exit_fraction<NS>(w, n, s, dn, ds);
  if (value(x) >= 0.0 && value(x) <= 1.0) return x;
  // Near the tip of a separated zone's surface rounding decides; what ends well outside has left at once.
  const double shear2 = squared_norm(s_end);
  const double size = value(w) * value(surface.cohesion) + std::abs(n_end) + std::sqrt(shear2);
  return value(surface.value_at(T(n_end), T(shear2), w)) > 1e-10 * size ? T(0.0) : T(-1.0);
}

/// First fraction in [0, 1] at which the elastic motion q0 + x dq reaches the yield surface, or a negative value. In
/// the published zone scaled tractions in tension, plain ones in compression, so that w = 0 is no special case; the
/// path has a kink where q_n = 0. The elastic domain is convex, so a straight piece that ends inside never left it.
template <int Dim, class T, class Law>
[[nodiscard]] FPZ_INLINE T yield_entry(const Zone<Law>& zone, const T& w, const Vec<T, Dim>& q0,
                                       const Vec<T, Dim>& dq) {
  constexpr int NS = Dim - 1;
  if (!has_contact_kink(zone.law.zone)) return yield_entry_without_kink<Dim>(zone, w, q0, dq);
  const auto& surface = zone.law.surface;
  bool tension = value(q0[0]) > 0.0 || (value(q0[0]) == 0.0 && value(dq[0]) >= 0.0);
  const double end_n = value(q0[0]) + value(dq[0]);
  const bool crosses = tension ? end_n < 0.0 : end_n > 0.0;
  const T kink = crosses ? T(-q0[0] / dq[0]) : T(1.0);
  const T inverse_cs = 1.0 / zone.shear_compliance(w);
  // At the kink tau_n = 0, whatever the scale: this test has no rounding that w could magnify.
  bool inside_at_kink = true;
  if (crosses) {
    double shear2 = 0.0;
    for (int k = 1; k < Dim; ++k) {
      const double tau = value(q0[k] + dq[k] * kink) * value(inverse_cs);
      shear2 += tau * tau;
    }
    inside_at_kink = surface.contains_shear(shear2);
  }
  for (int piece = 0; piece < (crosses ? 2 : 1); ++piece, tension = !tension) {
    const T from = piece == 0 ? T(0.0) : kink;
    T to = piece == 0 ? kink : T(1.0);
    const T scale = tension ? T(1.0) : w;
    const T inverse_cn = 1.0 / (zone.law.flexibility_n + (tension ? w : T(1.0)) * zone.series.normal);
    const T n = (q0[0] + dq[0] * from) * inverse_cn;
    const T dn = dq[0] * inverse_cn;
    const double length = value(to) - value(from);
    Vec<T, NS> s, ds;
    Vec<double, NS> s_end;
    for (int k = 0; k < NS; ++k) {
      s[k] = scale * (q0[k + 1] + dq[k + 1] * from) * inverse_cs;
      ds[k] = scale * dq[k + 1] * inverse_cs;
      s_end[k] = value(s[k]) + length * value(ds[k]);
    }
    const bool ends_at_kink = crosses && piece == 0;
    const double n_end = value(n) + length * value(dn);
    if (ends_at_kink ? inside_at_kink : surface.template contains<NS>(value(scale), n_end, s_end)) continue;
    const T x = surface.template exit_fraction<NS>(scale, n, s, dn, ds);
    if (value(x) >= 0.0 && value(x) <= length) return from + x;
    if (ends_at_kink) return to;  // it does leave; rounding put the exit beyond the kink
  }
  return T(-1.0);
}

}  // namespace fpz::detail
