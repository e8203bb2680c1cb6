// A toe at the beginning of a load-deflection curve: found, said, and fitted.
#include "fpz/calibration/rise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fpz/calibration/calibration.hpp"
#include "fpz/calibration/mid_line.hpp"
#include "specimens.hpp"

namespace fpz::calibration {
namespace {

constexpr double peak_reading = 1e-4;

/// A rise that the process zone flattens, up to a peak of 1 kN.
Eigen::VectorXd flattened(const Eigen::VectorXd& reading) {
  const Eigen::ArrayXd x = reading.array() / peak_reading;
  return 1000.0 * x * (2.0 - x);
}

Eigen::VectorXd line(Eigen::Index points) { return Eigen::VectorXd::LinSpaced(points, 0.0, peak_reading); }

TEST(RiseIntercept, ExactLineThroughAnOffset) {
  const Eigen::VectorXd reading = line(31);
  const Eigen::VectorXd load = 1e7 * (reading.array() - 1.5e-5).max(0.0);
  const auto found = rise_intercept(reading, load);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->reading, 1.5e-5, 1e-12);
  EXPECT_TRUE(found->beyond_zero);
}

TEST(RiseIntercept, ProcessZoneIsNoToe) {
  const auto found = rise_intercept(line(60), flattened(line(60)));
  ASSERT_TRUE(found);
  EXPECT_LT(found->reading, 0.0);
  EXPECT_FALSE(found->beyond_zero);
}

TEST(RiseIntercept, TooFewPointsSayNothing) { EXPECT_FALSE(rise_intercept(line(5), flattened(line(5)))); }

/// Noise of 2 % alone is not called a toe, however often one looks; a toe of 15 % of the reading is, mostly.
TEST(RiseIntercept, NoiseIsNoToeAndAToeIsFound) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> noise(0.0, 20.0);
  int false_alarms = 0;
  int found = 0;
  constexpr int trials = 300;
  for (int k = 0; k < trials; ++k) {
    const Eigen::VectorXd reading = line(60);
    Eigen::VectorXd load = 1e7 * reading;  // no process zone: nothing helps against false alarms
    for (double& p : load) p += noise(generator);
    false_alarms += rise_intercept(reading, load)->beyond_zero;
    found += rise_intercept(reading.array() + 0.15 * peak_reading, load)->beyond_zero;
  }
  EXPECT_LE(false_alarms, 1);
  EXPECT_GE(found, trials * 9 / 10);
}

// --- A load-deflection curve with a toe ------------------------------------------------------------------------------

constexpr double toe = 15e-6;
constexpr double toe_load = 250.0;
constexpr double machine = 4e-9;

NotchedSpecimen specimen() {
  NotchedSpecimen s = test::beam();
  s.notch = 0.02;
  return s;
}

Parameters rock() {
  Parameters p = test::mode_one_rock();
  p.delta0 = 25e-6;
  p.shear_stiffness = 1e14;
  return p;
}

/// Loads under growing CMOD on a finer mesh; the machine records the deflection at mid-depth, what its frame gives way,
/// and what the rollers have settled by since the load first rose.
struct Recorded {
  Eigen::VectorXd deflection, load;
};

Recorded record(double settled, double compliance) {
  NotchedSpecimen fine = specimen();
  fine.mesh.ligament_fraction *= 0.5;
  const Condensation body = condense(fine, rock().poisson_ratio);
  MidLine path(body, rock(), {}, false);
  constexpr Eigen::Index points = 60;
  Recorded out{Eigen::VectorXd(points), Eigen::VectorXd(points)};
  std::mt19937_64 generator(7);
  std::normal_distribution<double> noise(0.0, 4.0);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < points; ++k) {
    EXPECT_EQ(path.advance(1e-4 * std::pow(static_cast<double>(k + 1) / points, 2.0)), "");
    largest = std::max(largest, path.load());
    out.deflection[k] = path.gauge(Gauge::deflection_mid_depth) + compliance * path.load() +
                        settled * (1.0 - std::exp(-largest / toe_load));
    out.load[k] = path.load() + noise(generator);
  }
  return out;
}

std::string list(const Eigen::VectorXd& v) {
  std::string out;
  for (const double x : v) out += (out.empty() ? "" : ", ") + std::to_string(x);
  return out;
}

