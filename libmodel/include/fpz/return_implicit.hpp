// Algorithm 1 (b): backward Euler stress return, with the traction continuity of Algorithm 2 eliminated.
//
// In the local frame bulk and cohesive stiffness are diagonal, so u = d - b t removes the jump, and with scaled
// tractions (yield.hpp) two scalar unknowns remain, S = |tau_s| and a = d(kappa):
//   r1 = q_n - c_n(w) tau_n(S) - a m_n/(m_n+S) = 0,   r2 = |q_s| - c_s(w) S - a
//   S/(m_n+S) = 0,   w = w_old exp(-a/delta0).
// Newton from the point of first yield takes 2-4 iterations. If it leaves the domain, a bracketed solve takes over: r2
// fixes S uniquely for every a, and G(a) = r1(S(a), a) falls from G(0) > 0 to minus infinity, so a root always exists
// (psi > 0).
#pragma once

#include <limits>

#include "fpz/cohesive_state.hpp"
#include "fpz/options.hpp"

namespace fpz::detail {

/// A point of the damaged yield surface on which a return may end.
template <class T>
struct ReturnPoint {
  T w;
  HyperbolaPoint<T> hyp;
  T inv;      ///< 1/(m_n + S), 0 without flow
  T c_shear;  ///< c_s(w)
  /// q_s = shear_factor(a) * tau_s, as vectors.
  [[nodiscard]] T shear_factor(const T& a) const { return c_shear + a * inv; }
};

template <class T, class P>
[[nodiscard]] FPZ_INLINE T dissipation_density(const CohesiveLaw<P>& law, const ReturnPoint<T>& p, const T& shear) {
  return dissipation_density(law, p.hyp, shear, p.inv);
}

/// Residuals and Jacobian of the backward Euler system at (S, a).
template <class T>
struct ReturnSystem : ReturnPoint<T> {
  T r1, r2;
  T r1_s, r1_a, r2_s, r2_a;
  T normal_s;  ///< d tau_n / dS
  T c_normal;

  /// r1_s r2_a - r1_a r2_s; negative where G(a) falls, which is the discrete form of h > 0.
  [[nodiscard]] T determinant() const { return r1_s * r2_a - r1_a * r2_s; }
  /// h > 0 of the rate problem (rate.hpp) at this point of the surface, times c_s > 0.
  [[nodiscard]] T rate_modulus() const { return c_normal * normal_s * r2_a - r1_a * this->c_shear; }
};

template <class T, class P, class X>
[[nodiscard]] FPZ_INLINE ReturnSystem<T> return_system(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series,
                                                       const T& qn, const T& qs, const T& w_old, const X& s,
                                                       const X& a) {
  ReturnSystem<T> e;
  e.w = w_old * integrity_ratio(law, T(a));
  e.hyp = hyperbola(law, T(s * s));
  const ScaledCompliance<T> c = scaled_compliance(law, series, e.w, value(e.hyp.normal) >= 0.0);
  const T sum = e.hyp.flow_n + s;
  const bool flows = value(sum) > 0.0;
  const T joint = 1.0 / (flows ? T(sum * e.hyp.radius) : e.hyp.radius);  // one division for two reciprocals
  e.inv = flows ? T(joint * e.hyp.radius) : T(0.0);
  e.normal_s = -s * law.cot_phi * (flows ? T(joint * sum) : joint);
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
  double entry_density = 0.0;  ///< dissipation density where yielding starts
  ReturnPoint<double> point;   ///< at (s, a)
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
      out.status = e.rate_modulus() > 0.0 ? Status::ok : Status::snap_back;
      out.s = s;
      out.a = a;
      out.point = e;
      return out;
    }
    a = next;
  }
  return out;
}

/// The same system as return_system() multiplied by D = m_n + S and written in z, where S = A (z - 1/z)/2 and R = A (z
/// + 1/z)/2 run over the hyperbola: one division per evaluation and no root, which halves its latency.
struct FastSystem {
  double w, s, radius, normal, flow_n, sum, c_shear;
  double e1, e2, e1_z, e1_a, e2_z, e2_a;
  double modulus;  ///< positive where h > 0 (rate.hpp)
  double s_z, r_z;

  /// Moves the point by a step so small that second-order terms are below rounding.
  void shift(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series, double dz, double da) {
    const double dw = integrity_slope(law, w) * da;
    w += dw;
    c_shear += series.shear * dw;
    s += s_z * dz;
    const double dr = r_z * dz;
    radius += dr;
    normal -= law.cot_phi * dr;
    flow_n += law.flow_1 * dr;
    sum = flow_n + s;
  }
};

