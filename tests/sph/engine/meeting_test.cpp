// Faces that meet though they did not face each other at the start: separate blocks, pieces that have broken off.
#include <cmath>
#include <numbers>

#include "fpz/sph/simulation.hpp"
#include "sph/engine/setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double spacing = 1e-3;
constexpr double apart = 6.0 * spacing;  // they have no bonds

/// Blocks of `columns` x `rows`, the upper one `apart` above the lower one and `shifted` columns to the right.
RunSetup<2> two_blocks(int columns, int rows, int shifted = 0, double friction_deg = 30.0) {
  RunSetup<2> s = block(columns, rows);
  s.parameters.friction_angle_deg = friction_deg;
  add_lattice<2>(s.arrangement, vec(shifted * spacing, rows * spacing + apart),
                 vec((columns + shifted) * spacing, 2 * rows * spacing + apart));
  return s;
}

bool is_upper(const Vector& start, int rows) { return start[1] > rows * spacing + 0.5 * apart; }

double spin(const Simulation<2>& run) {
  const Particles<2>& p = run.particles();
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    sum += p.mass[i] * (p.position[0][i] * p.velocity[1][i] - p.position[1][i] * p.velocity[0][i]);
  }
  return sum;
}

/// Mean velocity of one of the blocks.
Vector velocity(const Simulation<2>& run, int rows, bool upper) {
  const Particles<2>& p = run.particles();
  Vector sum = vec(0.0, 0.0);
  double mass = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (is_upper(vec(p.start[0][i], p.start[1][i]), rows) != upper) continue;
    sum += p.mass[i] * vec(p.velocity[0][i], p.velocity[1][i]);
    mass += p.mass[i];
  }
  return sum / mass;
}

/// Bars of equal length without lateral strain exchange their velocities: the wave runs once to and fro.
TEST(Meeting, BarsThatCollideExchangeTheirVelocities) {
  constexpr int rows = 40;
  RunSetup<2> s = two_blocks(8, rows);
  s.parameters.poisson_ratio = 0.0;
  set_velocity(s, [](const Vector& x) { return vec(0.0, is_upper(x, rows) ? -5.0 : 5.0); });
  Simulation<2> run(s);
  const double mass = run.particles().mass[0] * static_cast<double>(run.particles().count);
  double overlap = 0.0, touching = 0.0;
  while (run.time() < 7e-4) {
    ASSERT_TRUE(run.step().ok());
    overlap = std::max(overlap, run.overlap());
    touching += run.energies().contact > 0.0 ? run.time_step() : 0.0;
  }
  std::printf("speeds %.4f of those before, friction %.4f of the kinetic energy\n",
              (velocity(run, rows, true) - velocity(run, rows, false))[1] / 10.0,
              run.energies().friction / run.energies().kinetic_start);
  const Vector up = velocity(run, rows, true), down = velocity(run, rows, false);
  EXPECT_LT(momentum(run).norm(), 1e-12 * mass * 5.0);
  EXPECT_LT(std::abs(spin(run)), 1e-9 * mass * 5.0 * rows * spacing);
  EXPECT_NEAR(up[1] - down[1], 10.0, 0.5);  // what lacks vibrates: a front is a few particles wide
  EXPECT_NEAR(touching, 2.0 * rows * spacing / std::sqrt(s.parameters.young_modulus / s.parameters.density),
              0.1 * touching);
  const Energies e = run.energies();
  EXPECT_LT(std::abs(e.error()), 1e-6 * e.kinetic_start);
  EXPECT_LT(e.friction, 0.02 * e.kinetic_start);
  EXPECT_LT(overlap, 0.05 * spacing);
}

