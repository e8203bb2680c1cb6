// Every operator against differences of the forces that the interface itself gives.
#include "interfaces/generic/generic_call.hpp"
#include "support/paths.hpp"

namespace fpz {
namespace {

using test::Client;

using Matrix = Eigen::MatrixXd;

Matrix operator_of(const Client& c) {
  Matrix k(c.size, c.size);
  for (std::size_t i = 0; i < c.size; ++i) {
    for (std::size_t j = 0; j < c.size; ++j) k(Eigen::Index(i), Eigen::Index(j)) = c.operator_at(i, j);
  }
  return k;
}

/// d(forces)/d(gradients at the end) of the step that `c` is about to make, by central differences.
Matrix differences(const Client& c, double h) {
  Matrix k(c.size, c.size);
  for (std::size_t j = 0; j < c.size; ++j) {
    Client less = c, more = c;
    less.g1[j] -= h;
    more.g1[j] += h;
    EXPECT_EQ(less.call(0), 1) << less.text();
    EXPECT_EQ(more.call(0), 1) << more.text();
    for (std::size_t i = 0; i < c.size; ++i) {
      k(Eigen::Index(i), Eigen::Index(j)) = (more.f1[i] - less.f1[i]) / (2.0 * h);
    }
  }
  return k;
}

/// One step of the strain (tensor components xx, yy, xy; a solid has some of the others too).
void move(Client& c, double xx, double yy, double xy) {
  c.g1[0] += xx;
  c.g1[1] += yy;
  c.g1[3] += std::sqrt(2.0) * xy;
  if (c.size == 6) {
    c.g1[2] += 0.1 * xx;
    c.g1[4] += 0.3 * xx;
    c.g1[5] -= 0.2 * xy;
  }
}

void step(Client& c, double xx, double yy, double xy) {
  move(c, xx, yy, xy);
  ASSERT_EQ(c.call(0), 1) << c.text();
  c.update();
}

/// A point that is cracked and yields in mixed mode.
Client yielding(const std::string& hypothesis) {
  Client c(hypothesis, test::table1(1e-3));
  for (int k = 0; k < 60; ++k) step(c, 5e-5, -1e-5, k < 30 ? 1e-5 : 4e-5);
  EXPECT_EQ(c.i0[0], 1.0);
  EXPECT_GT(c.i0.back(), 0.1);
  return c;
}

constexpr const char* hypotheses[] = {"Tridimensional", "PlaneStrain", "GeneralisedPlaneStrain", "PlaneStress"};

Matrix prediction(Client& c, double wanted) {
  EXPECT_EQ(c.call(wanted), 1) << c.text();
  return operator_of(c);
}

TEST(GenericOperator, ConsistentOnAllTheWay) {
  int onsets = 0;
  for (const char* hypothesis : hypotheses) {
    Client c(hypothesis, test::table1());
    for (int k = 0; k < 40; ++k) {
      const double sign = k < 25 ? 1.0 : -0.4;
      move(c, 7e-5 * sign, -1e-5, k < 10 ? 1e-5 : 5e-5 * sign);
      // The plane of an onset in space is found to some 1e-9 of the stress: no smaller differences.
      const Matrix expected = differences(c, 1e-7);
      const bool was_cracked = c.i0[0] == 1.0;
      ASSERT_EQ(c.call(4), 1) << c.text();
      EXPECT_LT((operator_of(c) - expected).norm(), 2e-5 * expected.norm()) << hypothesis << ' ' << k;
      onsets += c.cracked() && !was_cracked ? 1 : 0;
      c.update();
    }
    EXPECT_GT(c.i0.back(), 0.15);
  }
  EXPECT_EQ(onsets, 4);
}

TEST(GenericOperator, ElasticIsHookesLaw) {
  const Parameters p = test::table1();
  const double nu = p.poisson_ratio, mu = p.young_modulus / (2.0 * (1.0 + nu));
  const double lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
  Matrix solid = 2.0 * mu * Matrix::Identity(6, 6);
  solid.topLeftCorner(3, 3).array() += lambda;
  Matrix thin = Matrix::Zero(4, 4);
  thin(0, 0) = thin(1, 1) = p.young_modulus / (1.0 - nu * nu);
  thin(0, 1) = thin(1, 0) = nu * thin(0, 0);
  thin(3, 3) = 2.0 * mu;
  for (const char* hypothesis : hypotheses) {
    Client c = yielding(hypothesis);
    const std::string name = hypothesis;
    const Matrix expected = name == "PlaneStress" ? thin : name == "Tridimensional" ? solid : solid.topLeftCorner(4, 4);
    EXPECT_LT((prediction(c, -1) - expected).norm(), 1e-13 * expected.norm()) << name;
    ASSERT_EQ(c.call(1), 1);
    EXPECT_LT((operator_of(c) - expected).norm(), 1e-13 * expected.norm()) << name;
  }
}

TEST(GenericOperator, SecantIsThatOfUnloading) {
  for (const char* hypothesis : hypotheses) {
    Client c = yielding(hypothesis);
    step(c, -2e-5, 0, -2e-5);  // off the surface
    const Matrix elastic = prediction(c, -1);
    const Matrix expected = differences(c, 1e-9);
    EXPECT_LT((prediction(c, -2) - expected).norm(), 1e-6 * expected.norm()) << hypothesis;
    EXPECT_GT((elastic - expected).norm(), 0.05 * expected.norm()) << hypothesis;
    // Where it does not yield the tangent is the same.
    EXPECT_LT((prediction(c, -3) - expected).norm(), 1e-6 * expected.norm()) << hypothesis;
    // At the end of a step it is the one of the begin of the next.
    move(c, -1e-5, 0, -1e-5);
    ASSERT_EQ(c.call(2), 1);
    const Matrix at_end = operator_of(c);
    c.update();
    EXPECT_LT((prediction(c, -2) - at_end).norm(), 1e-12 * at_end.norm()) << hypothesis;
  }
}

TEST(GenericOperator, TangentIsThatOfFurtherLoading) {
  for (const char* hypothesis : hypotheses) {
    Client c = yielding(hypothesis);
    const Matrix secant = prediction(c, -2);
    const Matrix tangent = prediction(c, -3);
    EXPECT_GT((tangent - secant).norm(), 0.1 * secant.norm()) << hypothesis;
    Client ahead = c;
    move(ahead, 5e-9, -1e-9, 4e-9);
    const Matrix expected = differences(ahead, 1e-10);
    EXPECT_LT((tangent - expected).norm(), 1e-3 * expected.norm()) << hypothesis;
    move(c, 5e-5, -1e-5, 4e-5);
    ASSERT_EQ(c.call(3), 1);
    const Matrix at_end = operator_of(c);
    c.update();
    EXPECT_LT((prediction(c, -3) - at_end).norm(), 1e-6 * at_end.norm()) << hypothesis;
  }
}

TEST(GenericOperator, PredictionsTouchOnlyK) {
  for (const double wanted : {-1.0, -2.0, -3.0}) {
    Client c = yielding("PlaneStrain");
    const Client before = c;
    ASSERT_EQ(c.call(wanted), 1);
    EXPECT_TRUE(std::isnan(c.f1[0]) && std::isnan(c.i1[0]) && std::isnan(c.f1.back()) && std::isnan(c.i1.back()));
    EXPECT_EQ(c.rdt, Client::untouched);
    EXPECT_EQ(c.f0, before.f0);
    EXPECT_EQ(c.i0, before.i0);
    for (const double x : c.k) EXPECT_TRUE(std::isfinite(x));
  }
}

TEST(GenericOperator, WithoutOneKIsNotWritten) {
  Client c = yielding("Tridimensional");
  c.k.assign(c.k.size(), Client::untouched);
  move(c, 1e-5, 0, 0);
  ASSERT_EQ(c.call(0), 1);
  EXPECT_EQ(c.k[0], 0.0);
  for (std::size_t n = 1; n < c.k.size(); ++n) EXPECT_EQ(c.k[n], Client::untouched);
}

TEST(GenericOperator, SpeedOfSoundWhenAskedFor) {
  const Parameters p = test::table1();
  for (const char* hypothesis : hypotheses) {
    for (const double wanted : {100.0, 104.0, 99.0}) {
      Client c(hypothesis, p);
      ASSERT_EQ(c.call(wanted), 1) << c.text();
      const double nu = p.poisson_ratio;
      const double modulus = std::string(hypothesis) == "PlaneStress"
                                 ? p.young_modulus / (1.0 - nu * nu)
                                 : p.young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
      EXPECT_NEAR(c.sound, std::sqrt(modulus / p.density), 1e-10 * c.sound);
    }
  }
}

}  // namespace
}  // namespace fpz
