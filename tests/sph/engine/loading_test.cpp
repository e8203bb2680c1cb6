// Boundaries driven by velocities, displacements and forces over time, stiffly or through a machine, and loads on
// particles: against closed forms, with the energy they give.
#include <cmath>
#include <stdexcept>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double size = 1e-3;  // m
constexpr int columns = 40, rows = 8, grip = 3;
const Drive still = Motion{0.0, 0.0};

TEST(TimeTable, IsStraightOrSmoothBetweenItsTimes) {
  TimeTable t{{0.0, 2.0, 3.0}, {1.0, 5.0, -1.0}, false, 10.0};
  EXPECT_EQ(t.at(0.0), 1.0);
  EXPECT_EQ(t.at(10.0), 1.0);
  EXPECT_DOUBLE_EQ(t.at(10.5), 2.0);
  EXPECT_DOUBLE_EQ(t.at(12.5), 2.0);
  EXPECT_EQ(t.at(13.0), -1.0);
  EXPECT_EQ(t.at(1e9), -1.0);
  EXPECT_EQ(t.end(), 13.0);
  t.smooth = true;
  EXPECT_DOUBLE_EQ(t.at(11.0), 3.0);
  EXPECT_DOUBLE_EQ(t.at(10.5), 1.0 + 4.0 * 0.15625);
  EXPECT_NEAR((t.at(12.0 + 1e-6) - t.at(12.0 - 1e-6)) / 2e-6, 0.0, 1e-4);
  EXPECT_EQ(problem_of(t), "");
  EXPECT_NE(problem_of({{0.0, 0.0}, {1.0, 2.0}, false, 0.0}), "");
  EXPECT_NE(problem_of({{0.0, 1.0}, {1.0}, false, 0.0}), "");
  EXPECT_NE(problem_of({{}, {}, false, 0.0}), "");
  EXPECT_NE(problem_of(TimeTable::constant(std::nan(""))), "");
}

/// A bar held at its left end, its right end driven along it. Without the artificial stress of `updated`, which makes
/// it softer in tension.
RunSetup<2> bar(Configuration configuration, const Drive& right) {
  RunSetup<2> s = block(columns, rows, 0.0, size);
  s.options.configuration = configuration;
  s.options.artificial_stress = 0.0;
  add_group(s, {"left", {still, std::nullopt}, true}, [](const Vector& x) { return x[0] < grip * size; });
  add_group(s, {"right", {right, std::nullopt}, true}, [](const Vector& x) { return x[0] > (columns - grip) * size; });
  return s;
}

/// Mean displacement along the bar of the two columns beside x: `updated` lets columns alternate.
double displacement(const Simulation<2>& run, double x) {
  const Particles<2>& p = run.particles();
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (std::abs(p.start[0][i] - x) < 0.6 * size) sum += (p.position[0][i] - p.start[0][i]) / (2.0 * rows);
  }
  return sum;
}

/// E/(1 - nu^2): of a bar in plane strain that is free to contract in the plane.
double modulus(const RunSetup<2>& s) {
  const double nu = s.parameters.poisson_ratio;
  return s.parameters.young_modulus / (1.0 - nu * nu);
}

void run_until(Simulation<2>& run, double time) {
  advance(run, static_cast<long long>(std::ceil((time - run.time()) / run.time_step())));
}

constexpr double period = 4.0 * columns * size / 4000.0;  // s, of the slowest vibration along the bar, about
const Configuration both[] = {Configuration::reference, Configuration::updated};

TEST(Loading, AForceStretchesABarAsTheClosedFormHasIt) {
  const double force = 8e4;  // N/m: 10 MPa
  for (const Configuration c : both) {
    RunSetup<2> s = bar(c, {Drive::Kind::force, TimeTable::rise(0.0, force, 30.0 * period)});
    Simulation<2> run(s);
    run_until(run, 31.0 * period);
    EXPECT_NEAR(run.reaction(1)[0], force, 1e-9 * force);
    EXPECT_NEAR(run.reaction(0)[0], -force, 5e-3 * force);
    const double stretch = displacement(run, 30.0 * size) - displacement(run, 10.0 * size);
    const double expected = 20.0 * size * force / (rows * size) / modulus(s);
    EXPECT_NEAR(stretch, expected, 5e-3 * expected);
    // What the force has done is half of it times its path, and is stored.
    const Energies e = run.energies();
    const double path = displacement(run, 39.0 * size);
    EXPECT_NEAR(e.external, 0.5 * force * path, 5e-3 * e.external);
    EXPECT_NEAR(e.elastic + e.zero_energy, e.external, 5e-3 * e.external);
    EXPECT_LT(std::abs(e.error()), 1e-3 * e.external);
  }
}

