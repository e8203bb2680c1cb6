// The state of a cohesive zone (section 3.3) and of a material point (section 4).
#pragma once

#include <cmath>

#include "fpz/parameters.hpp"
#include "fpz/plane_frame.hpp"
#include "fpz/types.hpp"

namespace fpz {

/// Cohesive zone in its local frame: component 0 is normal (opening positive), the others are shear. Dim is the number
/// of traction components: 1 (pure opening), 2 or 3.
template <class T, int Dim>
struct CohesiveState {
  Vec<T, Dim> traction = Vec<T, Dim>::Constant(T(0.0));      ///< t, Pa
  Vec<T, Dim> jump = Vec<T, Dim>::Constant(T(0.0));          ///< u, displacement jump since onset, m
  Vec<T, Dim> plastic_jump = Vec<T, Dim>::Constant(T(0.0));  ///< up, m
  Vec<T, Dim> offset = Vec<T, Dim>::Constant(T(0.0));        ///< u0, m: K^-1 t_onset, 0 in the consistent zone
  T slip = T(0.0);                                           ///< up_s of eq 47: accumulated plastic slip, m
  T integrity = T(1.0);                                      ///< w = 1 - D
  T dissipated = T(0.0);                                     ///< energy dissipated since onset per crack area, J/m^2
};

/// The same state with another scalar type (constants lifted to duals, or plain values taken from them).
template <class To, class From, int Dim>
[[nodiscard]] CohesiveState<To, Dim> lift(const CohesiveState<From, Dim>& c) {
  CohesiveState<To, Dim> z;
  z.traction = convert<To>(c.traction);
  z.jump = convert<To>(c.jump);
  z.plastic_jump = convert<To>(c.plastic_jump);
  z.offset = convert<To>(c.offset);
  if constexpr (std::floating_point<To>) {
    z.slip = value(c.slip);
    z.integrity = value(c.integrity);
    z.dissipated = value(c.dissipated);
  } else {
    z.slip = To(c.slip);
    z.integrity = To(c.integrity);
    z.dissipated = To(c.dissipated);
  }
  return z;
}

/// False when any field is NaN or infinite.
template <class T, int Dim>
[[nodiscard]] bool is_finite(const CohesiveState<T, Dim>& c) {
  double sum = value(c.slip) + value(c.integrity) + value(c.dissipated);
  for (int k = 0; k < Dim; ++k) {
    sum += value(c.traction[k]) + value(c.jump[k]) + value(c.plastic_jump[k]) + value(c.offset[k]);
  }
  return std::isfinite(sum);
}

/// D of eq 47.
template <class T, int Dim>
[[nodiscard]] T damage(const CohesiveState<T, Dim>& c) {
  return 1.0 - c.integrity;
}

/// A zone that has just cracked under the traction `t_onset` (local frame, Pa): zero jump. The published zone has the
/// offset u0 = K^-1 t_onset.
template <class T, int Dim, class Law>
[[nodiscard]] CohesiveState<T, Dim> cracked_at(const Law& law, const Vec<T, Dim>& t_onset) {
  CohesiveState<T, Dim> z;
  z.traction = t_onset;
  if (law.zone == CohesiveZone::consistent) return z;
  z.offset[0] = t_onset[0] / law.kn;
  for (int k = 1; k < Dim; ++k) z.offset[k] = t_onset[k] / law.ks;
  return z;
}

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

}  // namespace fpz
