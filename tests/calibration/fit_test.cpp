// The fit itself: recovery, coverage, robust losses, bounds, undetermined directions, several minima, failing models.
#include "fpz/calibration/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "fit_models.hpp"

namespace fpz::calibration {
namespace {

using namespace testing;

bool mentions(const std::vector<std::string>& texts, const std::string& what) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const std::string& t) { return t.find(what) != std::string::npos; });
}

double worst_relative(const Eigen::VectorXd& values, const Eigen::VectorXd& truth) {
  return (values - truth).cwiseQuotient(truth).cwiseAbs().maxCoeff();
}

/// The decay curve with relative noise of its first value.
FitProblem noisy_decay(double noise, Eigen::Index points, std::uint64_t seed, bool known) {
  const Forward model = decay(openings(points));
  const double deviation = std::max(noise, 1e-3) * decay_truth()[0];
  Normal normal(seed);
  const Eigen::VectorXd measured =
      model(decay_truth(), false).values + noise * decay_truth()[0] * normal.vector(points);
  FitProblem problem;
  problem.parameters = decay_parameters();
  problem.data = {observations("curve", measured, deviation, model, known)};
  return problem;
}

TEST(Recovery, NoiseFreeDataGiveTheParametersBack) {
  for (const bool known : {true, false}) {
    const FitResult r = fit(noisy_decay(0.0, 40, 1, known));
    ASSERT_TRUE(r.usable()) << r.message;
    EXPECT_LT(worst_relative(r.values, decay_truth()), 1e-9) << known;
    EXPECT_EQ(r.distinct_minima, 1);
    EXPECT_TRUE(r.standard_error.allFinite());
    EXPECT_FALSE(mentions(r.warnings, "systematic"));
  }
}

TEST(Recovery, NoiseFreeInLinearVariablesAndFromBadUnits) {
  FitProblem problem = noisy_decay(0.0, 40, 1, false);
  problem.parameters[0].lower = -1e8;  // no logarithm
  problem.data[0].deviation *= 1e-12;  // only ratios count
  const FitResult r = fit(problem);
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_LT(worst_relative(r.values, decay_truth()), 1e-9);
}

TEST(Recovery, OneValueAndOneParameter) {
  FitProblem problem;
  problem.parameters = {parameter("delta0", 1e-5, 1e-6, 1e-3)};
  problem.data = {observations("fracture_energy", Eigen::VectorXd::Constant(1, 70.0), 3.5,
                               linear(Eigen::MatrixXd::Constant(1, 1, 5e6)))};
  const FitResult r = fit(problem);
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_NEAR(r.values[0], 1.4e-5, 1e-14);
  EXPECT_NEAR(r.standard_error[0], 3.5 / 5e6, 1e-12);
}

/// 100 repetitions with 2 % noise: the stated confidence must be the true one. With 95 % the number of hits is at most
/// 89 in 1 of 90 cases, at least 99 in 1 of 30.
TEST(Coverage, RegionAndIntervalsContainTheTruth) {
  for (const bool known : {true, false}) {
    int region = 0;
    int strength = 0;
    int length = 0;
    int profile = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      FitOptions options;
      options.starts = 1;
      options.profiles = {1};
      options.profile_points = 5;
      const FitResult r = fit(noisy_decay(0.02, 10, seed, known), options);
      ASSERT_TRUE(r.usable()) << r.message;
      const Eigen::VectorXd truth = decay_truth();
      region += inside_confidence_region(r, truth, 0.95) ? 1 : 0;
      strength += r.lower_limit[0] <= truth[0] && truth[0] <= r.upper_limit[0] ? 1 : 0;
      length += r.lower_limit[1] <= truth[1] && truth[1] <= r.upper_limit[1] ? 1 : 0;
      ASSERT_TRUE(r.profiles[0].lower && r.profiles[0].upper);
      profile += *r.profiles[0].lower <= truth[1] && truth[1] <= *r.profiles[0].upper ? 1 : 0;
    }
    for (const int hits : {region, strength, length, profile}) {
      EXPECT_GE(hits, 90) << known;
      EXPECT_LE(hits, 99) << known;
    }
  }
}

