// Algorithm 2: the double-scale model of an RVE. Elastic until a plane fails; then an elastic bulk in series with the
// embedded cohesive zone, coupled by traction continuity (eq 39-42).
#pragma once

#include "fpz/cohesive_law.hpp"
#include "fpz/onset.hpp"

namespace fpz {

/// State of a material point. Strain is the total strain (tensor components); the crack part has meaning only when
/// `cracked`.
template <class T, int Dim>
struct State {
  Tensor<T, Dim> strain = Tensor<T, Dim>::Constant(T(0.0));
  Tensor<T, Dim> stress = Tensor<T, Dim>::Constant(T(0.0));  ///< Pa
  bool cracked = false;
  Mat<T, Dim, Dim> frame = Mat<T, Dim, Dim>::Identity();  ///< R, rows (n, s1[, s2])
  CohesiveState<T, Dim> crack;
};

using State2 = State<double, 2>;
using State3 = State<double, 3>;

/// d(stress)/d(strain) on stored components: column j is the derivative with respect to stored strain component j, so a
/// shear column belongs to the tensor shear strain (which moves both eps_xy and eps_yx): 2 mu when elastic.
template <int Dim>
using Tangent = Mat<double, tensor_size<Dim>, tensor_size<Dim>>;

template <int Dim, class P>
[[nodiscard]] Tangent<Dim> elastic_tangent(const Elasticity<P>& bulk) {
  Tangent<Dim> c = Tangent<Dim>::Zero();
  c.template topLeftCorner<Dim, Dim>().setConstant(value(bulk.lambda));
  for (int k = 0; k < tensor_size<Dim>; ++k) c(k, k) += 2.0 * value(bulk.mu);
  return c;
}

/// Components of sym(n (x) U).
template <class T, int Dim>
[[nodiscard]] FPZ_INLINE Tensor<T, Dim> symmetric_product(const Vec<T, Dim>& n, const Vec<T, Dim>& jump) {
  Tensor<T, Dim> e;
  for (int k = 0; k < Dim; ++k) e[k] = n[k] * jump[k];
  e[Dim] = 0.5 * (n[0] * jump[1] + n[1] * jump[0]);
  if constexpr (Dim == 3) {
    e[4] = 0.5 * (n[0] * jump[2] + n[2] * jump[0]);
    e[5] = 0.5 * (n[1] * jump[2] + n[2] * jump[1]);
  }
  return e;
}

/// Elastic strain of the bulk, eps - sym(n (x) u)/H (eq 41), for a jump u in the local frame.
template <class T, int Dim, class P>
[[nodiscard]] FPZ_INLINE Tensor<T, Dim> bulk_strain(const Material<P>& m, const State<T, Dim>& s) {
  if (!s.cracked) return s.strain;
  Vec<T, Dim> n, jump;
  for (int k = 0; k < Dim; ++k) {
    n[k] = s.frame(0, k);
    jump[k] = s.frame(0, k) * s.crack.jump[0];
    for (int i = 1; i < Dim; ++i) jump[k] += s.frame(i, k) * s.crack.jump[i];
  }
  Tensor<T, Dim> e = symmetric_product<T, Dim>(n, jump);
  for (int k = 0; k < tensor_size<Dim>; ++k) e[k] = s.strain[k] - e[k] * m.inverse_length;
  return e;
}

namespace detail {

/// Elastic traction of the uncracked bulk on the plane, R n.(a0:eps), times the series compliance: the drive of the
/// zone (m).
template <class T, int Dim, class P>
[[nodiscard]] FPZ_INLINE Vec<T, Dim> drive(const Material<P>& m, const Mat<T, Dim, Dim>& frame,
                                           const Tensor<T, Dim>& strain) {
  Vec<T, Dim> d = local_traction<T, Dim>(frame, m.bulk.template stress<T, Dim>(strain));
  d[0] *= m.series.normal;
  for (int k = 1; k < Dim; ++k) d[k] *= m.series.shear;
  return d;
}

/// eq 41 in total form: sigma = a0 : (eps - sym(n (x) u)/H).
template <class T, int Dim, class P>
[[nodiscard]] FPZ_INLINE Tensor<T, Dim> macro_stress(const Material<P>& m, const State<T, Dim>& s) {
  return m.bulk.template stress<T, Dim>(bulk_strain(m, s));
}

/// The plane search chosen by the options.
template <int Dim, class T, class P>
[[nodiscard]] Plane<T, Dim> find_plane(const Material<P>& m, const Options& o, const Tensor<T, Dim>& stress) {
  return o.scan_resolution_deg > 0.0 ? scan_planes<Dim>(m, stress, o.scan_resolution_deg, o.preferred_normal)
                                     : critical_plane<Dim>(m, stress, o.preferred_normal);
}

/// Opens the crack inside the increment. `paper` takes the plane at the end and the traction at the begin of the
/// increment (Algorithm 2, lines 11-17); the others find the point of the path at which the plane fails. `scan` only
/// sets the orientation.
template <int Dim, class T, class P>
[[nodiscard]] State<T, Dim> open_crack(const Material<P>& m, const Options& o, const State<T, Dim>& begin,
                                       const Tensor<T, Dim>& end_strain, const Tensor<T, Dim>& end_stress) {
  State<T, Dim> s = begin;
  s.cracked = true;
  if (o.method == Method::paper) {
    s.frame = find_plane<Dim>(m, o, end_stress).frame;
    s.crack = cracked_at<T, Dim>(m.law, local_traction<T, Dim>(s.frame, begin.stress));
    return s;
  }
  const T x = onset_fraction<Dim>(m, begin.stress, end_stress);
  s.strain = begin.strain + (end_strain - begin.strain) * x;
  s.stress = begin.stress + (end_stress - begin.stress) * x;
  const Plane<T, Dim> plane = find_plane<Dim>(m, o, s.stress);
  s.frame = plane.frame;
  s.crack = cracked_at<T, Dim>(m.law, plane.traction);
  return s;
}

/// A cracked point whose strain goes straight from begin.strain to `strain`.
template <int Dim, class T, class P>
[[nodiscard]] Report update_cracked(const Material<P>& m, const Options& o, const State<T, Dim>& begin,
                                    const Tensor<T, Dim>& strain, State<T, Dim>& end) {
  if (!is_finite(begin.crack)) return {Status::invalid_input, 0, 0, false};
  const Vec<T, Dim> d0 = drive<T, Dim>(m, begin.frame, begin.strain);
  const Vec<T, Dim> d1 = drive<T, Dim>(m, begin.frame, strain);
  const Report report = integrate_cohesive(m.law, m.series, o, begin.crack, d0, d1, end.crack);
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
  Report report = update_cracked<Dim>(m, o, open_crack<Dim>(m, o, begin, strain, stress), strain, end);
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

/// The same, with the tangent d(stress)/d(dstrain) consistent with the discrete update of the chosen integrator.
template <int Dim>
[[nodiscard]] Report update_with_tangent(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                                         const Tensor<double, Dim>& dstrain, State<double, Dim>& end,
                                         Tangent<Dim>& tangent) {
  constexpr int N = tensor_size<Dim>;
  State<double, Dim> out;
  const Report report = detail::update_any<Dim>(m, o, begin, dstrain, out);
  if (!report.ok()) {
    end = State<double, Dim>(begin);
    return report;
  }
  if (!out.cracked) {
    tangent = elastic_tangent<Dim>(m.bulk);
  } else if (begin.cracked) {
    // The plane is fixed: only the local drive (Dim numbers) carries derivatives. dsigma = a0 deps - a0:sym(n (x)
    // dU)/H.
    using D = Dual<Dim>;
    const CohesiveState<D, Dim> zone = lift<D>(begin.crack);
    const Vec<D, Dim> d0 = convert<D>(detail::drive<double, Dim>(m, begin.frame, begin.strain));
    const Vec<double, Dim> d1 = detail::drive<double, Dim>(m, begin.frame, out.strain);
    Vec<D, Dim> seeded;
    for (int k = 0; k < Dim; ++k) seeded[k] = D::seed(d1[k], k);
    CohesiveState<D, Dim> result;
    const Report again = integrate_cohesive(m.law, m.series, o, zone, d0, seeded, result);
    if (!again.ok()) {
      end = State<double, Dim>(begin);
      return again;
    }
    Mat<double, N, Dim> spread;   // column k: a0 : sym(n (x) r_k), Pa m per unit local jump
    Mat<double, Dim, N> collect;  // row k: d(drive_k)/d(strain)
    const Vec<double, Dim> n = begin.frame.row(0).transpose();
    for (int k = 0; k < Dim; ++k) {
      const Vec<double, Dim> r = begin.frame.row(k).transpose();
      spread.col(k) = m.bulk.stress<double, Dim>(symmetric_product<double, Dim>(n, r));
      collect.row(k) = spread.col(k).transpose() * (k == 0 ? m.series.normal : m.series.shear);
    }
    collect.template rightCols<N - Dim>() *= 2.0;  // a tensor shear component enters twice
    Mat<double, Dim, Dim> jump_by_drive;
    for (int k = 0; k < Dim; ++k) jump_by_drive.row(k) = result.jump[k].grad.transpose();
    tangent = elastic_tangent<Dim>(m.bulk) - spread * jump_by_drive * collect * m.inverse_length;
  } else {
    using D = Dual<N>;
    State<D, Dim> lifted;
    lifted.strain = convert<D>(begin.strain);
    lifted.stress = convert<D>(begin.stress);
    Tensor<D, Dim> seeded;
    for (int k = 0; k < N; ++k) seeded[k] = D::seed(dstrain[k], k);
    State<D, Dim> result;
    const Report again = detail::update_any<Dim>(m, o, lifted, seeded, result);
    if (!again.ok()) {
      end = State<double, Dim>(begin);
      return again;
    }
    for (int k = 0; k < N; ++k) tangent.row(k) = result.stress[k].grad.transpose();
  }
  end = out;
  return report;
}

/// Out-of-plane stress of a 2-D state: zero in plane stress, nu (sigma_xx + sigma_yy) in plane strain (the jump lies in
/// the plane).
template <class T, class P>
[[nodiscard]] T stress_zz(const Material<P>& m, const State<T, 2>& s) {
  return m.setting == Setting::plane_stress ? T(0.0) : T(m.bulk.nu * (s.stress[0] + s.stress[1]));
}

/// Out-of-plane strain of a 2-D state: zero in plane strain, -nu/E (sigma_xx + sigma_yy) in plane stress.
template <class T, class P>
[[nodiscard]] T strain_zz(const Material<P>& m, const State<T, 2>& s) {
  if (m.setting == Setting::plane_strain) return T(0.0);
  const P young = 2.0 * m.bulk.mu * (1.0 + m.bulk.nu);
  return -m.bulk.nu / young * (s.stress[0] + s.stress[1]);
}

/// Stored energy per volume, J/m^3: elastic energy of the bulk plus that of the cohesive zone since onset over H. work
/// = stored + dissipated along every path. See docs/equations.md for why the zone's part can be slightly negative.
template <class T, int Dim, class P>
[[nodiscard]] T stored_energy(const Material<P>& m, const State<T, Dim>& s) {
  const T bulk = 0.5 * double_dot<Dim>(s.stress, bulk_strain(m, s));
  return s.cracked ? T(bulk + free_energy(m.law, s.crack) * m.inverse_length) : bulk;
}

/// Dissipated energy per volume, J/m^3; never decreases.
template <class T, int Dim, class P>
[[nodiscard]] T dissipated_energy(const Material<P>& m, const State<T, Dim>& s) {
  return s.cracked ? T(s.crack.dissipated * m.inverse_length) : T(0.0);
}

/// D of eq 47 (0 when uncracked).
template <class T, int Dim>
[[nodiscard]] T damage(const State<T, Dim>& s) {
  return s.cracked ? damage(s.crack) : T(0.0);
}

/// Rotates a state with a rigid rotation Q of the material (sigma' = Q sigma Q^T): objective rotation for updated
/// formulations.
template <class T, int Dim>
void rotate(State<T, Dim>& s, const Mat<T, Dim, Dim>& q) {
  const auto turn = [&](Tensor<T, Dim>& a) {
    const Mat<T, Dim, Dim> b = q * to_matrix<T, Dim>(a) * q.transpose();
    if constexpr (Dim == 2) {
      a << b(0, 0), b(1, 1), b(0, 1);
    } else {
      a << b(0, 0), b(1, 1), b(2, 2), b(0, 1), b(0, 2), b(1, 2);
    }
  };
  turn(s.strain);
  turn(s.stress);
  s.frame = (s.frame * q.transpose()).eval();
}

// The plain-double updates are compiled once, in the library; other scalars are instantiated where they are used.
extern template Report detail::update_cracked<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                                 const Tensor<double, 2>&, State<double, 2>&);
extern template Report detail::update_cracked<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                                 const Tensor<double, 3>&, State<double, 3>&);
extern template State<double, 2> detail::open_crack<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                                       const Tensor<double, 2>&, const Tensor<double, 2>&);
extern template State<double, 3> detail::open_crack<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                                       const Tensor<double, 3>&, const Tensor<double, 3>&);
extern template Report update_with_tangent<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                              const Tensor<double, 2>&, State<double, 2>&, Tangent<2>&);
extern template Report update_with_tangent<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                              const Tensor<double, 3>&, State<double, 3>&, Tangent<3>&);

}  // namespace fpz
