// Faces that meet: nothing in tension, as if there were no cut in compression, Coulomb's friction in shear.
#include <cmath>

#include "fpz/sph/simulation.hpp"
#include "sph/engine/setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double spacing = 1e-3;

/// A block of columns x rows with a cut (or a slot) between two rows, its lowest and highest two rows in groups.
RunSetup<2> cut_block(int columns, int rows, double friction, double slot = 0.0) {
  RunSetup<2> s = block(columns, rows);
  const double height = rows * spacing, middle = 0.5 * height;
  if (slot > 0.0) {
    RunSetup<2> without = s;
    without.arrangement = {};
    without.arrangement.spacing = spacing;
    for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
      if (std::abs(s.arrangement.position[i][1] - middle) > 0.5 * slot) {
        without.arrangement.add(s.arrangement.position[i], s.arrangement.volume[i]);
      }
    }
    s = without;
  }
  Cut<2> cut{{vec(0.0, middle), vec(columns * spacing, middle)}, {}};
  cut.width = cut.gap = slot;
  cut.friction = friction;
  s.arrangement.cuts = {cut};
  return s;
}

/// Mean force by which the top is held during the last `part` of the time.
Vector force_at_end(Simulation<2>& run, double time, double part = 0.2) {
  return mean_force(run, (1.0 - part) * time, time);
}

double force_between_platens(RunSetup<2> s, double speed) {
  hold_ends(s, 40.0 * spacing, {"top", {std::nullopt, Motion{speed, 2e-4}}, true});
  Simulation<2> run(s);
  return force_at_end(run, 1e-3)[1];
}

TEST(Contact, AClosedCutIsAsStiffAsNone) {
  RunSetup<2> cut = cut_block(16, 40, 0.7), intact = cut, pass = cut;
  intact.arrangement.cuts.clear();
  pass.options.contact_stiffness = 0.0;
  const double whole = force_between_platens(intact, -0.02);
  EXPECT_NEAR(force_between_platens(cut, -0.02), whole, 0.01 * std::abs(whole));
  EXPECT_NEAR(force_between_platens(pass, -0.02), 0.0, 0.01 * std::abs(whole));
}

TEST(Contact, NothingHoldsFacesTogether) {
  RunSetup<2> with = cut_block(16, 20, 0.7), without = with;
  without.options.contact_stiffness = 0.0;
  for (RunSetup<2>* s : {&with, &without}) {
    hold_ends(*s, 20.0 * spacing, {"top", {Motion{0.5, 1e-5}, Motion{0.5, 1e-5}}, true});
  }
  Simulation<2> a(with), b(without);
  EXPECT_EQ(a.time_step(), b.time_step());
  advance(a, 500);
  advance(b, 500);
  // Faces that have not parted yet touch within the rounding of positions.
  for (std::size_t i = 0; i < a.particles().count; ++i) {
    ASSERT_NEAR(a.particles().position[1][i], b.particles().position[1][i], 1e-14) << i;
  }
  EXPECT_EQ(a.energies().contact, 0.0);
  EXPECT_LT(a.energies().friction, 1e-12 * a.energies().external);
}

TEST(Contact, ASlotBearsWhenItsWidthIsClosed) {
  constexpr double width = 2.0 * spacing, speed = 10.0, ramp = 1e-5;
  RunSetup<2> s = cut_block(16, 42, 0.7, width);
  hold_ends(s, 42.0 * spacing, {"top", {Motion{}, Motion{-speed, ramp}}, true});
  Simulation<2> run(s);
  while (run.energies().contact == 0.0 && run.time() < 1e-3) ASSERT_TRUE(run.step().ok());
  // The face follows the platen by the time of a wave, and hurries ahead of it by vibration.
  const double travelled = speed * (run.time() - 0.5 * ramp);
  EXPECT_NEAR(travelled, width, 0.05 * width);
}

/// Steady sliding of a flat block: shear over pressure is the friction, and what it dissipates is shear times slip.
TEST(Contact, SlidesAtItsFriction) {
  for (const double friction : {0.3, 0.7}) {
    RunSetup<2> s = cut_block(20, 12, friction);
    constexpr double speed = 0.06, ramp = 2e-4, time = 1.2e-3;
    hold_ends(s, 12.0 * spacing, {"top", {Motion{speed, ramp}, Motion{-0.05 * speed, ramp}}, true});
    Simulation<2> run(s);
    advance(run, static_cast<long long>(0.6 * time / run.time_step()));
    const double before = run.energies().friction, sheared = run.energies().elastic;
    double work = 0.0;
    while (run.time() < time) {
      ASSERT_TRUE(run.step().ok());
      work += run.reaction(1).dot(vec(speed, -0.05 * speed)) * run.time_step();
    }
    const Energies e = run.energies();
    EXPECT_NEAR(e.friction - before, work - (e.elastic - sheared), 0.01 * work);
    EXPECT_LT(std::abs(e.error()), 1e-9 * e.external);
    const Vector force = force_at_end(run, 1.5 * time);
    EXPECT_NEAR(force[0], -friction * force[1], 0.005 * force[0]);
  }
}

