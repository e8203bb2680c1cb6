// The materials of the paper's Tables 1-3, as plain numbers for the tests, with the cohesive zone that it published.
#pragma once

#include "fpz/parameters.hpp"

namespace fpz::test {

/// Table 1, Johnstone; the element test of section 4.5 uses H = 4 mm.
inline Parameters table1(double rve_length = 4e-3) {
  Parameters p;
  p.young_modulus = 0.4e9;
  p.poisson_ratio = 0.25;
  p.density = 1540.0;
  p.tensile_strength = 0.6e6;
  p.cohesion = 1.0e6;
  p.friction_angle_deg = 33.0;
  p.dilation_angle_deg = 4.0;
  p.delta0 = 18e-6;
  p.normal_stiffness = 1e13;
  p.shear_stiffness = 1e11;
  p.rve_length = rve_length;
  p.choices.cohesive_zone = CohesiveZone::published;
  return p;
}

/// A material with the other form of the zone.
inline Parameters with_zone(Parameters p, CohesiveZone zone) {
  p.choices.cohesive_zone = zone;
  return p;
}

/// Table 1 with another softening law.
inline Parameters table1_with(SofteningKind softening, double rve_length = 4e-3) {
  Parameters p = table1(rve_length);
  p.choices.softening = softening;
  return p;
}

/// Table 2, concrete of the three-point bending test; cracks on an inclined plane in uniaxial tension.
inline Parameters table2(double rve_length = 1e-3) {
  Parameters p;
  p.young_modulus = 45e9;
  p.poisson_ratio = 0.24;
  p.density = 2400.0;
  p.tensile_strength = 2.9e6;
  p.cohesion = 2.9e6;
  p.friction_angle_deg = 37.0;
  p.dilation_angle_deg = 5.0;
  p.delta0 = 16.4e-6;
  p.normal_stiffness = 1e14;
  p.shear_stiffness = 1e11;
  p.rve_length = rve_length;
  p.choices.cohesive_zone = CohesiveZone::published;
  return p;
}

/// Table 3, marble.
inline Parameters table3(double rve_length = 0.5e-3) {
  Parameters p = table2(rve_length);
  p.young_modulus = 49e9;
  p.poisson_ratio = 0.19;
  p.density = 2700.0;
  p.tensile_strength = 3.6e6;
  p.cohesion = 10e6;
  p.friction_angle_deg = 33.0;
  p.dilation_angle_deg = 4.0;
  p.delta0 = 8.5e-6;
  return p;
}

}  // namespace fpz::test
