// Algorithm 1 (b): backward Euler stress return, with the traction continuity of Algorithm 2 eliminated.
//
// In the local frame bulk and cohesive stiffness are diagonal, so u = d - b t removes the jump, and with scaled
// tractions (yield.hpp) two scalar unknowns remain, S = |tau_s| and a = d(kappa):
//   r1 = q_n - c_n(w) tau_n(S) - a m_n/(m_n+S) = 0,   r2 = |q_s| - c_s(w) S - a S/(m_n+S) = 0,   w = w_old
//   exp(-a/delta0).
// Newton from a rate predictor takes 2-4 iterations. If it leaves the domain, a bracketed solve takes over: r2 fixes S
// uniquely for every a, and G(a) = r1(S(a), a) falls from G(0) > 0 to minus infinity, so a root always exists (psi >
// 0).
#pragma once

#include <limits>

#include "fpz/cohesive_state.hpp"
#include "fpz/options.hpp"

namespace fpz::detail {

/// Residuals and Jacobian of the backward Euler system at (S, a).
template <class T>
struct ReturnSystem {
  T r1, r2;
  T r1_s, r1_a, r2_s, r2_a;
  T w;
  HyperbolaPoint<T> hyp;
  T inv;       ///< 1/(m_n + S), 0 without flow
  T normal_s;  ///< d tau_n / dS
  T c_normal, c_shear;

  /// r1_s r2_a - r1_a r2_s; negative where G(a) falls, which is the discrete form of h_ser > 0.
  [[nodiscard]] T determinant() const { return r1_s * r2_a - r1_a * r2_s; }
  /// h > 0 of the rate problem (rate.hpp) at this point of the surface, times c_s > 0.
  [[nodiscard]] T rate_modulus() const { return c_normal * normal_s * r2_a - r1_a * c_shear; }
  /// q_s = shear_factor(a) * tau_s, as vectors.
  [[nodiscard]] T shear_factor(const T& a) const { return c_shear + a * inv; }
};

template <class T, class P, class X>
[[nodiscard]] ReturnSystem<T> return_system(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, const T& qn,
                                            const T& qs, const T& w_old, const X& s, const X& a) {
  ReturnSystem<T> e;
  e.w = w_old * integrity_ratio(law, T(a));
  e.hyp = hyperbola(law, T(s * s));
  const ScaledCompliance<T> c = scaled_compliance(law, series, e.w, value(e.hyp.normal) >= 0.0);
  const T sum = e.hyp.flow_n + s;
  e.inv = value(sum) > 0.0 ? T(1.0 / sum) : T(0.0);
  e.normal_s = -s * law.cot_phi / e.hyp.radius;
  e.c_normal = c.normal;
  e.c_shear = c.shear;
  const T flow_s = -law.tan_psi * law.tan_psi * e.normal_s;
  const T w_a = integrity_slope(law, e.w);
  const T fraction_n = e.hyp.flow_n * e.inv;
  const T fraction_s = s * e.inv;
  e.r1 = qn - c.normal * e.hyp.normal - a * fraction_n;
  e.r2 = qs - c.shear * s - a * fraction_s;
  e.r1_s = -c.normal * e.normal_s - a * (flow_s * fraction_s - fraction_n) * e.inv;
  e.r2_s = -c.shear - a * (fraction_n - fraction_s * flow_s) * e.inv;
  e.r1_a = -c.normal_slope * w_a * e.hyp.normal - fraction_n;
  e.r2_a = -c.shear_slope * w_a * s - fraction_s;
  return e;
}

struct ReturnSolution {
  Status status = Status::non_convergence;
  double s = 0.0;
  double a = 0.0;
  int iterations = 0;
  ReturnSystem<double> system;  ///< evaluated at (s, a)
};

/// S(a) from r2 = 0 by bracketed Newton; r2 falls strictly in S on [0, |q_s|/c_s].
inline double shear_at(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series, double qn, double qs,
                       double w_old, double a, double guess, int& iterations) {
  double lo = 0.0;
  double hi = qs / scaled_compliance(law, series, w_old * integrity_ratio(law, a), true).shear;
  double s = std::min(std::max(guess, lo), hi);
  for (int k = 0; k < 200; ++k) {
    ++iterations;
    const auto e = return_system(law, series, qn, qs, w_old, s, a);
    (e.r2 > 0.0 ? lo : hi) = s;
    double next = s - e.r2 / e.r2_s;
    if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
    if (std::abs(next - s) <= 1e-15 * (s + law.apex)) return next;
    s = next;
  }
  return s;
}

/// Bracketed solve of G(a) = r1(S(a), a) for its first root beyond 0.
inline ReturnSolution solve_bracketed(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series, double qn,
                                      double qs, double w_old, double a_guess, double tolerance) {
  ReturnSolution out;
  const double no_limit = std::numeric_limits<double>::infinity();
  const double a_limit = law.tan_psi > 0.0 ? no_limit : qs;  // without dilation the slip alone carries a
  double s = qs / scaled_compliance(law, series, w_old, true).shear;
  double lo = 0.0;
  double hi = std::min(std::max(a_guess, 1e-12 * law.delta0), a_limit);
  const auto g = [&](double a) {
    s = shear_at(law, series, qn, qs, w_old, a, s, out.iterations);
    return return_system(law, series, qn, qs, w_old, s, a);
  };
  for (int k = 0; k < 2000 && g(hi).r1 > 0.0; ++k) {
    if (hi >= a_limit) {
      out.status = Status::no_plastic_flow;
      return out;
    }
    lo = hi;
    hi = std::min(hi * 2.0, a_limit);
  }
  double a = hi;
  for (int k = 0; k < 300; ++k) {
    const auto e = g(a);
    (e.r1 > 0.0 ? lo : hi) = a;
    const double slope = -e.determinant() / e.r2_s;
    double next = a - e.r1 / slope;
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::abs(e.r1) <= tolerance || hi - lo <= 4e-16 * hi) {
      out.status = Status::ok;
      out.s = s;
      out.a = a;
      out.system = e;
      return out;
    }
    a = next;
  }
  return out;
}