[[nodiscard]] FPZ_INLINE FastSystem fast_system(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series,
                                                double qn, double qs, double w_old, double z, double a) {
  FastSystem e;
  const double zi = 1.0 / z;
  e.w = w_old * integrity_ratio(law, a);
  const double half = 0.5 * law.apex;
  e.s = half * (z - zi);
  e.radius = half * (z + zi);
  e.normal = law.normal_0 - law.cot_phi * e.radius;
  e.flow_n = law.flow_0 + law.flow_1 * e.radius;
  e.sum = e.flow_n + e.s;
  const ScaledCompliance<double> c = scaled_compliance(law, series, e.w, e.normal >= 0.0);
  e.c_shear = c.shear;
  const double w_a = integrity_slope(law, e.w);
  const double s_z = e.s_z = e.radius * zi;
  const double r_z = e.r_z = e.s * zi;

  const double sum_z = law.flow_1 * r_z + s_z;
  const double x = qn - c.normal * e.normal;
  const double y = qs - c.shear * e.s;
  const double push = c.normal * law.cot_phi * r_z;  // -c_n d(tau_n)/dz
  e.e1 = x * e.sum - a * e.flow_n;
  e.e2 = y * e.sum - a * e.s;
  e.e1_z = push * e.sum + x * sum_z - a * law.flow_1 * r_z;
  e.e2_z = -c.shear * s_z * e.sum + y * sum_z - a * s_z;
  e.e1_a = -c.normal_slope * w_a * e.normal * e.sum - e.flow_n;
  e.e2_a = -c.shear_slope * w_a * e.s * e.sum - e.s;
  e.modulus = -push * e.e2_a - e.e1_a * c.shear * s_z;
  return e;
}

[[nodiscard]] FPZ_INLINE ReturnPoint<double> point_of(const FastSystem& e) {
  ReturnPoint<double> p;
  p.w = e.w;
  p.hyp.radius = e.radius;
  p.hyp.normal = e.normal;
  p.hyp.flow_n = e.flow_n;
  p.inv = e.sum > 0.0 ? 1.0 / e.sum : 0.0;
  p.c_shear = e.c_shear;
  return p;
}

/// Solves the backward Euler system on plain values, from S = s_entry, a = 0, the point where the increment starts to
/// yield. Status snap_back when the rate problem there, or at the solution, has no unique answer.
[[nodiscard]] inline ReturnSolution solve_return(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series,
                                                 double qn, double qs, double w_old, double s_entry, double tolerance) {
  ReturnSolution out;
  double z = (s_entry + std::sqrt(s_entry * s_entry + law.apex * law.apex)) * law.inverse_apex;
  double a = 0.0;
  double first = 0.0;

  for (int k = 0; k < 12; ++k) {
    FastSystem e = fast_system(law, series, qn, qs, w_old, z, a);
    ++out.iterations;
    if (k == 0) {
      out.entry_density = dissipation_density(law, point_of(e), s_entry);
      if (!(e.modulus > 0.0)) {
        out.status = Status::snap_back;
        return out;
      }
    }
    const double det = e.e1_z * e.e2_a - e.e1_a * e.e2_z;
    if (!(det < 0.0)) break;
    const bool solved = std::abs(e.e1) <= tolerance * e.sum && std::abs(e.e2) <= tolerance * e.sum;
    const double inverse = 1.0 / det;
    const double dz = solved ? 0.0 : (e.e2 * e.e1_a - e.e1 * e.e2_a) * inverse;
    const double da = solved ? 0.0 : (e.e1 * e.e2_z - e.e2 * e.e1_z) * inverse;
    if (!(std::abs(dz) < 1e300 && std::abs(da) < 1e300)) break;
    const double smallest = std::min(a, law.delta0);
    if (solved || (std::abs(dz) <= 1e-8 * z && std::abs(da) <= 1e-8 * smallest && z + dz >= 1.0)) {
      // Newton converges quadratically: after a step of 1e-8 the next one is below rounding.
      out.status = e.modulus > 0.0 ? Status::ok : Status::snap_back;
      e.shift(law, series, qs == 0.0 ? 0.0 : dz, da);
      out.s = e.s;
      out.a = a + da;
      out.point = point_of(e);
      return out;
    }
    z = qs == 0.0 ? 1.0 : std::max(z + dz, 1.0);
    a = std::max(a + da, 0.0);
    if (k == 0) first = a;
  }
  const int spent = out.iterations;
  const double density = out.entry_density;
  out = solve_bracketed(law, series, qn, qs, w_old, first, tolerance);
  out.iterations += spent;
  out.entry_density = density;
  return out;
}

}  // namespace fpz::detail
