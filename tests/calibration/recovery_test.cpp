// From synthetic files back to the parameters that made them, through the program's own reading and fitting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "fit_models.hpp"
#include "fpz/calibration/calibration.hpp"
#include "fpz/io/problems.hpp"
#include "specimens.hpp"
#include "support/temporary_folder.hpp"

namespace fpz::calibration {
namespace {

using io::exact;

Parameters truth() { return test::mode_one_rock(); }

/// The true parameters; those in `fit` start 15 % off, up and down in turn.
std::string material(const std::vector<std::string>& fit) {
  const Parameters p = truth();
  std::string text = "\"parameters\": {\"density\": 2400";
  int k = 0;
  for (const ParameterInfo<double>& which : parameter_info) {
    const std::string name(which.name);
    const bool fitted = std::find(fit.begin(), fit.end(), name) != fit.end();
    const double x = p.*which.member;
    const double start = x * (k % 2 == 0 ? 1.15 : 0.85);
    if (fitted) ++k;
    text +=
        ", \"" + name + "\": " +
        (fitted ? "{\"start\": " + exact(start) + ", \"lower\": " + exact(x / 4) + ", \"upper\": " + exact(x * 2) + '}'
                : exact(x));
  }
  return text + '}';
}

std::string specification(const std::vector<std::string>& fit, const std::string& sets, int starts = 1) {
  return '{' + material(fit) + R"(, "options": {"profiles": [], "starts": )" + std::to_string(starts) +
         "}, \"data\": [" + sets + "]}";
}

class Recovery : public ::testing::Test {
 protected:
  Specification read(const std::string& text) const { return parse_specification(text, folder_.path() / "spec.json"); }

  std::string csv(const std::vector<std::string>& names, const std::vector<Eigen::VectorXd>& columns) const {
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k) text.append(k > 0 ? "," : "").append(names[k]);
    for (Eigen::Index i = 0; i < columns[0].size(); ++i) {
      text += '\n';
      for (std::size_t k = 0; k < columns.size(); ++k) text.append(k > 0 ? "," : "").append(exact(columns[k][i]));
    }
    folder_.write("data.csv", text + '\n');
    return "data.csv";
  }

  /// What the model of a data set gives for the true parameters; the set may hold any measured values.
  Eigen::VectorXd true_values(const std::string& set, const std::vector<std::string>& fit) const {
    const Specification s = read(specification(fit, set));
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(s.data[0].nuisances.size()));
    const Prediction x =
        std::visit([&](const auto& test) { return predict(test, truth(), none, false); }, s.data[0].test);
    EXPECT_TRUE(x.ok()) << x.failure;
    return x.values;
  }

  /// Fits and compares every fitted parameter.
  void expect_recovered(const std::string& set, const std::vector<std::string>& fit) const {
    const Calibration result = calibrate(read(specification(fit, set)));
    EXPECT_TRUE(result.result.usable()) << result.result.message;
    for (const ParameterInfo<double>& p : parameter_info) {
      EXPECT_NEAR(result.parameters.*p.member, truth().*p.member, 1e-6 * truth().*p.member) << p.name;
    }
  }

  /// A curve: file columns `names`, the last of them measured; `abscissae` are the others.
  void recover_curve(const std::string& kind, const std::string& keys, const std::vector<std::string>& names,
                     std::vector<Eigen::VectorXd> columns, double plausible,
                     const std::vector<std::string>& fit) const {
    std::string mapping;
    for (const std::string& name : names) {
      mapping.append(mapping.empty() ? "\"" : ", \"").append(name).append("\": \"").append(name).append("\"");
    }
    const std::string set = R"({"name": "d", "kind": ")" + kind + "\", " + keys +
                            R"("file": "data.csv", "columns": {)" + mapping +
                            R"(}, "deviation": {"relative_to_peak": 0.01}})";
    columns.push_back(Eigen::VectorXd::Constant(columns[0].size(), plausible));
    csv(names, columns);
    columns.back() = true_values(set, fit);
    csv(names, columns);
    expect_recovered(set, fit);
  }

  fpz::test::TemporaryFolder folder_;
};

