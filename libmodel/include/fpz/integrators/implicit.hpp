// Algorithm 1 (b): backward Euler stress return, with the traction continuity of Algorithm 2 eliminated.
//
// In the local frame bulk and cohesive stiffness are diagonal, so u = d - b t removes the jump, and with scaled
// tractions (law/hyperbola.hpp) two scalar unknowns remain, S = |tau_s| and a = d(kappa):
//   r1 = q_n - c_n(w) tau_n(S) - a m_n/(m_n+S) = 0,   r2 = |q_s| - c_s(w) S - a S/(m_n+S) = 0,
//   w = w(w_old, a) of the softening law; c as integrated over the step (law/unloading.hpp).
// Newton from the point of first yield takes 2-4 iterations. If it leaves the domain, a bracketed solve takes over: r2
// fixes S uniquely for every a, and G(a) = r1(S(a), a) falls from G(0) > 0 to minus infinity, so a root always exists
// (psi > 0).
//
// return_system() and the bracketed solve know the surface and the softening by their members only; on the hyperbola
// Newton runs in coordinates of its own, FastSystem.
#pragma once

#include <limits>

#include "fpz/integrators/rate.hpp"
#include "fpz/options.hpp"

namespace fpz::detail {

/// A point of the damaged yield surface on which a return may end.
template <class T>
struct ReturnPoint {
  T w;
  SurfacePoint<T> hyp;
  T inv;      ///< 1/(m_n + S), 0 without flow
  T c_shear;  ///< c_s
  /// q_s = shear_factor(a) * tau_s, as vectors.
  [[nodiscard]] T shear_factor(const T& a) const { return c_shear + a * inv; }
};

template <class T, class Law>
[[nodiscard]] FPZ_INLINE Dissipation<T> dissipation_at(const Law& law, const ReturnPoint<T>& p, const T& shear) {
  return dissipation(law, p.hyp, shear, p.inv);
}

/// What a backward Euler step starts from: q = d1 + u0 - up (m) at its end, normal and |q_s|, and the old integrity.
template <class T>
struct ReturnStart {
  T normal;
  T shear;
  T integrity;
};

/// The compliances of a backward Euler step that ends at w. The drags are their derivatives with respect to w.
template <class T, class Law>
[[nodiscard]] FPZ_INLINE ScaledCompliance<T> step_compliance(const Zone<Law>& zone, const ReturnStart<T>& start,
                                                             const T& w, bool tension) {
  const auto n = zone.normal_law(tension);
  const auto s = zone.shear_law();
  const T& old = start.integrity;
  const bool whole = value(start.shear) == 0.0;
  return {n.over_step(old, w, whole),       s.over_step(old, w, false),      n.slope(w), s.slope(w),
          n.over_step_slope(old, w, whole), s.over_step_slope(old, w, false)};
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

template <class T, class Law, class X>
[[nodiscard]] FPZ_INLINE ReturnSystem<T> return_system(const Zone<Law>& zone, const ReturnStart<T>& start, const X& s,
                                                       const X& a) {
  const auto& law = zone.law;
  ReturnSystem<T> e;
  e.w = law.softening.after(start.integrity, T(a));
  e.hyp = law.surface.point(T(s * s));
  const ScaledCompliance<T> c = step_compliance(zone, start, e.w, value(e.hyp.normal) >= 0.0);
  const T sum = e.hyp.flow_n + s;
  const bool flows = value(sum) > 0.0;
  const T joint = 1.0 / (flows ? T(sum * e.hyp.radius) : e.hyp.radius);  // one division for two reciprocals
  e.inv = flows ? T(joint * e.hyp.radius) : T(0.0);
  e.normal_s = law.surface.slope_along(s, flows ? T(joint * sum) : joint);
  e.c_normal = c.normal;
  e.c_shear = c.shear;
  const T flow_s = law.surface.flow_slope() * e.normal_s;
  const T w_a = law.softening.slope(law.softening.piece(value(e.w)), e.w);
  const T fraction_n = e.hyp.flow_n * e.inv;
  const T fraction_s = s * e.inv;
  e.r1 = start.normal - c.normal * e.hyp.normal - a * fraction_n;
  e.r2 = start.shear - c.shear * s - a * fraction_s;
  e.r1_s = -c.normal * e.normal_s - a * (flow_s * fraction_s - fraction_n) * e.inv;
  e.r2_s = -c.shear - a * (fraction_n - fraction_s * flow_s) * e.inv;
  e.r1_a = -c.normal_drag * w_a * e.hyp.normal - fraction_n;
  e.r2_a = -c.shear_drag * w_a * s - fraction_s;
  return e;
}

struct ReturnSolution {
  Status status = Status::non_convergence;
  double s = 0.0;
  double a = 0.0;
  int iterations = 0;
  Dissipation<double> entry{0.0, 0.0};  ///< where yielding starts
  ReturnPoint<double> point;            ///< at (s, a)
};

/// S(a) from r2 = 0 by bracketed Newton; r2 falls strictly in S on [0, |q_s|/c_s].
template <class Law>
[[nodiscard]] double shear_at(const Zone<Law>& zone, const ReturnStart<double>& start, double a, double guess,
                              int& iterations) {
  double lo = 0.0;
  const double w = zone.law.softening.after(start.integrity, a);
  double hi = start.shear / step_compliance(zone, start, w, true).shear;
  double s = std::min(std::max(guess, lo), hi);
  for (int k = 0; k < 200; ++k) {
    ++iterations;
    const auto e = return_system(zone, start, s, a);
    (e.r2 > 0.0 ? lo : hi) = s;
    double next = s - e.r2 / e.r2_s;
    if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
    if (std::abs(next - s) <= 1e-15 * (s + zone.law.surface.apex)) return next;
    s = next;
  }
  return s;
}

/// Bracketed solve of G(a) = r1(S(a), a) for its first root beyond 0.
template <class Law>
[[nodiscard]] ReturnSolution solve_bracketed(const Zone<Law>& zone, const ReturnStart<double>& start, double a_guess,
                                             double tolerance) {
  ReturnSolution out;
  const double no_limit = std::numeric_limits<double>::infinity();
  // Without dilation the slip alone carries a.
  const double a_limit = zone.law.surface.dilates() ? no_limit : start.shear;
  double s = start.shear / zone.shear_compliance(start.integrity);
  double lo = 0.0;
  double hi = std::min(std::max(a_guess, 1e-12 * zone.law.softening.length()), a_limit);
  const auto g = [&](double a) {
    s = shear_at(zone, start, a, s, out.iterations);
    return return_system(zone, start, s, a);
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

/// A zone whose surface is the hyperbola.
template <class P, class Softening>
using HyperbolicZone = Zone<CohesiveLaw<P, HyperbolicSurface<P>, Softening>>;

/// The same system as return_system() multiplied by D = m_n + S and written in z, where S = A (z - 1/z)/2 and R = A (z
/// + 1/z)/2 run over the hyperbola: one division per evaluation and no root, which halves its latency.
struct FastSystem {
  double w, s, radius, normal, flow_n, sum, c_shear, c_shear_w;
  double e1, e2, e1_z, e1_a, e2_z, e2_a;
  double modulus;  ///< positive where h > 0 (rate.hpp)
  double s_z, r_z;

  /// Moves the point by a step so small that second-order terms are below rounding.
  template <class Softening>
  void shift(const HyperbolicZone<double, Softening>& zone, double dz, double da) {
    const auto& law = zone.law;
    const double dw = law.softening.slope(law.softening.piece(w), w) * da;
    w += dw;
    w = std::max(w, integrity_floor(law.zone));  // a law that ends
    c_shear += c_shear_w * dw;
    s += s_z * dz;
    const double dr = r_z * dz;
    radius += dr;
    normal -= law.surface.cot_phi * dr;
    flow_n += law.surface.flow_1 * dr;
    sum = flow_n + s;
  }
};

template <class Softening>
[[nodiscard]] FPZ_INLINE FastSystem fast_system(const HyperbolicZone<double, Softening>& zone,
                                                const ReturnStart<double>& start, double z, double a) {
  const auto& law = zone.law.surface;
  const double qn = start.normal;
  const double qs = start.shear;
  FastSystem e;
  const double zi = 1.0 / z;
  e.w = zone.law.softening.after(start.integrity, a);
  const double half = 0.5 * law.apex;
  e.s = half * (z - zi);
  e.radius = half * (z + zi);
  e.normal = law.normal_0 - law.cot_phi * e.radius;
  e.flow_n = law.flow_0 + law.flow_1 * e.radius;
  e.sum = e.flow_n + e.s;
  const ScaledCompliance<double> c = step_compliance(zone, start, e.w, e.normal >= 0.0);
  e.c_shear = c.shear;
  e.c_shear_w = c.shear_drag;
  const double w_a = zone.law.softening.slope(zone.law.softening.piece(e.w), e.w);
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
  e.e1_a = -c.normal_drag * w_a * e.normal * e.sum - e.flow_n;
  e.e2_a = -c.shear_drag * w_a * e.s * e.sum - e.s;
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
/// yield. Status snap_back when the rate problem there, or at the solution, has no unique answer. Any surface.
template <class Law>
[[nodiscard]] ReturnSolution solve_return(const Zone<Law>& zone, const ReturnStart<double>& start, double s_entry,
                                          double tolerance) {
  const auto entry = return_system(zone, start, s_entry, 0.0);
  ReturnSolution out;
  out.iterations = 1;
  out.status = Status::snap_back;
  if (entry.rate_modulus() > 0.0) {
    out = solve_bracketed(zone, start, 0.0, tolerance);
    ++out.iterations;
  }
  out.entry = dissipation_at<double>(zone.law, entry, s_entry);
  return out;
}

/// The same on the hyperbola: Newton in (z, a), the bracketed solve where that leaves the domain.
template <class Softening>
[[nodiscard]] ReturnSolution solve_return(const HyperbolicZone<double, Softening>& zone,
                                          const ReturnStart<double>& start, double s_entry, double tolerance) {
  const auto& surface = zone.law.surface;
  ReturnSolution out;
  double z = (s_entry + std::sqrt(s_entry * s_entry + surface.apex * surface.apex)) * surface.inverse_apex;
  double a = 0.0;
  double first = 0.0;

  for (int k = 0; k < 12; ++k) {
    FastSystem e = fast_system(zone, start, z, a);
    ++out.iterations;
    if (k == 0) {
      out.entry = dissipation_at(zone.law, point_of(e), s_entry);
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
    const double smallest = std::min(a, zone.law.softening.length());
    if (solved || (std::abs(dz) <= 1e-8 * z && std::abs(da) <= 1e-8 * smallest && z + dz >= 1.0)) {
      // Newton converges quadratically: after a step of 1e-8 the next one is below rounding.
      out.status = e.modulus > 0.0 ? Status::ok : Status::snap_back;
      e.shift(zone, start.shear == 0.0 ? 0.0 : dz, da);
      out.s = e.s;
      out.a = a + da;
      out.point = point_of(e);
      return out;
    }
    z = start.shear == 0.0 ? 1.0 : std::max(z + dz, 1.0);
    a = std::max(a + da, 0.0);
    if (k == 0) first = a;
  }
  const int spent = out.iterations;
  const Dissipation<double> entry = out.entry;
  out = solve_bracketed(zone, start, first, tolerance);
  out.iterations += spent;
  out.entry = entry;
  return out;
}

/// |tau_s| where an increment starts to yield.
template <int Dim, class Law>
[[nodiscard]] FPZ_INLINE double shear_at_entry(const Zone<Law>& zone, double w, const Vec<double, Dim>& q0,
                                               const Vec<double, Dim>& q1) {
  Vec<double, Dim> rate;
  for (int k = 0; k < Dim; ++k) rate[k] = q1[k] - q0[k];
  const double x = std::max(yield_entry<Dim>(zone, w, q0, rate), 0.0);
  double qs2 = 0.0;
  for (int k = 1; k < Dim; ++k) qs2 += (q0[k] + x * rate[k]) * (q0[k] + x * rate[k]);
  return std::sqrt(qs2) / zone.shear_compliance(w);
}

/// Everything of the end state but the traction, from the traction and the inelastic increments. Reads `begin` field by
/// field as it writes `end`, so both may be one object.
template <class T, int Dim, class P>
FPZ_INLINE void write_state(const SeriesCompliance<P>& series, const CohesiveState<T, Dim>& begin,
                            const Vec<T, Dim>& drive, const Vec<T, Dim>& traction, CohesiveState<T, Dim>& end) {
  for (int k = 0; k < Dim; ++k) {
    end.offset[k] = begin.offset[k];
    end.traction[k] = traction[k];
  }
  end.jump = continuous_jump(series, drive, traction);
}

/// Elastic trial: accepted when its overshoot q_n - c_n tau_n(S) of the surface, a length, is within `tolerance`, which
/// is also the tolerance of the solve: an update repeated on its own result changes nothing.
struct Trial {
  double shear;      ///< |q_s|
  double tolerance;  ///< m: rounding of the terms that make up q
  bool elastic;
};

template <class T, int Dim, class Law>
[[nodiscard]] FPZ_INLINE Trial elastic_trial(const Zone<Law>& zone, double w, const CohesiveState<T, Dim>& begin,
                                             const Vec<T, Dim>& drive, const Vec<double, Dim>& q) {
  double qs2 = 0.0;
  double size_n = std::abs(value(drive[0])) + std::abs(value(begin.offset[0])) + std::abs(value(begin.plastic_jump[0]));
  double size_s = 0.0;
  for (int k = 1; k < Dim; ++k) {
    qs2 += q[k] * q[k];
    size_s += std::abs(value(drive[k])) + std::abs(value(begin.offset[k])) + std::abs(value(begin.plastic_jump[k]));
  }
  Trial t;
  t.shear = std::sqrt(qs2);
  const double inverse_cs = 1.0 / zone.shear_compliance(w);
  const double s = t.shear * inverse_cs;
  const double normal = zone.law.surface.point(s * s).normal;
  const double cn = scaled_compliance(zone, w, normal >= 0.0).normal;
  t.tolerance = 16.0 * std::numeric_limits<double>::epsilon() *
                (size_n + size_s * (1.0 + cn * inverse_cs * zone.law.surface.steepest_slope()));
  t.elastic = !(q[0] - cn * normal > t.tolerance);
  return t;
}

/// Largest loss of integrity in one backward Euler step. Its error there is a few thousandths of sigma_t0; an increment
/// that would lose more is taken in parts. With the normal component alone tau_n stays at sigma_t0, and one step of any
/// size is exact.
template <int Dim>
inline constexpr double largest_integrity_loss = Dim == 1 ? 1.0 : 0.02;

/// Whether a step from w loses more than `allowed`. In the consistent zone also when it loses more than half of what is
/// left: its integrated compliance (law/unloading.hpp) is meant for less, unless it is a pure opening.
template <class Law>
[[nodiscard]] bool goes_too_far(const Law& law, double w, double end, double allowed, bool pure_opening) {
  if (w - end > allowed) return true;
  return law.zone == CohesiveZone::consistent && allowed < 1.0 && !pure_opening && 2.0 * end < w;
}

/// Energy t.flow dissipated in a step of the consistent zone from w0 to w1 over the inelastic displacement `a`, J/m^2,
/// from tau.flow/a at its ends (Pa): exact where that is constant, as in pure opening, and where it goes as 1/w, as in
/// friction. What a separated zone that is not `closed` still carries does not count, as in accurate.
template <class T, class Softening>
[[nodiscard]] T flow_work(const Softening& softening, double p0, const T& p1, const T& w0, const T& w1, const T& a,
                          bool closed) {
  const bool settles = softening.piece(value(w1)) == settled_piece;
  if (settles && !closed && value(w0) == value(w1)) return T(0.0);
  if (value(w0) - value(w1) <= 1e-6 * value(w0)) return 0.25 * (p0 + p1) * (w0 + w1) * a;
  const T area = softening.dissipated(Dissipation<double>{1.0, 0.0}, Dissipation<T>{T(1.0), T(0.0)}, w0, w1);
  const T fall = settles ? softening.fall(w0, w1) : a;  // the rest goes on at the least integrity
  return p0 * area + (p1 - p0) / (1.0 / w1 - 1.0 / w0) * (fall - area / w0) +
         (closed ? T(p1 * w1 * (a - fall)) : T(0.0));
}

/// One backward Euler step over the drive d0 -> d1. The solve runs on plain values; one Newton step in T carries
/// derivatives over exactly. Writes `end` only on success; `begin` and `end` may be one object. Returns false, and
/// writes nothing, when the step loses more integrity than `allowed`.
template <class T, int Dim, class Law>
[[nodiscard]] bool implicit_step(const Zone<Law>& zone, double allowed, const CohesiveState<T, Dim>& begin,
                                 const Drive<T, Dim>& drive, CohesiveState<T, Dim>& end, Report& report) {
  using std::sqrt;
  const auto& lawv = values(zone.law);
  const auto& seriesv = values(zone.series);
  const Zone plain(lawv, seriesv);
  const Vec<T, Dim>& d1 = drive.to;
  const T w = begin.integrity;
  Vec<T, Dim> q, traction;
  Vec<double, Dim> q0, q1;
  for (int k = 0; k < Dim; ++k) {
    const T rest = begin.offset[k] - begin.plastic_jump[k];
    q[k] = d1[k] + rest;
    q0[k] = value(drive.from[k]) + value(rest);
    q1[k] = value(q[k]);
  }
  const Trial trial = elastic_trial(plain, value(w), begin, d1, q1);
  if (trial.elastic) {
    traction = elastic_traction(zone, w, q);
    for (int k = 0; k < Dim; ++k) end.plastic_jump[k] = begin.plastic_jump[k];
    end.slip = begin.slip;
    end.integrity = w;
    end.dissipated = begin.dissipated;
    write_state(zone.series, begin, d1, traction, end);
    return true;
  }

  const double entry = shear_at_entry<Dim>(plain, value(w), q0, q1);
  const ReturnSolution root =
      solve_return(plain, ReturnStart<double>{q1[0], trial.shear, value(w)}, entry, trial.tolerance);
  report.iterations += root.iterations;
  report.status = root.status;
  const bool consistent = lawv.zone == CohesiveZone::consistent;
  const bool too_far = root.a > 0.0 && goes_too_far(lawv, value(w), root.point.w, allowed, trial.shear == 0.0);
  if (consistent && too_far) return false;  // whatever it says: the step is not to be trusted that far
  // Without dilation nothing relaxes an opening, whatever H is.
  if (root.status == Status::snap_back && !lawv.surface.dilates() && q1[0] > 0.0)
    report.status = Status::no_plastic_flow;
  if (!report.ok()) return true;
  if (too_far) return false;

  T s = T(root.s);
  T a = T(root.a);
  ReturnPoint<T> point;
  if constexpr (std::floating_point<T>) {
    point = root.point;
  } else {
    const T qs = trial.shear > 0.0 ? T(sqrt(squared_norm(Vec<T, Dim - 1>(q.template tail<Dim - 1>())))) : T(0.0);
    const ReturnStart<T> start{q[0], qs, w};
    const ReturnSystem<T> e = return_system(zone, start, s, a);
    const double det = value(e.determinant());
    if (trial.shear > 0.0) {
      s += (e.r2 * value(e.r1_a) - e.r1 * value(e.r2_a)) / det;
      a += (e.r1 * value(e.r2_s) - e.r2 * value(e.r1_s)) / det;
    } else {
      a -= e.r1 / value(e.r1_a);
    }
    point = return_system(zone, start, s, a);
  }
  const T step = a * point.inv;
  const T shear_factor = 1.0 / point.shear_factor(a);
  traction[0] = point.w * point.hyp.normal;
  end.plastic_jump[0] = begin.plastic_jump[0] + step * point.hyp.flow_n;
  for (int k = 1; k < Dim; ++k) {
    const T tau = q[k] * shear_factor;
    traction[k] = point.w * tau;
    end.plastic_jump[k] = begin.plastic_jump[k] + step * tau;
  }
  end.slip = begin.slip + step * s;
  const Dissipation<T> dissipated = dissipation_at(zone.law, point, s);
  if (consistent) {
    const Vec<T, Dim> e = elastic_compliance<T, Dim>(zone, point.w);
    for (int k = 0; k < Dim; ++k) end.plastic_jump[k] = d1[k] - e[k] * traction[k];
    end.dissipated = begin.dissipated + flow_work(zone.law.softening, root.entry.plastic, dissipated.plastic, w,
                                                  point.w, a, value(point.hyp.normal) < 0.0);
  } else {
    end.dissipated = begin.dissipated + zone.law.softening.dissipated(root.entry, dissipated, w, point.w);
  }
  end.integrity = point.w;
  write_state(zone.series, begin, d1, traction, end);
  return true;
}

/// Backward Euler over the drive d0 -> d1, in halved parts where it loses more than `largest_integrity_loss`. Writes
/// `end` only on success; `begin` and `end` may be one object.
template <class T, int Dim, class Law>
[[nodiscard]] Report integrate_implicit(const Zone<Law>& zone, const Options&, const CohesiveState<T, Dim>& begin,
                                        const Drive<T, Dim>& drive, CohesiveState<T, Dim>& end) {
  constexpr double smallest_part = 1e-9;  // below it the loss is a jump of the solution, not a matter of step size
  Report report;
  report.substeps = 1;
  if (implicit_step(zone, largest_integrity_loss<Dim>, begin, drive, end, report)) return report;
  CohesiveState<T, Dim> z = begin;
  Drive<T, Dim> piece{drive.from, drive.from};
  report.substeps = 0;
  double done = 0.0;
  double part = 0.5;
  while (done < 1.0) {
    const double next = part >= 1.0 - done ? 1.0 : done + part;
    piece.to = next == 1.0 ? drive.to : Vec<T, Dim>(drive.from + (drive.to - drive.from) * T(next));
    const double allowed = part > smallest_part ? largest_integrity_loss<Dim> : 1.0;
    if (!implicit_step(zone, allowed, z, piece, z, report)) {
      part *= 0.5;
      continue;
    }
    if (!report.ok()) return report;
    ++report.substeps;
    piece.from = piece.to;
    done = next;
    part *= 2.0;
  }
  end = z;
  return report;
}

}  // namespace fpz::detail