TEST(Coverage, HalfTheTruthsLieInTheFiftyPercentRegion) {
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    FitOptions options;
    options.starts = 1;
    inside += inside_confidence_region(fit(noisy_decay(0.02, 6, seed, false), options), decay_truth(), 0.5) ? 1 : 0;
  }
  EXPECT_NEAR(inside, 100, 21);  // 3 standard deviations
}

TEST(ProfileLikelihood, AgreesWithABruteForceScan) {
  FitProblem problem = noisy_decay(0.1, 12, 4, true);  // so noisy that the profile is far from a parabola
  FitOptions options;
  options.profiles = {1};
  const FitResult r = fit(problem, options);
  const Profile& p = r.profiles[0];
  ASSERT_TRUE(p.lower && p.upper);
  // For a given length the best strength is that of a linear problem.
  const Eigen::VectorXd x = openings(12);
  const Observations& data = problem.data[0];
  const auto excess = [&](double length) {
    const Eigen::VectorXd shape = (-x / length).array().exp();
    const double strength = shape.dot(data.measured) / shape.squaredNorm();
    return (strength * shape - data.measured).squaredNorm() / (data.deviation[0] * data.deviation[0]) - 2.0 * r.cost;
  };
  for (Eigen::Index k = 0; k < p.values.size(); ++k) {
    EXPECT_NEAR(p.excess[k], excess(p.values[k]), 1e-6 * (1.0 + p.excess[k]));
  }
  const double threshold = 1.959963985 * 1.959963985;
  EXPECT_NEAR(p.threshold, threshold, 1e-6);
  double lower = 0.0;
  double upper = 0.0;
  for (double length = 1e-6; length < 1e-3; length *= 1.00002) {
    if (excess(length) > threshold) continue;
    if (lower == 0.0) lower = length;
    upper = length;
  }
  EXPECT_NEAR(*p.lower, lower, 1e-4 * lower);
  EXPECT_NEAR(*p.upper, upper, 1e-4 * upper);
  EXPECT_GT(std::abs(*p.upper + *p.lower - 2.0 * r.values[1]), 0.05 * (*p.upper - *p.lower));  // not symmetric
}

TEST(ProfileLikelihood, OpenIntervalEndsAtTheBound) {
  FitProblem problem = noisy_decay(0.02, 10, 2, true);
  problem.parameters[1].upper = 2.85e-5;
  problem.parameters[1].start = 2.5e-5;
  FitOptions options;
  options.profiles = {1};
  const FitResult r = fit(problem, options);
  ASSERT_FALSE(r.profiles[0].upper);
  EXPECT_TRUE(r.profiles[0].lower);
  EXPECT_EQ(r.profiles[0].values[r.profiles[0].values.size() - 1], 2.85e-5);
}

class RobustLoss : public ::testing::TestWithParam<LossKind> {};

