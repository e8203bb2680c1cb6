// The statistics of the fit against closed forms: linear least squares, variance components, likelihood intervals.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "fit_models.hpp"

namespace fpz::calibration {
namespace {

using namespace testing;

// Two-sided 95 % quantiles from printed tables.
constexpr double normal_95 = 1.959963985;
constexpr double t5_95 = 2.570581836;
constexpr double f_2_5_95 = 5.786135043;
constexpr double chi_squared_2_95 = 5.991464547;

/// A straight line through 7 points; the parameters are of size 1, their bounds far away.
struct Line {
  Eigen::MatrixXd a{7, 2};
  Eigen::VectorXd y{7};
  FitProblem problem;
  FitOptions options;

  explicit Line(bool known, double deviation = 0.2) {
    a.col(0).setOnes();
    a.col(1) << 0.0, 0.5, 1.0, 1.7, 2.0, 3.1, 4.0;
    y << 1.1, 1.38, 1.83, 2.71, 2.9, 4.22, 5.05;
    problem.parameters = {parameter("offset", 0.0, -100.0, 100.0), parameter("slope", 0.0, -100.0, 100.0)};
    problem.data = {observations("line", y, deviation, linear(a), known)};
    options.starts = 2;
  }
  [[nodiscard]] Eigen::VectorXd solution() const { return (a.transpose() * a).inverse() * (a.transpose() * y); }
  [[nodiscard]] double residual_variance() const { return (a * solution() - y).squaredNorm() / 5.0; }
};

TEST(LinearFit, KnownDeviationsGiveTheNormalEquations) {
  const Line line(true);
  const FitResult r = fit(line.problem, line.options);
  ASSERT_EQ(r.status, FitStatus::ok) << r.message;
  const Eigen::MatrixXd covariance = 0.04 * (line.a.transpose() * line.a).inverse();
  EXPECT_LT((r.values - line.solution()).norm(), 1e-9);
  EXPECT_LT((r.covariance - covariance).norm(), 1e-10 * covariance.norm());
  EXPECT_NEAR(r.correlation(0, 1), covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)), 1e-10);
  EXPECT_NEAR(r.upper_limit[1] - r.values[1], normal_95 * std::sqrt(covariance(1, 1)), 1e-8);
  EXPECT_NEAR(r.values[0] - r.lower_limit[0], normal_95 * std::sqrt(covariance(0, 0)), 1e-8);
  EXPECT_EQ(r.data[0].noise_factor, 1.0);
  EXPECT_NEAR(r.degrees_of_freedom, 5.0, 1e-9);
  EXPECT_TRUE(std::isinf(r.noise_degrees_of_freedom));
  EXPECT_NEAR(r.data[0].reduced_chi_squared, line.residual_variance() / 0.04, 1e-9);
  EXPECT_NEAR(r.cost, 0.5 * 5.0 * line.residual_variance() / 0.04, 1e-9);
}

TEST(LinearFit, UnknownDeviationsAreEstimatedAndStudentsTAppears) {
  const Line line(false, 3.0);  // only ratios count: 3 is wrong by far
  const FitResult r = fit(line.problem, line.options);
  const Eigen::MatrixXd covariance = line.residual_variance() * (line.a.transpose() * line.a).inverse();
  EXPECT_NEAR(3.0 * r.data[0].noise_factor, std::sqrt(line.residual_variance()), 1e-9);
  EXPECT_LT((r.covariance - covariance).norm(), 1e-8 * covariance.norm());
  EXPECT_NEAR(r.upper_limit[1] - r.values[1], t5_95 * std::sqrt(covariance(1, 1)), 1e-7);
  EXPECT_NEAR(r.noise_degrees_of_freedom, 5.0, 1e-9);
  for (Eigen::Index i = 0; i < 7; ++i) {
    const double variance = line.a.row(i) * covariance * line.a.row(i).transpose();
    EXPECT_NEAR(r.data[0].band[i], t5_95 * std::sqrt(variance), 1e-7) << i;
  }
}

TEST(LinearFit, JointRegionIsTheEllipsoidOfFOrChiSquared) {
  for (const bool known : {true, false}) {
    const Line line(known);
    const FitResult r = fit(line.problem, line.options);
    const double variance = known ? 0.04 : line.residual_variance();
    const Eigen::Matrix2d information = line.a.transpose() * line.a / variance;
    const double radius = std::sqrt(known ? chi_squared_2_95 : 2.0 * f_2_5_95);
    for (const Eigen::Vector2d& direction : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(-0.3, 1.0)}) {
      const Eigen::VectorXd edge = direction * (radius / std::sqrt(direction.dot(information * direction)));
      EXPECT_TRUE(inside_confidence_region(r, r.values + 0.9999 * edge, 0.95));
      EXPECT_FALSE(inside_confidence_region(r, r.values + 1.0001 * edge, 0.95));
    }
  }
}