/// Blocks that meet with half of their faces, moving aside as well.
TEST(Meeting, ObliqueCollisionKeepsMomentumSpinAndEnergy) {
  constexpr int rows = 16;
  RunSetup<2> s = two_blocks(16, rows, 8);
  set_velocity(s, [](const Vector& x) { return is_upper(x, rows) ? vec(2.0, -5.0) : vec(-2.0, 5.0); });
  Simulation<2> run(s);
  const double mass = run.particles().mass[0] * static_cast<double>(run.particles().count);
  const double before = spin(run);
  while (run.time() < 1e-3) ASSERT_TRUE(run.step().ok());
  const Energies e = run.energies();
  EXPECT_LT(momentum(run).norm(), 1e-12 * mass * 5.0);
  EXPECT_NEAR(spin(run), before, 1e-5 * std::abs(before));
  EXPECT_GT(velocity(run, rows, true)[1], 0.5);
  EXPECT_GT(e.friction, 0.0);
  EXPECT_LT(std::abs(e.error()), 1e-4 * e.kinetic_start);
  EXPECT_EQ(e.contact, 0.0);
}

/// The lower block rests on its lowest rows; the upper one is driven down by what `top` says.
void hold(RunSetup<2>& s, int rows, const Group<2>& top) { hold_ends(s, 2.0 * rows * spacing + apart, top); }

/// Mean force by which the top is held between now and `time`.
Vector mean_force_until(Simulation<2>& run, double time) { return mean_force(run, run.time(), time); }

void advance_to(Simulation<2>& run, double time) {
  while (run.time() < time) advance(run, 1);
}

TimeTable starting(double time, TimeTable table) {
  table.start = time;
  return table;
}

/// A block that was moved on to another one presses on it evenly, and the faces do not overlap.
TEST(Meeting, ABlockThatLandsBears) {
  constexpr int rows = 16, columns = 20;
  for (const bool meets : {true, false}) {
    RunSetup<2> s = two_blocks(columns, rows);
    s.options.damping = 0.3;
    s.options.contact_stiffness = meets ? 10.0 : 0.0;
    const double compressed = 10e-6;
    const Drive way(Drive::Kind::displacement, TimeTable{{0.0, 1e-3}, {0.0, -apart - compressed}, true, 0.0});
    hold(s, rows, {"top", {Motion{}, way}, true});
    Simulation<2> run(s);
    advance_to(run, 1.6e-3);
    const Vector force = mean_force_until(run, 1.8e-3);
    // Between even and confined by the platens.
    const double area = columns * spacing, free = 2.0 * (rows - 2) * spacing, nu = s.parameters.poisson_ratio;
    const double stiffness = s.parameters.young_modulus / (1.0 - nu * nu) * area / free;
    if (!meets) {
      EXPECT_NEAR(force[1], 0.0, 1e-3 * stiffness * compressed);
      continue;
    }
    EXPECT_NEAR(-force[1], stiffness * compressed, 0.06 * stiffness * compressed);
    EXPECT_LT(run.overlap(), 0.01 * spacing);
    EXPECT_LT(std::abs(run.energies().error()), 1e-3 * run.energies().external);
  }
}

/// A block is pressed on another one, dragged along it and off its end.
TEST(Meeting, ABlockSlidesOffAnother) {
  constexpr int rows = 10, columns = 16;
  constexpr double force = 2e4;
  RunSetup<2> s = two_blocks(columns, rows, 4, 20.0);
  s.options.damping = 0.07;
  const double friction = std::tan(20.0 * pi / 180.0);
  const Drive down(Drive::Kind::displacement, TimeTable{{0.0, 1e-3}, {0.0, -apart}, true, 0.0});
  hold(s, rows, {"top", {Motion{}, down}, true});
  Simulation<2> run(s);
  advance_to(run, 1.1e-3);
  run.set_drive(1, 1, Drive(Drive::Kind::force, starting(1.1e-3, TimeTable::rise(0.0, -force, 4e-4))));
  advance_to(run, 1.8e-3);
  run.set_drive(1, 0, Drive(Drive::Kind::velocity, starting(1.8e-3, TimeTable::rise(0.0, 4.0, 4e-4))));
  advance_to(run, 2.4e-3);
  const double before = run.energies().friction;
  const Vector mean = mean_force_until(run, 3.2e-3);  // slides by 3.2 spacings
  // Damping resists the motion as a whole too, but takes nothing from the friction.
  EXPECT_NEAR(mean[1], -force, 0.01 * force);
  EXPECT_NEAR(run.energies().friction - before, friction * force * 3.2 * spacing,
              0.01 * friction * force * 3.2 * spacing);
  std::printf("friction %.4f of Coulomb's\n", (run.energies().friction - before) / (friction * force * 3.2 * spacing));
  EXPECT_LT(run.overlap(), 0.01 * spacing);
  EXPECT_LT(std::abs(run.energies().error()), 1e-3 * run.energies().external);
  const Energies e = run.energies();
  run.set_drive(1, 1, Drive(Drive::Kind::velocity, TimeTable::constant(0.0)));
  run.set_drive(1, 0, Drive(Drive::Kind::velocity, starting(3.2e-3, TimeTable::rise(4.0, 20.0, 1e-4))));
  advance_to(run, 4.2e-3);
  EXPECT_EQ(run.energies().contact, 0.0);  // it has gone past the end
  EXPECT_GT(run.energies().friction, e.friction);
}

