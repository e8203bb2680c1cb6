// The `implicit` integrator: elastic trial, snap-back check where yielding starts, backward Euler
// (return_implicit.hpp).
#pragma once

#include <limits>

#include "fpz/options.hpp"
#include "fpz/rate.hpp"
#include "fpz/return_implicit.hpp"

namespace fpz::detail {

/// |tau_s| where an increment starts to yield.
template <int Dim>
[[nodiscard]] FPZ_INLINE double shear_at_entry(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series,
                                               double w, const Vec<double, Dim>& q0, const Vec<double, Dim>& q1) {
  Vec<double, Dim> rate;
  for (int k = 0; k < Dim; ++k) rate[k] = q1[k] - q0[k];
  const double x = std::max(yield_entry<Dim>(law, series, w, q0, rate), 0.0);
  double qs2 = 0.0;
  for (int k = 1; k < Dim; ++k) qs2 += (q0[k] + x * rate[k]) * (q0[k] + x * rate[k]);
  return std::sqrt(qs2) / (law.flexibility_s + w * series.shear);
}

/// Everything of the end state but the traction, from the traction and the inelastic increments. Reads `begin` field by
/// field as it writes `end`, so both may be one object.
template <class T, int Dim, class P>
FPZ_INLINE void write_state(const SeriesCompliance<P>& series, const CohesiveState<T, Dim>& begin,
                            const Vec<T, Dim>& drive, const Vec<T, Dim>& traction, CohesiveState<T, Dim>& end) {
  for (int k = 0; k < Dim; ++k) {
    end.offset[k] = begin.offset[k];
    end.traction[k] = traction[k];
    end.jump[k] = drive[k] - (k == 0 ? series.normal : series.shear) * traction[k];
  }
}

/// Elastic trial: accepted when its overshoot q_n - c_n tau_n(S) of the surface, a length, is within `tolerance`, which
/// is also the tolerance of the solve: an update repeated on its own result changes nothing.
struct Trial {
  double shear;      ///< |q_s|
  double tolerance;  ///< m: rounding of the terms that make up q
  bool elastic;
};

template <class T, int Dim>
[[nodiscard]] FPZ_INLINE Trial elastic_trial(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series,
                                             double w, const CohesiveState<T, Dim>& begin, const Vec<T, Dim>& drive,
                                             const Vec<double, Dim>& q) {
  double qs2 = 0.0;
  double size_n = std::abs(value(drive[0])) + std::abs(value(begin.offset[0])) + std::abs(value(begin.plastic_jump[0]));
  double size_s = 0.0;
  for (int k = 1; k < Dim; ++k) {
    qs2 += q[k] * q[k];
    size_s += std::abs(value(drive[k])) + std::abs(value(begin.offset[k])) + std::abs(value(begin.plastic_jump[k]));
  }
  Trial t;
  t.shear = std::sqrt(qs2);
  const double inverse_cs = 1.0 / (law.flexibility_s + w * series.shear);
  const double s = t.shear * inverse_cs;
  const double normal = hyperbola(law, s * s).normal;
  const double cn = scaled_compliance(law, series, w, normal >= 0.0).normal;
  t.tolerance =
      16.0 * std::numeric_limits<double>::epsilon() * (size_n + size_s * (1.0 + cn * inverse_cs * law.cot_phi));
  t.elastic = !(q[0] - cn * normal > t.tolerance);
  return t;
}

/// Largest loss of integrity in one backward Euler step. Its error there is a few thousandths of sigma_t0; an increment
/// that would lose more is taken in parts. With the normal component alone tau_n stays at sigma_t0, and one step of any
/// size is exact.
template <int Dim>
inline constexpr double largest_integrity_loss = Dim == 1 ? 1.0 : 0.02;

/// One backward Euler step over the drive d0 -> d1. The solve runs on plain values; one Newton step in T carries
/// derivatives over exactly. Writes `end` only on success; `begin` and `end` may be one object. Returns false, and
/// writes nothing, when the step loses more integrity than `allowed`.
template <class T, int Dim, class P>
[[nodiscard]] bool implicit_step(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, double allowed,
                                 const CohesiveState<T, Dim>& begin, const Vec<T, Dim>& d0, const Vec<T, Dim>& d1,
                                 CohesiveState<T, Dim>& end, Report& report) {
  using std::sqrt;
  const auto& lawv = values(law);
  const auto& seriesv = values(series);
  const T w = begin.integrity;
  Vec<T, Dim> q, traction;
  Vec<double, Dim> q0, q1;
  for (int k = 0; k < Dim; ++k) {
    const T rest = begin.offset[k] - begin.plastic_jump[k];
    q[k] = d1[k] + rest;
    q0[k] = value(d0[k]) + value(rest);
    q1[k] = value(q[k]);
  }
  const Trial trial = elastic_trial(lawv, seriesv, value(w), begin, d1, q1);
  if (trial.elastic) {
    traction = elastic_traction(law, series, w, q);
    for (int k = 0; k < Dim; ++k) end.plastic_jump[k] = begin.plastic_jump[k];
    end.slip = begin.slip;
    end.integrity = w;
    end.dissipated = begin.dissipated;
    write_state(series, begin, d1, traction, end);
    return true;
  }

  const double entry = shear_at_entry<Dim>(lawv, seriesv, value(w), q0, q1);
  const ReturnSolution root = solve_return(lawv, seriesv, q1[0], trial.shear, value(w), entry, trial.tolerance);
  report.iterations += root.iterations;
  report.status = root.status;
  // Without dilation nothing relaxes an opening, whatever H is.
  if (root.status == Status::snap_back && lawv.tan_psi == 0.0 && q1[0] > 0.0) report.status = Status::no_plastic_flow;
  if (!report.ok()) return true;
  if (value(w) - root.point.w > allowed) return false;

  T s = T(root.s);
  T a = T(root.a);
  ReturnPoint<T> point;
  if constexpr (std::floating_point<T>) {
    point = root.point;
  } else {
    const T qs = trial.shear > 0.0 ? T(sqrt(squared_norm(Vec<T, Dim - 1>(q.template tail<Dim - 1>())))) : T(0.0);
    const ReturnSystem<T> e = return_system<T>(law, series, q[0], qs, w, s, a);
    const double det = value(e.determinant());
    if (trial.shear > 0.0) {
      s += (e.r2 * value(e.r1_a) - e.r1 * value(e.r2_a)) / det;
      a += (e.r1 * value(e.r2_s) - e.r2 * value(e.r1_s)) / det;
    } else {
      a -= e.r1 / value(e.r1_a);
    }
    point = return_system<T>(law, series, q[0], qs, w, s, a);
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
  // Trapezoidal rule in the measure w d(kappa) = delta0 dD: exact in mode I, and never negative.
  end.dissipated =
      begin.dissipated + 0.5 * (root.entry_density + dissipation_density(law, point, s)) * law.delta0 * (w - point.w);
  end.integrity = point.w;
  write_state(series, begin, d1, traction, end);
  return true;
}

/// Backward Euler over the drive d0 -> d1, in halved parts where it loses more than `largest_integrity_loss`. Writes
/// `end` only on success; `begin` and `end` may be one object.
template <class T, int Dim, class P>
[[nodiscard]] Report integrate_implicit(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, const Options&,
                                        const CohesiveState<T, Dim>& begin, const Vec<T, Dim>& d0,
                                        const Vec<T, Dim>& d1, CohesiveState<T, Dim>& end) {
  constexpr double smallest_part = 1e-9;  // below it the loss is a jump of the solution, not a matter of step size
  Report report;
  report.substeps = 1;
  if (implicit_step(law, series, largest_integrity_loss<Dim>, begin, d0, d1, end, report)) return report;
  CohesiveState<T, Dim> z = begin;
  Vec<T, Dim> from = d0;
  report.substeps = 0;
  double done = 0.0;
  double part = 0.5;
  while (done < 1.0) {
    const double next = part >= 1.0 - done ? 1.0 : done + part;
    const Vec<T, Dim> to = next == 1.0 ? d1 : Vec<T, Dim>(d0 + (d1 - d0) * T(next));
    const double allowed = part > smallest_part ? largest_integrity_loss<Dim> : 1.0;
    if (!implicit_step(law, series, allowed, z, from, to, z, report)) {
      part *= 0.5;
      continue;
    }
    if (!report.ok()) return report;
    ++report.substeps;
    from = to;
    done = next;
    part *= 2.0;
  }
  end = z;
  return report;
}

}  // namespace fpz::detail