/// A force on a free body is mass times acceleration, whatever share of the body is driven.
TEST(Loading, AForceAcceleratesAFreeBody) {
  for (const Variant& v : variants) {
    RunSetup<2> s = block(6, 4, 0.0, size);
    s.options.configuration = v.configuration;
    s.options.momentum = v.momentum;
    add_group(s, {"all", {Drive{Drive::Kind::force, TimeTable::constant(5.0)}, std::nullopt}, true},
              [](const Vector&) { return true; });
    Simulation<2> run(s);
    advance(run, 100);
    double mass = 0.0;
    for (std::size_t i = 0; i < run.particles().count; ++i) mass += run.particles().mass[i];
    const double t = run.time(), moved = 0.5 * 5.0 / mass * t * t;
    EXPECT_NEAR(run.particles().position[0][0] - run.particles().start[0][0], moved, 1e-9 * moved);
    EXPECT_NEAR(run.velocity(0)[0], 5.0 / mass * (t + 0.5 * run.time_step()), 1e-9 * 5.0 / mass * t);
    EXPECT_NEAR(run.energies().external, 5.0 * moved, 1e-9 * 5.0 * moved);
    EXPECT_LT(std::abs(run.energies().error()), 1e-9 * 5.0 * moved);
  }
}

TEST(Loading, ADisplacementIsMetAndCyclesEndWhereTheyBegan) {
  const double u = 5e-6, leg = 20.0 * period;
  for (const Configuration c : both) {
    TimeTable cycles{{0.0, leg, 2.0 * leg, 3.0 * leg, 4.0 * leg}, {0.0, u, 0.0, -u, 0.0}, true, 0.0};
    Simulation<2> run(bar(c, {Drive::Kind::displacement, cycles}));
    run_until(run, leg);
    EXPECT_NEAR(displacement(run, 39.0 * size), cycles.at(run.time()), 1e-9 * u);
    const double force = run.reaction(1)[0], stored = run.energies().elastic;
    EXPECT_GT(force, 0.0);
    run_until(run, 3.0 * leg);
    EXPECT_NEAR(run.reaction(1)[0], -force, 5e-3 * force);
    run_until(run, 4.05 * leg);
    EXPECT_NEAR(displacement(run, 39.0 * size), 0.0, 1e-9 * u);
    EXPECT_LT(std::abs(run.reaction(1)[0]), 5e-3 * force);
    EXPECT_LT(std::abs(run.energies().external), 1e-3 * stored);
    EXPECT_LT(run.energies().elastic, 1e-3 * stored);
  }
}

/// A machine and a bar in series: their deflections add up to that of the drive, and both carry the force.
TEST(Loading, AMachineAndABarAreSpringsInSeries) {
  const double u = 8e-6, time = 30.0 * period;
  const TimeTable table = TimeTable::rise(0.0, u, time);
  for (const Configuration c : both) {
    Simulation<2> stiff(bar(c, {Drive::Kind::displacement, table}));
    run_until(stiff, 1.03 * time);
    const double own = stiff.reaction(1)[0] / u;  // N/m, per metre
    for (const double machine : {0.2 * own, 2.0 * own}) {
      Simulation<2> run(bar(c, {Drive::Kind::displacement, table, machine}));
      run_until(run, 1.03 * time);
      const double force = u / (1.0 / own + 1.0 / machine);
      EXPECT_NEAR(run.reaction(1)[0], force, 5e-3 * force) << machine / own;
      EXPECT_NEAR(displacement(run, 39.0 * size), u - force / machine, 5e-3 * u);
      EXPECT_LT(std::abs(run.energies().error()), 1e-3 * run.energies().external);
    }
  }
}

