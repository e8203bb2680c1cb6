// Jump control (arc length): the inelastic displacement kappa = up_n + up_s drives the point instead of the size of the
// strain, so that softening which is too brittle for its H can be followed where strain control snaps back.
#pragma once

#include "fpz/material.hpp"
#include "fpz/options.hpp"
#include "fpz/state.hpp"

namespace fpz {

/// Advances the inelastic displacement kappa = up_n + up_s (m) by exactly `dkappa` > 0 along begin.strain + load_factor
/// * direction / |direction|_max; load_factor (a strain) is found and may be negative where the path snaps back. An
/// uncracked or elastic begin state first goes elastically, along +direction, to onset or yield. Integrated with the
/// `accurate` scheme to options.tolerance whatever options.method says. On failure `end` equals `begin`:
/// non_convergence means that the direction never loads the zone.
template <int Dim>
[[nodiscard]] Report update_controlled(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                                       const Tensor<double, Dim>& direction, double dkappa, State<double, Dim>& end,
                                       double& load_factor);

}  // namespace fpz