Specification specification(const Recorded& r, const std::string& nuisance) {
  return parse_specification(R"({"parameters": {"young_modulus": {"start": 25e9, "lower": 5e9, "upper": 100e9},
      "poisson_ratio": 0.2, "density": 2400, "tensile_strength": {"start": 3e6, "lower": 1e6, "upper": 20e6},
      "cohesion": 12e6, "friction_angle_deg": 34, "dilation_angle_deg": 6,
      "delta0": {"start": 20e-6, "lower": 2e-6, "upper": 200e-6},
      "normal_stiffness": 1e14, "shear_stiffness": 1e14},
      "options": {"starts": 2, "profiles": []},
      "data": [{"name": "beam", "kind": "notched_beam",
                "geometry": {"unit": "mm", "depth": 80, "span": 240, "notch": 20, "thickness": 40, "length": 320},
                "values": {"deflection_mid_depth": {"unit": "um", "list": [)" +
                                 list(1e6 * r.deflection) + R"(]}, "load": {"unit": "N", "list": [)" + list(r.load) +
                                 "]}}" + nuisance + "}]}",
                             "beam.json");
}

bool warns_of_toe(const Specification& s) {
  return std::any_of(s.warnings.begin(), s.warnings.end(),
                     [](const std::string& w) { return w.find("meets zero load at") != std::string::npos; });
}

TEST(Toe, IsSaidWhereItIsNotFitted) {
  const Specification with = specification(record(toe, 0.0), "");
  EXPECT_TRUE(warns_of_toe(with));
  EXPECT_FALSE(warns_of_toe(specification(record(0.0, 0.0), "")));
  // What the warning is about.
  EXPECT_LT(calibrate(with).parameters.young_modulus, 24e9);
}

/// Three points on the rise cannot show a toe: that is said in place of nothing.
TEST(Toe, TooFewPointsToSeeOneAreSaid) {
  Recorded r = record(toe, 0.0);
  Eigen::Index top = 0;
  const double peak = r.load.maxCoeff(&top);
  std::vector<Eigen::Index> kept;
  int rising = 0;
  for (Eigen::Index k = 0; k < r.load.size(); ++k) {
    const bool on_rise = k < top && r.load[k] > 0.1 * peak && r.load[k] < 0.7 * peak;
    if (!on_rise || ++rising <= 3) kept.push_back(k);
  }
  ASSERT_GT(rising, 3);
  r = {Eigen::VectorXd(r.deflection(kept)), Eigen::VectorXd(r.load(kept))};
  const Specification s = specification(r, "");
  EXPECT_TRUE(std::any_of(s.warnings.begin(), s.warnings.end(), [](const std::string& w) {
    return w.find("too few points on the rise") != std::string::npos;
  }));
}

TEST(Toe, IsFittedWithTheMaterial) {
  const std::string nuisance = R"(, "nuisance": {"toe": {"unit": "um"}, "toe_load": {"unit": "N"},
                                  "machine_compliance": {"value": 4e-9}})";
  const Specification s = specification(record(toe, machine), nuisance);
  EXPECT_FALSE(warns_of_toe(s));
  const Calibration c = calibrate(s);
  EXPECT_TRUE(c.result.usable()) << c.result.message;
  const Eigen::VectorXd& x = c.result.values;
  const Eigen::VectorXd truth = (Eigen::VectorXd(5) << 30e9, 3.5e6, 25e-6, toe, toe_load).finished();
  ASSERT_EQ(x.size(), truth.size());
  for (Eigen::Index k = 0; k < truth.size(); ++k) {
    const double error = std::max(c.result.standard_error[k], c.result.correlated_error[k]);
    EXPECT_NEAR(x[k], truth[k], 3.5 * error + 0.002 * truth[k])
        << c.problem.parameters[static_cast<std::size_t>(k)].name;
    EXPECT_LT(error, 0.1 * truth[k]) << c.problem.parameters[static_cast<std::size_t>(k)].name;
  }
}

TEST(Toe, SlipsInItsStatementAreNamed) {
  const Recorded r = record(toe, 0.0);
  const auto message = [&](const std::string& nuisance) -> std::string {
    try {
      (void)specification(r, ", \"nuisance\": " + nuisance);
    } catch (const io::InputError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(message(R"({"toe": {"unit": "um"}})").find("\"toe\" and \"toe_load\" go together"), std::string::npos);
  EXPECT_NE(message(R"({"machine_compliance": {"value": 1e-9, "start": 1e-9}})").find("which holds it"),
            std::string::npos);
  EXPECT_NE(message(R"({"machine_compliance": {"value": -1e-9}})").find("must be >= 0"), std::string::npos);
}

}  // namespace
}  // namespace fpz::calibration