Eigen::VectorXd line(Eigen::Index n, double from, double to) { return Eigen::VectorXd::LinSpaced(n, from, to); }

TEST_F(Recovery, FractureEnergy) {
  const auto set = [](double energy) {
    return R"({"name": "G", "kind": "fracture_energy", "mode": "I", "end_opening": {"value": 60, "unit": "um"},
               "deviation": {"relative": 0.02}, "energy": )" +
           exact(energy) + '}';
  };
  expect_recovered(set(true_values(set(50.0), {"delta0"})[0]), {"delta0"});
}

TEST_F(Recovery, Toughness) {
  const auto set = [](double k) {
    return R"({"name": "K", "kind": "fracture_energy", "mode": "I", "deviation": {"relative": 0.02}, "toughness": )" +
           exact(k) + '}';
  };
  const double k = true_values(set(1e6), {"delta0"})[0];
  const Parameters p = truth();
  EXPECT_NEAR(k, std::sqrt(p.tensile_strength * p.delta0 * p.young_modulus / (1 - p.poisson_ratio * p.poisson_ratio)),
              1e-9 * k);
  expect_recovered(set(k), {"delta0"});
}

const std::vector<std::string> strength_kinds = {R"("uniaxial_tension")",
                                                 R"("uniaxial_compression")",
                                                 R"("direct_shear", "pressure": 5e6)",
                                                 R"("triaxial_axial", "pressure": 10e6)",
                                                 R"("triaxial_deviator", "pressure": 20e6)",
                                                 R"("brazilian_stress")",
                                                 R"("brazilian_load", "diameter": 0.05, "thickness": 0.025)"};

std::string strength_set(const Eigen::VectorXd& values) {
  std::string points;
  for (std::size_t k = 0; k < strength_kinds.size(); ++k) {
    points.append(k > 0 ? ", " : "").append("{\"test\": ").append(strength_kinds[k]).append(", \"strength\": ");
    points.append(exact(values[static_cast<Eigen::Index>(k)])).append("}");
  }
  return R"({"name": "s", "kind": "strength", "deviation": {"relative": 0.02}, "points": [)" + points + "]}";
}

const std::vector<std::string> strengths = {"tensile_strength", "cohesion", "friction_angle_deg"};

Eigen::VectorXd plausible_strengths() {
  Eigen::VectorXd values(7);
  values << 3e6, 4e7, 1e7, 6e7, 6e7, 3e6, 6e3;
  return values;
}

TEST_F(Recovery, Strength) {
  expect_recovered(strength_set(true_values(strength_set(plausible_strengths()), strengths)), strengths);
}

TEST_F(Recovery, OpeningCurve) {
  recover_curve("traction_separation", R"("measured": "normal_traction", )", {"opening", "normal_traction"},
                {line(15, 2e-6, 80e-6)}, 1e6, {"tensile_strength", "delta0"});
}

TEST_F(Recovery, DirectShearCurve) {
  recover_curve("traction_separation", R"("measured": "shear_traction", "constant_normal_traction": -2e6, )",
                {"slip", "shear_traction"}, {line(15, 2e-6, 120e-6)}, 1e6, {"cohesion", "delta0"});
}

TEST_F(Recovery, StressStrainCurve) {
  folder_.write("path.json", R"({"material": ")" FPZ_DATA_DIR R"(/materials/marble.json", "rve_length": 0.005,
    "setting": "plane_strain", "integrator": {"name": "accurate", "tolerance": 1e-6},
    "stages": [{"increments": 40, "strain": {"xx": 0.004}}]})");
  recover_curve("stress_strain", R"("path": "path.json", "measured": "sig_xx", )", {"eps_xx", "sig_xx"},
                {line(25, 0.2e-4, 39e-4)}, 1e6, {"young_modulus", "tensile_strength", "delta0"});
}

TEST_F(Recovery, NotchedBeam) {
  recover_curve("notched_beam",
                R"("geometry": {"unit": "mm", "depth": 50, "thickness": 50, "span": 125, "notch": 25}, )",
                {"cmod", "load"}, {line(25, 2e-6, 120e-6)}, 1000.0, {"young_modulus", "tensile_strength", "delta0"});
}

