// G_F from the area under computed curves, whose fracture energy is known.
#include "fpz/calibration/work_of_fracture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fpz/calibration/calibration.hpp"
#include "specimens.hpp"

namespace fpz::calibration {
namespace {

struct Curve {
  Eigen::VectorXd deflection, load;
};

/// The load-deflection curve of the beam until the load has fallen to a part of its peak.
Curve curve_down_to(const NotchedSpecimen& s, double part) {
  const FractureCurve c = fracture_curve(s, test::concrete(), part, 0.02);
  EXPECT_EQ(c.failure, "");
  const auto n = static_cast<Eigen::Index>(c.load.size());
  return {Eigen::Map<const Eigen::VectorXd>(c.deflection_load_point.data(), n),
          Eigen::Map<const Eigen::VectorXd>(c.load.data(), n)};
}

NotchedSpecimen rolled() {
  NotchedSpecimen s = test::beam();
  s.notch = 0.03;
  s.roller_width = 4e-3;
  return s;
}

double truth() { return test::concrete().tensile_strength * test::concrete().delta0; }

double area() { return rolled().thickness * rolled().ligament(); }

/// The area alone misses what is spent behind the end; with the tail G_F is right wherever the test was stopped.
TEST(WorkOfFracture, TailMakesUpForAnEarlyEnd) {
  for (const double part : {0.2, 0.1, 0.05}) {
    const Curve c = curve_down_to(rolled(), part);
    const WorkOfFracture w = work_of_fracture(c.deflection, c.load, area(), 0.0);
    ASSERT_EQ(w.failure, "");
    EXPECT_LT(w.measured / area(), 0.97 * truth()) << part;
    EXPECT_NEAR(w.energy, truth(), 0.03 * truth()) << part;
  }
}

/// What the machine records of a beam that sags under its own weight, which bends it as the load `dead` does: less by
/// that and counted from there. The beam breaks by itself when the machine's load is zero.
Curve under_weight(double dead) {
  const Curve whole = curve_down_to(rolled(), 0.02);
  EXPECT_GT(dead, whole.load[whole.load.size() - 1]);
  std::vector<double> deflection, load;
  double sag = -1.0;
  for (Eigen::Index k = 0; k < whole.load.size(); ++k) {
    if (sag < 0.0 && whole.load[k] >= dead) {
      const double part = (dead - whole.load[k - 1]) / (whole.load[k] - whole.load[k - 1]);
      sag = whole.deflection[k - 1] + part * (whole.deflection[k] - whole.deflection[k - 1]);
    }
    if (sag < 0.0) continue;
    if (whole.load[k] < dead && whole.deflection[k] > sag) break;
    deflection.push_back(whole.deflection[k] - sag);
    load.push_back(whole.load[k] - dead);
  }
  const auto n = static_cast<Eigen::Index>(load.size());
  return {Eigen::Map<const Eigen::VectorXd>(deflection.data(), n), Eigen::Map<const Eigen::VectorXd>(load.data(), n)};
}

TEST(WorkOfFracture, WeightBreaksTheBeamAtTheEnd) {
  const Curve c = under_weight(80.0);
  const WorkOfFracture with = work_of_fracture(c.deflection, c.load, area(), 160.0);
  const WorkOfFracture without = work_of_fracture(c.deflection, c.load, area(), 0.0);
  EXPECT_NEAR(with.energy, truth(), 0.03 * truth());
  EXPECT_LT(without.energy, 0.9 * truth());
}

std::string list(const Eigen::VectorXd& v, double factor) {
  std::string out;
  for (Eigen::Index k = 0; k < v.size(); k += 3) out += (k > 0 ? ", " : "") + std::to_string(factor * v[k]);
  return out;
}

/// 240 N on 320 mm, 40 mm of them overhanging at each end, bend a beam of 240 mm span as 80 N in its middle do.
TEST(SelfWeight, IsPartOfTheFit) {
  const Curve c = under_weight(80.0);
  const auto specification = [&](const std::string& more) {
    return parse_specification(
        R"({"material": {"young_modulus": 45e9, "poisson_ratio": 0.24, "density": 2400, "tensile_strength": 2.9e6,
            "cohesion": 5e6, "friction_angle_deg": 37, "dilation_angle_deg": 5, "delta0": 12e-6,
            "normal_stiffness": 1e14, "shear_stiffness": 1e14}, "fit": ["young_modulus", "tensile_strength", "delta0"],
            "options": {"starts": 1, "profiles": []},
            "data": [{"name": "beam", "kind": "notched_beam",
              "geometry": {"unit": "mm", "depth": 80, "span": 240, "notch": 30, "thickness": 40, "length": 320,
                           "roller_width": 4},
              "values": {"deflection": {"unit": "um", "list": [)" +
            list(c.deflection, 1e6) + R"(]}, "load": {"unit": "N", "list": [)" + list(c.load, 1.0) + "]}}" + more +
            "}]}",
        "beam.json");
  };
  const Calibration with = calibrate(specification(R"(, "self_weight": {"value": 240, "unit": "N"})"));
  ASSERT_TRUE(with.result.usable()) << with.result.message;
  const Parameters made = test::concrete();
  EXPECT_NEAR(with.parameters.young_modulus, made.young_modulus, 0.01 * made.young_modulus);
  EXPECT_NEAR(with.parameters.tensile_strength, made.tensile_strength, 0.01 * made.tensile_strength);
  EXPECT_NEAR(with.parameters.delta0, made.delta0, 0.02 * made.delta0);
  const Calibration without = calibrate(specification(""));
  EXPECT_LT(without.parameters.tensile_strength * without.parameters.delta0, 0.9 * truth());
  EXPECT_THROW((void)specification(R"(, "self_weight": {"value": 2400, "unit": "N"})"), io::InputError);
}

TEST(SelfWeight, DerivativesAgainstDifferences) {
  for (const Gauge gauge : {Gauge::cmod, Gauge::deflection_load_point}) {
    NotchedData data;
    data.test.specimen = rolled();
    data.test.gauge = gauge;
    data.test.readings = Eigen::VectorXd::LinSpaced(5, 1e-5, 1e-4);
    data.dead_load = 80.0;
    data.fitted = {0};
    const Eigen::VectorXd nuisance = Eigen::VectorXd::Constant(1, gauge == Gauge::cmod ? 1e-6 : 2e-9);
    const Parameters p = test::concrete();
    const Prediction exact = predict(data, p, nuisance, true);
    ASSERT_TRUE(exact.ok()) << exact.failure;
    const auto expect = [&](int column, const Eigen::VectorXd& slope) {
      EXPECT_LE((exact.jacobian.col(column) - slope).cwiseAbs().maxCoeff(), 1e-4 * slope.cwiseAbs().maxCoeff());
    };
    for (const Parameter which : {Parameter::young_modulus, Parameter::poisson_ratio, Parameter::tensile_strength}) {
      const auto member = parameter_info[static_cast<std::size_t>(which)].member;
      const double step = 1e-4 * p.*member;
      Parameters up = p, down = p;
      up.*member += step;
      down.*member -= step;
      expect(static_cast<int>(which),
             (predict(data, up, nuisance, false).values - predict(data, down, nuisance, false).values) / (2.0 * step));
    }
    const Eigen::VectorXd step = 1e-3 * nuisance;
    expect(parameter_count,
           (predict(data, p, nuisance + step, false).values - predict(data, p, nuisance - step, false).values) /
               (2.0 * step[0]));
  }
}

TEST(WorkOfFracture, StandsInTheReportBesideTheFit) {
  const NotchedSpecimen s = rolled();
  const Curve c = curve_down_to(s, 0.1);
  const auto specification = [&](const std::string& gauge) {
    return parse_specification(
        R"({"material": {"young_modulus": 45e9, "poisson_ratio": 0.24, "density": 2400, "tensile_strength": 2.9e6,
            "cohesion": 5e6, "friction_angle_deg": 37, "dilation_angle_deg": 5, "delta0": 12e-6,
            "normal_stiffness": 1e14, "shear_stiffness": 1e14}, "fit": ["delta0"],
            "options": {"starts": 1, "profiles": []},
            "data": [{"name": "beam", "kind": "notched_beam", "work_of_fracture": {"weight": 0},
              "geometry": {"unit": "mm", "depth": 80, "span": 240, "notch": 30, "thickness": 40, "length": 320,
                           "roller_width": 4},
              "values": {")" +
            gauge + R"(": {"unit": "um", "list": [)" + list(c.deflection, 1e6) +
            R"(]}, "load": {"unit": "N", "list": [)" + list(c.load, 1.0) + "]}}}]}",
        "beam.json");
  };
  const Calibration all = calibrate(specification("deflection"));
  const auto derived = std::find_if(all.derived.begin(), all.derived.end(), [](const Derived& d) {
    return d.name.find("work of fracture") != std::string::npos;
  });
  ASSERT_NE(derived, all.derived.end());
  EXPECT_NEAR(derived->value, truth(), 0.03 * truth());
  EXPECT_NEAR(all.parameters.tensile_strength * all.parameters.delta0, truth(), 0.01 * truth());
  EXPECT_THROW((void)specification("cmod"), io::InputError);
}

TEST(WorkOfFracture, CurvesThatDoNotHoldTheWorkAreRefused) {
  const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(5, 0.0, 4.0);
  const auto failure = [&](std::vector<double> p) {
    return work_of_fracture(d, Eigen::Map<Eigen::VectorXd>(p.data(), 5), 1.0, 0.0).failure;
  };
  EXPECT_NE(failure({0, 1, 2, 2, 1.5}).find("ends above half"), std::string::npos);
  EXPECT_NE(failure({1, 1, 2, 1, 0}).find("begins above a fifth"), std::string::npos);
  EXPECT_EQ(failure({0, 1, 2, 1, 0}), "");
}

}  // namespace
}  // namespace fpz::calibration
