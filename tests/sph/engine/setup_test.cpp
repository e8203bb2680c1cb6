// What is wrong with a set-up, and what goes wrong in a run.
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fpz/material.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

bool complains(const RunSetup<2>& s, const std::string& word) {
  for (const std::string& text : problems(s)) {
    if (text.find(word) != std::string::npos) return true;
  }
  return false;
}

TEST(RunSetup, EveryProblemIsNamed) {
  EXPECT_TRUE(problems(block(4, 4)).empty());
  RunSetup<2> s = block(4, 4);
  s.options.courant = -1.0;
  s.options.damping = 1.0;
  s.options.mass_scale = 0.5;
  s.options.rve_length = {RveLength::Rule::number, 0.0};
  s.parameters.cohesion = 1.0;
  s.arrangement.position[3][0] = std::numeric_limits<double>::quiet_NaN();
  s.arrangement.volume[4] = 0.0;
  s.arrangement.group[5] = 2;
  s.velocity.resize(3);
  for (const char* word : {"courant", "damping", "mass_scale", "rve_length", "cohesion", "particle 3", "particle 4",
                           "particle 5", "velocity"}) {
    EXPECT_TRUE(complains(s, word)) << word;
  }
  EXPECT_THROW(Simulation<2>{s}, std::invalid_argument);
  s = {};
  EXPECT_TRUE(complains(s, "no particles"));
}

TEST(RunSetup, ExplosionIsReported) {
  RunSetup<2> s = block(10, 10);
  set_velocity(s, [](const Vector& x) { return vec(x[0] > 8e-3 ? 8000.0 : 0.0, 0.0); });
  Simulation<2> run(s);
  Outcome o;
  for (int k = 0; k < 100 && o.ok(); ++k) o = run.step();
  EXPECT_EQ(o.failure, Failure::too_fast);
  EXPECT_GT(o.speed, 4000.0);
  EXPECT_NE(o.message().find("faster than sound"), std::string::npos);
}

/// Two particles: strain (u2 - u1)/d in both, so omega = 2 c/d with the confined wave speed c.
TEST(RunSetup, StabilityLimitOfAPairIsExact) {
  RunSetup<2> s = block(2, 1);
  const Material<double> m = make_material(s.parameters, s.setting);
  const double celerity = std::sqrt((m.bulk.lambda + 2.0 * m.bulk.mu) / s.parameters.density);
  EXPECT_NEAR(stability_limit(s), 1e-3 / celerity, 1e-5 * 1e-3 / celerity);
}

/// The measured limit bounds the time step, so that no Courant number makes an elastic run explode, however irregular
/// the arrangement.
TEST(RunSetup, TimeStepIsBoundedByTheMeasuredLimit) {
  for (const Configuration c : {Configuration::reference, Configuration::updated}) {
    RunSetup<2> s = block(14, 9, 0.35);
    s.options.configuration = c;
    s.options.viscosity_alpha = c == Configuration::updated ? 0.1 : 0.0;
    s.options.courant = 10.0;
    EXPECT_EQ(time_step(s), stability_margin * stability_limit(s));
    set_velocity(s, [](const Vector& x) { return vec(std::sin(5e3 * x[0]), std::cos(4e3 * x[1])); });
    Simulation<2> run(s);
    advance(run, 3000);
    EXPECT_LT(run.energies().kinetic, run.energies().kinetic_start);
    s.options.courant = 0.1;
    EXPECT_EQ(time_step(s), courant_step(s));
  }
}

/// Local damping makes a body stiffer while it turns back: nine tenths of the limit of the elastic one are too long.
TEST(RunSetup, TimeStepIsBoundedWithLocalDamping) {
  RunSetup<2> s = block(14, 9, 0.35);
  s.options.courant = 10.0;
  s.most_damping = 0.5;
  EXPECT_EQ(time_step(s), stability_margin * stability_limit(s) / std::sqrt(1.5));
  set_velocity(s, [](const Vector& x) { return vec(std::sin(5e3 * x[0]), std::cos(4e3 * x[1])); });
  Simulation<2> run(s);
  run.set_damping(0.5);
  advance(run, 3000);
  EXPECT_LT(run.energies().kinetic + run.energies().elastic, 0.01 * run.energies().kinetic_start);
  EXPECT_THROW(run.set_damping(0.6), std::invalid_argument);
  EXPECT_THROW(run.set_damping(-0.1), std::invalid_argument);
}

/// H beyond the snap-back length is an error of the stress update, not a wrong number.
TEST(RunSetup, SnapBackIsReported) {
  RunSetup<2> s = block(12, 4);
  s.parameters = concrete();
  s.options.rve_length = {RveLength::Rule::number, 5.0};
  set_velocity(s, [](const Vector& x) { return vec(x[0] < 6e-3 ? -2.0 : 2.0, 0.0); });
  Simulation<2> run(s);
  Outcome o;
  for (int k = 0; k < 500 && o.ok(); ++k) o = run.step();
  EXPECT_EQ(o.failure, Failure::constitutive);
  EXPECT_EQ(o.status, Status::snap_back);
  EXPECT_NE(o.message().find("rve_length"), std::string::npos);
}

/// Neighbours against all pairs, on an irregular cloud with distant outliers.
TEST(RunSetup, NeighboursAgreeWithAllPairs) {
  RunSetup<2> s = block(15, 9, 0.4);
  s.arrangement.add(vec(5.0, -3.0), 1e-6);
  s.arrangement.add(vec(5.0005, -3.0005), 1e-6);
  const double reach = kernel_support * s.options.smoothing_ratio * s.arrangement.spacing;
  std::size_t pairs = 0;
  for (const Vector& a : s.arrangement.position) {
    for (const Vector& b : s.arrangement.position) pairs += (a - b).norm() < reach ? 1U : 0U;
  }
  const auto n = static_cast<double>(s.arrangement.size());
  EXPECT_NEAR(Simulation<2>(s).mean_neighbours() * n, static_cast<double>(pairs) - n, 1e-6);
}

/// A long journey in the updated configuration makes the lists anew, standing still does not.
TEST(RunSetup, ListsAreRebuiltOnlyWhenNeeded) {
  RunSetup<2> s = block(8, 8);
  s.options.configuration = Configuration::updated;
  Simulation<2> still(s);
  advance(still, 200);
  EXPECT_EQ(still.neighbour_builds(), 1);
  set_velocity(s, [](const Vector&) { return vec(100.0, 0.0); });
  Simulation<2> moving(s);
  advance(moving, 200);
  const double path = 100.0 * moving.time();
  const double allowed = 0.5 * s.options.skin * s.arrangement.spacing;
  EXPECT_NEAR(static_cast<double>(moving.neighbour_builds()), 1.0 + path / allowed, 0.2 * path / allowed + 1.0);
}

}  // namespace
}  // namespace fpz::sph::test