/// Hold a force, let it go, hold the place: the drive changes during the run and nothing jumps.
TEST(Loading, DrivesChangeDuringARun) {
  const double u = 5e-6, leg = 20.0 * period;
  Simulation<2> run(bar(Configuration::reference, {Drive::Kind::displacement, TimeTable::rise(0.0, u, leg)}));
  run_until(run, leg);
  const double force = run.reaction(1)[0];
  run.set_drive(1, 0, {Drive::Kind::force, TimeTable::constant(force)});
  run_until(run, 2.0 * leg);
  EXPECT_NEAR(displacement(run, 39.0 * size), u, 5e-3 * u);
  TimeTable release{{0.0, leg}, {force, 0.0}, true, run.time()};
  run.set_drive(1, 0, {Drive::Kind::force, release});
  run_until(run, 3.05 * leg);
  EXPECT_NEAR(displacement(run, 39.0 * size), 0.0, 5e-3 * u);
  // A stiff machine takes over at the force that is there.
  run.set_drive(1, 0, {Drive::Kind::force, TimeTable{{0.0, leg}, {0.0, force}, true, run.time()}});
  run_until(run, 4.1 * leg);
  run.set_drive(1, 0, {Drive::Kind::velocity, TimeTable::constant(0.0), 2.0 * force / u});
  run_until(run, 5.0 * leg);
  EXPECT_NEAR(run.reaction(1)[0], force, 1e-2 * force);
  run.set_drive(1, 0, {Drive::Kind::steered, TimeTable::constant(0.0)});
  run.steer(1, 0, 1e-3);
  advance(run, 1);
  EXPECT_EQ(run.velocity(1)[0], 1e-3);
  EXPECT_THROW(run.set_drive(1, 1, Motion{0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(run.set_drive(1, 0, Drive{Drive::Kind::force, TimeTable{{0.0, 0.0}, {1.0, 1.0}, false, 0.0}}),
               std::invalid_argument);
}

/// Loads on the particles of the right end stretch the bar as the same force on a grip does, and their work is booked,
/// with local damping too: it may not take them for forces out of balance.
TEST(Loading, LoadsOnParticlesStretchABar) {
  const double force = 8e4;
  for (const Configuration c : both) {
    RunSetup<2> s = block(columns, rows, 0.0, size);
    s.options.configuration = c;
    s.options.artificial_stress = 0.0;
    s.options.damping = 0.2;
    s.most_damping = 0.5;
    add_group(s, {"left", {still, std::nullopt}, true}, [](const Vector& x) { return x[0] < grip * size; });
    Load<2> load{"pull", {}, TimeTable::rise(0.0, force, 10.0 * period)};
    for (const Vector& x : s.arrangement.position) {
      load.force.push_back(vec(x[0] > (columns - grip) * size ? 1.0 / (grip * rows) : 0.0, 0.0));
    }
    s.loads.push_back(load);
    Simulation<2> run(s);
    run_until(run, 20.0 * period);
    EXPECT_NEAR(run.factor(0), force, 1e-9 * force);
    EXPECT_NEAR(run.reaction(0)[0], -force, 1e-3 * force);
    const double stretch = displacement(run, 30.0 * size) - displacement(run, 10.0 * size);
    const double expected = 20.0 * size * force / (rows * size) / modulus(s);
    EXPECT_NEAR(stretch, expected, 5e-3 * expected);
    const Energies e = run.energies();
    EXPECT_NEAR(e.elastic + e.zero_energy + e.damping + e.kinetic + e.viscous, e.external, 2e-3 * e.external);
    EXPECT_GT(e.elastic, 0.8 * e.external);
    run.set_factor(0, TimeTable{{0.0, 10.0 * period}, {force, 0.0}, true, run.time()});
    run.set_damping(0.5);
    run_until(run, 40.0 * period);
    EXPECT_LT(run.energies().elastic, 1e-4 * e.elastic);
    EXPECT_LT(std::abs(run.energies().error()), 2e-3 * e.external);
  }
}

/// Two platens that meet at a corner of the body do not hold each other.
TEST(Loading, GroupsThatKeepToThemselvesHaveNoBonds) {
  for (const Configuration c : both) {
    for (const bool alone : {false, true}) {
      RunSetup<2> s = block(4, 4, 0.0, size);
      s.options.configuration = c;
      add_group(s, {"left", {still, still}, true}, [](const Vector& x) { return x[0] < 2.0 * size; });
      add_group(s, {"right", {Motion{0.01, 1e-6}, still}, true}, [](const Vector& x) { return x[0] > 2.0 * size; });
      s.groups[0].keeps_to_itself = alone;
      Simulation<2> run(s);
      advance(run, 50);
      EXPECT_EQ(run.reaction(0)[0] == 0.0, alone);
    }
  }
}

TEST(Loading, SnapshotsHaveDrivesAndLoads) {
  for (const Variant& v : variants) {
    RunSetup<2> s = torn(v);
    s.most_damping = 0.3;
    s.groups[1].drive[0] =
        Drive{Drive::Kind::velocity, TimeTable{{0.0, 2e-5, 4e-5}, {0.0, 1.0, 0.5}, false, 0.0}, 1e11};
    Load<2> load{"push", {}, TimeTable{{0.0, 5e-5}, {0.0, 2e3}, false, 0.0}};
    for (const int g : s.arrangement.group) load.force.push_back(vec(0.0, g < 0 ? 1e-3 : 0.0));
    s.loads.push_back(load);
    add_group(s, {"shoe", {std::nullopt, Motion{0.1, 1e-5}}, true, vec(15e-3, 13.5e-3)},
              [](const Vector& x) { return std::abs(x[0] - 15e-3) < 2e-3 && x[1] > 12e-3; });
    for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
      if (s.arrangement.group[i] >= 0) s.loads[0].force[i].setZero();
    }
    const auto change = [](Simulation<2>& run) {
      run.set_drive(1, 0, {Drive::Kind::force, TimeTable{{0.0, 1e-5}, {1e4, 5e4}, true, run.time()}});
      run.set_factor(0, TimeTable{{0.0, 1e-5}, {3e3, -1e3}, true, run.time()});
      run.set_drive(0, 0, {Drive::Kind::steered, TimeTable::constant(0.0)});
      run.steer(0, 0, -0.5);
      run.set_damping(0.3);
    };
    Simulation<2> whole(s);
    advance(whole, 60);
    change(whole);
    advance(whole, 60);
    const std::vector<unsigned char> middle = whole.snapshot();
    advance(whole, 60);
    Simulation<2> continued(s);
    continued.restore(middle);
    advance(continued, 60);
    EXPECT_EQ(continued.snapshot(), whole.snapshot());
    EXPECT_EQ(continued.energies().external, whole.energies().external);
    RunSetup<2> other = s;
    other.loads[0].factor.value[1] = 1e3;
    EXPECT_THROW(Simulation<2>(other).restore(middle), std::runtime_error);
  }
}

/// A cantilever whose end is lifted by a platen: guided it has four times the bending stiffness of a hinged end, which
/// carries no moment (a bonded end that is free along the beam as a whole is guided). Timoshenko's beam in plane
/// strain.
TEST(Loading, AHingedPlatenCarriesNoMoment) {
  const double u = 2e-5, length = 54.0 * size, height = 8.0 * size;
  for (const Configuration c : both) {
    const auto lift = [&](bool hinged) {
      RunSetup<2> s = block(60, 8, 0.0, size);
      s.options.configuration = c;
      s.options.artificial_stress = 0.0;
      s.options.damping = 0.3;
      add_group(s, {"left", {still, still}, true}, [](const Vector& x) { return x[0] < 3.0 * size; });
      const Drive up(Drive::Kind::displacement, TimeTable::rise(0.0, u, 6e-4));
      Group<2> right{"right", {Drive{Drive::Kind::force, TimeTable::constant(0.0)}, up}, true};
      if (hinged) right.hinge = vec(57.0 * size, 4.0 * size);
      add_group(s, right, [](const Vector& x) { return x[0] > 57.0 * size; });
      Simulation<2> run(s);
      run_until(run, 2e-3);
      EXPECT_LT(std::abs(run.energies().error()), 2e-3 * run.energies().external);
      EXPECT_NEAR(run.reaction(0)[1], -run.reaction(1)[1], 0.01 * run.reaction(1)[1]);
      return run.reaction(1)[1] / u;  // N/m, per metre
    };
    const Parameters p = unbreakable();
    const double bending = modulus(block(1, 1)) * height * height * height / 12.0;
    const double shear = 5.0 / 6.0 * p.young_modulus / (2.0 * (1.0 + p.poisson_ratio)) * height;
    const double cubed = length * length * length;
    const double guided = 1.0 / (cubed / (12.0 * bending) + length / shear);
    const double hinged = 1.0 / (cubed / (3.0 * bending) + length / shear);
    // Their ratio: eight rows and the clamp of the other end make both softer by an eighth.
    EXPECT_NEAR(lift(true) / lift(false), hinged / guided, 0.06 * hinged / guided) << static_cast<int>(c);
  }
}

/// A hinged platen that nothing else holds spins and flies as the rigid body that it is.
TEST(Loading, AHingedPlatenIsARigidBody) {
  RunSetup<2> s = block(6, 4, 0.0, size);
  Group<2> all{"all", {Drive{Drive::Kind::force, TimeTable::constant(5.0)}, still}, true};
  all.hinge = vec(0.0, 2.0 * size);  // on its left side: the force pulls along the middle line
  add_group(s, all, [](const Vector&) { return true; });
  Simulation<2> run(s);
  advance(run, 100);
  double mass = 0.0;
  for (std::size_t i = 0; i < run.particles().count; ++i) mass += run.particles().mass[i];
  EXPECT_NEAR(run.velocity(0)[0], 5.0 / mass * (run.time() + 0.5 * run.time_step()), 1e-9);
  EXPECT_NEAR(run.velocity(0)[1], 0.0, 1e-12);
  // A force across it at a hinge at its end: the hinge of a uniform rod of length L accelerates by F/m (1 +
  // 3/(1+(h/L)^2)).
  RunSetup<2> rod = block(6, 4, 0.0, size);
  Group<2> end{"all", {std::nullopt, Drive{Drive::Kind::force, TimeTable::constant(5.0)}}, true};
  end.hinge = vec(0.0, 2.0 * size);
  add_group(rod, end, [](const Vector&) { return true; });
  Simulation<2> flying(rod);
  advance(flying, 100);
  double about = 0.0;  // moment of inertia about the middle
  for (std::size_t i = 0; i < flying.particles().count; ++i) {
    const Vector r = vec(flying.particles().start[0][i], flying.particles().start[1][i]) - vec(3.0 * size, 2.0 * size);
    about += flying.particles().mass[i] * r.squaredNorm();
  }
  const double give = 1.0 / mass + 9.0 * size * size / about;
  EXPECT_NEAR(flying.velocity(0)[1], 5.0 * give * (flying.time() + 0.5 * flying.time_step()),
              1e-6 * 5.0 * give * flying.time());
  EXPECT_LT(std::abs(flying.energies().error()), 1e-6 * flying.energies().external);
}

TEST(Loading, WrongDrivesAreRefused) {
  const auto problem = [](const RunSetup<2>& s) {
    std::string all;
    for (const std::string& p : problems(s)) all += p + "\n";
    return all;
  };
  RunSetup<2> s = bar(Configuration::reference, {Drive::Kind::force, TimeTable{{0.0, 1.0}, {0.0}, false, 0.0}});
  EXPECT_NE(problem(s).find("drive of group right: its table must have a value for each time"), std::string::npos);
  s = bar(Configuration::reference, {Drive::Kind::force, TimeTable::constant(0.0), 1e9});
  EXPECT_NE(problem(s).find("zero where a force drives it"), std::string::npos);
  s = bar(Configuration::reference, still);
  s.loads.push_back({"pull", std::vector<Vector>(s.arrangement.size(), vec(1.0, 0.0)), TimeTable::constant(1.0)});
  EXPECT_NE(problem(s).find("load pull: acts on particle 0, which belongs to a group"), std::string::npos);
  s.loads[0].force.clear();
  EXPECT_NE(problem(s).find("load pull: must have a force for each particle"), std::string::npos);
}

}  // namespace
}  // namespace fpz::sph::test
