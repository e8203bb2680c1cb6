// Algorithm 2 for any scalar: doubles, dual numbers, ceres::Jet. Clients with doubles include update.hpp instead, which
// costs them no compile time.
#pragma once

#include "fpz/cohesive_update.hpp"
#include "fpz/onset.hpp"

namespace fpz {

namespace detail {

/// The point where it cracks inside the increment from `begin` to (end_strain, end_stress). `paper` takes the plane at
/// the end and the traction at the begin of the increment (Algorithm 2, lines 11-17); the others find the point of the
/// path at which the plane fails. `scan` only sets the orientation.
template <int Dim, class T, class P>
[[nodiscard]] State<T, Dim> cracked_between(const Material<P>& m, const Options& o, const State<T, Dim>& begin,
                                            const Tensor<T, Dim>& end_strain, const Tensor<T, Dim>& end_stress) {
  State<T, Dim> s = begin;
  if (o.method == Method::paper) {
    s.cracked = true;
    s.frame = find_plane<Dim>(m, o, end_stress).frame;
    s.crack = cracked_at<T, Dim>(m.law, local_traction<T, Dim>(s.frame, begin.stress));
    return s;
  }
  const T x = onset_fraction<Dim>(m, begin.stress, end_stress);
  go_elastically<Dim>(s, Tensor<T, Dim>(end_strain - begin.strain), Tensor<T, Dim>(end_stress - begin.stress), x);
  open_crack<Dim>(m, o, s);
  return s;
}

/// A cracked point whose strain goes straight from begin.strain to `strain`.
template <int Dim, class T, class P>
[[nodiscard]] Report update_cracked(const Material<P>& m, const Options& o, const State<T, Dim>& begin,
                                    const Tensor<T, Dim>& strain, State<T, Dim>& end) {
  if (!is_finite(begin.crack)) return {Status::invalid_input, 0, 0, false};
  const Drive<T, Dim> way{drive<T, Dim>(m, begin.frame, begin.strain), drive<T, Dim>(m, begin.frame, strain)};
  const Report report = integrate_cohesive(Zone(m.law, m.series), o, begin.crack, way, end.crack);
  if (!report.ok()) return report;
  end.cracked = true;
  if (&end != &begin) end.frame = begin.frame;
  end.strain = strain;
  end.stress = macro_stress(m, end);
  return report;
}

/// The update proper, for any scalar. Reads `begin` completely before it writes `end`, and writes only on success.
template <int Dim, class T, class P>
[[nodiscard]] Report update_any(const Material<P>& m, const Options& o, const State<T, Dim>& begin,
                                const Tensor<T, Dim>& dstrain, State<T, Dim>& end) {
  Tensor<T, Dim> strain;
  for (int k = 0; k < tensor_size<Dim>; ++k) strain[k] = begin.strain[k] + dstrain[k];
  if (!is_finite(strain)) return {Status::invalid_input, 0, 0, false};
  if (begin.cracked) return update_cracked<Dim>(m, o, begin, strain, end);
  const Tensor<T, Dim> stress = m.bulk.template stress<T, Dim>(strain);
  if (surely_intact<Dim>(m, convert<double>(stress)) || value(find_plane<Dim>(m, o, stress).failure_value) < 0.0) {
    end.strain = strain;
    end.stress = stress;
    end.cracked = false;
    return {};
  }
  Report report = update_cracked<Dim>(m, o, cracked_between<Dim>(m, o, begin, strain, stress), strain, end);
  report.onset = true;
  return report;
}

}  // namespace detail

/// Stress-strain update of one point over a strain increment (Algorithm 2). The strain moves on a straight line from
/// begin.strain to begin.strain + dstrain. On failure `end` equals `begin` and the status says why. begin and end may
/// be the same object; while a point stays uncracked, only strain, stress and `cracked` of `end` are written. No heap
/// allocation. T may carry derivatives (Dual, ceres::Jet), as may the material's P: the result then carries the
/// derivatives of the discrete update, onset and sub-stepping included.
template <int Dim, class T, class P>
[[nodiscard]] Report update(const Material<P>& m, const Options& o, const State<T, Dim>& begin,
                            const Tensor<T, Dim>& dstrain, State<T, Dim>& end) {
  const Report report = detail::update_any<Dim>(m, o, begin, dstrain, end);
  if (!report.ok() && &end != &begin) end = begin;
  return report;
}

}  // namespace fpz
