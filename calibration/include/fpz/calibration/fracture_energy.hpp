// Work of fracture of one cohesive zone per crack area, int t.du from onset, and what it says about delta0.
//
// Tractions are tension positive; jumps count from onset, as in the library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fpz/calibration/prediction.hpp"
#include "fpz/io/material_conversion.hpp"

namespace fpz::calibration {

/// How the zone is taken apart.
enum class FracturePath {
  opening,                   ///< mode I: pure opening
  shear_at_normal_traction,  ///< mode II while the normal traction keeps its value and the zone may dilate
  shear_at_fixed_opening,    ///< mode II with the normal jump held at zero, so that dilation presses the plane shut
  direction                  ///< the jump grows along a fixed direction
};

}  // namespace fpz::calibration

/// As the key "mode" of a specification names them.
template <>
struct fpz::Words<fpz::calibration::FracturePath> {
  using K = calibration::FracturePath;
  static constexpr Word<K> list[] = {{K::opening, "I"},
                                     {K::shear_at_normal_traction, "II"},
                                     {K::shear_at_fixed_opening, "II_fixed_opening"},
                                     {K::direction, "direction"}};
};

namespace fpz::calibration {

/// One measured fracture energy: what was done to the zone.
///
/// The zone starts at onset, on the yield surface. Where on it is not a property of the jump path, so it must be
/// chosen. By default the onset traction is K.direction scaled onto the surface: that of a zone which has been loaded
/// from zero along its own springs in the direction of the later jump. At constant normal traction it follows from that
/// traction. Otherwise `onset_angle_deg` replaces it, e.g. where the stress in the specimen is known.
struct FractureEnergyTest {
  FracturePath path = FracturePath::opening;
  double angle_deg = 0.0;        ///< direction: of the jump from the normal; 0 opens, 90 shears; [0, 90]
  double normal_traction = 0.0;  ///< shear_at_normal_traction: t_n, Pa, tension positive
  std::optional<double> end;     ///< |u| at the end (at normal traction: the slip), m; nothing: full separation
  std::optional<double> onset_angle_deg;  ///< of the onset traction from the normal, [0, 180); above 90: compression
};

/// One value, the work of fracture in J/m^2. Exact to about 1e-13 where the plane stays open or its normal traction is
/// given (a quadrature along the yield hyperbola); where the jump path presses it shut, 1e-9 (the library's `accurate`
/// integrator). Mode I is sigma_t0 delta0 (1 - exp(-end/delta0)). Fails where the work is not finite (friction on a
/// plane that stays shut, without an end slip) or the zone separates at once before `end` (constant tension).
[[nodiscard]] Prediction predict(const FractureEnergyTest& test, const Parameters& parameters, bool derivatives);

// --- toughness ---

using io::energy_from_toughness;
using io::toughness_from_energy;

// --- delta0 ---

/// delta0 (m) with sigma_t0 delta0 (1 - exp(-end/delta0)) = energy in mode I; energy/sigma_t0 without `end`. Throws
/// std::invalid_argument unless 0 < energy < strength * end: no delta0 gives more.
[[nodiscard]] double mode_one_delta0(double energy, double strength, std::optional<double> end = {});

/// The end opening (m) at which mode I has used `energy` for a given delta0; nothing where it never does, that is for
/// energy >= strength * delta0.
[[nodiscard]] std::optional<double> mode_one_end_opening(double energy, double strength, double delta0);

/// A value of one parameter at which a test has a given energy.
struct ParameterForEnergy {
  std::optional<double> value;  ///< the root closest (in ratio) to the present value; nothing: not reachable
  double least = 0.0;           ///< smallest and largest energy met between the bounds, J/m^2
  double largest = 0.0;
  std::string failure;  ///< why there is no value; empty when there is one
};

/// Varies one parameter between lower and upper (0 < lower < upper), the others fixed, until the test's work of
/// fracture is `energy`. Values that the model does not admit are left out.
[[nodiscard]] ParameterForEnergy parameter_for_energy(const FractureEnergyTest& test, const Parameters& parameters,
                                                      Parameter which, double energy, double lower, double upper);

/// delta0 (m) for any test; the search spans 1e-4 to 1e4 times energy/sigma_t0.
[[nodiscard]] ParameterForEnergy delta0_for_energy(const FractureEnergyTest& test, const Parameters& parameters,
                                                   double energy);

// --- G_I and G_II together ---

struct ParameterRange {
  Parameter parameter = Parameter::cohesion;
  double lower = 0.0;
  double upper = 0.0;
};

/// What freeing one more parameter does, delta0 being fitted to G_I all along.
struct FreedParameter {
  ParameterRange range;
  ParameterForEnergy match;      ///< for G_II
  double sensitivity = 0.0;      ///< d ln G_II / d ln parameter at the given parameters
  std::optional<double> delta0;  ///< goes with match.value, m
  std::string words;
};

/// One delta0 cannot match two energies: the numbers, and the ways out.
struct TwoEnergies {
  double delta0_one = 0.0;  ///< from G_I alone, m
  double delta0_two = 0.0;  ///< from G_II alone, m
  double two_at_one = 0.0;  ///< G_II predicted with delta0_one, J/m^2
  double one_at_two = 0.0;  ///< G_I predicted with delta0_two, J/m^2
  bool consistent = false;  ///< the two delta0 agree to 1e-6
  std::vector<FreedParameter> freed;
  std::vector<std::string> statements;  ///< all of it in words
  std::string failure;                  ///< empty when the numbers above have meaning

  [[nodiscard]] bool ok() const { return failure.empty(); }
};

/// Ranges used where none are given: Ks 1e-2 to 1e2 times its value, c0 from its admissible minimum to 10 times its
/// value, psi up to phi.
[[nodiscard]] std::vector<ParameterRange> default_ranges(const Parameters& parameters);

[[nodiscard]] TwoEnergies compare_energies(const FractureEnergyTest& one, double energy_one,
                                           const FractureEnergyTest& two, double energy_two,
                                           const Parameters& parameters, const std::vector<ParameterRange>& ranges);

}  // namespace fpz::calibration
