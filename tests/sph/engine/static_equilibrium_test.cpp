// Bodies at rest against closed forms, and against the forces of a run.
#include "fpz/sph/static_equilibrium.hpp"

#include <cmath>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr int columns = 60, rows = 12;
constexpr double size = 1e-3;  // m

/// A bar held at its left end.
RunSetup<2> held_bar(double jitter) {
  RunSetup<2> s = block(columns, rows, jitter, size);
  const Motion still{0.0, 0.0};
  add_group(s, {"left", {still, still}, true}, [](const Vector& x) { return x[0] < 3.0 * size; });
  return s;
}

/// An even pull at the right end, 1 N in all.
StaticLoad<2> pull(const RunSetup<2>& s) {
  StaticLoad<2> load;
  double volume = 0.0;
  const auto at_end = [](const Vector& x) { return x[0] > (columns - 1) * size; };
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    if (at_end(s.arrangement.position[i])) volume += s.arrangement.volume[i];
  }
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    load.force.push_back(at_end(s.arrangement.position[i]) ? vec(s.arrangement.volume[i] / volume, 0.0)
                                                           : vec(0.0, 0.0));
  }
  return load;
}

TEST(StaticEquilibrium, APulledBarHasTheStressAndTheStretchOfTheClosedForm) {
  const RunSetup<2> s = held_bar(0.0);
  const StaticState<2> state = StaticBody<2>(s).equilibrium(pull(s));
  EXPECT_LT(state.residual, 1e-8);
  EXPECT_NEAR(state.reaction[0][0], -1.0, 1e-8);
  EXPECT_NEAR(state.reaction[0][1], 0.0, 1e-8);
  const double stress = 1.0 / (rows * size), nu = s.parameters.poisson_ratio;
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const double x = s.arrangement.position[i][0] / size;
    if (std::abs(x - 22.5) < 0.1) left += state.displacement[i][0] / rows;
    if (std::abs(x - 37.5) < 0.1) right += state.displacement[i][0] / rows;
    if (x < 22.0 || x > 38.0) continue;
    EXPECT_NEAR(state.stress[i][0], stress, 1e-3 * stress);
    EXPECT_NEAR(state.stress[i][1], 0.0, 1e-3 * stress);
    EXPECT_NEAR(state.stress[i][2], 0.0, 1e-3 * stress);
  }
  const double stretch = 15.0 * size * stress * (1.0 - nu * nu) / s.parameters.young_modulus;  // plane strain
  EXPECT_NEAR(right - left, stretch, 1e-3 * stretch);
}

/// Linear: stresses follow the load, and prescribed displacements at the ends give a load back.
TEST(StaticEquilibrium, IsLinear) {
  const RunSetup<2> s = held_bar(0.3);
  StaticBody<2> body(s);
  StaticLoad<2> load = pull(s);
  const StaticState<2> once = body.equilibrium(load);
  for (Vector& f : load.force) f *= 1e6;
  const StaticState<2> more = body.equilibrium(load);
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    EXPECT_NEAR(more.stress[i][0], 1e6 * once.stress[i][0], 1e-6 * 1e6 / size);
  }
}

/// A run that begins with the displacements of the equilibrium has no force on a free particle after its first step.
TEST(StaticEquilibrium, IsThatOfARun) {
  RunSetup<2> s = held_bar(0.3);
  const Motion still{0.0, 0.0};
  add_group(s, {"right", {Motion{1.0, 0.0}, still}, true}, [](const Vector& x) { return x[0] > (columns - 3) * size; });
  StaticLoad<2> load;
  for (const Vector& x : s.arrangement.position) load.displacement.push_back(vec(x[0] > 0.5 * columns * size, 0.0));
  const StaticState<2> state = StaticBody<2>(s).equilibrium(load);
  EXPECT_NEAR(state.reaction[0][0], -state.reaction[1][0], 1e-7 * state.reaction[1][0]);
  s.velocity = state.displacement;  // m/s
  Simulation<2> run(s);
  advance(run, 1);
  const Particles<2>& p = run.particles();
  double largest = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (s.arrangement.group[p.id[i]] >= 0) continue;
    largest = std::max(largest, p.mass[i] * std::hypot(p.acceleration[0][i], p.acceleration[1][i]));
  }
  EXPECT_LT(largest, 1e-5 * std::abs(run.reaction(1)[0]));
  EXPECT_GT(run.reaction(1)[0], 0.0);
}

TEST(StaticEquilibrium, WhatHasNoEnergyIsRefused) {
  RunSetup<2> s = held_bar(0.0);
  s.options.configuration = Configuration::updated;
  EXPECT_THROW(StaticBody<2>{s}, std::invalid_argument);
  s = held_bar(0.0);
  s.options.momentum = MomentumForm::paper;
  EXPECT_THROW(StaticBody<2>{s}, std::invalid_argument);
}

}  // namespace
}  // namespace fpz::sph::test
