// The steps of one cohesive zone that the forward models take: the one place where the calibration calls the
// integrators of the law, compiled once for the scalars that the models use.
#pragma once

#include "fpz/integrators/zone.hpp"
#include "fpz/options.hpp"

namespace fpz::calibration {

/// The law of a zone whose jump itself is driven: always that of the published form. The consistent one is rigid at
/// onset and has no traction of its own at a given jump there. Strengths, damage, G_I and G_II are the same in both,
/// and the jumps differ by at most D K^-1 t (docs/equations.md).
template <class P>
[[nodiscard]] CohesiveLaw<P> jump_driven_law(BasicParameters<P> p) {
  p.choices.cohesive_zone = CohesiveZone::published;
  return make_cohesive_law(p);
}

/// The zone in series with a compliance while its drive goes straight on (m), with error control to options.tolerance.
/// `end` is written only on success.
template <class T, class P>
[[nodiscard]] Report follow_zone(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, const Options& options,
                                 const CohesiveState<T, 2>& begin, const Drive<T, 2>& drive, CohesiveState<T, 2>& end);

/// The same with the jump itself driven, by `du` (m).
template <class T>
[[nodiscard]] Report move_zone(const CohesiveLaw<T>& law, const Options& options, const CohesiveState<T, 2>& begin,
                               const Vec<T, 2>& du, CohesiveState<T, 2>& end) {
  const SeriesCompliance<T> rigid{T(0.0), T(0.0)};
  const Vec<T, 2> target = begin.jump + du;
  if (!is_finite(target) || !is_finite(begin)) return {Status::invalid_input, 0, 0, false};
  CohesiveState<T, 2> out;
  const Report report = follow_zone(law, rigid, options, begin, Drive<T, 2>{begin.jump, target}, out);
  if (report.ok()) end = out;
  return report;
}

/// A zone in pure opening at the given jump (m), by the implicit step, which is exact there.
template <class T, class P>
[[nodiscard]] Status open_zone(const CohesiveLaw<P>& law, const CohesiveState<T, 1>& begin, const T& jump,
                               CohesiveState<T, 1>& end);

}  // namespace fpz::calibration
