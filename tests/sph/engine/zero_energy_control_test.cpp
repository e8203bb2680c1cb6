// Zero-energy control: the displacements that the gradient of the reference configuration does not see.
#include <cmath>
#include <numbers>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using Matrix = Mat<double, 2, 2>;

RunSetup<2> lattice(double control, const std::function<Vector(const Vector&)>& field, double jitter = 0.0) {
  RunSetup<2> s = block(24, 16, jitter);
  s.options.zero_energy_control = control;
  set_velocity(s, field);
  return s;
}

/// Alternates from particle to particle in both directions.
Vector checkerboard(const Vector& x) {
  const auto parity = [](double c) { return std::lround(c / 1e-3 - 0.5) % 2 == 0 ? 1.0 : -1.0; };
  return 0.01 * parity(x[0]) * parity(x[1]) * vec(1.0, 0.5);
}

/// Part of the alternating velocities that is left inside, 1 at the start.
double left(const Simulation<2>& run) {
  const Particles<2>& p = run.particles();
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.start[0][i] < 6e-3 || p.start[0][i] > 18e-3 || p.start[1][i] < 4e-3 || p.start[1][i] > 12e-3) continue;
    const Vector pattern = checkerboard(vec(p.start[0][i], p.start[1][i]));
    sum += pattern.dot(vec(p.velocity[0][i], p.velocity[1][i]));
    square += pattern.squaredNorm();
  }
  return sum / square;
}

/// A checkerboard has no gradient: it drifts without control. With it, every particle hangs on its four nearest
/// neighbours, which move the other way, by k = 0.2 (lambda + 2 mu) 0.75 10/(7 pi) each (the slope of the cubic spline
/// at one smoothing length; diagonal ones move along), so that omega^2 = 8 k/m.
TEST(ZeroEnergyControl, AlternatingDisplacementsOscillate) {
  for (const MomentumForm form : {MomentumForm::adjoint, MomentumForm::paper}) {
    RunSetup<2> off = lattice(0.0, checkerboard);
    RunSetup<2> on = lattice(0.2, checkerboard);
    off.options.momentum = on.options.momentum = form;
    off.options.courant = on.options.courant = 0.05;
    const Parameters& p = on.parameters;
    const double modulus =
        p.young_modulus * (1.0 - p.poisson_ratio) / ((1.0 + p.poisson_ratio) * (1.0 - 2.0 * p.poisson_ratio));
    const double stiffness = 0.2 * modulus * 0.75 * 10.0 / (7.0 * std::numbers::pi);
    const double omega = std::sqrt(8.0 * stiffness / (p.density * 1e-6));
    Simulation<2> free(off), controlled(on);
    const auto half_period = std::lround(std::numbers::pi / omega / controlled.time_step());
    advance(free, half_period);
    EXPECT_GT(left(free), 0.9);
    advance(controlled, half_period / 2);
    EXPECT_NEAR(left(controlled), 0.0, 0.05);
    advance(controlled, half_period - half_period / 2);
    EXPECT_NEAR(left(controlled), -1.0, 0.05);
  }
}

/// Its energy is stored, never negative, and given back: the balance closes and nothing is dissipated; prescribed
/// components included.
TEST(ZeroEnergyControl, ItsEnergyIsStored) {
  RunSetup<2> s = lattice(0.2, checkerboard, 0.1);
  s.options.courant = 0.1;
  add_group(s, {"left", {Motion{0.0, 0.0}, std::nullopt}, true}, [](const Vector& x) { return x[0] < 3e-3; });
  add_group(s, {"right", {Motion{0.02, 5e-6}, Motion{0.0, 0.0}}, true}, [](const Vector& x) { return x[0] > 21e-3; });
  Simulation<2> run(s);
  double most = 0.0;
  for (int k = 0; k < 400; ++k) {
    advance(run, 1);
    const Energies e = run.energies();
    EXPECT_LT(std::abs(e.error()), 1e-6 * e.kinetic_start);
    EXPECT_GE(e.zero_energy, 0.0);
    EXPECT_LT(std::abs(e.viscous), 0.02 * e.kinetic_start);  // of the order of the square of the time step
    most = std::max(most, e.zero_energy);
  }
  EXPECT_GT(most, 0.3 * run.energies().kinetic_start);
}

/// Affine motion meets no force of the zero-energy control on any arrangement, neither does half a turn.
TEST(ZeroEnergyControl, DoesNothingToAffineMotion) {
  Matrix a;
  a << 30.0, -20.0, 50.0, 10.0;
  const auto held = [](const std::function<Vector(const Vector&)>& field) {
    RunSetup<2> s = lattice(0.2, field, 0.25);
    s.options.courant = 1e-4;  // steps so short that it stays affine
    Simulation<2> run(s);
    advance(run, 50);
    return run.energies().zero_energy / run.energies().kinetic_start;
  };
  EXPECT_LT(held([&](const Vector& x) { return Vector(a * x); }), 1e-6 * held(checkerboard));

  const double omega = 2000.0;
  const Vector centre = vec(12e-3, 8e-3);
  RunSetup<2> spin =
      lattice(0.2, [&](const Vector& x) { return vec(-omega * (x[1] - centre[1]), omega * (x[0] - centre[0])); });
  Simulation<2> turning(spin);
  advance(turning, static_cast<long long>(0.5 * 3.14159 / omega / turning.time_step()));
  EXPECT_LT(turning.energies().zero_energy, 1e-6 * turning.energies().kinetic_start);
  EXPECT_LT(std::abs(turning.energies().viscous), 1e-6 * turning.energies().kinetic_start);
}

