// The same bits on any number of threads, with any instruction set, and after a snapshot; symmetry to rounding.
#include <cmath>
#include <stdexcept>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

/// A notched block torn at its ends: cracks grow, some particles crack early.
RunSetup<2> torn(const Variant& v) {
  RunSetup<2> s = block(30, 14);
  s.parameters = concrete();
  s.options.configuration = v.configuration;
  s.options.momentum = v.momentum;
  s.options.damping = 0.05;
  s.options.release_integrity = 0.3;
  RunSetup<2> notched = s;
  notched.arrangement = {};
  notched.arrangement.spacing = s.arrangement.spacing;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const Vector& x = s.arrangement.position[i];
    if (x[1] < 5e-3 && std::abs(x[0] - 15e-3) < 1e-3) continue;
    notched.arrangement.add(x, s.arrangement.volume[i]);
  }
  add_group(notched, {"left", {Motion{-1.0, 1e-6}, Motion{0.0, 0.0}}, true},
            [](const Vector& x) { return x[0] < 3e-3; });
  add_group(notched, {"right", {Motion{1.0, 1e-6}, std::nullopt}, true}, [](const Vector& x) { return x[0] > 27e-3; });
  return notched;
}

std::vector<unsigned char> state_after(RunSetup<2> s, int steps) {
  Simulation<2> run(s);
  advance(run, steps);
  EXPECT_GT(run.cracked(), 5U);
  return run.snapshot();
}

constexpr int steps = 400;

TEST(Reproducibility, ThreadsDoNotChangeABit) {
  for (const Variant& v : variants) {
    RunSetup<2> s = torn(v);
    const std::vector<unsigned char> one = state_after(s, steps / 4);
    for (const int threads : {2, 3}) {
      s.options.threads = threads;
      EXPECT_EQ(state_after(s, steps / 4), one) << threads;
    }
  }
}

TEST(Reproducibility, InstructionSetsDoNotChangeABit) {
  for (const Variant& v : variants) {
    RunSetup<2> s = torn(v);
    s.options.instruction_set = InstructionSet::baseline;
    const std::vector<unsigned char> baseline = state_after(s, steps);
    for (const InstructionSet i : {InstructionSet::avx2, InstructionSet::avx512}) {
      s.options.instruction_set = i;
      EXPECT_EQ(state_after(s, steps), baseline);
    }
  }
}

TEST(Reproducibility, SnapshotContinuesBitForBit) {
  for (const Variant& v : variants) {
    const RunSetup<2> s = torn(v);
    Simulation<2> whole(s);
    advance(whole, steps / 2);
    EXPECT_EQ(whole.released_bonds() > 0, v.configuration == Configuration::reference);
    const std::vector<unsigned char> middle = whole.snapshot();
    advance(whole, steps / 2);
    Simulation<2> continued(s);
    continued.restore(middle);
    EXPECT_EQ(continued.snapshot(), middle);
    advance(continued, steps / 2);
    EXPECT_EQ(continued.snapshot(), whole.snapshot());
    EXPECT_EQ(continued.energies().external, whole.energies().external);
  }
}

TEST(Reproducibility, BadSnapshotsAreRefused) {
  RunSetup<2> s = torn(variants[0]);
  Simulation<2> run(s);
  advance(run, 10);
  std::vector<unsigned char> bytes = run.snapshot();
  Simulation<2> other(s);
  EXPECT_THROW(other.restore(std::span(bytes).first(20)), std::runtime_error);
  EXPECT_THROW(other.restore(std::span(bytes).first(bytes.size() - 8)), std::runtime_error);
  s.options.courant *= 0.5;
  Simulation<2> different(s);
  EXPECT_THROW(different.restore(bytes), std::runtime_error);
  bytes[bytes.size() / 2] ^= 1U;
  EXPECT_THROW(other.restore(bytes), std::runtime_error);
}

/// Largest difference of |velocity| between a run and the same set-up turned and mirrored, over the largest |velocity|.
double asymmetry(const Variant& v, double angle, bool mirror) {
  RunSetup<2> s = block(16, 10);
  s.options.configuration = v.configuration;
  s.options.momentum = v.momentum;
  set_velocity(s, [](const Vector& x) { return vec(0.3 * std::sin(300.0 * x[0]) + 20.0 * x[1], -15.0 * x[0]); });
  RunSetup<2> t = s;
  Mat<double, 2, 2> q;
  q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  if (mirror) q.col(0) *= -1.0;
  for (Vector& x : t.arrangement.position) x = q * x;
  for (Vector& u : t.velocity) u = q * u;
  Simulation<2> a(s);
  Simulation<2> b(t);
  advance(a, 100);
  advance(b, 100);
  double worst = 0.0;
  double largest = 0.0;
  for (std::size_t k = 0; k < s.arrangement.size(); ++k) {
    const std::size_t i = a.slot(k);
    const std::size_t j = b.slot(k);
    const Vector ua = q * vec(a.particles().velocity[0][i], a.particles().velocity[1][i]);
    const Vector ub = vec(b.particles().velocity[0][j], b.particles().velocity[1][j]);
    worst = std::max(worst, (ua - ub).norm());
    largest = std::max(largest, ua.norm());
  }
  return worst / largest;
}

TEST(Reproducibility, RotationAndMirrorSymmetry) {
  for (const Variant& v : variants) {
    EXPECT_LT(asymmetry(v, 0.7, false), 1e-9);
    EXPECT_LT(asymmetry(v, 0.0, true), 1e-9);
    EXPECT_LT(asymmetry(v, -2.0, true), 1e-9);
  }
}

}  // namespace
}  // namespace fpz::sph::test
