// Zero-energy control: the velocities that the gradient of the reference configuration does not see.
#include <cmath>

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

/// Alternates from particle to particle in both directions, or from column to column.
Vector checkerboard(const Vector& x) {
  const auto parity = [](double c) { return std::lround(c / 1e-3 - 0.5) % 2 == 0 ? 1.0 : -1.0; };
  return vec(0.01 * parity(x[0]) * parity(x[1]), 0.01 * parity(x[0]));
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

TEST(ZeroEnergyControl, RemovesAlternatingVelocities) {
  for (const MomentumForm form : {MomentumForm::adjoint, MomentumForm::paper}) {
    RunSetup<2> off = lattice(0.0, checkerboard);
    RunSetup<2> on = lattice(Options<2>{}.zero_energy_control, checkerboard);
    off.options.momentum = on.options.momentum = form;
    Simulation<2> free(off), controlled(on);
    advance(free, 10);
    EXPECT_GT(left(free), 0.9);
    advance(free, 1990);
    advance(controlled, 2000);
    EXPECT_LT(std::abs(left(controlled)), 0.02);
    EXPECT_LT(controlled.energies().kinetic, 0.05 * free.energies().kinetic);
  }
}

/// The energy that it takes is reported, and the balance closes; prescribed components included.
TEST(ZeroEnergyControl, ItsWorkIsReported) {
  RunSetup<2> s = lattice(0.01, checkerboard, 0.1);
  add_group(s, {"left", {Motion{0.0, 0.0}, std::nullopt}, true}, [](const Vector& x) { return x[0] < 3e-3; });
  add_group(s, {"right", {Motion{0.02, 5e-6}, Motion{0.0, 0.0}}, true}, [](const Vector& x) { return x[0] > 21e-3; });
  Simulation<2> run(s);
  double last = 0.0;
  for (int k = 0; k < 400; ++k) {
    advance(run, 1);
    const Energies e = run.energies();
    EXPECT_LT(std::abs(e.error()), 1e-6 * e.kinetic_start);
    EXPECT_GE(e.viscous, last - 1e-9 * e.kinetic_start);
    last = e.viscous;
  }
  EXPECT_GT(last, 0.3 * run.energies().kinetic_start);
}

/// Affine motion meets no force of the zero-energy control on any arrangement (steps so short that it stays affine),
/// neither does a spin through half a turn.
TEST(ZeroEnergyControl, DoesNothingToAffineMotion) {
  Matrix a;
  a << 30.0, -20.0, 50.0, 10.0;
  const auto taken = [](const std::function<Vector(const Vector&)>& field) {
    RunSetup<2> s = lattice(0.01, field, 0.25);
    s.options.courant = 1e-4;
    Simulation<2> run(s);
    advance(run, 50);
    return run.energies().viscous / run.energies().kinetic_start;
  };
  EXPECT_LT(taken([&](const Vector& x) { return Vector(a * x); }), 1e-6 * taken(checkerboard));

  const double omega = 2000.0;
  const Vector centre = vec(12e-3, 8e-3);
  RunSetup<2> spin =
      lattice(0.01, [&](const Vector& x) { return vec(-omega * (x[1] - centre[1]), omega * (x[0] - centre[0])); });
  Simulation<2> turning(spin);
  advance(turning, static_cast<long long>(0.5 * 3.14159 / omega / turning.time_step()));
  EXPECT_LT(std::abs(turning.energies().viscous), 1e-6 * turning.energies().kinetic_start);
}

TEST(ZeroEnergyControl, ConservesMomentumAndMomentOfMomentum) {
  RunSetup<2> s = lattice(
      0.02, [](const Vector& x) { return Vector(checkerboard(x) + vec(0.0, 0.01 + x[0])); }, 0.2);
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
  EXPECT_GT(run.energies().viscous, 1e-3 * run.energies().kinetic_start);
}

/// However strong: the interval and the time step follow, and no run explodes.
TEST(ZeroEnergyControl, IsStableAtAnyStrength) {
  for (const double control : {0.01, 0.1, 1.0, 10.0}) {
    RunSetup<2> s = lattice(
        control, [](const Vector& x) { return vec(std::sin(5e3 * x[0]), std::cos(4e3 * x[1])); }, 0.3);
    s.options.gradient = Gradient::kernel;  // whose strength the bound on the rates counts with
    s.options.courant = 10.0;
    Simulation<2> run(s);
    advance(run, 2000);
    EXPECT_LT(run.energies().kinetic, run.energies().kinetic_start) << control;
    EXPECT_GT(run.energies().viscous, 0.0);
  }
  RunSetup<2> weak = lattice(0.0, checkerboard);
  RunSetup<2> strong = lattice(10.0, checkerboard);
  EXPECT_LT(stability_limit(strong), 0.2 * stability_limit(weak));
}

}  // namespace
}  // namespace fpz::sph::test