TEST(LinearFit, PriorIsOneMoreValue) {
  Line line(true);
  line.problem.parameters[1].prior = Prior{0.5, 0.05};
  const FitResult r = fit(line.problem, line.options);
  const Eigen::Matrix2d information =
      line.a.transpose() * line.a / 0.04 + Eigen::Vector2d(0.0, 400.0).asDiagonal().toDenseMatrix();
  const Eigen::Vector2d right = line.a.transpose() * line.y / 0.04 + Eigen::Vector2d(0.0, 0.5 * 400.0);
  EXPECT_LT((r.values - information.inverse() * right).norm(), 1e-8);
  EXPECT_LT((r.covariance - information.inverse()).norm(), 1e-9);
  EXPECT_NEAR(r.degrees_of_freedom, 6.0, 1e-9);
}

TEST(LinearFit, WeightsChangeTheEstimateButNotTheNoise) {
  Line line(true);
  Observations second = line.problem.data[0];
  second.name = "second";
  second.measured.array() += 0.1;
  second.weight = 0.25;
  line.problem.data.push_back(second);
  const FitResult r = fit(line.problem, line.options);
  // offset: mean with weights 1 and 1/4; its variance: (1 + 1/16)/(1 + 1/4)^2 of that of one set
  EXPECT_NEAR(r.values[0], line.solution()[0] + 0.1 * 0.25 / 1.25, 1e-9);
  const Eigen::MatrixXd one = 0.04 * (line.a.transpose() * line.a).inverse();
  EXPECT_NEAR(r.covariance(1, 1), one(1, 1) * (1.0 + 1.0 / 16.0) / (1.25 * 1.25), 1e-10);
}

TEST(LinearFit, ProfileOfALinearModelIsTheParabola) {
  for (const bool known : {true, false}) {
    Line line(known);
    line.options.profiles = {1};
    const FitResult r = fit(line.problem, line.options);
    ASSERT_EQ(r.profiles.size(), 1u);
    const Profile& p = r.profiles[0];
    for (Eigen::Index k = 0; k < p.values.size(); ++k) {
      const double distance = (p.values[k] - r.values[1]) / r.standard_error[1];
      EXPECT_NEAR(p.excess[k], distance * distance, 1e-6);
    }
    ASSERT_TRUE(p.lower && p.upper);
    EXPECT_NEAR(*p.lower, r.lower_limit[1], 1e-6);
    EXPECT_NEAR(*p.upper, r.upper_limit[1], 1e-6);
    EXPECT_LE(p.values.minCoeff(), r.values[1] - 3.999 * r.standard_error[1]);
    EXPECT_TRUE(std::is_sorted(p.values.begin(), p.values.end()));
  }
}

/// The mean of two groups of values with different unknown noise: the restricted likelihood of the two variances,
/// maximised by brute force, and the weighted mean that follows.
TEST(VarianceComponents, TwoSetsAgreeWithRestrictedLikelihood) {
  Normal normal(5);
  const Eigen::VectorXd first = 10.0 + (0.5 * normal.vector(12)).array();
  const Eigen::VectorXd second = 10.0 + (2.0 * normal.vector(9)).array();
  FitProblem problem;
  problem.parameters = {parameter("mean", 5.0, -100.0, 100.0)};
  problem.data = {observations("first", first, 1.0, linear(Eigen::MatrixXd::Ones(12, 1)), false),
                  observations("second", second, 7.0, linear(Eigen::MatrixXd::Ones(9, 1)), false)};
  const FitResult r = fit(problem);
  ASSERT_TRUE(r.usable()) << r.message;

  const auto minus_twice_log = [&](double s1, double s2) {
    const double w1 = 12.0 / (s1 * s1);
    const double w2 = 9.0 / (s2 * s2);
    const double mean = (w1 * first.mean() + w2 * second.mean()) / (w1 + w2);
    return 24.0 * std::log(s1) + 18.0 * std::log(s2) + std::log(w1 + w2) +
           (first.array() - mean).square().sum() / (s1 * s1) + (second.array() - mean).square().sum() / (s2 * s2);
  };
  double s1 = 1.0;
  double s2 = 1.0;
  for (double step = 0.2; step > 1e-9; step *= 0.5) {  // pattern search
    bool moved = true;
    while (moved) {
      moved = false;
      for (const auto& [d1, d2] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
        if (minus_twice_log(s1 + step * d1, s2 + step * d2) >= minus_twice_log(s1, s2)) continue;
        s1 += step * d1;
        s2 += step * d2;
        moved = true;
      }
    }
  }
  EXPECT_NEAR(r.data[0].noise_factor, s1, 1e-5);
  EXPECT_NEAR(7.0 * r.data[1].noise_factor, s2, 1e-5);
  EXPECT_NEAR(r.standard_error[0], 1.0 / std::sqrt(12.0 / (s1 * s1) + 9.0 / (s2 * s2)), 1e-5);
}

