// The operators that a client may ask for besides the consistent one of an update.
#pragma once

#include "fpz/point/behaviour.hpp"
#include "fpz/tangent.hpp"

namespace fpz::generic {

/// d(stress)/d(strain) with the zone held as it is: damage and inelastic displacement do not change.
template <int Dim>
[[nodiscard]] Tangent<Dim> secant_operator(const point::Behaviour& b, const State<double, Dim>& s) {
  Tangent<Dim> t = elastic_tangent<Dim>(b.material.bulk);
  State<double, Dim> end;
  const Tensor<double, Dim> none = Tensor<double, Dim>::Zero();
  // Fails only where the state is none; the elastic operator is as good as any there.
  const Report report = update_with_tangent<Dim>(b.material, b.options, s, none, end, t);
  return report.ok() ? t : elastic_tangent<Dim>(b.material.bulk);
}

/// The derivative for a crack that goes on yielding: of a small increment that would scale its traction up. The secant
/// operator where the crack does not yield at once or there is no such derivative (snap-back).
template <int Dim>
[[nodiscard]] Tangent<Dim> tangent_operator(const point::Behaviour& b, const State<double, Dim>& s) {
  if (!s.cracked) return elastic_tangent<Dim>(b.material.bulk);
  constexpr double small = 1e-6;  // of the traction: far above rounding, far below what changes the derivative
  Vec<double, Dim> local;
  local[0] = small * s.crack.traction[0] * b.material.series.normal;
  for (int k = 1; k < Dim; ++k) local[k] = small * s.crack.traction[k] * b.material.series.shear;
  const Vec<double, Dim> normal = s.frame.row(0).transpose();
  const Vec<double, Dim> jump = s.frame.transpose() * local;
  const Tensor<double, Dim> increment = symmetric_product<double, Dim>(normal, jump) * b.material.inverse_length;
  Tangent<Dim> t;
  State<double, Dim> end;
  const Report report = update_with_tangent<Dim>(b.material, b.options, s, increment, end, t);
  return report.ok() ? t : secant_operator<Dim>(b, s);
}

}  // namespace fpz::generic
