#include "fpz/calibration/strength.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "differences.hpp"
#include "fpz/onset.hpp"
#include "support/materials.hpp"

namespace fpz::calibration {
namespace {

/// Table 2 with the cohesion at which uniaxial tension changes from an inclined to a normal plane, times a factor.
Parameters near_kink(double factor) {
  Parameters p = test::table2();
  const double t = std::tan(p.friction_angle_deg * std::numbers::pi / 180.0);
  p.cohesion = factor * p.tensile_strength * (t + 0.5 / t);
  return p;
}

std::vector<Parameters> parameter_sets() {
  return {test::table1(), test::table2(), test::table3(), near_kink(0.97), near_kink(1.03)};
}

StrengthTest every_kind() {
  return {{{StrengthKind::uniaxial_tension, 0.0, 0.0, 0.0},
           {StrengthKind::uniaxial_compression, 0.0, 0.0, 0.0},
           {StrengthKind::direct_shear, 2e6, 0.0, 0.0},
           {StrengthKind::direct_shear, 0.0, 0.0, 0.0},
           {StrengthKind::direct_shear, -0.3e6, 0.0, 0.0},
           {StrengthKind::triaxial_axial, 5e6, 0.0, 0.0},
           {StrengthKind::triaxial_deviator, 5e6, 0.0, 0.0},
           {StrengthKind::brazilian_stress, 0.0, 0.0, 0.0},
           {StrengthKind::brazilian_load, 0.0, 0.05, 0.025}}};
}

/// Stress (tension positive) at the predicted peak; the fixed plane of a shear box has no such state.
Tensor<double, 3> stress_at(const StrengthPoint& x, double peak) {
  Tensor<double, 3> s = Tensor<double, 3>::Zero();
  switch (x.kind) {
    case StrengthKind::uniaxial_tension:
      s[0] = peak;
      break;
    case StrengthKind::uniaxial_compression:
      s[0] = -peak;
      break;
    case StrengthKind::triaxial_axial:
    case StrengthKind::triaxial_deviator:
      s << -peak, -x.pressure, -x.pressure, 0.0, 0.0, 0.0;
      if (x.kind == StrengthKind::triaxial_deviator) s[0] -= x.pressure;
      break;
    case StrengthKind::brazilian_stress:
      s[0] = peak;
      s[1] = -3.0 * peak;
      break;
    case StrengthKind::brazilian_load:
      s[0] = splitting_stress(peak, x.diameter, x.thickness);
      s[1] = -3.0 * s[0];
      break;
    case StrengthKind::direct_shear:
      break;
  }
  return s;
}

TEST(Strength, PeakIsWhereTheLibraryFindsOnset) {
  for (const Parameters& p : parameter_sets()) {
    const Material<double> m = make_material(p, Setting::three_d);
    const StrengthTest test = every_kind();
    const Prediction peaks = predict(test, p, false);
    ASSERT_TRUE(peaks.ok()) << peaks.failure;
    for (std::size_t i = 0; i < test.points.size(); ++i) {
      const StrengthPoint& x = test.points[i];
      const double peak = peaks.values[static_cast<Eigen::Index>(i)];
      if (x.kind == StrengthKind::direct_shear) {
        EXPECT_NEAR(m.law.surface.value_at(-x.pressure, peak * peak, 1.0), 0.0, 1e-13 * p.cohesion);
        continue;
      }
      const Tensor<double, 3> s = stress_at(x, peak);
      const double size = s.lpNorm<Eigen::Infinity>();
      const double closed_form = critical_plane<3>(m, s).failure_value;
      EXPECT_NEAR(closed_form, 0.0, 1e-13 * size) << to_string(x.kind);
      // The scan meets the worst plane to within its resolution: from below, with an error of second order.
      const double scanned = scan_planes<3>(m, s, 0.5).failure_value;
      EXPECT_LE(scanned, 1e-12 * size) << to_string(x.kind);
      EXPECT_GE(scanned, -1e-4 * size) << to_string(x.kind);
      EXPECT_LT(critical_plane<3>(m, Tensor<double, 3>(0.999 * s)).failure_value, 0.0) << to_string(x.kind);
    }
  }
}

TEST(Strength, UniaxialTensionIsTheLibrarysAndNotAlwaysTheParameter) {
  const StrengthTest tension{{{StrengthKind::uniaxial_tension, 0.0, 0.0, 0.0}}};
  for (const Parameters& p : parameter_sets()) {
    const double predicted = predict(tension, p, false).values[0];
    EXPECT_NEAR(predicted, uniaxial_tensile_strength(p), 1e-12 * p.tensile_strength);
  }
  EXPECT_EQ(predict(tension, test::table1(), false).values[0], 0.6e6);
  EXPECT_NEAR(predict(tension, test::table2(), false).values[0], 2.67e6, 0.005e6);
}

TEST(Strength, WithoutTensionCutTheCriterionIsMohrCoulomb) {
  // A -> 0 makes the hyperbola its asymptotes: C = 2 c cos/(1 - sin), and the deviator grows by 2 sin/(1 - sin) per
  // confining pressure.
  Parameters p = test::table1();
  const double phi = p.friction_angle_deg * std::numbers::pi / 180.0;
  p.tensile_strength = p.cohesion / std::tan(phi) * (1.0 - 1e-9);
  const Prediction peaks = predict({{{StrengthKind::uniaxial_compression, 0.0, 0.0, 0.0},
                                     {StrengthKind::triaxial_deviator, 3e6, 0.0, 0.0},
                                     {StrengthKind::direct_shear, 3e6, 0.0, 0.0}}},
                                   p, false);
  const double unconfined = 2.0 * p.cohesion * std::cos(phi) / (1.0 - std::sin(phi));
  EXPECT_NEAR(peaks.values[0], unconfined, 1e-12 * unconfined);
  EXPECT_NEAR(peaks.values[1], unconfined + 3e6 * 2.0 * std::sin(phi) / (1.0 - std::sin(phi)), 1e-11 * unconfined);
  EXPECT_NEAR(peaks.values[2], p.cohesion + 3e6 * std::tan(phi), 1e-11 * unconfined);
}

TEST(Strength, LoadAndStressOfTheDiscAgree) {
  const Prediction peaks = predict(every_kind(), test::table3(), false);
  EXPECT_NEAR(splitting_stress(peaks.values[8], 0.05, 0.025), peaks.values[7], 1e-9 * peaks.values[7]);
}

TEST(Strength, Derivatives) {
  for (const Parameters& p : parameter_sets()) {
    expect_derivatives([](const Parameters& q, bool d) { return predict(every_kind(), q, d); }, p, 1e-3, 1e-8);
  }
}

TEST(Strength, FailuresSayWhatIsWrong) {
  const Parameters p = test::table1();
  const auto why = [&](StrengthPoint x) { return predict({{x}}, p, true).failure; };
  EXPECT_NE(why({StrengthKind::triaxial_axial, -1e6, 0.0, 0.0}).find("compression counts positive"), std::string::npos);
  EXPECT_NE(why({StrengthKind::direct_shear, -0.6e6, 0.0, 0.0}).find("tensile strength"), std::string::npos);
  EXPECT_NE(why({StrengthKind::direct_shear, std::nan(""), 0.0, 0.0}).find("not a number"), std::string::npos);
  EXPECT_NE(why({StrengthKind::brazilian_load, 0.0, 0.0, 0.025}).find("diameter"), std::string::npos);
  Parameters q = p;
  q.cohesion = 0.1e6;
  EXPECT_NE(predict(every_kind(), q, false).failure.find("cohesion"), std::string::npos);
}

}  // namespace
}  // namespace fpz::calibration
