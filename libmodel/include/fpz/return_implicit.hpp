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
  T w, flow_n, shear_factor;  ///< shear_factor: q_s = shear_factor * tau_s (vectors)

  /// r1_s r2_a - r1_a r2_s; negative where G(a) falls, which is the discrete form of h_ser > 0.
  [[nodiscard]] T determinant() const { return r1_s * r2_a - r1_a * r2_s; }
};

template <class T, class P, class X>
[[nodiscard]] ReturnSystem<T> return_system(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, const T& qn,
                                            const T& qs, const T& w_old, const X& s, const X& a) {
  ReturnSystem<T> e;
  e.w = w_old * integrity_ratio(T(a), law.delta0);
  const HyperbolaPoint<T> h = hyperbola(law, T(s * s));
  e.flow_n = h.flow_n;
  const ScaledCompliance<T> c = scaled_compliance(law, series, e.w, value(h.normal) >= 0.0);
  const T sum = h.flow_n + s;
  const bool flows = value(sum) > 0.0;
  const T inv = flows ? T(1.0 / sum) : T(0.0);
  const T normal_s = -s / (law.tan_phi * h.radius);  // d tau_n / dS
  const T flow_s = -law.tan_psi * law.tan_psi * normal_s;
  const T w_a = integrity_slope(e.w, law.delta0);
  e.r1 = qn - c.normal * h.normal - a * h.flow_n * inv;
  e.r2 = qs - c.shear * s - a * s * inv;
  e.r1_s = -c.normal * normal_s - a * (flow_s * s - h.flow_n) * inv * inv;
  e.r2_s = -c.shear - a * (h.flow_n - s * flow_s) * inv * inv;
  e.r1_a = -c.normal_slope * w_a * h.normal - h.flow_n * inv;
  e.r2_a = -c.shear_slope * w_a * s - s * inv;
  e.shear_factor = c.shear + a * inv;
  return e;
}

struct ReturnSolution {
  Status status = Status::non_convergence;
  double s = 0.0;
  double a = 0.0;
  int iterations = 0;
};

/// S(a) from r2 = 0 by bracketed Newton; r2 falls strictly in S on [0, |q_s|/c_s].
inline double shear_at(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series, double qn, double qs,
                       double w_old, double a, double guess, int& iterations) {
  double lo = 0.0;
  double hi = qs / scaled_compliance(law, series, w_old * integrity_ratio(a, law.delta0), true).shear;
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
  for (int k = 0; k < 12; ++k) {
    const auto e = return_system(law, series, qn, qs, w_old, s, a);
    ++out.iterations;
    const double det = e.determinant();
    if (std::abs(e.r1) <= tolerance && std::abs(e.r2) <= tolerance && det < 0.0 && a >= 0.0) {
      out.status = Status::ok;
      out.s = s;
      out.a = a;
      return out;
    }
    const double ds = (e.r2 * e.r1_a - e.r1 * e.r2_a) / det;
    const double da = (e.r1 * e.r2_s - e.r2 * e.r1_s) / det;
    if (!(det < 0.0) || !std::isfinite(ds) || !std::isfinite(da)) break;
    s = std::max(s + ds, 0.0);
    a = std::max(a + da, 0.0);
    if (qs == 0.0) s = 0.0;
    // Converged to rounding although the residual test is stricter than the rounding of its terms.
    if (std::abs(ds) <= 1e-14 * (s + law.apex) && std::abs(da) <= 1e-14 * a && a > 0.0) {
      out.status = Status::ok;
      out.s = s;
      out.a = a;
      return out;
    }
  }
  const int spent = out.iterations;
  out = solve_bracketed(law, series, qn, qs, w_old, a0, tolerance);
  out.iterations += spent;
  return out;
}

}  // namespace fpz::detail