TEST_F(Recovery, NotchedBeamUnderTwoLoads) {
  recover_curve(
      "notched_beam",
      R"("geometry": {"unit": "mm", "depth": 50, "thickness": 50, "span": 150, "load_span": 50, "notch": 20}, )",
      {"cmod", "load"}, {line(25, 2e-6, 120e-6)}, 1000.0, {"young_modulus", "tensile_strength", "delta0"});
}

TEST_F(Recovery, UnnotchedBeam) {
  recover_curve(
      "notched_beam",
      R"("geometry": {"unit": "mm", "depth": 20, "thickness": 20, "span": 60, "load_span": 20, "notch": 0}, )",
      {"deflection_mid_depth", "load"}, {line(30, 2e-6, 60e-6)}, 1000.0,
      {"young_modulus", "tensile_strength", "delta0"});
}

TEST_F(Recovery, SemicircularBend) {
  recover_curve("semicircular_bend",
                R"("geometry": {"unit": "mm", "radius": 50, "thickness": 25, "span": 80, "notch": 20}, )",
                {"cmod", "load"}, {line(20, 2e-6, 100e-6)}, 1000.0, {"tensile_strength", "delta0"});
}

TEST_F(Recovery, ModulusFromTheInitialSlope) {
  const std::string set =
      R"({"name": "d", "kind": "notched_beam", "file": "data.csv", "columns": {"cmod": "cmod", "load": "load"},
          "deviation": {"relative_to_peak": 0.01}, "initial_slope": {"from": 0.05, "to": 0.3},
          "geometry": {"unit": "mm", "depth": 50, "thickness": 50, "span": 125, "notch": 25}})";
  csv({"cmod", "load"}, {line(120, 0.2e-6, 40e-6), Eigen::VectorXd::Constant(120, 1000.0)});
  const Eigen::VectorXd load = true_values(set, {"delta0"});
  csv({"cmod", "load"}, {line(120, 0.2e-6, 40e-6), load});
  std::string text = specification({"tensile_strength", "delta0"}, set);
  const std::string own = "\"young_modulus\": " + exact(truth().young_modulus);
  text.replace(text.find(own), own.size(), R"("young_modulus": {"from_initial_slope": "d"})");
  const Specification s = read(text);
  ASSERT_TRUE(s[Parameter::young_modulus].from_slope);
  // A process zone forms from the first load on, so the slope is a few per cent low.
  EXPECT_NEAR(s[Parameter::young_modulus].value, truth().young_modulus, 0.06 * truth().young_modulus);
  EXPECT_LT(s[Parameter::young_modulus].value, truth().young_modulus);
}

/// Jacobians of the assembled problem against differences: columns in their places, nuisances included.
TEST_F(Recovery, JacobianOfTheAssembledProblem) {
  csv({"cmod", "load"}, {line(6, 4e-6, 80e-6), Eigen::VectorXd::Constant(6, 1000.0)});
  const std::string beam =
      R"({"name": "b", "kind": "notched_beam", "file": "data.csv", "columns": {"cmod": "cmod", "load": "load"},
          "geometry": {"unit": "mm", "depth": 50, "thickness": 50, "span": 125, "notch": 25},
          "nuisance": {"cmod_offset": {"start": 0.5, "unit": "um", "lower": -2, "upper": 2}}})";
  const std::string toughness =
      R"({"name": "K", "kind": "fracture_energy", "mode": "I", "deviation": {"relative": 0.02}, "toughness": 1.5e6})";
  const FitProblem problem = make_problem(
      read(specification({"young_modulus", "poisson_ratio", "tensile_strength", "delta0"}, toughness + ", " + beam)));
  ASSERT_EQ(problem.parameters.size(), 5u);
  EXPECT_EQ(problem.parameters[4].name, "b.cmod_offset");
  EXPECT_DOUBLE_EQ(problem.parameters[4].start, 0.5e-6);
  Eigen::VectorXd x(5);
  for (Eigen::Index k = 0; k < 5; ++k) x[k] = problem.parameters[static_cast<std::size_t>(k)].start;
  for (const Observations& o : problem.data) {
    const Prediction at = o.forward(x, true);
    ASSERT_TRUE(at.ok()) << at.failure;
    ASSERT_EQ(at.jacobian.cols(), 5);
    for (Eigen::Index k = 0; k < 5; ++k) {
      const double step = 1e-4 * x[k];
      Eigen::VectorXd up = x, down = x;
      up[k] += step;
      down[k] -= step;
      const Eigen::VectorXd slope = (o.forward(up, false).values - o.forward(down, false).values) / (2.0 * step);
      EXPECT_LT((at.jacobian.col(k) - slope).norm() * x[k], 1e-5 * at.values.norm()) << o.name << " by " << k;
    }
  }
}

