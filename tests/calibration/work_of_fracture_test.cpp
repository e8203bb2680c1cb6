// G_F from the area under computed curves, whose fracture energy is known.
#include "fpz/calibration/work_of_fracture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// A beam that sags under its own weight: the machine's load is less by half the weight and counts from there, and the
/// beam breaks by itself when the machine's load is zero.
TEST(WorkOfFracture, WeightBreaksTheBeamAtTheEnd) {
  const double weight = 160.0;
  const Curve whole = curve_down_to(rolled(), 0.02);
  const double half = 0.5 * weight;
  ASSERT_GT(half, whole.load[whole.load.size() - 1]);
  std::vector<double> deflection, load;
  double sag = -1.0;
  for (Eigen::Index k = 0; k < whole.load.size(); ++k) {
    if (sag < 0.0 && whole.load[k] >= half) sag = whole.deflection[k];
    if (sag < 0.0) continue;
    if (whole.load[k] < half && whole.deflection[k] > sag) break;
    deflection.push_back(whole.deflection[k] - sag);
    load.push_back(whole.load[k] - half);
  }
  const auto n = static_cast<Eigen::Index>(load.size());
  const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(deflection.data(), n);
  const Eigen::VectorXd p = Eigen::Map<const Eigen::VectorXd>(load.data(), n);
  const WorkOfFracture with = work_of_fracture(d, p, area(), weight);
  const WorkOfFracture without = work_of_fracture(d, p, area(), 0.0);
  EXPECT_NEAR(with.energy, truth(), 0.03 * truth());
  EXPECT_LT(without.energy, 0.9 * truth());
}

TEST(WorkOfFracture, StandsInTheReportBesideTheFit) {
  const NotchedSpecimen s = rolled();
  const Curve c = curve_down_to(s, 0.1);
  const auto list = [](const Eigen::VectorXd& v, double factor) {
    std::string out;
    for (Eigen::Index k = 0; k < v.size(); k += 3) out += (k > 0 ? ", " : "") + std::to_string(factor * v[k]);
    return out;
  };
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
