// Algorithm 1: the stress return of the cohesive fracture law (section 3.3), and the same return in series with an
// elastic bulk.
#pragma once

#include "fpz/integrate_accurate.hpp"
#include "fpz/return_implicit.hpp"
#include "fpz/return_paper.hpp"

namespace fpz {

namespace detail {

/// State at which an increment starts to yield, and the rate problem there: predictor and snap-back check of
/// `implicit`.
struct Entry {
  bool unique = true;  ///< h > 0
  double s = 0.0;
  double a = 0.0;
  double density = 0.0;  ///< dissipation density at the entry
};

template <int Dim>
[[nodiscard]] Entry enter_yield(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series, double w,
                                const Vec<double, Dim>& q0, const Vec<double, Dim>& q1) {
  constexpr int NS = Dim - 1;
  const Vec<double, Dim> rate = q1 - q0;
  const double x = std::max(yield_entry<Dim>(law, series, w, q0, rate), 0.0);
  const double cs = law.flexibility_s + w * series.shear;
  Vec<double, NS> tau_s = (q0 + x * rate).template tail<NS>() / cs;
  const Vec<double, NS> rate_s = rate.template tail<NS>();
  Branch branch;
  branch.tension = q0[0] + x * rate[0] >= 0.0;
  if constexpr (NS == 1) branch.shear_sign = (tau_s[0] != 0.0 ? tau_s[0] : rate_s[0]) < 0.0 ? -1.0 : 1.0;
  const RatePoint<double, NS> r = rate_point<NS>(law, series, branch, tau_s, w, rate_s);
  Entry e;
  e.unique = r.h > 0.0;
  e.s = std::abs(r.shear);
  e.density = dissipation_density(law, r.hyp, r.shear, r.inv);
  const double load = loading(r, rate[0], rate_s) * (1.0 - x);
  if (e.unique && load > 0.0) {
    e.a = load / r.h;
    tau_s += (rate_s * (1.0 - x) - r.m22 * e.a) / r.c.shear;
    e.s = tau_s.norm();
  }
  return e;
}

/// Backward Euler over the drive d0 -> d1. The solve runs on plain values; one Newton step in T carries derivatives
/// over exactly.
template <class T, int Dim, class P>
[[nodiscard]] Report integrate_implicit(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, const Options&,
                                        const CohesiveState<T, Dim>& begin, const Vec<T, Dim>& d0,
                                        const Vec<T, Dim>& d1, CohesiveState<T, Dim>& end) {
  using std::sqrt;
  Report report;
  report.substeps = 1;
  const Vec<T, Dim> q = d1 + begin.offset - begin.plastic_jump;
  const T w = begin.integrity;
  const auto finish = [&](const CohesiveState<T, Dim>& z) {
    end = z;
    end.jump[0] = d1[0] - series.normal * z.traction[0];
    for (int k = 1; k < Dim; ++k) end.jump[k] = d1[k] - series.shear * z.traction[k];
  };
  const CohesiveLaw<double> lawv = values(law);
  const SeriesCompliance<double> seriesv = values(series);
  const Vec<double, Dim> qv = convert<double>(q);
  const double wv = value(w);
  const double qs = qv.template tail<Dim - 1>().norm();

  // Elastic trial, in lengths: G(0) = q_n - c_n tau_n(S_trial). The entry tolerance is the convergence tolerance.
  const ScaledCompliance<double> c = scaled_compliance(lawv, seriesv, wv, true);
  const double s_trial = qs / c.shear;
  const double normal = hyperbola(lawv, s_trial * s_trial).normal;
  const double cn = scaled_compliance(lawv, seriesv, wv, normal >= 0.0).normal;
  const double size_n =
      std::abs(value(d1[0])) + std::abs(value(begin.offset[0])) + std::abs(value(begin.plastic_jump[0]));
  const double size_s = convert<double>(d1).template tail<Dim - 1>().norm() +
                        convert<double>(begin.plastic_jump).template tail<Dim - 1>().norm() +
                        convert<double>(begin.offset).template tail<Dim - 1>().norm();
  const double tolerance =
      16.0 * std::numeric_limits<double>::epsilon() * (size_n + size_s * std::max(1.0, cn / (c.shear * lawv.tan_phi)));
  if (!(qv[0] - cn * normal > tolerance)) {
    CohesiveState<T, Dim> z = begin;
    z.traction = elastic_traction(law, series, w, q);
    finish(z);
    return report;
  }

  const Vec<double, Dim> q0 = convert<double>(Vec<T, Dim>(d0 + begin.offset - begin.plastic_jump));
  const Entry entry = enter_yield<Dim>(lawv, seriesv, wv, q0, qv);
  const bool no_flow = lawv.tan_psi == 0.0 && qv[0] > 0.0;
  if (!entry.unique) {
    report.status = no_flow ? Status::no_plastic_flow : Status::snap_back;
    return report;
  }
  const ReturnSolution root = solve_return(lawv, seriesv, qv[0], qs, wv, entry.s, entry.a, tolerance);
  report.iterations = root.iterations;
  if (root.status != Status::ok) {
    report.status = root.status;
    return report;
  }
  if (!(root.system.rate_modulus() > 0.0)) {
    report.status = Status::snap_back;
    return report;
  }

  T s = T(root.s);
  T a = T(root.a);
  ReturnSystem<T> e;
  if constexpr (std::floating_point<T>) {
    e = root.system;
  } else {
    T qs2 = T(0.0);
    for (int k = 1; k < Dim; ++k) qs2 += q[k] * q[k];
    const T qst = qs > 0.0 ? T(sqrt(qs2)) : T(0.0);
    e = return_system<T>(law, series, q[0], qst, w, s, a);
    const double det = value(e.determinant());
    if (qs > 0.0) s += (e.r2 * value(e.r1_a) - e.r1 * value(e.r2_a)) / det;
    a += qs > 0.0 ? T((e.r1 * value(e.r2_s) - e.r2 * value(e.r1_s)) / det) : T(-e.r1 / value(e.r1_a));
    e = return_system<T>(law, series, q[0], qst, w, s, a);
  }
  const T step = a * e.inv;
  const T shear_factor = 1.0 / e.shear_factor(a);
  CohesiveState<T, Dim> z = begin;
  z.integrity = e.w;
  z.traction[0] = e.w * e.hyp.normal;
  z.plastic_jump[0] += step * e.hyp.flow_n;
  z.slip += step * s;
  for (int k = 1; k < Dim; ++k) {
    const T tau = q[k] * shear_factor;
    z.traction[k] = e.w * tau;
    z.plastic_jump[k] += step * tau;
  }
  // Trapezoidal rule in the measure w d(kappa) = delta0 dD: exact in mode I, and never negative.
  z.dissipated += 0.5 * (entry.density + dissipation_density(law, e.hyp, s, e.inv)) * law.delta0 * (w - e.w);
  finish(z);
  return report;
}

}  // namespace detail

/// Integrates the cohesive zone while its drive goes straight from d0 to d1 (local frame, m). The jump follows from
/// traction continuity u = d - b t (eq 40, 41, 58); with zero compliance the drive is the jump itself, which is
/// Algorithm 1. On failure `end` is left untouched.
template <class T, int Dim, class P>
[[nodiscard]] Report integrate_cohesive(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series,
                                        const Options& options, const CohesiveState<T, Dim>& begin,
                                        const Vec<T, Dim>& d0, const Vec<T, Dim>& d1, CohesiveState<T, Dim>& end) {
  switch (options.method) {
    case Method::paper:
      return detail::integrate_paper(law, series, options, begin, d0, d1, end);
    case Method::implicit:
      return detail::integrate_implicit(law, series, options, begin, d0, d1, end);
    case Method::accurate:
      return detail::integrate_accurate(law, series, options, begin, d0, d1, end);
  }
  return {Status::invalid_input, 0, 0, false};
}

/// A zone that has just cracked under the traction `t_onset` (local frame, Pa): zero jump, offset u0 = K^-1 t_onset.
template <class T, int Dim, class P>
[[nodiscard]] CohesiveState<T, Dim> cracked_at(const CohesiveLaw<P>& law, const Vec<T, Dim>& t_onset) {
  CohesiveState<T, Dim> z;
  z.traction = t_onset;
  z.offset[0] = t_onset[0] / law.kn;
  for (int k = 1; k < Dim; ++k) z.offset[k] = t_onset[k] / law.ks;
  return z;
}

/// Algorithm 1: traction after the jump increment `du` (local frame, m). With `tangent`, also dt/du (Pa/m) consistent
/// with the discrete update. `end` (and `tangent`) are written only when the status is ok.
template <class T, int Dim, class P>
[[nodiscard]] Report cohesive_update(const CohesiveLaw<P>& law, const Options& options,
                                     const CohesiveState<T, Dim>& begin, const Vec<T, Dim>& du,
                                     CohesiveState<T, Dim>& end, Mat<double, Dim, Dim>* tangent = nullptr) {
  const SeriesCompliance<P> rigid{P(0.0), P(0.0)};
  const Vec<T, Dim> target = begin.jump + du;
  for (int k = 0; k < Dim; ++k) {
    if (!std::isfinite(value(target[k]))) return {Status::invalid_input, 0, 0, false};
  }
  CohesiveState<T, Dim> out;
  const Report report = integrate_cohesive(law, rigid, options, begin, begin.jump, target, out);
  if (!report.ok()) return report;
  if (tangent) {
    using D = Dual<Dim>;
    const CohesiveState<D, Dim> lifted = lift<D>(lift<double>(begin));
    Vec<D, Dim> seeded;
    for (int k = 0; k < Dim; ++k) seeded[k] = D::seed(value(target[k]), k);
    CohesiveState<D, Dim> dual;
    const Report again = integrate_cohesive(values(law), values(rigid), options, lifted, lifted.jump, seeded, dual);
    if (!again.ok()) return again;
    for (int k = 0; k < Dim; ++k) tangent->row(k) = dual.traction[k].grad.transpose();
  }
  end = out;
  return report;
}

}  // namespace fpz
