// What the energies of a yielding zone are made of, before the softening law says how it adds up.
#pragma once

namespace fpz {

/// The two parts of the dissipation on the yield surface, scaled by the integrity w: `plastic` = tau.flow/d(kappa)
/// (Pa), the plastic work per unit of w d(kappa); `damage` = Y (J/m^2), the energy released per unit of lost integrity
/// (none in the consistent zone, where it is reversible). Both >= 0.
template <class T>
struct Dissipation {
  T plastic;
  T damage;
};

/// Integrals of w (m) and w^2 (m) over the inelastic displacement.
template <class T>
struct SofteningMoments {
  T first;
  T second;
};

}  // namespace fpz
