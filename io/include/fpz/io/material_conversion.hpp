// From what laboratories state of a material to the parameters of the model. Closed forms, SI, angles in degrees.
#pragma once

#include <optional>

#include "fpz/types.hpp"

namespace fpz::io {

/// E (Pa) and nu of an isotropic solid.
struct ElasticConstants {
  double young_modulus = 0.0;
  double poisson_ratio = 0.0;
};

/// Two of the four: Young's modulus, Poisson's ratio, bulk and shear modulus. E = 9 K G/(3 K + G), nu = (3 K - 2 G)/(6
/// K
/// + 2 G) and what follows from them (Landau and Lifshitz, Theory of Elasticity, section 5). Throws
/// std::invalid_argument unless two are given.
[[nodiscard]] ElasticConstants elastic_constants(std::optional<double> young_modulus,
                                                 std::optional<double> poisson_ratio,
                                                 std::optional<double> bulk_modulus,
                                                 std::optional<double> shear_modulus);

/// E' that joins toughness and energy, K^2 = G E' (Irwin 1957): E/(1 - nu^2) in plane strain, E in plane stress. Throws
/// std::invalid_argument for other settings.
[[nodiscard]] double energy_modulus(double young_modulus, double poisson_ratio, Setting setting);

/// G = K^2/E' in J/m^2 of K in Pa sqrt(m). Throws std::invalid_argument for a negative K and as energy_modulus().
[[nodiscard]] double energy_from_toughness(double toughness, double young_modulus, double poisson_ratio,
                                           Setting setting);

/// The inverse: K in Pa sqrt(m) from G in J/m^2.
[[nodiscard]] double toughness_from_energy(double energy, double young_modulus, double poisson_ratio, Setting setting);

/// The cohesion c0 (Pa) with which uniaxial compression cracks at `strength` (Pa, positive) on the yield surface of the
/// model: the Mohr circle of radius q/2 about -q/2 meets sqrt(r^2 + A^2) = c0 cos(phi) - p sin(phi), A = c0 - sigma_t0
/// tan(phi) (docs/equations.md). Without tension, far from the tip, that is Mohr-Coulomb's q (1 - sin(phi))/(2
/// cos(phi)). Nothing when no cohesion above sigma_t0 tan(phi) does.
[[nodiscard]] std::optional<double> cohesion_from_compression(double strength, double friction_angle_deg,
                                                              double tensile_strength);

/// Mohr-Coulomb's cohesion q (1 - sin(phi))/(2 cos(phi)), Pa (Jaeger, Cook and Zimmerman, Fundamentals of Rock
/// Mechanics, section 4.5).
[[nodiscard]] double mohr_coulomb_cohesion(double strength, double friction_angle_deg);

/// The stress 2 P/(pi D t) (Pa) at which the centre of a disc under a diametral load cracks: sigma_t0, or less where
/// the critical plane of the stresses (S, -3 S) is inclined.
[[nodiscard]] double splitting_strength(double tensile_strength, double cohesion, double friction_angle_deg);

/// Axial tensile strength (Pa) from the flexural one of an unnotched beam of that depth (m): a/(1 + a) of it, a = 0.06
/// (depth/mm)^0.7 (fib Model Code 2010, eq 5.1-8; for concrete).
[[nodiscard]] double tensile_from_bending(double flexural_strength, double depth);

}  // namespace fpz::io
