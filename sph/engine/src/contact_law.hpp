// The law of faces that meet, one for notches, cracks and pieces: they press on each other while they are closed, never
// pull, and slide when the shear reaches friction times pressure (Coulomb, without cohesion).
#pragma once

#include <algorithm>
#include <cmath>

namespace fpz::sph::detail {

/// Stiffness that keeps faces from passing through each other, force per length of closure: for a point of a face, its
/// area times a stiffness in Pa/m.
struct ContactLaw {
  double normal_stiffness = 0.0;  ///< N/m
  double shear_stiffness = 0.0;   ///< N/m
  double friction = 0.0;          ///< coefficient, tan of the friction angle

  /// N, >= 0, at a gap (m, negative: closed).
  [[nodiscard]] double pressure(double gap) const { return normal_stiffness * std::max(0.0, -gap); }

  /// Slip (m) of faces that have come to `gap` and `shift`, when it was `slip`: what lies between shift and slip is
  /// elastic, and no more than friction bears. Open faces remember nothing.
  [[nodiscard]] double slip_at(double gap, double shift, double slip) const {
    const double most = friction * pressure(gap) / shear_stiffness;
    return shift - std::clamp(shift - slip, -most, most);
  }

  /// J, stored at `gap` and `shift` with `slip`.
  [[nodiscard]] double stored(double gap, double shift, double slip) const {
    const double closed = std::max(0.0, -gap), elastic = closed > 0.0 ? shift - slip : 0.0;
    return 0.5 * (normal_stiffness * closed * closed + shear_stiffness * elastic * elastic);
  }

  /// Pressure that belongs to the gap which it leaves: `gap` (m) without any, `give` (m/N) more with each newton.
  [[nodiscard]] double implicit_pressure(double gap, double give) const {
    return std::max(0.0, -gap * normal_stiffness / (1.0 + normal_stiffness * give));
  }

  /// Shear force against `elastic` (m), which each newton shortens by `give`, bounded by friction.
  [[nodiscard]] double implicit_shear(double elastic, double give, double pressure) const {
    const double most = friction * pressure;
    return std::clamp(-elastic * shear_stiffness / (1.0 + shear_stiffness * give), -most, most);
  }
};

}  // namespace fpz::sph::detail
