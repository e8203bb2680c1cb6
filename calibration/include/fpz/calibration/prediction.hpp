// What every forward model of the calibration returns: predicted values and their derivatives with respect to the
// material parameters.
#pragma once

#include <ceres/jet.h>

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>

#include "fpz/parameters.hpp"

namespace fpz::calibration {

/// The material parameters that data can inform, in the order of the derivatives. Density and the RVE length are not
/// among them: no quasi-static test of a specimen depends on the first, and the second belongs to the test.
enum class Parameter : int {
  young_modulus,
  poisson_ratio,
  tensile_strength,
  cohesion,
  friction_angle_deg,
  dilation_angle_deg,
  delta0,
  normal_stiffness,
  shear_stiffness
};
inline constexpr int parameter_count = 9;

/// A number with its derivatives with respect to all material parameters.
using Jet = ceres::Jet<double, parameter_count>;

struct ParameterInfo {
  std::string_view name;    ///< as in material files
  std::string_view symbol;  ///< for pictures and tables
  std::string_view unit;
  double Parameters::*member;
  Jet BasicParameters<Jet>::*jet_member;
};

// clang-format off
inline constexpr std::array<ParameterInfo, parameter_count> parameter_info = {{
    {"young_modulus", "E", "Pa", &Parameters::young_modulus, &BasicParameters<Jet>::young_modulus},
    {"poisson_ratio", "nu", "", &Parameters::poisson_ratio, &BasicParameters<Jet>::poisson_ratio},
    {"tensile_strength", "sigma_t0", "Pa", &Parameters::tensile_strength, &BasicParameters<Jet>::tensile_strength},
    {"cohesion", "c0", "Pa", &Parameters::cohesion, &BasicParameters<Jet>::cohesion},
    {"friction_angle_deg", "phi", "deg", &Parameters::friction_angle_deg, &BasicParameters<Jet>::friction_angle_deg},
    {"dilation_angle_deg", "psi", "deg", &Parameters::dilation_angle_deg, &BasicParameters<Jet>::dilation_angle_deg},
    {"delta0", "delta0", "m", &Parameters::delta0, &BasicParameters<Jet>::delta0},
    {"normal_stiffness", "Kn", "Pa/m", &Parameters::normal_stiffness, &BasicParameters<Jet>::normal_stiffness},
    {"shear_stiffness", "Ks", "Pa/m", &Parameters::shear_stiffness, &BasicParameters<Jet>::shear_stiffness},
}};
// clang-format on

[[nodiscard]] constexpr const ParameterInfo& info(Parameter p) { return parameter_info[static_cast<std::size_t>(p)]; }

/// The parameters, each the seed of its own derivative.
[[nodiscard]] inline BasicParameters<Jet> seeded(const Parameters& p) {
  BasicParameters<Jet> out;
  out.density = Jet(p.density);
  out.rve_length = Jet(p.rve_length);
  for (int k = 0; k < parameter_count; ++k) {
    const ParameterInfo& which = parameter_info[static_cast<std::size_t>(k)];
    out.*which.jet_member = Jet(p.*which.member, k);
  }
  return out;
}

/// Predicted values, one per measured point. Columns of the Jacobian: the material parameters in the order of
/// `Parameter` (per SI unit or degree), then the test's own nuisance parameters, if it has any. Empty when derivatives
/// were not asked for.
struct Prediction {
  Eigen::VectorXd values;
  Eigen::MatrixXd jacobian;
  std::string failure;  ///< why there is no prediction; empty when there is one

  [[nodiscard]] bool ok() const { return failure.empty(); }
};

[[nodiscard]] inline Prediction failed(std::string why) {
  Prediction p;
  p.failure = std::move(why);
  return p;
}

}  // namespace fpz::calibration
