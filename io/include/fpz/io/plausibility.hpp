// Is a number what it can be in tests of rock and concrete? A value far off is nearly always one in another unit, and
// the message says which.
#pragma once

#include <string>
#include <string_view>

#include "fpz/io/units.hpp"
#include "fpz/parameters.hpp"

namespace fpz::io {

/// A range of values (SI) of one quantity.
struct Typical {
  Quantity quantity = Quantity::number;
  Plausible range;
};

enum class Verdict { plausible, doubtful, impossible };

struct Judgement {
  Verdict verdict = Verdict::plausible;
  std::string text;         ///< empty when plausible
  bool other_unit = false;  ///< the number would be usual in another unit, which the text names
};

/// A number as a person wrote it, and in SI.
struct Written {
  double si = 0.0;
  double number = 0.0;
  std::string_view unit;  ///< of the number
};

/// What a file lets a person write: numbers in SI only, or {"value": x, "unit": "..."} as well.
enum class Spelling { si_only, with_unit };

/// Judges a value; `what` names it in the message. Outside [low, high]: doubtful; outside [far_low, far_high]:
/// impossible. Where the number in another unit would be typical, the message says so, and how to write it.
[[nodiscard]] Judgement judge(std::string_view what, const Written& value, const Typical& typical,
                              Spelling spelling = Spelling::with_unit);

/// "; 3.9 MPa was probably meant: write 3.9e+06", with the unit in which the number would be typical; empty when there
/// is none.
[[nodiscard]] std::string likely_unit(const Written& value, const Typical& typical, Spelling spelling);

/// Judges a parameter by its name in the table of parameters, a number in SI. Throws as typical_parameter().
[[nodiscard]] Judgement judge_parameter(std::string_view name, double si);

/// The range over `factor`, of another quantity: loads by the stress that they mean.
[[nodiscard]] Typical scaled(const Typical& typical, Quantity quantity, double factor);

/// The range of a parameter, by its name in the table of parameters. Throws std::invalid_argument for an unknown name.
[[nodiscard]] Typical typical_parameter(std::string_view name);

namespace typical {
inline constexpr Typical fracture_energy{Quantity::energy_per_area, {0.02, 0.5, 1e3, 1e5}};
inline constexpr Typical toughness{Quantity::toughness, {1e3, 1e4, 6e6, 6e7}};
inline constexpr Typical opening{Quantity::length, {1e-9, 1e-7, 3e-3, 1e-2}};         ///< largest jump, CMOD
inline constexpr Typical specimen_size{Quantity::length, {1e-3, 5e-3, 3.0, 20.0}};    ///< depth, span, radius
inline constexpr Typical small_size{Quantity::length, {1e-4, 5e-4, 1.0, 10.0}};       ///< notch, thickness, roller
inline constexpr Typical bending_stress{Quantity::stress, {2e4, 2e5, 5e7, 5e8}};      ///< nominal, at the peak
inline constexpr Typical tensile_stress{Quantity::stress, {1e4, 5e4, 3e7, 1e8}};      ///< tractions, tensile strengths
inline constexpr Typical compressive_stress{Quantity::stress, {1e5, 5e5, 1e9, 5e9}};  ///< peaks in compression
inline constexpr Typical pressure{Quantity::stress, {1e3, 1e4, 5e8, 5e9}};            ///< confinement
inline constexpr Typical shear_stress{Quantity::stress, {1e4, 5e4, 3e8, 2e9}};        ///< direct shear
}  // namespace typical

}  // namespace fpz::io
