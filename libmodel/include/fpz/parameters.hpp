// Material parameters as a person states them, and their validation.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/types.hpp"

namespace fpz {

/// Which softening law a material has: a value of the list in law/softening.hpp, the default first.
enum class SofteningKind : std::uint8_t {};

/// How the jump of a cohesive zone that does not yield follows the traction, the default first (docs/equations.md).
enum class CohesiveZone : std::uint8_t {
  consistent,  ///< u - up = D K^-1 t: rigid at onset, never stores less than nothing
  published    ///< t = P K (u + u0 - up), the paper's: springs preloaded at onset by u0 = K^-1 t_onset
};

template <>
struct Words<CohesiveZone> {
  static constexpr Word<CohesiveZone> list[] = {{CohesiveZone::consistent, "consistent"},
                                                {CohesiveZone::published, "published"}};
};

/// What a material chooses besides its numbers. Files may leave a choice out: it is the default then.
struct MaterialChoices {
  SofteningKind softening{};
  CohesiveZone cohesive_zone{};
};

/// Calls f(key, choice) for every choice; all are enumerations with words (words.hpp, law/softening.hpp).
template <class Choices, class F>
void visit_choices(Choices& c, F&& f) {
  f("softening", c.softening);
  f("cohesive_zone", c.cohesive_zone);
}

/// The eleven numbers of the model (Tables 1-3 of the paper) and its choices. SI units, angles in degrees.
template <class T>
struct BasicParameters {
  T young_modulus{};       ///< E, Pa
  T poisson_ratio{};       ///< nu
  T density{};             ///< rho, kg/m^3
  T tensile_strength{};    ///< sigma_t0, Pa
  T cohesion{};            ///< c0, Pa
  T friction_angle_deg{};  ///< phi, degrees
  T dilation_angle_deg{};  ///< psi, degrees
  T delta0{};              ///< delta0 of eq 47, m: mode I fracture energy over tensile strength, whatever the softening
  T normal_stiffness{};    ///< Kn, Pa/m
  T shear_stiffness{};     ///< Ks, Pa/m
  T rve_length{};          ///< H, m
  MaterialChoices choices{};
};
using Parameters = BasicParameters<double>;

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Values that a parameter may have: between `lower` and `upper`, themselves excluded unless said.
struct Bounds {
  double lower = 0.0;
  double upper = unbounded;
  bool lower_included = false;

  [[nodiscard]] constexpr bool hold(double x) const { return (lower_included ? x >= lower : x > lower) && x < upper; }
  /// "> 0 and < 90"
  [[nodiscard]] std::string text() const;
};

/// What is met in tests of rock and concrete, from low to high, and what is out of the question beyond far_low and
/// far_high. A value outside is nearly always one in another unit.
struct Plausible {
  double far_low = 0.0;
  double low = 0.0;
  double high = 0.0;
  double far_high = 0.0;
};

/// One parameter: all that readers, checks, reports and tables know about it.
template <class T>
struct ParameterInfo {
  std::string_view name;    ///< key in files and messages; the member of BasicParameters has the same name
  std::string_view symbol;  ///< for tables and pictures
  std::string_view unit;    ///< SI; angles in degrees
  T BasicParameters<T>::*member;
  Bounds bounds;
  Plausible plausible;
  bool of_material = true;  ///< false: belongs to the place of the material point, not to the material
};

/// The one list of the parameters, in the order of the struct. Constraints between parameters are in validate().
// clang-format off
template <class T>
inline constexpr std::array<ParameterInfo<T>, 11> parameter_table = {{
    {"young_modulus",      "E",        "Pa",    &BasicParameters<T>::young_modulus,      {},                    {2e7, 1e8, 1.5e11, 1e12}},
    {"poisson_ratio",      "nu",       "",      &BasicParameters<T>::poisson_ratio,      {-1.0, 0.5},           {0.005, 0.05, 0.45, 0.5}},
    {"density",            "rho",      "kg/m3", &BasicParameters<T>::density,            {},                    {300.0, 1000.0, 3500.0, 1e4}},
    {"tensile_strength",   "sigma_t0", "Pa",    &BasicParameters<T>::tensile_strength,   {},                    {1e4, 5e4, 3e7, 1e8}},
    {"cohesion",           "c0",       "Pa",    &BasicParameters<T>::cohesion,           {},                    {1e4, 5e4, 2e8, 1e9}},
    {"friction_angle_deg", "phi",      "deg",   &BasicParameters<T>::friction_angle_deg, {0.0, 90.0},           {2.0, 10.0, 65.0, 85.0}},
    {"dilation_angle_deg", "psi",      "deg",   &BasicParameters<T>::dilation_angle_deg, {0.0, unbounded, true}, {0.02, 0.5, 40.0, 85.0}},
    {"delta0",             "delta0",   "m",     &BasicParameters<T>::delta0,             {},                    {1e-9, 3e-7, 3e-4, 2e-3}},
    {"normal_stiffness",   "Kn",       "Pa/m",  &BasicParameters<T>::normal_stiffness,   {},                    {1e8, 1e11, 1e16, 1e19}},
    {"shear_stiffness",    "Ks",       "Pa/m",  &BasicParameters<T>::shear_stiffness,    {},                    {1e7, 1e9, 1e16, 1e19}},
    {"rve_length",         "H",        "m",     &BasicParameters<T>::rve_length,         {},                    {1e-6, 1e-5, 0.5, 10.0}, false},
}};
// clang-format on

/// How many of them a material file states: the first ones of the table.
inline constexpr std::size_t material_parameter_count = 10;

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
/// = 0 (pure opening has no solution), uniaxial tensile strength below sigma_t0 (3.4), springs that are preloaded with
/// more than a tenth of G (published zone) or that are not used because they are softer than the softening
/// (consistent).
[[nodiscard]] Validation validate(const Parameters& p, Setting setting);

/// Largest H without snap-back under strain control in mode I: (lambda + 2 mu) l / sigma_t0, and the plane-stress
/// modulus E/(1 - nu^2) in place of lambda + 2 mu where that applies. In the published zone 1/l is the steepest slope
/// of the softening law (l = delta0 for the exponential one); in the consistent one l is longer or shorter by a part of
/// sigma_t0/Kn (docs/equations.md). Metres.
[[nodiscard]] double snap_back_length(const Parameters& p, Setting setting);

/// The energy t.K^-1.t/2 with which the springs of the published zone are preloaded at onset and which no work pays
/// for, at its largest for normal tractions from -c0 to sigma_t0; it grows with more pressure.
struct OnsetPreload {
  double ratio = 0.0;      ///< over the fracture energy sigma_t0 delta0; 0 in the consistent zone
  double normal = 0.0;     ///< traction at which it is largest, Pa
  double shear = 0.0;      ///< the same, magnitude
  double stiffness = 0.0;  ///< of Kn and Ks the one that matters most there, Pa/m
};
[[nodiscard]] OnsetPreload onset_preload(const Parameters& p);

/// The stress at which uniaxial tension cracks: sigma_t0, or less when the critical plane is inclined
/// (docs/equations.md). Pa.
[[nodiscard]] double uniaxial_tensile_strength(const Parameters& p);

}  // namespace fpz
