// Largest loads against whole curves by steps, differences, and back to the parameters that made them.
#include "fpz/calibration/peak_load.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "fpz/calibration/calibration.hpp"
#include "specimens.hpp"

namespace fpz::calibration {
namespace {

using test::beam;
using test::concrete;
using test::semicircular;

/// The largest load of a curve by steps under growing CMOD, on elements of half the size.
double peak_by_steps(NotchedSpecimen s, const Parameters& p) {
  s.mesh.ligament_fraction *= 0.5;
  s.mesh.tip_fraction *= 0.5;
  const FractureCurve c = fracture_curve(s, p, 0.95, 0.02);
  EXPECT_EQ(c.failure, "");
  return *std::max_element(c.load.begin(), c.load.end());
}

NotchedSpecimen scaled(double factor) {
  NotchedSpecimen s = beam();
  s.notch = 0.02;
  for (double NotchedSpecimen::*m :
       {&NotchedSpecimen::length, &NotchedSpecimen::depth, &NotchedSpecimen::span, &NotchedSpecimen::notch}) {
    s.*m *= factor;
  }
  return s;
}

PeakLoadTest test_of(const std::vector<NotchedSpecimen>& specimens) {
  PeakLoadTest t;
  for (const NotchedSpecimen& s : specimens) t.specimens.push_back({s});
  return t;
}

TEST(PeakLoad, IsThatOfTheWholeCurve) {
  const std::vector<NotchedSpecimen> specimens = {beam(), semicircular(), scaled(0.5), scaled(4.0)};
  const Prediction p = predict(test_of(specimens), concrete(), false);
  ASSERT_TRUE(p.ok()) << p.failure;
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    const double expected = peak_by_steps(specimens[k], concrete());
    EXPECT_NEAR(p.values[static_cast<Eigen::Index>(k)], expected, 1e-3 * expected) << k;
  }
}

TEST(PeakLoad, DerivativesAgainstDifferences) {
  const PeakLoadTest t = test_of({beam(), scaled(3.0)});
  const Prediction exact = predict(t, concrete(), true);
  ASSERT_TRUE(exact.ok()) << exact.failure;
  for (const Parameter which : {Parameter::young_modulus, Parameter::tensile_strength, Parameter::delta0}) {
    const auto member = parameter_info[static_cast<std::size_t>(which)].member;
    const double step = 1e-3 * concrete().*member;
    Parameters up = concrete(), down = concrete();
    up.*member += step;
    down.*member -= step;
    const Eigen::VectorXd slope = (predict(t, up, false).values - predict(t, down, false).values) / (2.0 * step);
    const Eigen::VectorXd column = exact.jacobian.col(static_cast<int>(which));
    EXPECT_LE((column - slope).cwiseAbs().maxCoeff(), 1e-5 * slope.cwiseAbs().maxCoeff()) << static_cast<int>(which);
  }
}

/// Similar beams of three sizes: peaks alone give strength and fracture energy when E is known.
TEST(PeakLoad, SizeEffectGivesStrengthAndEnergyBack) {
  std::string points;
  for (const double factor : {0.5, 1.0, 2.0, 4.0}) {
    const NotchedSpecimen s = scaled(factor);
    const auto mm = [](double x) { return std::to_string(1e3 * x); };
    points += (points.empty() ? "" : ", ") + std::string(R"({"geometry": {"unit": "mm", "depth": )") + mm(s.depth) +
              R"(, "span": )" + mm(s.span) + R"(, "notch": )" + mm(s.notch) + R"(, "thickness": )" + mm(s.thickness) +
              R"(, "length": )" + mm(s.length) + R"(}, "load": )" + std::to_string(peak_by_steps(s, concrete())) + '}';
  }
  const Calibration c = calibrate(parse_specification(
      R"({"parameters": {"young_modulus": 45e9, "poisson_ratio": 0.24, "density": 2400,
          "tensile_strength": {"start": 4e6, "lower": 1e6, "upper": 20e6}, "cohesion": 5e6, "friction_angle_deg": 37,
          "dilation_angle_deg": 5, "delta0": {"start": 10e-6, "lower": 1e-6, "upper": 200e-6},
          "normal_stiffness": 1e14, "shear_stiffness": 1e14},
          "options": {"starts": 2, "profiles": []},
          "data": [{"name": "series", "kind": "peak_load", "deviation": {"relative": 0.02}, "points": [)" +
          points + "]}]}",
      "series.json"));
  EXPECT_TRUE(c.result.usable()) << c.result.message;
  EXPECT_NEAR(c.parameters.tensile_strength, concrete().tensile_strength, 0.01 * concrete().tensile_strength);
  EXPECT_NEAR(c.parameters.delta0, concrete().delta0, 0.02 * concrete().delta0);
  EXPECT_EQ(c.specification.data[0].labels[3], "specimen 4");
}

}  // namespace
}  // namespace fpz::calibration
