// The consistent tangent of an update: d(stress)/d(strain) of the discrete update itself, onset, sub-steps and events
// included (eq 63-67 for the infinitesimal one). Declared here, compiled in the library.
#pragma once

#include "fpz/material.hpp"
#include "fpz/options.hpp"
#include "fpz/state.hpp"

namespace fpz {

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

/// update() (update.hpp) together with the tangent d(stress)/d(dstrain) consistent with the discrete update of the
/// chosen integrator. Dim 2 and 3.
template <int Dim>
[[nodiscard]] Report update_with_tangent(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                                         const Tensor<double, Dim>& dstrain, State<double, Dim>& end,
                                         Tangent<Dim>& tangent);

}  // namespace fpz