/// A block that slides down an inclined joint: g (sin - friction cos).
TEST(Contact, AccelerationOnAnInclinedPlane) {
  constexpr double pi = 3.14159265358979323846;
  constexpr double gravity = 2e4, friction = 0.2;
  for (const double degrees : {25.0, 40.0, 60.0}) {
    const double slope = degrees * pi / 180.0;
    RunSetup<2> s = cut_block(20, 16, friction);
    s.options.gravity = gravity * vec(std::sin(slope), -std::cos(slope));
    add_group(s, {"bottom", {Motion{}, Motion{}}, true}, [](const Vector& x) { return x[1] < 2.0 * spacing; });
    Simulation<2> run(s);
    double slid = 0.0;
    while (run.time() < 4e-4) {
      ASSERT_TRUE(run.step().ok());
      double momentum = 0.0, mass = 0.0;
      const Particles<2>& p = run.particles();
      for (std::size_t i = 0; i < p.count; ++i) {
        if (p.start[1][i] < 8.0 * spacing) continue;
        momentum += p.mass[i] * p.velocity[0][i];
        mass += p.mass[i];
      }
      slid += run.time_step() * momentum / mass;
    }
    const double acceleration = gravity * (std::sin(slope) - friction * std::cos(slope));
    const double expected = 0.5 * acceleration * run.time() * run.time();
    EXPECT_NEAR(slid, expected, 0.02 * expected) << degrees;
  }
}

/// Two free pieces that collide: their momentum stays, their kinetic energy is accounted for.
TEST(Contact, PiecesThatCollide) {
  RunSetup<2> s = cut_block(16, 42, 0.5, 2.0 * spacing);
  set_velocity(s, [](const Vector& x) { return x[1] > 21.0 * spacing ? vec(0.0, -2.0) : vec(0.0, 2.0); });
  Simulation<2> run(s);
  const auto spin = [](const Simulation<2>& r) {
    const Particles<2>& p = r.particles();
    double sum = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      sum += p.mass[i] * (p.position[0][i] * p.velocity[1][i] - p.position[1][i] * p.velocity[0][i]);
    }
    return sum;
  };
  const Vector before = momentum(run);
  const double spin_before = spin(run);
  double overlap = 0.0;
  while (run.time() < 6e-4) {
    ASSERT_TRUE(run.step().ok());
    overlap = std::max(overlap, run.overlap());
  }
  const Energies e = run.energies();
  const double scale = run.particles().mass[0] * static_cast<double>(run.particles().count) * 2.0;
  EXPECT_LT((momentum(run) - before).norm(), 1e-12 * scale);
  EXPECT_LT(std::abs(spin(run) - spin_before), 1e-9 * scale * 20.0 * spacing);
  EXPECT_GT(e.friction, 0.0);
  EXPECT_LT(std::abs(e.error()), 1e-4 * e.kinetic_start);
  EXPECT_LT(overlap, 0.01 * spacing);
  double upper = 0.0;
  for (std::size_t i = 0; i < run.particles().count; ++i) {
    if (run.particles().start[1][i] > 21.0 * spacing) upper = std::max(upper, run.particles().velocity[1][i]);
  }
  EXPECT_GT(upper, 0.0);  // it has turned round
}

/// A bar with an edge notch that is torn apart by 200 um and pushed together again, to 35 um.
RunSetup<2> torn_and_closed(double contact_stiffness, int threads = 1) {
  RunSetup<2> s = block(12, 30);
  s.parameters = concrete();
  s.parameters.choices.cohesive_zone = CohesiveZone::consistent;  // the published one gives energy
  s.options.contact_stiffness = contact_stiffness;
  s.options.threads = threads;
  s.arrangement.cuts = {Cut<2>{{vec(-spacing, 15.0 * spacing), vec(4.2 * spacing, 15.0 * spacing)}, {false, true}}};
  s.arrangement.cuts[0].friction = 0.7;
  const Drive way(Drive::Kind::displacement, TimeTable{{0.0, 1e-3, 2e-3}, {0.0, 200e-6, 35e-6}, true, 0.0});
  hold_ends(s, 30.0 * spacing, {"top", {Motion{}, way}, true});
  return s;
}

