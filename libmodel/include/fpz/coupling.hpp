// The elastic bulk around a crack plane (eq 39-42): its strain and stress, and the drive by which it moves the zone.
#pragma once

#include "fpz/material.hpp"
#include "fpz/state.hpp"

namespace fpz {

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

}  // namespace detail
}  // namespace fpz
