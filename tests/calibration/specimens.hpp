// Specimens and materials of the notched specimen tests.
#pragma once

#include "fpz/calibration/notched_specimen.hpp"
#include "support/materials.hpp"

namespace fpz::calibration::test {

/// The beam of section 5.1 of the paper.
inline NotchedSpecimen beam() {
  NotchedSpecimen s;
  s.shape = SpecimenShape::beam;
  s.length = 0.32;
  s.depth = 0.08;
  s.thickness = 0.04;
  s.span = 0.24;
  s.notch = 0.008;
  return s;
}

/// A made-up rock that cracks in mode I under uniaxial tension.
inline Parameters mode_one_rock() {
  Parameters p;
  p.young_modulus = 30e9;
  p.poisson_ratio = 0.2;
  p.density = 2400.0;
  p.tensile_strength = 3.5e6;
  p.cohesion = 12e6;
  p.friction_angle_deg = 34.0;
  p.dilation_angle_deg = 6.0;
  p.delta0 = 20e-6;
  p.normal_stiffness = 1e14;
  p.shear_stiffness = 2e12;
  return p;
}

/// The half disc of section 5.2 of the paper at zero notch angle, with a longer notch.
inline NotchedSpecimen semicircular() {
  NotchedSpecimen s;
  s.shape = SpecimenShape::semicircular;
  s.radius = 0.05;
  s.thickness = 0.02;
  s.span = 0.06;
  s.notch = 0.02;
  return s;
}

/// Table 2 with a cohesion that lets it crack in mode I, and delta0 = G/sigma_t0 without the paper's rounding.
inline Parameters concrete() {
  Parameters p = fpz::test::table2();
  p.cohesion = 5e6;
  p.delta0 = 47.17 / 2.9e6;
  return p;
}

}  // namespace fpz::calibration::test
