// Algorithm 2: the double-scale model of an RVE. Elastic until a plane fails; then an elastic bulk in series with the
// embedded cohesive zone, coupled by traction continuity (eq 39-42).
#pragma once

#include "fpz/material.hpp"
#include "fpz/options.hpp"
#include "fpz/state.hpp"

namespace fpz {

namespace detail {

/// The part of update() that may crack: compiled in the library. Does not restore `end` on failure.
template <int Dim>
[[nodiscard]] Report update_beyond_elastic(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                                           const Tensor<double, Dim>& dstrain, State<double, Dim>& end);

/// Strain and stress at the end of an increment from an uncracked begin, and whether the point is certainly intact
/// there.
template <int Dim>
[[nodiscard]] FPZ_INLINE bool stays_intact(const Material<double>& m, const Tensor<double, Dim>& begin_strain,
                                           const Tensor<double, Dim>& dstrain, Tensor<double, Dim>& strain,
                                           Tensor<double, Dim>& stress) {
  for (int k = 0; k < tensor_size<Dim>; ++k) strain[k] = begin_strain[k] + dstrain[k];
  stress = m.bulk.stress<double, Dim>(strain);
  return m.law.surface.surely_intact<Dim>(stress);  // false for NaN
}

}  // namespace detail

/// Stress-strain update of one point over a strain increment (Algorithm 2). The strain moves on a straight line from
/// begin.strain to begin.strain + dstrain. On failure `end` equals `begin` and the status says why. begin and end may
/// be the same object; while a point stays uncracked, only strain, stress and `cracked` of `end` are written. No heap
/// allocation. For other scalars see update_any_scalar.hpp.
template <int Dim>
[[nodiscard]] Report update(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                            const Tensor<double, Dim>& dstrain, State<double, Dim>& end) {
  if (!begin.cracked) {
    Tensor<double, Dim> strain, stress;
    if (detail::stays_intact<Dim>(m, begin.strain, dstrain, strain, stress)) {
      end.strain = strain;
      end.stress = stress;
      end.cracked = false;
      return {};
    }
  }
  const Report report = detail::update_beyond_elastic<Dim>(m, o, begin, dstrain, end);
  if (!report.ok() && &end != &begin) end = begin;
  return report;
}

}  // namespace fpz
