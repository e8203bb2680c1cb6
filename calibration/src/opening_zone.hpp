// A zone of the mid-line as a function of its jump and of the inputs that a path is differentiated with respect to.
#pragma once

#include "fpz/calibration/mid_line.hpp"
#include "zone.hpp"

namespace fpz::calibration {

/// The parameters of the path, those among its inputs as seeds of derivatives.
template <class Slope>
[[nodiscard]] BasicParameters<Slope> seeded_inputs(const Parameters& p) {
  const auto seed = [](double value, PathInput which) { return Slope::seed(value, static_cast<int>(which)); };
  BasicParameters<Slope> s;
  s.young_modulus = seed(p.young_modulus, PathInput::young_modulus);
  s.poisson_ratio = seed(p.poisson_ratio, PathInput::poisson_ratio);
  s.tensile_strength = seed(p.tensile_strength, PathInput::tensile_strength);
  s.delta0 = seed(p.delta0, PathInput::delta0);
  s.normal_stiffness = seed(p.normal_stiffness, PathInput::normal_stiffness);
  s.cohesion = p.cohesion;
  s.friction_angle_deg = p.friction_angle_deg;
  s.dilation_angle_deg = p.dilation_angle_deg;
  s.shear_stiffness = p.shear_stiffness;
  s.choices = p.choices;
  return s;
}

/// A zone that has just cracked in pure opening.
template <class Slope, class P>
[[nodiscard]] CohesiveState<Slope, 1> fresh_zone(const CohesiveLaw<P>& law) {
  return cracked_at<Slope, 1>(law, Vec<Slope, 1>::Constant(Slope(law.surface.tensile_strength)));
}

}  // namespace fpz::calibration