TEST(ZeroEnergyControl, ConservesMomentumAndMomentOfMomentum) {
  RunSetup<2> s = lattice(
      0.2, [](const Vector& x) { return Vector(checkerboard(x) + vec(0.0, 0.01 + x[0])); }, 0.2);
  s.options.courant = 0.01;  // the internal force, which keeps the moment only to the order of the strain, is small
  Simulation<2> run(s);
  const auto moment = [&] {
    const Particles<2>& p = run.particles();
    double sum = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      sum += p.mass[i] * (p.position[0][i] * p.velocity[1][i] - p.position[1][i] * p.velocity[0][i]);
    }
    return sum;
  };
  advance(run, 1);
  const Vector before = momentum(run);
  const double moment_before = moment();
  advance(run, 48);
  EXPECT_LT((momentum(run) - before).norm(), 1e-12 * before.norm());
  EXPECT_NEAR(moment() / moment_before, 1.0, 1e-8);
  EXPECT_GT(run.energies().zero_energy, 1e-3 * run.energies().kinetic_start);
}

/// However strong, and at any step: no wave grows, also where one action stands for several steps.
TEST(ZeroEnergyControl, IsStableAtAnyStrength) {
  for (const double control : {0.05, 0.2, 1.0, 10.0}) {
    for (const double courant : {0.3, 0.5, 10.0}) {
      RunSetup<2> s = lattice(
          control, [](const Vector& x) { return Vector(checkerboard(x) + vec(std::sin(5e3 * x[0]), 0.0)); }, 0.3);
      s.options.courant = courant;
      Simulation<2> run(s);
      advance(run, 4000);
      const Energies e = run.energies();
      EXPECT_LT(e.kinetic + e.elastic + e.zero_energy, 1.05 * e.kinetic_start) << control << " " << courant;
    }
  }
  RunSetup<2> weak = lattice(0.0, checkerboard);
  RunSetup<2> strong = lattice(10.0, checkerboard);
  EXPECT_LT(stability_limit(strong), 0.5 * stability_limit(weak));
}

/// What it held in bonds that end at a crack is dissipated, so that the balance is as good as without control (cracks
/// that open within a step leave an error of their own).
TEST(ZeroEnergyControl, WhatItHeldAtCracksIsDissipated) {
  RunSetup<2> with = torn(variants[0]);
  with.options.rve_length.rule = RveLength::Rule::spacing;  // nothing else is numerically lost
  RunSetup<2> without = with;
  without.options.zero_energy_control = 0.0;
  Simulation<2> free(without), controlled(with);
  advance(free, 1000);
  double last = 0.0;
  for (int k = 0; k < 40; ++k) {
    advance(controlled, 25);
    const Energies e = controlled.energies();
    EXPECT_GE(e.zero_energy, 0.0);
    EXPECT_GE(e.viscous, last * (1.0 - 1e-9));  // differences of energies, rounded
    last = e.viscous;
  }
  const Energies e = controlled.energies();
  EXPECT_GT(controlled.cracked(), 20U);
  EXPECT_GT(e.viscous, 0.0);
  EXPECT_LT(std::abs(e.error()), std::abs(free.energies().error()) + 1e-3 * e.external);
}

/// A notched bar is torn apart in tension. What bonds across its crack held would grow as the square of the opening;
/// and a run that is read back goes on without the bonds that were cut.
TEST(ZeroEnergyControl, HoldsLittleAcrossAnOpenCrack) {
  RunSetup<2> s = block(12, 30, 0.15);
  s.parameters = concrete();
  s.arrangement.cuts = {Cut<2>{{vec(-1e-3, 0.015), vec(4.2e-3, 0.015)}, {false, true}}};
  hold_ends(s, 0.03, {"top", {Motion{}, Motion{0.2, 2e-4}}, true});
  Simulation<2> run(s), again(s);
  while (run.time() < 8e-4) ASSERT_TRUE(run.step().ok());
  const Energies e = run.energies();
  EXPECT_LT(e.zero_energy, 0.02 * e.fracture);
  EXPECT_LT(std::abs(e.error()), 5e-3 * e.external);
  again.restore(run.snapshot());
  advance(run, 200);
  advance(again, 200);
  EXPECT_EQ(run.snapshot(), again.snapshot());
}

}  // namespace
}  // namespace fpz::sph::test
