// Algorithm 1: the stress return of the cohesive fracture law (section 3.3), and the same return in series with an
// elastic bulk.
#pragma once

#include "fpz/integrate_accurate.hpp"
#include "fpz/integrate_implicit.hpp"
#include "fpz/return_paper.hpp"

namespace fpz {

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
  if (!is_finite(target) || !is_finite(begin)) return {Status::invalid_input, 0, 0, false};

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

extern template Report cohesive_update<double, 2, double>(const CohesiveLaw<double>&, const Options&,
                                                          const CohesiveState<double, 2>&, const Vec<double, 2>&,
                                                          CohesiveState<double, 2>&, Mat<double, 2, 2>*);
extern template Report cohesive_update<double, 3, double>(const CohesiveLaw<double>&, const Options&,
                                                          const CohesiveState<double, 3>&, const Vec<double, 3>&,
                                                          CohesiveState<double, 3>&, Mat<double, 3, 3>*);

}  // namespace fpz