/// The part of a disc of `radius` about (0, y) that lies within `depth` of the x axis, with its outline.
void add_cap(RunSetup<2>& s, double y, double radius, double depth) {
  const double half = std::sqrt(radius * radius - std::pow(radius - depth, 2)), side = y > 0.0 ? 1.0 : -1.0;
  const double begin = std::abs(y) - radius, low = y > 0.0 ? begin : -begin - depth;
  add_lattice<2>(s.arrangement, vec(-spacing * std::ceil(half / spacing), low),
                 vec(spacing * std::ceil(half / spacing), low + depth), Arrangement<2>::specimen,
                 [&](const Vector& x) { return (x - vec(0.0, y)).norm() < radius; });
  std::vector<Vector> outline;
  const double widest = std::asin(half / radius);
  for (int k = -200; k <= 200; ++k) {
    const double angle = widest * k / 200.0;
    outline.push_back(vec(radius * std::sin(angle), y - side * radius * std::cos(angle)));
  }
  outline.push_back(outline.front());
  s.arrangement.surface.push_back(outline);
}

/// Half width of the contact of two discs, from the second moment of the stress in the rows beside it: a quarter of its
/// square under the pressure of Hertz, and the depth squared for the way down to the row (Flamant).
TEST(Meeting, DiscsTouchAsWideAsHertzSays) {
  constexpr double radius = 120.0 * spacing, depth = 24.0 * spacing, gap = 1.5 * spacing;
  RunSetup<2> s = block(0, 0);
  s.options.damping = 0.3;
  add_cap(s, -radius - gap, radius, depth);
  add_cap(s, radius + gap, radius, depth);
  add_group(s, {"bottom", {Motion{}, Motion{}}, true},
            [&](const Vector& x) { return x[1] < -depth - gap + 2.0 * spacing; });
  const Drive way(Drive::Kind::displacement, TimeTable{{0.0, 5e-4}, {0.0, -2.0 * gap - 0.35 * spacing}, true, 0.0});
  add_group(s, {"top", {Motion{}, way}, true}, [&](const Vector& x) { return x[1] > depth + gap - 2.0 * spacing; });
  Simulation<2> run(s);
  advance_to(run, 8e-4);
  const double force = -mean_force_until(run, 8.5e-4)[1];
  const Particles<2>& p = run.particles();
  double sum = 0.0, square = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double into = std::abs(p.start[1][i]) - gap;
    if (into > 1.0 * spacing || std::abs(p.position[0][i]) > 14.0 * spacing) continue;
    sum -= p.stress[1][i];
    square -= p.stress[1][i] * p.position[0][i] * p.position[0][i];
  }
  const double half_width = 2.0 * std::sqrt(square / sum - 0.25 * spacing * spacing);
  const double nu = s.parameters.poisson_ratio, modulus = s.parameters.young_modulus / (1.0 - nu * nu) / 2.0;
  const double hertz = std::sqrt(4.0 * force * (radius / 2.0) / (pi * modulus));
  EXPECT_GT(hertz, 3.0 * spacing);
  EXPECT_NEAR(half_width, hertz, 0.05 * hertz);
  EXPECT_LT(run.overlap(), 0.02 * spacing);
  std::printf("half width %.4g mm, Hertz %.4g mm, force %.4g N (rows %.4g), overlap %.3g um\n", 1e3 * half_width,
              1e3 * hertz, force, 0.5 * sum * spacing, 1e6 * run.overlap());
}