/// Solves the backward Euler system on plain values. `s`, `a` on entry are the predictor.
inline ReturnSolution solve_return(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series, double qn,
                                   double qs, double w_old, double s, double a, double tolerance) {
  ReturnSolution out;
  const double a0 = a;
  bool close = false;  // the last step was so small that the next iterate is exact to rounding
  for (int k = 0; k < 12; ++k) {
    const ReturnSystem<double> e = return_system(law, series, qn, qs, w_old, s, a);
    ++out.iterations;
    const double det = e.determinant();
    const bool solved = std::abs(e.r1) <= tolerance && std::abs(e.r2) <= tolerance;
    if ((close || solved) && det < 0.0 && a >= 0.0) {
      out.status = Status::ok;
      out.s = s;
      out.a = a;
      out.system = e;
      return out;
    }
    const double inverse = 1.0 / det;
    const double ds = (e.r2 * e.r1_a - e.r1 * e.r2_a) * inverse;
    const double da = (e.r1 * e.r2_s - e.r2 * e.r1_s) * inverse;
    if (!(det < 0.0) || !std::isfinite(ds) || !std::isfinite(da)) break;
    close = std::abs(ds) <= 1e-9 * (s + law.apex) && std::abs(da) <= 1e-9 * a;
    s = qs == 0.0 ? 0.0 : std::max(s + ds, 0.0);
    a = std::max(a + da, 0.0);
  }
  const int spent = out.iterations;
  out = solve_bracketed(law, series, qn, qs, w_old, a0, tolerance);
  out.iterations += spent;
  return out;
}

}  // namespace fpz::detail
