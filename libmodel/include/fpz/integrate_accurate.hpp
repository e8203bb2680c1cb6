// Drives the phases of return_accurate.hpp over one increment.
#pragma once

#include "fpz/return_accurate.hpp"

namespace fpz::detail {

/// Fraction of the requested tolerance that each sub-step may use: the rest is left for accumulation along a path.
inline constexpr double local_tolerance_fraction = 0.05;

template <class T, int Dim>
struct Yielded {
  Status status = Status::ok;
  Vec<T, Dim> y = Vec<T, Dim>::Constant(T(0.0));  ///< (tau_s, a) at the end of the phase
  T fraction = T(0.0);                            ///< where in the increment the phase ended
  T dissipated = T(0.0);                          ///< J/m^2
  bool unloaded = false;
};

/// Picks the smooth branch that the motion enters at y.
template <class T, int Dim, class P>
void choose_branch(const CohesiveLaw<P>& law, YieldingPhase<T, Dim, P>& phase, const Vec<T, Dim>& y) {
  constexpr int NS = Dim - 1;
  const double none = negligible_shear * value(law.apex);
  double shear = 0.0;
  double heading_shear = 0.0;
  for (int k = 0; k < NS; ++k) {
    shear = std::max(shear, std::abs(value(y[k])));
    heading_shear = std::max(heading_shear, std::abs(value(phase.rate_s()[k])));
  }
  phase.branch.shear = shear > none || heading_shear > none * value(law.flexibility_s);
  if constexpr (NS == 1) {
    const double s = shear > none ? value(y[0]) : value(phase.rate_s()[0]);
    phase.branch.shear_sign = s < 0.0 ? -1.0 : 1.0;
  }
  phase.branch.tension = true;
  const RatePoint<T, NS> r = phase.point(y);
  const double normal = value(r.hyp.normal);
  if (std::abs(normal) > 1e-12 * value(law.tensile_strength)) {
    phase.branch.tension = normal > 0.0;
    return;
  }
  const Vec<T, Dim> f = phase.rates(r);
  double heading = 0.0;
  for (int k = 0; k < NS; ++k) heading += value(r.normal_s[k]) * value(f[k]);
  phase.branch.tension = heading >= 0.0;
}

/// Largest inelastic displacement of one step, in units of delta0: tau_s may be known so well that its error allows
/// more, but the dissipated energy needs the softening in between.
inline constexpr double largest_softening_step = 1.0;
/// Integrity below which the energy that is left does not count.
inline constexpr double negligible_integrity = 1e-14;

/// Energy dissipated in an accepted step of length h from (y, f) to (y1, f1), J/m^2. Fourth order, as the solution is,
/// from the ends and the cubic Hermite mid-point: Simpson's rule, or, where the step softens noticeably, the quadratic
/// through the three points as a function of w, which is exact for pure opening.
template <class T, int Dim, class P>
[[nodiscard]] T step_dissipation(const CohesiveLaw<P>& law, const YieldingPhase<T, Dim, P>& phase,
                                 const RatePoint<T, Dim - 1>& r, const Vec<T, Dim>& y, const Vec<T, Dim>& f,
                                 const RatePoint<T, Dim - 1>& r1, const Vec<T, Dim>& y1, const Vec<T, Dim>& f1,
                                 const T& h) {
  constexpr int NS = Dim - 1;
  const T whole = r.w - r1.w;
  if (value(r.w) < negligible_integrity) return whole * law.delta0 * 0.5 * (phase.density(r) + phase.density(r1));
  const Vec<T, Dim> middle = (y + y1) * T(0.5) + (f - f1) * T(h / 8.0);
  const RatePoint<T, NS> rm = phase.point(middle);
  if (value(y1[NS]) - value(y[NS]) < 1e-3 * value(law.delta0)) {  // differences of w would lose digits
    const Vec<T, Dim> fm = phase.rates(rm);
    return (phase.power(r, f[NS]) + 4.0 * phase.power(rm, fm[NS]) + phase.power(r1, f1[NS])) * T(h / 6.0);
  }
  const T first = (r.w - rm.w) / whole;
  const T second = 1.0 - first;
  const T sum = (2.0 - second / first) * phase.density(r) + phase.density(rm) / (first * second) +
                (2.0 - first / second) * phase.density(r1);
  return whole * law.delta0 * sum / 6.0;
}

/// Runs one yielding phase from `fraction` until the increment ends or the point unloads.
template <class T, int Dim, class P>
[[nodiscard]] Yielded<T, Dim> run_yielding(const CohesiveLaw<P>& law, YieldingPhase<T, Dim, P>& phase, Vec<T, Dim> y,
                                           T fraction, const Options& options, Report& report) {
  constexpr int NS = Dim - 1;
  Yielded<T, Dim> out;
  const double tolerance = local_tolerance_fraction * options.tolerance;
  choose_branch(law, phase, y);
  RatePoint<T, NS> r = phase.point(y);
  const auto stop = [&](Status s) {
    out.status = s;
    return out;
  };
  const auto stuck = [&] {
    return value(law.tan_psi) == 0.0 && value(r.hyp.normal) > 0.0 ? Status::no_plastic_flow : Status::snap_back;
  };
  if (!(value(r.h) > 0.0)) return stop(stuck());
  Vec<T, Dim> f = phase.rates(r);
  // First guess: a fraction of delta0 that an order-4 method can take at this tolerance; never more than what is left.
  const double first = 0.5 * value(law.delta0) * std::pow(options.tolerance, 0.25) / (std::abs(value(f[NS])) + 1e-300);
  double step = std::min(1.0 - value(fraction), first);
  while (value(fraction) < 1.0) {
    if (report.iterations >= options.max_substeps) return stop(Status::non_convergence);
    const double left = 1.0 - value(fraction);
    const bool last = step >= left * (1.0 - 1e-12);
    T h = last ? T(1.0 - fraction) : T(step);
    ++report.iterations;
    auto trial = phase.advance(y, r, f, h);
    const double error = trial.defined ? phase.error_norm(r, trial.error) / tolerance : 1e9;
    if (!(error <= 1.0)) {
      step = value(h) * std::max(0.1, 0.9 * std::pow(error, -0.25));
      if (step < 1e-13) return stop(stuck());
      continue;
    }
    const double softening = (value(trial.y[NS]) - value(y[NS])) / value(law.delta0);
    if (softening > largest_softening_step && value(r.w) > negligible_integrity) {
      step = value(h) * 0.9 * largest_softening_step / softening;
      continue;
    }
    RatePoint<T, NS> r1 = phase.point(trial.y);
    if (!(value(r1.h) > 0.0)) {
      step = 0.1 * value(h);
      if (step < 1e-13) return stop(stuck());
      continue;
    }
    int fired = -1;
    double earliest = value(h);
    for (int which = 0; which < phase.event_count; ++which) {
      if (value(phase.event(which, r1)) >= 0.0) continue;
      const T x = locate_event(phase, y, r, f, value(h), which);
      if (value(x) <= earliest) {
        earliest = value(x);
        fired = which;
        trial = phase.advance(y, r, f, x);
        r1 = phase.point(trial.y);
        h = x;
      }
    }
    const Vec<T, Dim> f1 = phase.rates(r1);
    out.dissipated += step_dissipation<T, Dim>(law, phase, r, y, f, r1, trial.y, f1, h);
    y = trial.y;
    fraction = last && fired < 0 ? T(1.0) : T(fraction + h);
    ++report.substeps;
    if (fired == 0) {
      out.unloaded = true;
      break;
    }
    if (fired > 0) {
      if (fired == 1) phase.branch.tension = !phase.branch.tension;
      if (fired == 2) phase.branch.shear_sign = -phase.branch.shear_sign;
      r = phase.point(y);
      if (!(value(r.h) > 0.0)) return stop(stuck());
      f = phase.rates(r);
      step = std::max(step - earliest, 1e-3 * step);
      continue;
    }
    r = r1;
    f = f1;
    step = value(h) * std::min(5.0, 0.9 * std::pow(error + 1e-12, -0.25));
  }
  out.y = y;
  out.fraction = fraction;
  return out;
}

/// Integrates the zone along the straight drive d0 -> d1 with local error control. `end` is written only on success.
template <class T, int Dim, class P>
[[nodiscard]] Report integrate_accurate(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series,
                                        const Options& options, const CohesiveState<T, Dim>& begin,
                                        const Vec<T, Dim>& d0, const Vec<T, Dim>& d1, CohesiveState<T, Dim>& end) {
  constexpr int NS = Dim - 1;
  Report report;
  CohesiveState<T, Dim> z = begin;
  const Vec<T, Dim> rate = d1 - d0;
  T fraction = T(0.0);
  int stalled = 0;
  double skip = 1e-12;
  const auto finish = [&] {
    z.jump[0] = d1[0] - series.normal * z.traction[0];
    for (int k = 1; k < Dim; ++k) z.jump[k] = d1[k] - series.shear * z.traction[k];
    end = z;
    return report;
  };
  for (int phase_number = 0;; ++phase_number) {
    if (phase_number > 1000) {
      report.status = Status::non_convergence;
      return report;
    }
    const Vec<T, Dim> q = d0 + rate * fraction + z.offset - z.plastic_jump;
    const T left = 1.0 - fraction;
    const T entry = yield_entry<Dim>(law, series, z.integrity, q, Vec<T, Dim>(rate * left));
    if (value(entry) < 0.0 || value(fraction) >= 1.0) break;
    fraction += entry * left;
    if (value(fraction) >= 1.0 - 1e-15) break;  // the surface is only touched: the increment ends elastically

    // A grazing contact that does not load is passed over; its overshoot is of second order in the distance skipped.
    if (stalled > 1) {
      fraction += skip;
      skip *= 8.0;
      stalled = 0;
      if (value(fraction) >= 1.0) break;
      continue;
    }
    const Vec<T, Dim> q_entry = d0 + rate * fraction + z.offset - z.plastic_jump;
    const T cs = law.flexibility_s + z.integrity * series.shear;
    Vec<T, Dim> y;
    for (int k = 0; k < NS; ++k) y[k] = q_entry[k + 1] / cs;
    y[NS] = T(0.0);
    YieldingPhase<T, Dim, P> phase(law, series, z.integrity, rate);
    choose_branch(law, phase, y);
    if (value(phase.loading_at(phase.point(y))) <= 0.0) {
      ++stalled;
      continue;
    }
    const double before = value(fraction);
    const Yielded<T, Dim> yielded = run_yielding(law, phase, y, fraction, options, report);
    if (yielded.status != Status::ok) {
      report.status = yielded.status;
      return report;
    }
    fraction = yielded.fraction;
    stalled = value(fraction) > before ? 0 : stalled + 1;
    const RatePoint<T, NS> r = phase.point(yielded.y);
    end_yielding<T, Dim>(z, d0 + rate * fraction, r, yielded.y.template head<NS>(), yielded.y[NS], yielded.dissipated);
    if (!yielded.unloaded) return finish();
  }
  z.traction = elastic_traction(law, series, z.integrity, Vec<T, Dim>(d1 + z.offset - z.plastic_jump));
  return finish();
}

}  // namespace fpz::detail