TEST_P(RobustLoss, ResistsGrossOutliers) {
  for (const bool known : {true, false}) {
    FitProblem problem = noisy_decay(0.02, 60, 8, known);
    for (Eigen::Index i = 3; i < 60; i += 10) problem.data[0].measured[i] += 5e6;  // 10 % of the points, 25 deviations
    const FitResult plain = fit(problem);
    problem.data[0].loss = {GetParam(), GetParam() == LossKind::tukey ? 4.685 : 1.345};
    const FitResult robust = fit(problem);
    ASSERT_TRUE(robust.usable()) << robust.message;
    EXPECT_GT(worst_relative(plain.values, decay_truth()), 0.1);
    EXPECT_LT(worst_relative(robust.values, decay_truth()), 0.05) << known;
    EXPECT_TRUE(inside_confidence_region(robust, decay_truth(), 0.99)) << known;
    if (known) continue;
    EXPECT_NEAR(robust.data[0].noise_factor, 1.0, 0.5);
    EXPECT_GT(plain.data[0].noise_factor, 3.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RobustLoss,
                         ::testing::Values(LossKind::huber, LossKind::soft_l1, LossKind::cauchy, LossKind::tukey));

TEST(RobustLoss, StandardErrorsAreTrueWithOutliers) {
  for (const LossKind kind : {LossKind::huber, LossKind::tukey}) {
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      FitProblem problem = noisy_decay(0.02, 60, seed, false);
      Normal normal(1000 + seed);
      for (Eigen::Index i = 3; i < 60; i += 10) problem.data[0].measured[i] += 2e6 * normal();
      problem.data[0].loss = {kind, kind == LossKind::tukey ? 4.685 : 1.345};
      FitOptions options;
      options.starts = 1;
      hits += inside_confidence_region(fit(problem, options), decay_truth(), 0.95) ? 1 : 0;
    }
    EXPECT_GE(hits, 90);
  }
}

TEST(Bounds, ActiveBoundIsHeldOutAndSaid) {
  FitProblem problem = noisy_decay(0.02, 40, 3, true);
  problem.parameters[1].upper = 2e-5;
  problem.parameters[1].start = 1e-5;
  const FitResult r = fit(problem);
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_EQ(r.values[1], 2e-5);
  EXPECT_EQ(r.at_upper_bound, std::vector<int>{1});
  EXPECT_TRUE(r.at_lower_bound.empty());
  EXPECT_EQ(r.standard_error[1], 0.0);
  EXPECT_TRUE(mentions(r.warnings, "length is at its upper bound 2e-05: the fit would go on beyond it"));
  // The strength is the linear fit for this length, its error that of a one-parameter fit.
  const Eigen::VectorXd shape = (-openings(40) / 2e-5).array().exp();
  EXPECT_NEAR(r.values[0], shape.dot(problem.data[0].measured) / shape.squaredNorm(), 1e-8 * r.values[0]);
  EXPECT_NEAR(r.standard_error[0], 0.02 * decay_truth()[0] / shape.norm(), 1e-6 * r.standard_error[0]);
  EXPECT_FALSE(inside_confidence_region(r, decay_truth(), 0.95));  // the bound is wrong, and far off
}

TEST(Bounds, AllParametersAtBounds) {
  FitProblem problem = noisy_decay(0.02, 40, 3, false);
  problem.parameters = {parameter("strength", 2e7, 1.5e7, 1e8), parameter("length", 1e-5, 1e-6, 1.5e-5)};
  const FitResult r = fit(problem);
  EXPECT_EQ(r.at_lower_bound, std::vector<int>{0});
  EXPECT_EQ(r.at_upper_bound, std::vector<int>{1});
  EXPECT_EQ(r.values, Eigen::Vector2d(1.5e7, 1.5e-5));
  EXPECT_EQ(r.data[0].band.norm(), 0.0);
  EXPECT_TRUE(inside_confidence_region(r, r.values, 0.95));
}

TEST(Bounds, SolutionAlongABoundIsExact) {
  // Rosenbrock's valley cut by a bound on the first parameter: the second must follow to x^2.
  FitProblem problem;
  problem.parameters = {parameter("x", -1.0, -2.0, 0.5), parameter("y", 1.0, -2.0, 2.0)};
  problem.data = {observations("valley", Eigen::Vector2d(0.0, 0.0), 1.0,
                               curve<2>(Eigen::Vector2d(0.0, 1.0), [](const auto& p, double row) {
                                 return row == 0.0 ? 10.0 * (p[1] - p[0] * p[0]) : 1.0 - p[0];
                               }))};
  const FitResult r = fit(problem);
  EXPECT_EQ(r.values[0], 0.5);
  EXPECT_NEAR(r.values[1], 0.25, 1e-9);
}

/// y depends on the product of the first two parameters and on the third.
Forward product(const Eigen::VectorXd& x) {
  return curve<3>(x, [](const auto& p, double at) { return p[0] * p[1] * exp(-at / p[2]); });
}

FitProblem product_problem() {
  const Eigen::VectorXd x = openings(30);
  const Eigen::Vector3d truth(5e6, 2.0, 3e-5);
  Normal normal(6);
  FitProblem problem;
  problem.parameters = {parameter("tensile_strength", 3e6, 1e5, 1e8), parameter("factor", 1.0, 0.1, 100.0),
                        parameter("delta0", 1e-5, 1e-6, 1e-3)};
  const Forward model = product(x);
  problem.data = {observations("curve", model(truth, false).values + 1e5 * normal.vector(30), 1e5, model)};
  return problem;
}

TEST(Undetermined, ProductOfTwoParametersIsFoundAndPutInWords) {
  const FitResult r = fit(product_problem());
  EXPECT_EQ(r.status, FitStatus::undetermined);
  EXPECT_FALSE(r.usable());
  ASSERT_EQ(r.undetermined.size(), 1u);
  EXPECT_EQ(
      r.undetermined[0].words,
      "raising tensile_strength by 10 % and lowering factor by 10 % changes no prediction at all (to first order)");
  EXPECT_NEAR(std::abs(r.undetermined[0].direction.dot(Eigen::Vector3d(1.0, -1.0, 0.0).normalized())), 1.0, 1e-9);
  EXPECT_NE(r.message.find(r.undetermined[0].words), std::string::npos);
  EXPECT_TRUE(std::isinf(r.standard_error[0]) && std::isinf(r.standard_error[1]));
  EXPECT_NEAR(r.values[0] * r.values[1], 1e7, 3e5);
  EXPECT_LT(r.standard_error[2], 0.1 * r.values[2]);  // what the data do determine keeps its error
  EXPECT_EQ(r.distinct_minima, 1);                    // the valley is one minimum
}

TEST(Undetermined, TwoPairsAreNamedPairByPair) {
  const Eigen::VectorXd x = openings(30);
  const Forward model =
      curve<4>(x, [](const auto& p, double at) { return p[0] * p[1] * exp(-at / (1e-5 * p[2] * p[3])); });
  FitProblem problem;
  problem.parameters = {parameter("a", 2.0, 0.1, 100.0), parameter("b", 3.0, 0.1, 100.0),
                        parameter("c", 1.5, 0.1, 100.0), parameter("d", 2.0, 0.1, 100.0)};
  problem.data = {observations("curve", model(Eigen::Vector4d(3.0, 3.0, 1.0, 2.0), false).values, 0.1, model)};
  const FitResult r = fit(problem);
  ASSERT_EQ(r.undetermined.size(), 2u);
  const std::vector<std::string> words = {r.undetermined[0].words, r.undetermined[1].words};
  EXPECT_TRUE(mentions(words, "raising a by 10 % and lowering b by 10 %")) << words[0] << "\n" << words[1];
  EXPECT_TRUE(mentions(words, "raising c by 10 % and lowering d by 10 %")) << words[0] << "\n" << words[1];
}

TEST(Undetermined, PriorSettlesItAndIsNamedAsTheOnlySource) {
  FitProblem problem = product_problem();
  problem.parameters[1].prior = Prior{2.0, 0.1};
  const FitResult r = fit(problem);
  EXPECT_EQ(r.status, FitStatus::ok) << r.message;
  EXPECT_NEAR(r.values[1], 2.0, 1e-6);
  EXPECT_NEAR(r.standard_error[1], 0.1, 1e-6);
  EXPECT_TRUE(mentions(r.warnings, "without the priors raising tensile_strength by 10 % and lowering factor by 10 %"));
}

TEST(Undetermined, ParameterWithoutInfluenceIsNamed) {
  FitProblem problem = noisy_decay(0.02, 20, 1, true);
  problem.parameters.push_back(parameter("poisson_ratio", 0.2, 0.0, 0.49));
  problem.data[0].forward =
      curve<3>(openings(20), [](const auto& p, double at) { return p[0] * exp(-at / p[1]) + 0.0 * p[2]; });
  const FitResult r = fit(problem);
  EXPECT_EQ(r.status, FitStatus::undetermined);
  ASSERT_EQ(r.undetermined.size(), 1u);
  EXPECT_EQ(r.undetermined[0].words, "poisson_ratio influences no prediction at all");
  EXPECT_LT(r.standard_error[0], 0.1 * r.values[0]);
}

TEST(Undetermined, LessThanOneStandardDeviationForTheWholeValueIsNothing) {
  FitProblem problem;  // y = a with a = 1 +- 2
  problem.parameters = {parameter("a", 1.0, 0.01, 100.0)};
  problem.data = {observations("value", Eigen::VectorXd::Ones(1), 2.0, linear(Eigen::MatrixXd::Ones(1, 1)))};
  FitResult r = fit(problem);
  EXPECT_EQ(r.status, FitStatus::undetermined);
  EXPECT_NEAR(r.singular_values[0], 0.5, 1e-9);
  EXPECT_EQ(r.undetermined[0].words, "raising a by 10 % changes no prediction by more than 0.05 standard deviations");
  EXPECT_NEAR(r.standard_error[0], 2.0, 1e-9);
  problem.data[0].deviation[0] = 0.7;
  r = fit(problem);
  EXPECT_EQ(r.status, FitStatus::ok);
  EXPECT_TRUE(mentions(r.warnings, "a is weakly determined"));
}

/// cost = ((a^2 - 4)/deviation)^2/2 + tilt^2 (a + 2)^2/2: the least at a = -2, another minimum near a = 2.
FitProblem two_minima(double tilt, double deviation = 1.0) {
  FitProblem problem;
  problem.parameters = {parameter("a", 1.5, -4.0, 4.0)};
  problem.data = {observations("well", Eigen::Vector2d(0.0, 0.0), 1.0,
                               curve<1>(Eigen::Vector2d(0.0, 1.0), [tilt](const auto& p, double row) {
                                 return row == 0.0 ? p[0] * p[0] - 4.0 : tilt * (p[0] + 2.0);
                               }))};
  problem.data[0].deviation[0] = deviation;
  return problem;
}

TEST(MultiStart, FindsTheBetterMinimumAndNamesTheOther) {
  const FitResult r = fit(two_minima(0.1));
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_NEAR(r.values[0], -2.0, 1e-8);
  EXPECT_EQ(r.distinct_minima, 2);
  EXPECT_TRUE(mentions(r.warnings, "another minimum is nearly as good"));
  ASSERT_EQ(r.starts.size(), 8u);
  EXPECT_EQ(r.starts[0].start[0], 1.5);
  EXPECT_GT(r.starts[0].end[0], 1.9);
  FitOptions one;
  one.starts = 1;
  EXPECT_NEAR(fit(two_minima(0.1), one).values[0], r.starts[0].end[0], 1e-6);
}

TEST(MultiStart, MuchWorseMinimumIsOnlyCounted) {
  const FitResult r = fit(two_minima(0.9));  // the cost at the other, a = 1.771, is 6.1
  EXPECT_NEAR(r.values[0], -2.0, 1e-8);
  EXPECT_EQ(r.distinct_minima, 2);
  EXPECT_FALSE(mentions(r.warnings, "nearly as good"));
}

TEST(MultiStart, ProfileThatFallsIntoADeeperMinimumIsFollowed) {
  FitOptions options;
  options.starts = 1;
  EXPECT_NEAR(fit(two_minima(0.3, 4.0), options).values[0], 1.0 + std::sqrt(0.28), 1e-6);
  options.profiles = {0};
  const FitResult r = fit(two_minima(0.3, 4.0), options);
  EXPECT_NEAR(r.values[0], -2.0, 1e-8);
  EXPECT_EQ(r.distinct_minima, 2);
}

TEST(MultiStart, SameMinimumIsNotRefinedAgain) {
  const FitResult r = fit(noisy_decay(0.02, 40, 1, true));
  EXPECT_EQ(r.distinct_minima, 1);
  int repeated = 0;
  for (const StartResult& s : r.starts) {
    EXPECT_TRUE(s.converged);
    EXPECT_EQ(s.end, r.values);
    repeated += s.message.find("earlier start") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(repeated, 7);
}

/// The decay model refuses a region that holds some of the starts and touches the way to the solution.
FitProblem with_gap() {
  FitProblem problem = noisy_decay(0.02, 40, 5, true);
  const Forward model = problem.data[0].forward;
  problem.data[0].forward = [model](const Eigen::VectorXd& p, bool derivatives) {
    if (p[0] * p[1] > 400.0) return failed("strength times length exceeds 400 N/m");  // truth: 270
    return model(p, derivatives);
  };
  return problem;
}

TEST(FailingModel, StepsAndStartsAroundTheGap) {
  FitProblem problem = with_gap();
  problem.parameters[0].start = 1e6;
  problem.parameters[1].start = 3.9e-4;
  const FitResult r = fit(problem);
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_LT(worst_relative(r.values, decay_truth()), 0.05);
  for (const StartResult& s : r.starts) EXPECT_TRUE(std::isfinite(s.cost)) << s.message;
}

TEST(FailingModel, GivenStartFailsButOthersDoNot) {
  FitProblem problem = with_gap();
  problem.parameters[0].start = 1e8;
  problem.parameters[1].start = 1e-3;
  const FitResult r = fit(problem);
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_LT(worst_relative(r.values, decay_truth()), 0.05);
  EXPECT_TRUE(mentions(r.warnings, "the given one among them"));
  EXPECT_FALSE(r.starts[0].converged);
  EXPECT_TRUE(std::isinf(r.starts[0].cost));
}

TEST(FailingModel, NoPredictionAnywhereIsAFailureWithTheModelsWords) {
  FitProblem problem = noisy_decay(0.02, 10, 1, true);
  problem.data[0].forward = [](const Eigen::VectorXd&, bool) { return failed("no equilibrium at step 3"); };
  FitResult r = fit(problem);
  EXPECT_EQ(r.status, FitStatus::failed);
  EXPECT_NE(r.message.find("curve: no equilibrium at step 3"), std::string::npos) << r.message;
  problem.data[0].forward = [](const Eigen::VectorXd&, bool) -> Prediction { throw std::runtime_error("broken"); };
  r = fit(problem);
  EXPECT_NE(r.message.find("broken"), std::string::npos);
  problem.data[0].forward = linear(Eigen::MatrixXd::Ones(3, 2));
  r = fit(problem);
  EXPECT_NE(r.message.find("3 values for 10 measured ones"), std::string::npos);
}

TEST(FailingModel, MinimumBeyondTheEdgeIsNotConverged) {
  FitProblem problem = with_gap();
  const Forward model = problem.data[0].forward;
  problem.data[0].forward = [model](const Eigen::VectorXd& p, bool derivatives) {
    return p[0] > 8e6 ? failed("strength above 8 MPa") : model(p, derivatives);  // truth: 9.74 MPa
  };
  const FitResult r = fit(problem);
  EXPECT_EQ(r.status, FitStatus::not_converged);
  EXPECT_NE(r.message.find("strength above 8 MPa"), std::string::npos) << r.message;
}

TEST(FailingModel, ProfileStopsAtTheEdgeAndSaysSo) {
  FitProblem problem = noisy_decay(0.02, 10, 2, true);
  const Forward model = problem.data[0].forward;
  problem.data[0].forward = [model](const Eigen::VectorXd& p, bool derivatives) {
    return p[1] > 2.85e-5 ? failed("no equilibrium") : model(p, derivatives);
  };
  FitOptions options;
  options.profiles = {1};
  const FitResult r = fit(problem, options);
  ASSERT_EQ(r.profiles.size(), 1u) << r.message;
  EXPECT_TRUE(r.profiles[0].lower);
  EXPECT_FALSE(r.profiles[0].upper);
  EXPECT_TRUE(mentions(r.warnings, "the profile of length ends at"));
}

TEST(IterationLimit, IsNotConvergedInWords) {
  FitOptions options;
  options.starts = 1;
  options.max_iterations = 1;
  const FitResult r = fit(noisy_decay(0.02, 40, 1, true), options);
  EXPECT_EQ(r.status, FitStatus::not_converged);
  EXPECT_NE(r.message.find("limit of 1 iterations"), std::string::npos) << r.message;
}

TEST(Determinism, SameProblemSameBits) {
  FitOptions options;
  options.profiles = {0, 1};
  const FitResult a = fit(with_gap(), options);
  const FitResult b = fit(with_gap(), options);
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.covariance, b.covariance);
  for (std::size_t k = 0; k < a.starts.size(); ++k) EXPECT_EQ(a.starts[k].start, b.starts[k].start);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(a.profiles[k].excess, b.profiles[k].excess);
}

TEST(Silence, NothingIsWrittenToStderrOrStdout) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  FitProblem problem = with_gap();
  problem.parameters[0].start = 1e8;
  problem.parameters[1].start = 1e-3;
  static_cast<void>(fit(problem));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(Progress, NamesStartsAndProfiles) {
  std::vector<std::string> stages;
  FitOptions options;
  options.starts = 2;
  options.profiles = {1};
  options.progress = [&](const FitProgress& p) { stages.push_back(p.stage); };
  static_cast<void>(fit(noisy_decay(0.02, 10, 1, false), options));
  EXPECT_TRUE(mentions(stages, "start 2 of 2"));
  EXPECT_TRUE(mentions(stages, "profile of length"));
}

TEST(ForwardModels, RobustSetsRunOncePerParameterVector) {
  int plain = 0;
  int robust = 0;
  for (const bool with_loss : {false, true}) {
    FitProblem problem = noisy_decay(0.02, 200, 1, true);
    const Forward model = problem.data[0].forward;
    int& count = with_loss ? robust : plain;
    problem.data[0].forward = [model, &count](const Eigen::VectorXd& p, bool derivatives) {
      ++count;
      return model(p, derivatives);
    };
    if (with_loss) problem.data[0].loss = {LossKind::huber, 1.345};
    FitOptions options;
    options.starts = 1;
    static_cast<void>(fit(problem, options));
  }
  EXPECT_LT(robust, 3 * plain);  // not 200 times
}

template <class Change>
std::string refusal(Change change) {
  FitProblem problem = noisy_decay(0.02, 10, 1, true);
  change(problem);
  try {
    require_valid(problem);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

TEST(RequireValid, NamesWhatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](FitProblem&) {}), "accepted");
  EXPECT_EQ(refusal([](FitProblem& p) { p.data[0].deviation[3] = 0.0; }),
            "data set curve: standard deviation of point 4 = 0: must be finite and > 0");
  EXPECT_EQ(refusal([&](FitProblem& p) { p.data[0].measured[0] = nan; }),
            "data set curve: measured value of point 1 = nan: must be finite");
  EXPECT_EQ(refusal([](FitProblem& p) { p.data[0].weight = 0.0; }),
            "data set curve: weight = 0: must be finite and > 0; leave the set out instead of weight 0");
  EXPECT_EQ(refusal([](FitProblem& p) { p.data[0].deviation.conservativeResize(4); }),
            "data set curve: 4 deviations for 10 measured values");
  EXPECT_EQ(refusal([](FitProblem& p) { p.parameters[0].start = 1.0; }),
            "parameter strength: start = 1: must lie within the bounds 1e+05 ... 1e+08");
  EXPECT_EQ(refusal([](FitProblem& p) { p.parameters[0].upper = p.parameters[0].lower; }),
            "parameter strength: lower = 1e+05: must be < upper = 1e+05");
  EXPECT_EQ(refusal([&](FitProblem& p) { p.parameters[1].start = nan; }),
            "parameter length: start = nan: must be finite");
  EXPECT_EQ(refusal([](FitProblem& p) {
              p.parameters[1].prior = Prior{1e-5, 0.0};
            }),
            "parameter length: prior deviation = 0: must be finite and > 0");
  EXPECT_EQ(refusal([](FitProblem& p) { p.parameters[1].name = "strength"; }), "parameter strength: named twice");
  EXPECT_EQ(refusal([](FitProblem& p) {
              p.data[0].loss = {LossKind::huber, -1.0};
            }),
            "data set curve: scale of the robust loss = -1: must be finite and > 0");
  EXPECT_EQ(refusal([](FitProblem& p) { p.data[0].forward = nullptr; }), "data set curve: no forward model");
  EXPECT_EQ(refusal([](FitProblem& p) {
              p.data[0].measured.conservativeResize(1);
              p.data[0].deviation.conservativeResize(1);
            }),
            "1 measured values and priors cannot determine 2 parameters: fix some, give priors or add data");
  EXPECT_EQ(refusal([](FitProblem& p) {
              p.data[0].measured.conservativeResize(1);
              p.data[0].deviation.conservativeResize(1);
              p.parameters[1].prior = Prior{2e-5, 1e-6};
            }),
            "accepted");
}

}  // namespace
}  // namespace fpz::calibration
