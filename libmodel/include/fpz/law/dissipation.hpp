// The two parts of the dissipation of a yielding zone, before the softening law says how they add up.
#pragma once

namespace fpz {

/// On the yield surface, scaled by the integrity w: `plastic` = tau.dup/d(kappa) (Pa), the plastic work per unit of
/// w d(kappa); `damage` = Y (J/m^2), the energy released per unit of lost integrity. Both >= 0.
template <class T>
struct Dissipation {
  T plastic;
  T damage;
};

}  // namespace fpz
