// What a client learns when a step fails or its data are no point of this behaviour.
#include <cstring>

#include "interfaces/generic/generic_call.hpp"
#include "support/paths.hpp"

namespace fpz {
namespace {

using test::Client;

/// A point that is cracked.
Client cracked_point(const std::string& hypothesis = "PlaneStrain") {
  Client c(hypothesis, test::table1());
  for (int k = 0; k < 40; ++k) {
    test::add_strain<2>(c.g1, test::strain2(6e-5, 0, k < 20 ? 0.0 : 4e-5));
    EXPECT_EQ(c.call(0), 1) << c.text();
    c.update();
  }
  EXPECT_EQ(c.i0[0], 1.0);
  return c;
}

void expect_refused(Client& c, const std::string& word) {
  EXPECT_EQ(c.call(4), -1) << word;
  EXPECT_NE(c.text().find(word), std::string::npos) << "no \"" << word << "\" in: " << c.text();
  EXPECT_EQ(c.f1, c.f0) << word;
  EXPECT_EQ(c.i1, c.i0) << word;
}

TEST(GenericFailure, SnapBackLeavesTheBeginAndAdvisesASmallerStep) {
  Client c("PlaneStrain", test::table1(1.0));
  test::add_strain<2>(c.g1, test::strain2(1e-4, 0, 0));
  ASSERT_EQ(c.call(4), 1);
  c.update();
  test::add_strain<2>(c.g1, test::strain2(1e-2, 0, 0));
  EXPECT_EQ(c.call(4), -1);
  EXPECT_EQ(c.rdt, 0.25);
  EXPECT_NE(c.text().find("snap_back"), std::string::npos) << c.text();
  EXPECT_NE(c.text().find("rve_length = 1 "), std::string::npos) << c.text();
  EXPECT_EQ(c.f1, c.f0);
  EXPECT_EQ(c.i1, c.i0);
  EXPECT_EQ(c.stored1, c.stored0);
  EXPECT_EQ(c.dissipated1, c.dissipated0);
  EXPECT_GT(c.stored0, 0.0);
}

TEST(GenericFailure, MessagesFitAndMayBeUnwanted) {
  Client c("PlaneStrain", test::table1());
  std::fill_n(c.properties.begin(), parameter_table<double>.size(), -1.0);  // everything is wrong: a long text
  c.properties[7] = -1.234567890123e-300;
  EXPECT_EQ(c.call(4), -1);
  EXPECT_EQ(std::strlen(c.message.c_str()), 511u);
  EXPECT_NE(c.text().find("young_modulus = -1: must be > 0"), std::string::npos) << c.text();
  EXPECT_EQ(c.rdt, Client::untouched);  // a smaller step does not help
  using Function = int (*)(test::ClientData*);
  test::ClientData nothing{};
  EXPECT_EQ(reinterpret_cast<Function>(test::find_symbol("Fpz_PlaneStrain"))(&nothing), -1);
}

TEST(GenericFailure, MissingDataAreNamed) {
  using Function = int (*)(test::ClientData*);
  const auto f = reinterpret_cast<Function>(test::find_symbol("Fpz_PlaneStrain"));
  const Client c("PlaneStrain", test::table1());
  std::vector<double> k(16, 0.0), out(4), internal(c.i0.size());
  std::string message(512, '#');
  const test::ClientData good{
      message.data(),
      1.0,
      k.data(),
      nullptr,
      nullptr,
      {c.g0.data(), c.f0.data(), nullptr, nullptr, c.i0.data(), nullptr, nullptr, nullptr},
      {c.g1.data(), out.data(), nullptr, c.properties.data(), internal.data(), nullptr, nullptr, nullptr}};
  test::ClientData d = good;
  EXPECT_EQ(f(&d), 1);  // rdt, energies, densities are not needed
  const auto expect = [&](const char* word) {
    EXPECT_EQ(f(&d), -1);
    EXPECT_NE(std::string(message.c_str()).find(word), std::string::npos) << message.c_str();
    d = good;
  };
  d.s0.gradients = nullptr;
  expect("gradients at the begin");
  d.s1.gradients = nullptr;
  expect("gradients at the end");
  d.s0.forces = nullptr;
  expect("thermodynamic forces at the begin");
  d.s1.forces = nullptr;
  expect("thermodynamic forces at the end");
  d.s1.material_properties = nullptr;
  expect("material properties");
  d.s0.internal = nullptr;
  expect("internal state variables at the begin");
  d.s1.internal = nullptr;
  expect("internal state variables at the end");
  d.k = nullptr;
  expect("K");
  k[0] = Client::poison;
  expect("K[0]");
  k[0] = 100.0;
  expect("speed of sound");
}

TEST(GenericFailure, NumbersThatAreNone) {
  Client c = cracked_point();
  c.g1[0] = Client::poison;
  expect_refused(c, "not finite");
  c = cracked_point();
  c.g0[1] = Client::poison;
  expect_refused(c, "not finite");
  c = cracked_point();
  c.f0[3] = std::numeric_limits<double>::infinity();
  expect_refused(c, "not finite");
}

TEST(GenericFailure, StatesThatNoStepLeft) {
  Client c = cracked_point();
  c.i0[0] = 0.5;  // averaged between an intact and a cracked point
  expect_refused(c, "averaged");
  c = cracked_point();
  c.i0[1] = 0.0;  // of the frame
  expect_refused(c, "rotation");
}

TEST(GenericFailure, StressAndCrackOfDifferentSteps) {
  Client c = cracked_point();
  c.f0.assign(c.f0.size(), 0.0);
  expect_refused(c, "must be those of one end of a step");
}

TEST(GenericFailure, MaterialFaultsNameTheProperty) {
  Client c = cracked_point();
  c.properties[4] = 1e5;
  expect_refused(c, "cohesion");
  c.properties = test::material_properties_of(test::table1());
  c.properties[10] = 0.0;
  expect_refused(c, "rve_length");
  c.properties[10] = -1.0;
  expect_refused(c, "rve_length");
  c.properties[10] = 0.004;
  c.properties[11] = 9.0;
  expect_refused(c, "softening = 9");
  c.properties[11] = 0.0;
  EXPECT_EQ(c.call(4), 1) << c.text();
}

// An initial stress makes no strain. The point behaves as one that was strained into that stress.
TEST(GenericInitialStress, IsAsIfThePointHadBeenStrainedIntoIt) {
  for (const char* hypothesis : {"Tridimensional", "PlaneStrain", "GeneralisedPlaneStrain", "PlaneStress"}) {
    Client strained(hypothesis, test::table1()), stressed(hypothesis, test::table1());
    test::add_strain<2>(strained.g1, test::strain2(-2e-4, -5e-4, 1e-4));
    ASSERT_EQ(strained.call(0), 1);
    strained.update();
    stressed.f0 = strained.f0;
    double damage = 0.0;
    for (int k = 0; k < 60; ++k) {
      for (Client* c : {&strained, &stressed}) {
        test::add_strain<2>(c->g1, test::strain2(6e-5, 0, 3e-5));
        ASSERT_EQ(c->call(4), 1) << c->text();
      }
      for (std::size_t i = 0; i < 4; ++i) {
        ASSERT_NEAR(strained.f1[i], stressed.f1[i], 1e-9 * test::table1().tensile_strength);
        for (std::size_t j = 0; j < 4; ++j) {
          ASSERT_NEAR(strained.operator_at(i, j), stressed.operator_at(i, j), 1e-7 * test::table1().young_modulus);
        }
      }
      ASSERT_NEAR(strained.stored1, stressed.stored1, 1e-9 * strained.stored1);
      ASSERT_NEAR(strained.dissipated1, stressed.dissipated1, 1e-9 * (1.0 + strained.dissipated1));
      damage = stressed.i1.back();
      strained.update();
      stressed.update();
    }
    EXPECT_GT(damage, 0.3);
  }
}

// The stress along z of a rock mass is not nu (sigma_xx + sigma_yy); it is kept.
TEST(GenericInitialStress, KeepsAnyStressAlongZInPlaneStrain) {
  Client c("PlaneStrain", test::table1());
  c.f0 = {-1e5, -4e5, -3e5, 0.0};
  test::add_strain<2>(c.g1, test::strain2(1e-5, 0, 0));
  ASSERT_EQ(c.call(0), 1) << c.text();
  const double nu = 0.25, lambda = 0.4e9 * nu / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(c.f1[2], -3e5 + lambda * 1e-5, 1e-6);
  // Half sigma : C^-1 : sigma.
  const double sum = c.f1[0] + c.f1[1] + c.f1[2];
  const double squares = c.f1[0] * c.f1[0] + c.f1[1] * c.f1[1] + c.f1[2] * c.f1[2];
  EXPECT_NEAR(c.stored1, ((1 + nu) * squares - nu * sum * sum) / (2 * 0.4e9), 1e-9 * c.stored1);
}

TEST(GenericInitialStress, MustBeOneThatThePointCanBear) {
  Client c("PlaneStrain", test::table1());
  c.f0[0] = 0.7e6;
  expect_refused(c, "beyond the strength");
  Client thin("PlaneStress", test::table1());
  thin.f0[2] = -1e5;
  expect_refused(thin, "stress along z");
}

}  // namespace
}  // namespace fpz
