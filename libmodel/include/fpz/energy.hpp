// Energies of a cohesive zone (per crack area) and of a material point (per volume).
#pragma once

#include "fpz/coupling.hpp"
#include "fpz/law/dissipation.hpp"

namespace fpz {

/// Energy release per unit of damage of the published zone, Y = -d(psi)/dD >= 0, for a scaled traction (J/m^2). In
/// compression only shear counts.
template <class T, class Law>
[[nodiscard]] T damage_energy(const Law& law, const T& scaled_normal, const T& scaled_shear_squared) {
  const T shear = 0.5 * law.flexibility_s * scaled_shear_squared;
  return value(scaled_normal) > 0.0 ? T(shear + 0.5 * law.flexibility_n * scaled_normal * scaled_normal) : shear;
}

/// Free energy of the zone per area since onset (J/m^2). Consistent: t.D K^-1.t/2 >= 0. Published: w' P K w'/2 with w'
/// = u + u0 - up, minus its value at onset; only differences have meaning, because the offset u0 preloads the springs K
/// with an energy that no work has paid for.
template <class T, int Dim, class Law>
[[nodiscard]] T free_energy(const Law& law, const CohesiveState<T, Dim>& c) {
  if (law.zone == CohesiveZone::consistent) {
    T sum = law.flexibility_n * c.traction[0] * c.traction[0];
    for (int k = 1; k < Dim; ++k) sum += law.flexibility_s * c.traction[k] * c.traction[k];
    return 0.5 * (1.0 - c.integrity) * sum;
  }
  const Vec<T, Dim> e = c.jump + c.offset - c.plastic_jump;
  const T normal = value(e[0]) > 0.0 ? T(c.integrity * e[0] * e[0]) : T(e[0] * e[0]);
  T shear = T(0.0);
  T shear_onset = T(0.0);
  for (int k = 1; k < Dim; ++k) {
    shear += e[k] * e[k];
    shear_onset += c.offset[k] * c.offset[k];
  }
  return 0.5 * (law.kn * (normal - c.offset[0] * c.offset[0]) + law.ks * (c.integrity * shear - shear_onset));
}

/// Dissipation on the yield surface at the scaled point `h`: t.flow + Y dD, scaled by w; both parts >= 0, and Y = 0 in
/// the consistent zone. `shear` is |tau_s|, `inv` is 1/(m_n + |tau_s|), or 0 without flow.
template <class T, class Law>
[[nodiscard]] FPZ_INLINE Dissipation<T> dissipation(const Law& law, const SurfacePoint<T>& h, const T& shear,
                                                    const T& inv) {
  const T shear_squared = shear * shear;
  const T plastic = (h.normal * h.flow_n + shear_squared) * inv;
  if (law.zone == CohesiveZone::consistent) return {plastic, T(0.0)};
  return {plastic, damage_energy(law, h.normal, shear_squared)};
}

/// Stored energy per volume, J/m^3: elastic energy of the bulk plus that of the cohesive zone since onset over H. work
/// = stored + dissipated along every path (eq 37-38). The part of a published zone can be negative
/// (docs/equations.md).
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

}  // namespace fpz
