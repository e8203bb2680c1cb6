// The same bits on any number of threads, with any instruction set, and after a snapshot; symmetry to rounding.
#include <cmath>
#include <stdexcept>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

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

/// All that a look shows is the same whether the steps store it or it is made for the look, and no look changes the
/// run.
TEST(Reproducibility, LooksInBetweenDoNotChangeABit) {
  for (const Variant& v : variants) {
    const RunSetup<2> s = torn(v);
    Simulation<2> unseen(s), seen(s), watched(s);
    const Particles<2>& all = watched.particles();
    for (int k = 0; k < steps / 4; ++k) {
      advance(unseen, 1), advance(seen, 1), advance(watched, 1);
      if (k % 7 != 0) continue;
      const Particles<2>& now = seen.particles_now();
      EXPECT_EQ(now.stress, all.stress) << k;
      EXPECT_EQ(now.strain, all.strain) << k;
      EXPECT_EQ(now.rotation, all.rotation) << k;
    }
    EXPECT_GT(unseen.cracked(), 5U);
    EXPECT_EQ(seen.snapshot(), watched.snapshot());
    EXPECT_EQ(unseen.snapshot(), watched.snapshot());
  }
}

/// Whether this processor has what the version needs: the library takes the next lower one otherwise.
bool available([[maybe_unused]] InstructionSet i) {
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") > 0;
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") > 0 && __builtin_cpu_supports("avx512vl") > 0 &&
                      __builtin_cpu_supports("avx512dq") > 0;
  return i == InstructionSet::avx2 ? avx2 : avx512;
#else
  return false;
#endif
}

class InstructionSets : public testing::TestWithParam<InstructionSet> {};

TEST_P(InstructionSets, DoNotChangeABit) {
  if (!available(GetParam())) GTEST_SKIP() << "this processor has no " << to_string(GetParam()) << ": nothing compared";
  for (const Variant& v : variants) {
    RunSetup<2> s = torn(v);
    s.options.instruction_set = InstructionSet::baseline;
    const std::vector<unsigned char> baseline = state_after(s, steps);
    s.options.instruction_set = GetParam();
    EXPECT_EQ(state_after(s, steps), baseline);
  }
}

INSTANTIATE_TEST_SUITE_P(Reproducibility, InstructionSets,
                         testing::Values(InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& set) { return std::string(to_string(set.param)); });

/// Everything that a run may use at once.
RunSetup<2> full(const Variant& v) {
  RunSetup<2> s = torn(v);
  s.options.gravity = vec(50.0, -1e3);
  s.options.mass_scale = 2.0;
  s.options.zero_energy_control = 0.3;
  s.options.skin = 0.02;  // lists are made anew before and after the snapshot
  return s;
}

/// Also into a run that has already been elsewhere: nothing of its own past is left.
TEST(Reproducibility, SnapshotContinuesBitForBit) {
  for (const Variant& v : variants) {
    const bool reference = v.configuration == Configuration::reference;
    const RunSetup<2> s = full(v);
    Simulation<2> whole(s);
    advance(whole, steps / 2);
    EXPECT_GT(whole.cracked(), 5U);
    EXPECT_EQ(whole.released_bonds() > 0, reference);
    EXPECT_EQ(whole.neighbour_builds() > 1, !reference);
    const std::vector<unsigned char> middle = whole.snapshot();
    advance(whole, steps / 2);
    for (const int past : {0, steps / 4, steps}) {
      Simulation<2> continued(s);
      advance(continued, past);
      continued.restore(middle);
      EXPECT_EQ(continued.snapshot(), middle) << past;
      advance(continued, steps / 2);
      EXPECT_EQ(continued.snapshot(), whole.snapshot()) << past;
      const Energies a = continued.energies();
      const Energies b = whole.energies();
      for (const EnergyTerm& term : energy_terms) EXPECT_EQ(a.*term.member, b.*term.member) << term.name;
      for (std::size_t g = 0; g < s.groups.size(); ++g) EXPECT_EQ(continued.reaction(g), whole.reaction(g));
    }
    const Energies e = whole.energies();
    EXPECT_GT(e.viscous, 0.0);
    EXPECT_GT(e.damping, 0.0);
    EXPECT_GT(e.fracture, 0.0);
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
