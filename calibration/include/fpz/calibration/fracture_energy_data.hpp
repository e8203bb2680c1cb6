// Data of the kind "fracture_energy": one measured energy, or the toughness that stands for it.
#pragma once

#include "fpz/calibration/fracture_energy.hpp"

namespace fpz::calibration {

struct FractureEnergyData {
  FractureEnergyTest test;
  bool is_toughness = false;
  double measured = 0.0;  ///< J/m^2, or Pa sqrt(m)
  Setting setting = Setting::plane_strain;
};

/// One value, an energy or a toughness as it was measured.
[[nodiscard]] Prediction predict(const FractureEnergyData& data, const Parameters& parameters,
                                 const Eigen::VectorXd& nuisance, bool derivatives);

/// The measured energy, J/m^2; of a toughness with the elastic constants of `parameters`.
[[nodiscard]] double measured_energy(const FractureEnergyData& data, const Parameters& parameters);

}  // namespace fpz::calibration
