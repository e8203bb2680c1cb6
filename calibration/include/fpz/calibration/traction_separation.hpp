// Traction-separation curves of one cohesive zone: opening, shear and mixed tests, and the direct shear test under a
// prescribed normal stress, with unloading and reloading.
//
// Tractions are tension positive (the normal stress of a shear box enters as a negative traction); jumps in metres.
#pragma once

#include <optional>
#include <vector>

#include "fpz/calibration/prediction.hpp"

namespace fpz::calibration {

/// One row of the loading history. Between rows both prescribed quantities change linearly. Either `normal_jump` or
/// `normal_traction` is given.
struct ZoneRow {
  double shear_jump = 0.0;                ///< u_s, m; stays zero in an opening test
  std::optional<double> normal_jump;      ///< u_n, m
  std::optional<double> normal_traction;  ///< t_n, Pa
};

enum class ZoneQuantity { normal_traction, shear_traction, normal_jump };

}  // namespace fpz::calibration

/// As columns of data name them.
template <>
struct fpz::Words<fpz::calibration::ZoneQuantity> {
  using K = calibration::ZoneQuantity;
  static constexpr Word<K> list[] = {
      {K::normal_traction, "normal_traction"}, {K::shear_traction, "shear_traction"}, {K::normal_jump, "opening"}};
};

namespace fpz::calibration {

/// A measured value: what was measured at which row (counted from 0).
struct ZonePoint {
  int row = 0;
  ZoneQuantity quantity = ZoneQuantity::shear_traction;
};

/// Where the curve starts.
///
/// Rigid (the default): the zone does not exist before onset, jumps count from there, and the first row is met from the
/// onset point. The onset traction lies on the yield surface: at the first row's normal traction where that is
/// prescribed, otherwise as in FractureEnergyTest, with the direction of the first row that has a jump. The rising
/// branch of a measured curve must be taken off before.
///
/// `elastic_before_onset`: the curve starts from zero traction and rises along the springs Kn, Ks, as in an interface
/// that was there before; jumps contain the elastic part. Where the first row prescribes a normal traction, that is
/// applied first, at zero shear, and the normal jump counts from then on, as a dilation gauge is zeroed.
struct TractionSeparationTest {
  std::vector<ZoneRow> rows;
  std::vector<ZonePoint> points;
  bool elastic_before_onset = false;
  std::optional<double> onset_angle_deg;  ///< rigid, first row with a jump: see FractureEnergyTest
  double tolerance = 1e-9;                ///< of the integrator, see Options
};

/// One value per point: Pa, or m for the normal jump. A prescribed normal traction is met to rounding at the rows and
/// to about 1e-4 sigma_t0 times the step's damage between them. Fails, naming the row, where the zone has no onset or
/// separates at once (constant tension), and for an incomplete history.
[[nodiscard]] Prediction predict(const TractionSeparationTest& test, const Parameters& parameters, bool derivatives);

}  // namespace fpz::calibration