/// A bar is torn apart by `opening`; its upper part is lifted, moved aside by six spacings and put down again on what
/// it did not face.
RunSetup<2> torn_and_moved(double opening) {
  RunSetup<2> s = block(16, 30);
  s.parameters = concrete();
  s.parameters.choices.cohesive_zone = CohesiveZone::consistent;  // debris: the published one gives energy
  s.options.damping = 0.05;
  s.arrangement.cuts = {Cut<2>{{vec(-spacing, 15.0 * spacing), vec(4.2 * spacing, 15.0 * spacing)}, {false, true}}};
  s.arrangement.cuts[0].friction = 0.7;
  add_group(s, {"bottom", {Motion{}, Motion{}}, true}, [](const Vector& x) { return x[1] < 2.0 * spacing; });
  const TimeTable up{{0.0, 1e-3, 1.5e-3, 3e-3, 4e-3}, {0.0, opening, 3e-3, 3e-3, 0.0}, true, 0.0};
  const TimeTable aside{{0.0, 1.5e-3, 3e-3}, {0.0, 0.0, 6e-3}, true, 0.0};
  add_group(s, {"top", {Drive(Drive::Kind::displacement, aside), Drive(Drive::Kind::displacement, up)}, true},
            [](const Vector& x) { return x[1] > 28.0 * spacing; });
  return s;
}

/// Ten columns bear, more than sixteen did in tension; their rough faces are crushed. How much is chance: the mean of
/// some bars, which are torn differently.
TEST(Meeting, ABrokenPieceLandsElsewhere) {
  double force = 0.0, error = 0.0, work = 0.0;
  for (const double opening : {280e-6, 300e-6, 320e-6}) {
    const RunSetup<2> s = torn_and_moved(opening);
    Simulation<2> run(s);
    advance_to(run, 3e-3);
    EXPECT_GT(run.released_bonds(), 50);
    EXPECT_LT(run.energies().contact, 0.01 * run.energies().fracture);  // debris
    advance_to(run, 3.95e-3);
    force -= mean_force_until(run, 4e-3)[1] / 3.0;
    EXPECT_LT(run.overlap(), 0.02 * spacing);
    error += std::abs(run.energies().error()), work += run.energies().external;
  }
  EXPECT_GT(force, 16.0 * spacing * concrete().tensile_strength);
  EXPECT_LT(error, 5e-3 * work);
  std::printf("force %.4g N, error %.3g of the work\n", force, error / work);
}

TEST(Meeting, ThreadsAndSnapshotsDoNotChangeABit) {
  constexpr int rows = 12;
  const auto setup = [](int threads) {
    RunSetup<2> s = two_blocks(16, rows, 6);
    s.options.threads = threads;
    set_velocity(s, [](const Vector& x) { return is_upper(x, rows) ? vec(2.0, -20.0) : vec(-2.0, 20.0); });
    return s;
  };
  Simulation<2> one(setup(1)), three(setup(3)), continued(setup(1));
  while (one.energies().contact == 0.0 && one.time() < 1e-3) advance(one, 10);
  EXPECT_GT(one.energies().contact, 0.0);
  continued.restore(one.snapshot());
  const long long steps = one.steps();
  advance(one, 200);
  advance(continued, 200);
  advance(three, steps + 200);
  EXPECT_EQ(one.snapshot(), continued.snapshot());
  EXPECT_EQ(one.snapshot(), three.snapshot());
}

}  // namespace
}  // namespace fpz::sph::test
