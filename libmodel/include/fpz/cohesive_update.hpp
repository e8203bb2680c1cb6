// Algorithm 1: the stress return of the cohesive fracture law (section 3.3), and the same return in series with an
// elastic bulk.
#pragma once

#include "fpz/integrators/accurate.hpp"
#include "fpz/integrators/implicit.hpp"
#include "fpz/integrators/paper.hpp"

namespace fpz {
namespace detail {

/// The consistent zone is rigid at onset, so that a prescribed jump alone would leave its traction open. Where there is
/// no compliance in series it gets this fraction of that of the softening, length/sigma_t0: the jump is met to as much
/// of the softening length.
inline constexpr double testing_compliance = 1e-8;

/// The one place where an integrator is chosen.
template <class T, int Dim, class Law>
[[nodiscard]] Report integrate_by_method(const Zone<Law>& zone, const Options& options,
                                         const CohesiveState<T, Dim>& begin, const Drive<T, Dim>& drive,
                                         CohesiveState<T, Dim>& end) {
  switch (options.method) {
    case Method::paper:
      if (zone.law.zone != CohesiveZone::published) break;
      return integrate_paper(zone, options, begin, drive, end);
    case Method::implicit:
      return integrate_implicit(zone, options, begin, drive, end);
    case Method::accurate:
      return integrate_accurate(zone, options, begin, drive, end);
  }
  return {Status::invalid_input, 0, 0, false};
}

}  // namespace detail

/// Integrates a zone while its drive goes straight on (local frame, m). The jump follows from traction continuity u = d
/// - b t (eq 40, 41, 58); with zero compliance the drive is the jump itself, which is Algorithm 1 (in the consistent
/// zone to 1e-8 of the softening length). On failure `end` is left untouched; `paper` knows the published zone only,
/// and another is invalid_input.
template <class T, int Dim, class Law>
[[nodiscard]] Report integrate_cohesive(const Zone<Law>& zone, const Options& options,
                                        const CohesiveState<T, Dim>& begin, const Drive<T, Dim>& drive,
                                        CohesiveState<T, Dim>& end) {
  using P = typename Law::Scalar;
  const bool free_n = value(zone.series.normal) == 0.0;
  const bool free_s = value(zone.series.shear) == 0.0;
  if (zone.law.zone == CohesiveZone::published || !(free_n || free_s)) {
    return detail::integrate_by_method(zone, options, begin, drive, end);
  }
  const P least = detail::testing_compliance * zone.law.softening.length() / zone.law.surface.tensile_strength;
  const SeriesCompliance<P> series{free_n ? least : zone.series.normal, free_s ? least : zone.series.shear};
  Drive<T, Dim> way = drive;
  for (int k = 0; k < Dim; ++k) {
    if (k == 0 ? !free_n : !free_s) continue;
    way.from[k] += least * begin.traction[k];
    way.to[k] += least * begin.traction[k];
  }
  return detail::integrate_by_method(Zone<Law>(zone.law, series), options, begin, way, end);
}

/// Algorithm 1: traction after the jump increment `du` (local frame, m). With `tangent`, also dt/du (Pa/m) consistent
/// with the discrete update. `end` (and `tangent`) are written only when the status is ok.
template <class T, int Dim, class Law>
[[nodiscard]] Report cohesive_update(const Law& law, const Options& options, const CohesiveState<T, Dim>& begin,
                                     const Vec<T, Dim>& du, CohesiveState<T, Dim>& end,
                                     Mat<double, Dim, Dim>* tangent = nullptr) {
  using P = typename Law::Scalar;
  const SeriesCompliance<P> rigid{P(0.0), P(0.0)};
  const Vec<T, Dim> target = begin.jump + du;
  if (!is_finite(target) || !is_finite(begin)) return {Status::invalid_input, 0, 0, false};

  CohesiveState<T, Dim> out;
  const Report report = integrate_cohesive(Zone(law, rigid), options, begin, Drive<T, Dim>{begin.jump, target}, out);
  if (!report.ok()) return report;
  if (tangent) {
    using D = Dual<Dim>;
    const CohesiveState<D, Dim> lifted = lift<D>(lift<double>(begin));
    Drive<D, Dim> drive{lifted.jump, lifted.jump};
    for (int k = 0; k < Dim; ++k) drive.to[k] = D::seed(value(target[k]), k);
    CohesiveState<D, Dim> dual;
    const auto& plain = values(law);
    const auto& plain_rigid = values(rigid);
    const Report again = integrate_cohesive(Zone(plain, plain_rigid), options, lifted, drive, dual);
    if (!again.ok()) return again;
    for (int k = 0; k < Dim; ++k) tangent->row(k) = dual.traction[k].grad.transpose();
  }
  end = out;
  return report;
}

extern template Report cohesive_update<double, 2, CohesiveLaw<double>>(const CohesiveLaw<double>&, const Options&,
                                                                       const CohesiveState<double, 2>&,
                                                                       const Vec<double, 2>&, CohesiveState<double, 2>&,
                                                                       Mat<double, 2, 2>*);
extern template Report cohesive_update<double, 3, CohesiveLaw<double>>(const CohesiveLaw<double>&, const Options&,
                                                                       const CohesiveState<double, 3>&,
                                                                       const Vec<double, 3>&, CohesiveState<double, 3>&,
                                                                       Mat<double, 3, 3>*);

}  // namespace fpz
