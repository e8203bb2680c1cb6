// Strength tests: the load at which the onset criterion (docs/equations.md, "Onset") is first met, in closed form.
//
// Inputs and results follow the laboratory: compressive stresses are positive numbers here, as are the strengths.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "fpz/calibration/prediction.hpp"

namespace fpz::calibration {

enum class StrengthKind {
  uniaxial_tension,      ///< peak tension, Pa: sigma_t0, or less where an inclined plane fails first
  uniaxial_compression,  ///< peak compression, Pa
  direct_shear,          ///< peak shear stress on the fixed plane of a shear box, Pa
  triaxial_axial,        ///< peak axial compression at a confining pressure, Pa
  triaxial_deviator,     ///< the same less the confining pressure, Pa
  brazilian_stress,      ///< splitting stress 2P/(pi D t) of a disc, Pa
  brazilian_load         ///< splitting load P of a disc, N
};

}  // namespace fpz::calibration

template <>
struct fpz::Words<fpz::calibration::StrengthKind> {
  using K = calibration::StrengthKind;
  static constexpr Word<K> list[] = {
      {K::uniaxial_tension, "uniaxial_tension"},   {K::uniaxial_compression, "uniaxial_compression"},
      {K::direct_shear, "direct_shear"},           {K::triaxial_axial, "triaxial_axial"},
      {K::triaxial_deviator, "triaxial_deviator"}, {K::brazilian_stress, "brazilian_stress"},
      {K::brazilian_load, "brazilian_load"}};
};

namespace fpz::calibration {

/// One specimen.
struct StrengthPoint {
  StrengthKind kind = StrengthKind::uniaxial_tension;
  /// Triaxial: confining pressure, >= 0. Direct shear: normal stress on the plane, compression positive (tension, i.e.
  /// negative, is allowed up to the tensile strength). Pa.
  double pressure = 0.0;
  double diameter = 0.0;   ///< brazilian_load: D, m
  double thickness = 0.0;  ///< brazilian_load: t, m
};

struct StrengthTest {
  std::vector<StrengthPoint> points;
};

/// SI unit of the measured value of specimen k.
[[nodiscard]] inline std::string_view unit_of_value(const StrengthTest& test, std::size_t k) {
  return test.points[k].kind == StrengthKind::brazilian_load ? "N" : "Pa";
}

/// 2P/(pi D t), Pa: the tension at the centre of an elastic disc under the load P (N). The compression there is three
/// times as large.
[[nodiscard]] double splitting_stress(double load, double diameter, double thickness);

/// Peak stress (brazilian_load: peak load) of every specimen. A Brazilian test is taken to fail where and when its
/// centre meets the criterion; the stress along the disc's axis lies between the other two and plays no part. Fails
/// for inadmissible parameters, for pressures or sizes that make no sense, and for a plane under tension beyond
/// sigma_t0.
[[nodiscard]] Prediction predict(const StrengthTest& test, const Parameters& parameters, bool derivatives);

}  // namespace fpz::calibration
