// The energies of a run and their balance.
#pragma once

namespace fpz::sph {

/// Joule (per metre of thickness in 2-D). The sinks of the balance external = elastic + kinetic + fracture + viscous +
/// damping + artificial, all counted from the start; kinetic is the difference from the start.
struct Energies {
  double external = 0.0;    ///< work of prescribed motions and of gravity
  double elastic = 0.0;     ///< stored in bulk and cohesive zones
  double kinetic = 0.0;     ///< sum m v(n-1/2).v(n+1/2)/2, the leap-frog's own invariant
  double fracture = 0.0;    ///< dissipated by the cohesive zones
  double viscous = 0.0;     ///< dissipated by artificial viscosity and by the control of zero-energy velocities
  double damping = 0.0;     ///< dissipated by local damping
  double artificial = 0.0;  ///< taken by the artificial stress (may be negative)
  double kinetic_start = 0.0;

  [[nodiscard]] double error() const {
    return external - (elastic + kinetic - kinetic_start + fracture + viscous + damping + artificial);
  }
};

}  // namespace fpz::sph
