// Steps in one sweep and in two passes are the same to the bit, whatever happens between strains and forces.
#include <cmath>

#include "engine.hpp"
#include "fpz/sph/archive.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using detail::Engine;

struct Seen {
  std::vector<unsigned char> state;
  double most = 0.0, least = 1.0;  ///< part of the blocks that one sweep has finished in a step
  std::size_t cracked = 0;
  bool pressed = false;
  long long released = 0;
};

Seen run(RunSetup<2> s, int steps, bool in_one, int threads = 1, InstructionSet set = InstructionSet::best) {
  s.options.threads = threads;
  s.options.instruction_set = set;
  Engine<2> e(s, 0.5 * time_step(s));
  e.run.in_one_sweep = in_one;
  e.run.chunk_blocks = 2;  // many, as in large bodies
  e.body->plan_sweep();
  Seen seen;
  for (int k = 0; k < steps; ++k) {
    const Outcome o = e.step();
    EXPECT_TRUE(o.ok()) << o.message();
    if (!o.ok()) break;
    const double part = e.body->sweep().early_part();
    seen.most = std::max(seen.most, part);
    if (e.body->sweep().in_one()) seen.least = std::min(seen.least, part);
    seen.pressed = seen.pressed || (e.contact && e.contact->presses());
  }
  seen.cracked = e.run.cracked.size();
  seen.released = e.body->released();
  Writer w(1);
  e.save(w);
  seen.state = std::move(w).sealed();
  return seen;
}

/// Compares; what the run in one sweep by one thread has seen.
Seen expect_same_bits(const RunSetup<2>& s, int steps) {
  const Seen two = run(s, steps, false), one = run(s, steps, true);
  EXPECT_EQ(two.most, 0.0);
  EXPECT_GT(one.most, 0.9);  // before anything happens: faces of cuts are held
  EXPECT_EQ(one.state, two.state);
  for (const int threads : {2, 3}) EXPECT_EQ(run(s, steps, true, threads).state, two.state) << threads;
  EXPECT_EQ(run(s, steps, true, 1, InstructionSet::baseline).state, two.state);
  return one;
}

TEST(OneSweep, CracksDoNotChangeABit) {
  for (const Variant& v : variants) {
    const Seen seen = expect_same_bits(torn(v), 300);
    EXPECT_GT(seen.cracked, 5U);
    EXPECT_EQ(seen.least < 0.9, v.configuration == Configuration::reference) << seen.least;
  }
}

/// Cuts, contact of their faces and of those of cracks; rows are rewritten.
TEST(OneSweep, FacesOfCracksDoNotChangeABit) {
  const Seen seen = expect_same_bits(torn_block(), 600);
  EXPECT_GT(seen.cracked, 10U);
  EXPECT_GT(seen.released, 0);
  EXPECT_LT(seen.least, 0.9);
}

/// The same on a lattice across the order of the coordinates.
TEST(OneSweep, ATurnedLatticeDoesNotChangeABit) {
  RunSetup<2> s = torn_block();
  const auto turn = [](Vector& x) { x = vec(0.8 * x[0] - 0.6 * x[1], 0.6 * x[0] + 0.8 * x[1]); };
  for (Vector& x : s.arrangement.position) turn(x);
  for (Vector& x : s.arrangement.cuts[0].corner) turn(x);
  EXPECT_GT(expect_same_bits(s, 400).cracked, 10U);
}

TEST(OneSweep, ScatteredParticlesDoNotChangeABit) {
  RunSetup<2> s = block(40, 24, 0.15);
  s.parameters = concrete();
  s.options.gradient = Gradient::kernel;
  add_group(s, {"left", {Motion{-1.0, 1e-6}, Motion{0.0, 0.0}}, true}, [](const Vector& x) { return x[0] < 3e-3; });
  add_group(s, {"right", {Motion{1.0, 1e-6}, std::nullopt}, true}, [](const Vector& x) { return x[0] > 37e-3; });
  EXPECT_GT(expect_same_bits(s, 300).cracked, 10U);
}

/// Forces on some particles, and faces that press and slide.
TEST(OneSweep, PushesDoNotChangeABit) {
  RunSetup<2> s = block(40, 24);
  Cut<2> cut{{vec(0.0, 12e-3), vec(40e-3, 12e-3)}, {}};
  cut.friction = 0.3;
  s.arrangement.cuts = {cut};
  hold_ends(s, 24e-3, {"top", {Motion{1.0, 1e-5}, Motion{-0.5, 1e-5}}, true});
  Load<2> load{"push", {}, TimeTable::rise(0.0, 1.0, 1e-5)};
  for (const Vector& x : s.arrangement.position) load.force.push_back(vec(x[0] < 2e-3 ? 10.0 : 0.0, 0.0));
  s.loads.push_back(load);
  const Seen seen = run(s, 300, true);
  EXPECT_TRUE(seen.pressed);
  EXPECT_GT(seen.most, 0.3);
  EXPECT_LT(seen.most, 1.0);
  EXPECT_EQ(seen.state, run(s, 300, false).state);
  EXPECT_EQ(seen.state, run(s, 300, true, 3).state);
}

/// Small bodies stay in caches: they take two passes.
TEST(OneSweep, IsForLargeBodies) {
  EXPECT_FALSE(Engine<2>(block(40, 24), 1.0).run.in_one_sweep);
  RunSetup<2> s = block(260, 130);
  s.options.gradient = Gradient::kernel;
  EXPECT_TRUE(Engine<2>(s, 1.0).run.in_one_sweep);
  s.options.threads = 16;
  EXPECT_FALSE(Engine<2>(s, 1.0).run.in_one_sweep);
}

}  // namespace
}  // namespace fpz::sph::test
