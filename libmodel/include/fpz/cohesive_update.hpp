// Algorithm 1: the stress return of the cohesive fracture law (section 3.3), and the same return in series with an
// elastic bulk.
#pragma once

#include "fpz/integrators/accurate.hpp"
#include "fpz/integrators/implicit.hpp"
#include "fpz/integrators/paper.hpp"

namespace fpz {

/// Integrates a zone while its drive goes straight on (local frame, m). The jump follows from traction continuity u = d
/// - b t (eq 40, 41, 58); with zero compliance the drive is the jump itself, which is Algorithm 1. On failure `end` is
/// left untouched. This is the one place where an integrator is chosen.
template <class T, int Dim, class Law>
[[nodiscard]] Report integrate_cohesive(const Zone<Law>& zone, const Options& options,
                                        const CohesiveState<T, Dim>& begin, const Drive<T, Dim>& drive,
                                        CohesiveState<T, Dim>& end) {
  switch (options.method) {
    case Method::paper:
      return detail::integrate_paper(zone, options, begin, drive, end);
    case Method::implicit:
      return detail::integrate_implicit(zone, options, begin, drive, end);
    case Method::accurate:
      return detail::integrate_accurate(zone, options, begin, drive, end);
  }
  return {Status::invalid_input, 0, 0, false};
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