TEST(VarianceComponents, NoiseOfBothCurvesIsRecovered) {
  const Eigen::VectorXd x = openings(400);
  const Forward model = decay(x);
  const Eigen::VectorXd clean = model(decay_truth(), false).values;
  Normal normal(11);
  FitProblem problem;
  problem.parameters = decay_parameters();
  problem.data = {observations("quiet", clean + 5e4 * normal.vector(400), 1.0, model, false),
                  observations("loud", clean + 1e6 * normal.vector(400), 1.0, model, false)};
  const FitResult r = fit(problem);
  EXPECT_NEAR(r.data[0].noise_factor, 5e4, 5e4 * 0.11);  // 3 standard deviations of an estimate from 400 values
  EXPECT_NEAR(r.data[1].noise_factor, 1e6, 1e6 * 0.11);
  // The noise of the second set costs next to nothing: the errors are those of the first alone.
  problem.data.pop_back();
  const FitResult alone = fit(problem);
  EXPECT_NEAR(r.standard_error[1] / alone.standard_error[1], 1.0, 0.02);
}

TEST(VarianceComponents, SetTooSmallForItsNoiseKeepsTheGivenDeviations) {
  Line line(false);
  line.problem.data.push_back(
      observations("single", Eigen::VectorXd::Constant(1, 1.1), 0.01, linear(Eigen::RowVector2d(0.0, 1.0)), false));
  const FitResult r = fit(line.problem, line.options);
  EXPECT_EQ(r.data[1].noise_factor, 1.0);
  EXPECT_TRUE(std::any_of(r.warnings.begin(), r.warnings.end(),
                          [](const std::string& w) { return w.find("single: too few points") != std::string::npos; }));
}

TEST(Autocorrelation, EffectivePointsOfAnAutoregressiveSeries) {
  // AR(1) noise on a constant: the spread of the mean over many series is that of the effective points.
  const double rho = 0.8;
  double sum_effective = 0.0;
  double sum_square = 0.0;
  Normal normal(3);
  for (int k = 0; k < 200; ++k) {
    Eigen::VectorXd y(200);
    y[0] = normal();
    for (Eigen::Index i = 1; i < 200; ++i) y[i] = rho * y[i - 1] + std::sqrt(1.0 - rho * rho) * normal();
    FitProblem problem;
    problem.parameters = {parameter("mean", 0.0, -100.0, 100.0)};
    problem.data = {observations("series", y, 1.0, linear(Eigen::MatrixXd::Ones(200, 1)))};
    FitOptions options;
    options.starts = 1;
    const FitResult r = fit(problem, options);
    sum_effective += r.data[0].effective_points;
    sum_square += r.values[0] * r.values[0];
  }
  const double expected = 200.0 * (1.0 - rho) / (1.0 + rho);
  EXPECT_NEAR(sum_effective / 200.0, expected, 0.15 * expected);
  EXPECT_NEAR(1.0 / (sum_square / 200.0), expected, 0.3 * expected);
}

TEST(Autocorrelation, OnlyTheCorrelatedErrorCoversUnderCorrelatedNoise) {
  const Eigen::VectorXd x = openings(200);
  const Forward model = decay(x);
  const Eigen::VectorXd clean = model(decay_truth(), false).values;
  int plain = 0;
  int correlated = 0;
  int warned = 0;
  Normal normal(17);
  for (int k = 0; k < 100; ++k) {
    Eigen::VectorXd noise(200);
    noise[0] = normal();
    for (Eigen::Index i = 1; i < 200; ++i) noise[i] = 0.9 * noise[i - 1] + std::sqrt(0.19) * normal();
    FitProblem problem;
    problem.parameters = decay_parameters();
    problem.data = {observations("curve", clean + 2e5 * noise, 1.0, model, false)};
    FitOptions options;
    options.starts = 1;
    const FitResult r = fit(problem, options);
    const double miss = std::abs(r.values[1] - decay_truth()[1]);
    plain += miss < normal_95 * r.standard_error[1] ? 1 : 0;
    correlated += miss < normal_95 * r.correlated_error[1] ? 1 : 0;
    warned += !r.warnings.empty() && r.warnings[0].find("systematic") != std::string::npos ? 1 : 0;
  }
  EXPECT_LT(plain, 60);
  EXPECT_GE(correlated, 88);
  EXPECT_EQ(warned, 100);
}

TEST(Scatter, ResidualsFarBeyondKnownDeviationsAreReported) {
  const Line line(true, 0.002);
  const FitResult r = fit(line.problem, line.options);
  ASSERT_FALSE(r.warnings.empty());
  EXPECT_NE(r.warnings[0].find("times as large as its standard deviations allow"), std::string::npos);
}

}  // namespace
}  // namespace fpz::calibration
