// Is a good fit called good, and a bad one bad?
#include <gtest/gtest.h>

#include <cmath>

#include "verdict_study.hpp"

namespace fpz::calibration {
namespace {

/// A curve of 20 smooth points, two of them on the rise. The fit must be usable and near 49.5 GPa, 2.38 MPa and 17.5
/// um, where eight starts of a solver that stopped at kinks of the prediction had ended.
TEST(Verdict, SmoothCurveOfTwentyPointsIsUsable) {
  const Calibration c = calibrate(read_specification(FPZ_DATA_DIR "/calibration/smooth_twenty_points.json"));
  EXPECT_TRUE(c.result.usable()) << c.result.message;
  EXPECT_NEAR(c.parameters.young_modulus, 49.49e9, 0.2 * c.result.standard_error[0]);
  EXPECT_NEAR(c.parameters.tensile_strength, 2.381e6, 0.2 * c.result.standard_error[1]);
  EXPECT_NEAR(c.parameters.delta0, 17.55e-6, 0.2 * c.result.standard_error[2]);
}

/// The full study is a program of its own, fpz-verdict-study; its result is docs/verdict-study.csv. These are some of
/// its beams: every noise, both laws, among them those whose fits end at kinks of the bilinear law.
TEST(Verdict, RightFitsAreAcceptedWhateverTheirNoise) {
  for (const std::uint64_t number : {1U, 5U, 15U, 23U}) {
    const test::StudyOutcome o = test::study_fit(test::study_beam(number), 1.4, 2);
    EXPECT_TRUE(o.right) << number << ": " << o.deviation << " standard errors";
    EXPECT_EQ(o.status, FitStatus::ok) << number << ": " << o.message;
  }
}

/// A model whose derivatives are wrong, and one that has no minimum within its range, are not accepted.
Observations line_data(const Forward& forward) {
  Observations o;
  o.name = "line";
  o.measured = Eigen::VectorXd::LinSpaced(10, 1.0, 10.0);
  o.deviation = Eigen::VectorXd::Constant(10, 0.1);
  o.deviation_known = true;
  o.forward = forward;
  return o;
}

FitProblem one_parameter(const Forward& forward) {
  FitProblem problem;
  FitParameter p;
  p.name = "slope";
  p.start = 0.5;
  p.lower = 0.1;
  p.upper = 3.0;
  problem.parameters = {p};
  problem.data = {line_data(forward)};
  return problem;
}

Prediction line_at(double slope, double derivative) {
  Prediction out;
  out.values = slope * Eigen::VectorXd::LinSpaced(10, 1.0, 10.0);
  out.jacobian = derivative * Eigen::VectorXd::LinSpaced(10, 1.0, 10.0);
  return out;
}

TEST(Verdict, WrongDerivativesAreNotAccepted) {
  const FitResult r = fit(one_parameter([](const Eigen::VectorXd& x, bool) { return line_at(x[0], -1.0); }));
  EXPECT_EQ(r.status, FitStatus::not_converged) << r.message;
}

TEST(Verdict, EdgeOfTheModelIsNotAccepted) {
  const FitResult r = fit(one_parameter([](const Eigen::VectorXd& x, bool) {
    if (x[0] > 0.8) return failed("no solution beyond 0.8");
    return line_at(x[0], 1.0);
  }));
  EXPECT_EQ(r.status, FitStatus::not_converged) << r.message;
  EXPECT_NE(r.message.find("no solution beyond 0.8"), std::string::npos) << r.message;
}

/// Two data that pull in opposite directions with a kink at the minimum: |slope - 1| in effect. Derivatives from either
/// side promise a gain; there is none.
TEST(Verdict, MinimumAtAKinkIsAccepted) {
  const auto kinked = [](const Eigen::VectorXd& x, bool) {
    Prediction out;
    const double d = x[0] - 1.0;
    out.values = Eigen::Vector2d(2.0 + std::abs(d), 1.0 + 0.1 * d);
    out.jacobian = Eigen::Vector2d(d < 0.0 ? -1.0 : 1.0, 0.1);
    return out;
  };
  FitProblem problem = one_parameter(kinked);
  problem.data[0].measured = Eigen::Vector2d(1.0, 1.0);
  problem.data[0].deviation = Eigen::Vector2d(0.1, 0.1);
  const FitResult r = fit(problem);
  EXPECT_EQ(r.status, FitStatus::ok) << r.message;
  EXPECT_NEAR(r.values[0], 1.0, 0.1 * r.standard_error[0]);
}

}  // namespace
}  // namespace fpz::calibration
