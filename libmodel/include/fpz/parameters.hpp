// Material parameters as a person states them, and their validation.
#pragma once

#include <string>
#include <vector>

#include "fpz/types.hpp"

namespace fpz {

/// The eleven inputs of the model (Tables 1-3 of the paper). SI units, angles in degrees.
template <class T>
struct BasicParameters {
  T young_modulus{};       ///< E, Pa
  T poisson_ratio{};       ///< nu
  T density{};             ///< rho, kg/m^3
  T tensile_strength{};    ///< sigma_t0, Pa
  T cohesion{};            ///< c0, Pa
  T friction_angle_deg{};  ///< phi, degrees
  T dilation_angle_deg{};  ///< psi, degrees
  T delta0{};              ///< delta0 of eq 47, m
  T normal_stiffness{};    ///< Kn, Pa/m
  T shear_stiffness{};     ///< Ks, Pa/m
  T rve_length{};          ///< H, m
};
using Parameters = BasicParameters<double>;

/// One broken constraint (or, as a warning, one doubtful value).
struct Violation {
  std::string field;       ///< name of the member, as in material files
  double value = 0.0;      ///< the value that breaks the constraint
  std::string constraint;  ///< the constraint in words and numbers
};

/// All that is wrong or doubtful with a set of parameters, collected in one pass.
struct Validation {
  std::vector<Violation> errors;
  std::vector<Violation> warnings;

  [[nodiscard]] bool ok() const { return errors.empty(); }
  /// One line per entry: "error: cohesion = 3e+05: must be > tensile_strength * tan(friction_angle_deg) = 389640".
  [[nodiscard]] std::string report() const;
};

/// Checks every constraint of the model. Errors: non-finite or non-positive values, -1 < nu < 0.5, 0 <= psi <= phi, 0 <
/// phi < 90, c0 > sigma_t0 tan phi (docs/equations.md). Warnings: H at or above the mode I snap-back length (3.6), psi
/// = 0 (pure opening has no solution), uniaxial tensile strength below sigma_t0 (3.4).
[[nodiscard]] Validation validate(const Parameters& p, Setting setting);

/// Largest H without snap-back under strain control in mode I: (lambda + 2 mu) delta0 / sigma_t0, with the plane-stress
/// modulus E/(1 - nu^2) in place of lambda + 2 mu where that applies. Metres.
[[nodiscard]] double snap_back_length(const Parameters& p, Setting setting);

/// The stress at which uniaxial tension cracks: sigma_t0, or less when the critical plane is inclined
/// (docs/equations.md). Pa.
[[nodiscard]] double uniaxial_tensile_strength(const Parameters& p);

}  // namespace fpz
