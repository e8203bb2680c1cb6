// Conversions of material quantities against closed forms and against the model itself.
#include "fpz/io/material_conversion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fpz/material.hpp"
#include "fpz/onset.hpp"

namespace fpz::io {
namespace {

TEST(MaterialConversion, ElasticConstantsOfEveryPair) {
  const double e = 30e9, nu = 0.22, k = e / (3.0 * (1.0 - 2.0 * nu)), g = e / (2.0 * (1.0 + nu));
  using Given = std::optional<double>;
  const Given none;
  const std::vector<std::array<Given, 4>> pairs = {{e, nu, none, none}, {e, none, k, none},  {e, none, none, g},
                                                   {none, nu, k, none}, {none, nu, none, g}, {none, none, k, g}};
  for (const auto& p : pairs) {
    const ElasticConstants c = elastic_constants(p[0], p[1], p[2], p[3]);
    EXPECT_NEAR(c.young_modulus, e, 1e-12 * e);
    EXPECT_NEAR(c.poisson_ratio, nu, 1e-13);
  }
  EXPECT_THROW((void)elastic_constants(e, nu, k, {}), std::invalid_argument);
  EXPECT_THROW((void)elastic_constants(e, {}, {}, {}), std::invalid_argument);
}

TEST(MaterialConversion, ToughnessOfTable1) {
  // The paper prints delta0 = 18 um for K_Ic = 2.15 MPa sqrt(mm), E = 0.4 GPa, nu = 0.25, sigma_t0 = 0.6 MPa.
  const double k = 2.15e6 * std::sqrt(1e-3);
  const double g = energy_from_toughness(k, 0.4e9, 0.25, Setting::plane_strain);
  EXPECT_NEAR(g, 10.8340, 1e-4);
  EXPECT_NEAR(g / 0.6e6, 18.06e-6, 0.01e-6);
  EXPECT_NEAR(energy_from_toughness(k, 0.4e9, 0.25, Setting::plane_stress), k * k / 0.4e9, 1e-12);
}

/// The load at which a homogeneous plane stress (xx, yy) times x cracks, by the scan over planes of the library.
double onset_load(double xx, double yy, double tension, double cohesion, double phi) {
  Parameters p;
  p.young_modulus = 30e9;
  p.poisson_ratio = 0.2;
  p.density = 2400.0;
  p.tensile_strength = tension;
  p.cohesion = cohesion;
  p.friction_angle_deg = phi;
  p.dilation_angle_deg = 0.2 * phi;
  p.delta0 = 20e-6;
  p.normal_stiffness = 1e14;
  p.shear_stiffness = 1e14;
  p.rve_length = 1e-3;
  const Material<double> m = make_material(p, Setting::plane_strain);
  double low = 0.0, high = 1e9;
  for (int k = 0; k < 60; ++k) {
    const double x = 0.5 * (low + high);
    Tensor<double, 2> stress;
    stress << x * xx, x * yy, 0.0;
    (scan_planes<2>(m, stress, 0.05).failure_value >= 0.0 ? high : low) = x;
  }
  return high;
}

TEST(MaterialConversion, CohesionThatGivesTheCompressiveStrength) {
  for (const double phi : {10.0, 30.0, 45.0, 60.0}) {
    for (const double ratio : {5.0, 12.0, 30.0}) {
      const double tension = 4e6, strength = ratio * tension;
      const auto c = cohesion_from_compression(strength, phi, tension);
      // With A = 0 the surface is a cone and the strength 2 c0 cos(phi)/(1 - sin(phi)), c0 = sigma_t0 tan(phi).
      const double s = std::sin(phi * std::numbers::pi / 180.0);
      EXPECT_EQ(c.has_value(), strength > 2.0 * tension * s / (1.0 - s)) << phi << ' ' << ratio;
      if (!c) continue;
      EXPECT_NEAR(onset_load(0.0, -1.0, tension, *c, phi), strength, 1e-6 * strength) << phi << ' ' << ratio;
      EXPECT_GT(*c, mohr_coulomb_cohesion(strength, phi)) << "the surface lies inside its asymptotes";
    }
  }
}

TEST(MaterialConversion, CohesionIsRefusedWhereThereIsNone) {
  EXPECT_FALSE(cohesion_from_compression(1e6, 60.0, 10e6));
}

TEST(MaterialConversion, MohrCoulombsCohesionIsTangentToTheCircle) {
  // tau = c - sigma_n tan(phi) and the circle from 0 to -q: the distance of the centre from the line is the radius.
  const double q = 70e6, phi = 35.0, rad = phi * std::numbers::pi / 180.0;
  const double c = mohr_coulomb_cohesion(q, phi);
  EXPECT_NEAR((c + 0.5 * q * std::tan(rad)) * std::cos(rad), 0.5 * q, 1e-6);
}

TEST(MaterialConversion, DiscCracksWhereItsCentreDoes) {
  for (const double cohesion : {4e6, 6e6, 10e6, 20e6, 40e6}) {
    const double s = splitting_strength(4e6, cohesion, 35.0);
    EXPECT_NEAR(onset_load(1.0, -3.0, 4e6, cohesion, 35.0), s, 1e-6 * s) << cohesion;
  }
  EXPECT_EQ(splitting_strength(4e6, 40e6, 35.0), 4e6);
  EXPECT_LT(splitting_strength(4e6, 6e6, 35.0), 4e6);
}

TEST(MaterialConversion, BendingStrengthOfTheModelCode) {
  // fib Model Code 2010: 100 mm deep, a = 0.06 * 100^0.7 = 1.507, factor 0.601.
  EXPECT_NEAR(tensile_from_bending(5e6, 0.1) / 5e6, 0.601, 5e-4);
  EXPECT_GT(tensile_from_bending(5e6, 0.5), tensile_from_bending(5e6, 0.05));
}

}  // namespace
}  // namespace fpz::io