/// Mean force on the top between two moments.
double force_between(Simulation<2>& run, double from, double to) {
  double sum = 0.0, count = 0.0;
  while (run.time() < to) {
    const Outcome o = run.step();
    EXPECT_TRUE(o.ok()) << o.message();
    if (!o.ok()) break;
    if (run.time() >= from) sum += run.reaction(1)[1], count += 1.0;
  }
  return sum / count;
}

/// Momentum of what goes with the upper platen, which has moved by 200 um.
double momentum_above(const Simulation<2>& run) {
  const Particles<2>& p = run.particles();
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.position[1][i] - p.start[1][i] > 100e-6) sum += p.mass[i] * p.velocity[1][i];
  }
  return sum;
}

/// Up to the last step before a moment.
void advance_to(Simulation<2>& run, double time) {
  while (run.time() + run.time_step() < time) advance(run, 1);
}

/// Mean force across the crack between two moments: what the piece above it gets, less what the platen gives it. It
/// does not see how the piece vibrates.
double crack_force_between(Simulation<2>& run, double from, double to) {
  advance_to(run, from);
  const double before = momentum_above(run), begin = run.time();
  const double pushed = force_between(run, from, to);
  return (momentum_above(run) - before) / (run.time() - begin) - pushed;
}

/// The faces of a crack open freely, and bear when they meet again: here by what the cracked rows have kept of their
/// opening before it has gone back to zero.
TEST(Contact, FacesOfACrackThatClosesAgain) {
  Simulation<2> with(torn_and_closed(10.0)), without(torn_and_closed(0.0));
  const double peak = force_between(with, 1.8e-4, 2.2e-4);
  EXPECT_NEAR(peak, force_between(without, 1.8e-4, 2.2e-4), 1e-9 * peak);
  advance_to(with, 0.9e-3);  // open
  const double taken = with.energies().contact + with.energies().friction;
  advance_to(with, 1e-3);
  EXPECT_NEAR(with.energies().contact + with.energies().friction, taken, 1e-3 * with.energies().fracture);
  EXPECT_GT(with.released_bonds(), 50);
  EXPECT_LT(with.energies().contact, 1e-5 * with.energies().fracture);  // some bonds are cut before others
  EXPECT_LT(force_between(with, 1.98e-3, 2e-3), -peak);
  EXPECT_NEAR(force_between(without, 1.98e-3, 2e-3), 0.0, 0.1 * peak);
  const Energies e = with.energies();
  EXPECT_GT(e.contact, 0.0);
  EXPECT_GT(e.friction, 0.0);
  EXPECT_LT(std::abs(e.error()), 0.005 * e.external);  // rows that lose bonds under load change their stiffness
  EXPECT_LT(with.overlap(), 0.01 * spacing);
}

/// Between the faces of an open crack a few particles may still hang on both: less than one column of the twelve bears,
/// on average over bars that are torn a little faster or slower.
TEST(Contact, FacesOfAnOpenCrackAreFree) {
  double force = 0.0, peak = 0.0;
  for (const double opening : {160e-6, 180e-6, 200e-6, 220e-6, 240e-6}) {
    RunSetup<2> s = torn_and_closed(10.0);
    s.groups[1].drive[1] = Drive(Drive::Kind::displacement, TimeTable{{0.0, 1e-3}, {0.0, opening}, true, 0.0});
    Simulation<2> run(s);
    peak += force_between(run, 1.8e-4, 2.2e-4);
    advance_to(run, 0.7e-3);
    force += crack_force_between(run, 0.7e-3, 1e-3);
  }
  EXPECT_LT(std::abs(force), peak / 12.0);
}

TEST(Contact, FacesOfACrackInSnapshots) {
  Simulation<2> one(torn_and_closed(10.0)), two(torn_and_closed(10.0, 2));
  while (one.energies().contact == 0.0 && one.time() < 2e-3) advance(one, 50);
  EXPECT_GT(one.energies().contact, 0.0);
  two.restore(one.snapshot());
  advance(one, 300);
  advance(two, 300);
  EXPECT_GT(one.energies().friction, 0.0);
  EXPECT_EQ(one.snapshot(), two.snapshot());
}

