// The `accurate` integrator: elastic phases in closed form, yielding phases with error control (yielding.hpp), kinks
// and reversals located as events.
#pragma once

#include "fpz/integrators/yielding.hpp"

namespace fpz::detail {

/// Integrates the zone along a straight drive with local error control. `end` is written only on success.
template <class T, int Dim, class Law>
[[nodiscard]] Report integrate_accurate(const Zone<Law>& zone, const Options& options,
                                        const CohesiveState<T, Dim>& begin, const Drive<T, Dim>& drive,
                                        CohesiveState<T, Dim>& end) {
  constexpr int NS = Dim - 1;
  Report report;
  CohesiveState<T, Dim> z = begin;
  const Vec<T, Dim>& d0 = drive.from;
  const Vec<T, Dim> rate = drive.to - d0;
  T fraction = T(0.0);
  int stalled = 0;
  double skip = 1e-12;
  const auto finish = [&] {
    z.jump = continuous_jump(zone.series, drive.to, z.traction);
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
    const T entry = yield_entry<Dim>(zone, z.integrity, q, Vec<T, Dim>(rate * left));
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
    const T cs = zone.shear_compliance(z.integrity);
    Vec<T, Dim> y;
    for (int k = 0; k < NS; ++k) y[k] = q_entry[k + 1] / cs;
    y[NS] = T(0.0);
    YieldingPhase<T, Dim, Law> phase(zone, z.integrity, rate);
    choose_branch(phase, y);
    if (value(phase.loading_at(phase.point(y))) <= 0.0) {
      ++stalled;
      continue;
    }
    const double before = value(fraction);
    const auto yielded = run_yielding(phase, y, fraction, 1.0, options, report);
    if (yielded.status != Status::ok) {
      report.status = yielded.status;
      return report;
    }
    fraction = yielded.position;
    stalled = value(fraction) > before ? 0 : stalled + 1;
    end_yielding<Dim>(z, Vec<T, Dim>(d0 + rate * fraction), phase, yielded);
    if (!yielded.unloaded && !yielded.kinked) return finish();
  }
  z.traction = elastic_traction(zone, z.integrity, Vec<T, Dim>(drive.to + z.offset - z.plastic_jump));
  return finish();
}

}  // namespace fpz::detail