/// The share of 200 series of 2 % noise for which the joint 95 % region of the fitted parameters holds the truth. Over
/// 1000 series it is 0.937 with known and 0.925 with estimated noise (regions are those of the linearised model); a
/// share below 0.88 would then come in one of a hundred choices of the seeds.
constexpr double least_coverage = 0.88;
double covered(const Specification& exact_spec, bool known) {
  const FitProblem clean = make_problem(exact_spec);
  Eigen::VectorXd x(static_cast<Eigen::Index>(clean.parameters.size()));
  for (std::size_t k = 0; k < clean.parameters.size(); ++k) {
    for (const ParameterInfo<double>& p : parameter_info) {
      if (p.name == clean.parameters[k].name) x[static_cast<Eigen::Index>(k)] = truth().*p.member;
    }
  }
  int inside = 0;
  FitOptions options;
  options.starts = 1;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    testing::Normal normal(seed);
    FitProblem problem = clean;
    for (Observations& o : problem.data) {
      o.measured = o.forward(x, false).values;
      o.deviation_known = known;
      for (Eigen::Index k = 0; k < o.measured.size(); ++k) {
        o.deviation[k] = 0.02 * std::abs(o.measured[k]);
        o.measured[k] += o.deviation[k] * normal();
      }
    }
    const FitResult r = fit(problem, options);
    inside += r.usable() && inside_confidence_region(r, x, 0.95) ? 1 : 0;
  }
  return inside / 200.0;
}

const std::string opening_set =
    R"({"name": "c", "kind": "traction_separation", "measured": "normal_traction", "file": "data.csv",
        "columns": {"opening": "opening", "normal_traction": "normal_traction"}})";

TEST_F(Recovery, CoverageOfTwoSetsWithKnownNoise) {
  csv({"opening", "normal_traction"}, {line(12, 2e-6, 60e-6), Eigen::VectorXd::Constant(12, 1e6)});
  std::vector<std::string> fitted = strengths;
  fitted.emplace_back("delta0");
  const std::string sets = strength_set(plausible_strengths()) + ", " + opening_set;
  EXPECT_GE(covered(read(specification(fitted, sets)), true), least_coverage);
}

/// The strengths leave about four degrees of freedom for their noise, which the region has to know of.
TEST_F(Recovery, CoverageOfTwoSetsWithEstimatedNoise) {
  csv({"opening", "normal_traction"}, {line(12, 2e-6, 60e-6), Eigen::VectorXd::Constant(12, 1e6)});
  std::vector<std::string> fitted = strengths;
  fitted.emplace_back("delta0");
  const std::string sets = strength_set(plausible_strengths()) + ", " + opening_set;
  EXPECT_GE(covered(read(specification(fitted, sets)), false), least_coverage);
}

TEST_F(Recovery, CoverageOfOneSetWithEstimatedNoise) {
  csv({"opening", "normal_traction"}, {line(12, 2e-6, 60e-6), Eigen::VectorXd::Constant(12, 1e6)});
  EXPECT_GE(covered(read(specification({"tensile_strength", "delta0"}, opening_set)), false), least_coverage);
}

}  // namespace
}  // namespace fpz::calibration