/// A block that is dragged along by six spacings: friction stays, and what it has left bears nothing any more.
TEST(Contact, FacesThatSlideFarMeetWhatIsOpposite) {
  const double friction = 0.3, force = 2e4;
  RunSetup<2> s = cut_block(20, 12, friction);
  s.options.damping = 0.07;  // which also opposes the motion as a whole, a little
  Group<2> top{"top", {Motion{4.0, 4e-4}, std::nullopt}, true};
  top.drive[1] = Drive(Drive::Kind::force, TimeTable::rise(0.0, -force, 2e-4));
  hold_ends(s, 12.0 * spacing, top);
  Simulation<2> run(s);
  const Vector mean = force_at_end(run, 1.9e-3, 0.1);
  EXPECT_NEAR(mean[0], friction * force, 0.01 * friction * force);
  const Particles<2>& p = run.particles();
  double slid = 0.0, uncovered = 0.0, covered = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    slid = std::max(slid, p.position[0][i] - p.start[0][i]);
    const double below = 6.0 * spacing - p.start[1][i], x = p.start[0][i];
    if (below < 0.0 || below > spacing) continue;
    if (x < 4.0 * spacing) uncovered = std::max(uncovered, std::abs(p.stress[1][i]));
    if (x > 6.0 * spacing) covered -= p.stress[1][i] * spacing;
  }
  EXPECT_GT(slid, 6.0 * spacing);
  EXPECT_LT(uncovered, 0.05 * force / (14.0 * spacing));
  EXPECT_NEAR(covered, force, 0.1 * force);  // the row just below the face
  EXPECT_LT(std::abs(run.energies().error()), 1e-3 * run.energies().external);
}

/// A bar is torn apart by `opening`, put together again under a force, and its upper half dragged along by three
/// spacings.
Simulation<2> torn_and_dragged(double opening, double force) {
  RunSetup<2> s = torn_and_closed(10.0);
  s.options.damping = 0.07;
  s.groups[1].drive[1] = Drive(Drive::Kind::displacement, TimeTable{{0.0, 1e-3}, {0.0, opening}, true, 0.0});
  Simulation<2> run(s);
  advance_to(run, 1.1e-3);
  run.set_drive(1, 1, Drive(Drive::Kind::force, TimeTable::rise(0.0, -force, 4e-4)));
  advance_to(run, 1.6e-3);
  run.set_drive(1, 0, Drive(Drive::Kind::velocity, TimeTable::rise(0.0, 4.0, 2e-4)));
  return run;
}

/// The faces of a crack slide with the friction of the material, and bear where something is opposite. They are rough,
/// and which particles hook is chance: over many bars the ratio of the forces has a standard deviation of a third. The
/// mean over some is the friction within three standard errors and one step of a spacing in the crack's twelve.
TEST(Contact, FacesOfACrackThatSlideFar) {
  constexpr double force = 2e4;
  double count = 0.0, sum = 0.0, square = 0.0, error = 0.0, work = 0.0;
  for (double opening = 550e-6; opening < 615e-6; opening += 15e-6) {
    Simulation<2> run = torn_and_dragged(opening, force);
    const Vector mean = mean_force(run, 2.1e-3, 2.5e-3);
    EXPECT_NEAR(mean[1], -force, 0.01 * force);
    EXPECT_LT(run.overlap(), 0.01 * spacing);
    count += 1.0, sum -= mean[0] / mean[1], square += std::pow(mean[0] / mean[1], 2);
    error += std::abs(run.energies().error()), work += run.energies().external;
  }
  const double ratio = sum / count, standard_error = std::sqrt((square / count - ratio * ratio) / (count - 1.0));
  std::printf("friction %.3f +- %.3f, error %.2g of the work\n", ratio, standard_error, error / work);
  const double angle = concrete().friction_angle_deg * M_PI / 180.0, slope = std::atan(1.0 / 12.0);
  EXPECT_GT(ratio, std::tan(angle - slope) - 3.0 * standard_error);
  EXPECT_LT(ratio, std::tan(angle + slope) + 3.0 * standard_error);
  EXPECT_LT(standard_error, 0.25);
  EXPECT_LT(error, 1e-3 * work);
}

RunSetup<2> sliding(int threads) {
  RunSetup<2> s = cut_block(20, 12, 0.5);
  hold_ends(s, 12.0 * spacing, {"top", {Motion{0.5, 1e-5}, Motion{-0.1, 1e-5}}, true});
  s.options.threads = threads;
  return s;
}

TEST(Contact, ThreadsAndSnapshotsDoNotChangeABit) {
  Simulation<2> one(sliding(1)), three(sliding(3)), continued(sliding(1));
  advance(one, 400);
  EXPECT_GT(one.energies().friction, 0.0);
  continued.restore(one.snapshot());
  advance(one, 400);
  advance(continued, 400);
  advance(three, 800);
  EXPECT_EQ(one.snapshot(), continued.snapshot());
  EXPECT_EQ(one.snapshot(), three.snapshot());
}

TEST(Contact, IsOfTheReferenceConfigurationOnly) {
  RunSetup<2> s = cut_block(16, 20, 0.5);
  EXPECT_NEAR(Simulation<2>(s).overlap(), 0.0, 1e-15);
  s.options.configuration = Configuration::updated;
  EXPECT_TRUE(std::isnan(Simulation<2>(s).overlap()));
}

}  // namespace
}  // namespace fpz::sph::test
