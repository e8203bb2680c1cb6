// Bodies of several materials against closed forms.
#include "fpz/sph/materials.hpp"

#include <cmath>
#include <complex>

#include "fpz/material.hpp"
#include "fpz/sph/static_equilibrium.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double mm = 1e-3;
const Motion still{0.0, 0.0};

/// Gives the particles for which `inside` holds another material.
void add_material(RunSetup<2>& s, const Parameters& p, const std::function<bool(const Vector&)>& inside) {
  s.materials.further.push_back(p);
  s.materials.of_particle.resize(s.arrangement.size(), 0);
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    if (inside(s.arrangement.position[i])) s.materials.of_particle[i] = static_cast<int>(s.materials.further.size());
  }
}

/// Without lateral contraction: layers do not hinder each other.
Parameters without_contraction(double factor) {
  Parameters p = unbreakable();
  p.poisson_ratio = 0.0;
  p.young_modulus *= factor;
  return p;
}

/// Forces of 1 Pa at the right end of a bar of so many columns and rows of 1 mm.
StaticLoad<2> pull(const RunSetup<2>& s, int columns) {
  StaticLoad<2> load;
  for (const Vector& x : s.arrangement.position) load.force.push_back(vec(x[0] > (columns - 1) * mm ? mm : 0.0, 0.0));
  return load;
}

double mean_in_column(const RunSetup<2>& s, int column, const std::function<double(std::size_t)>& value) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    if (static_cast<int>(s.arrangement.position[i][0] / mm) == column) sum += value(i), count += 1.0;
  }
  return sum / count;
}

/// Flexibilities add up, and the stress goes through: alternating about the right one in the rows beside the interface.
TEST(Materials, LayersInSeriesAddTheirFlexibilities) {
  constexpr int columns = 60;
  RunSetup<2> s = block(columns, 12);
  s.parameters = without_contraction(1.0);
  add_material(s, without_contraction(4.0), [](const Vector& x) { return x[0] > 30.0 * mm; });
  add_group(s, {"left", {still, std::nullopt}, true}, [](const Vector& x) { return x[0] < mm; });
  const StaticState<2> state = StaticBody<2>(s).equilibrium(pull(s, columns));
  const auto stress = [&](std::size_t i) { return state.stress[i][0]; };
  const auto moved = [&](std::size_t i) { return state.displacement[i][0]; };
  for (int c = 8; c < columns - 8; ++c) {
    const int away = c < 30 ? 29 - c : c - 30;
    if (away == 0 || away >= 6) {
      EXPECT_NEAR(mean_in_column(s, c, stress), 1.0, away == 0 ? 0.15 : 0.01) << c;
    }
  }
  EXPECT_NEAR(0.5 * (mean_in_column(s, 29, stress) + mean_in_column(s, 30, stress)), 1.0, 0.01);
  const double stretch = mean_in_column(s, 50, moved) - mean_in_column(s, 10, moved);
  const double exact = (19.5 * mm + 20.5 * mm / 4.0) / s.parameters.young_modulus;
  EXPECT_NEAR(stretch / exact, 1.0, 0.005);
}

/// Stiffnesses add up, and each layer has its stress.
TEST(Materials, LayersInParallelAddTheirStiffnesses) {
  constexpr int columns = 40, rows = 12;
  RunSetup<2> s = block(columns, rows);
  s.parameters = without_contraction(1.0);
  add_material(s, without_contraction(4.0), [](const Vector& x) { return x[1] > 6.0 * mm; });
  add_group(s, {"held", {still, still}, true},
            [](const Vector& x) { return x[0] < 3.0 * mm || x[0] > (columns - 3) * mm; });
  const double strain = 1e-5;
  StaticLoad<2> load;
  for (const Vector& x : s.arrangement.position) load.displacement.push_back(vec(strain * x[0], 0.0));
  const StaticState<2> state = StaticBody<2>(s).equilibrium(load);
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const Vector& x = s.arrangement.position[i];
    const bool inner = x[0] > 3.0 * mm && x[0] < (columns - 3) * mm;
    const double exact = strain * s.parameters.young_modulus * (x[1] > 6.0 * mm ? 4.0 : 1.0);
    if (inner) {
      EXPECT_NEAR(state.stress[i][0], exact, 5e-3 * exact);
    }
  }
}

/// The disc of another stiffness in a plate under even stress: its own stress is even (Lame for equal tension in both
/// directions, Goodier for shear).
struct Inclusion {
  static constexpr double radius = 12.0 * mm, half = 30.0 * mm;
  RunSetup<2> setup;
  Elasticity<double> plate, disc;

  Inclusion() : setup(block(60, 60)) {
    for (Vector& x : setup.arrangement.position) x -= vec(half, half);
    Parameters other = setup.parameters;
    other.young_modulus *= 3.0;
    other.poisson_ratio = 0.1;
    add_material(setup, other, [](const Vector& x) { return x.norm() < radius; });
    add_group(setup, {"rim", {still, still}, true},
              [](const Vector& x) { return x.cwiseAbs().maxCoeff() > half - 3.0 * mm; });
    plate = make_material(setup.parameters, setup.setting).bulk;
    disc = make_material(other, setup.setting).bulk;
  }

  /// Mean of a stress component of the disc away from its rim.
  double inner_stress(const std::function<Vector(const Vector&)>& rim, int component) {
    StaticLoad<2> load;
    for (const Vector& x : setup.arrangement.position) load.displacement.push_back(rim(x));
    const StaticState<2> state = StaticBody<2>(setup).equilibrium(load);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < setup.arrangement.size(); ++i) {
      if (setup.arrangement.position[i].norm() < 0.7 * radius) sum += state.stress[i][component], count += 1.0;
    }
    return sum / count;
  }
};

TEST(Materials, AnInclusionHasTheEvenStressOfTheClosedForm) {
  Inclusion body;
  // Plate u = A r + B/r, disc u = c r: displacement and radial stress go through at the radius.
  const double a2 = Inclusion::radius * Inclusion::radius, c = 1e-6;
  const double k = body.plate.lambda + body.plate.mu, inner = body.disc.lambda + body.disc.mu;
  const double far = c * (inner + body.plate.mu) / (k + body.plate.mu), near = (c - far) * a2;
  const double even = body.inner_stress([&](const Vector& x) { return Vector((far + near / x.squaredNorm()) * x); }, 0);
  EXPECT_NEAR(even / (2.0 * inner * c), 1.0, 0.02);

  // Complex potentials phi = alpha/z, psi = i far z + alpha a2/z^3 outside, psi = i inside z inside.
  using Complex = std::complex<double>;
  const double mu = body.plate.mu, kappa = 3.0 - 4.0 * body.plate.nu, far_stress = 2.0 * mu * 1e-6;
  const double exact = far_stress * body.disc.mu * (kappa + 1.0) / (mu + kappa * body.disc.mu);
  const Complex i(0.0, 1.0), alpha = i * a2 * (far_stress - exact);
  const auto rim = [&](const Vector& x) {
    const Complex z(x[0], x[1]), conjugate = std::conj(z);
    const Complex u = kappa * alpha / z + std::conj(alpha) * z / (conjugate * conjugate) + i * far_stress * conjugate -
                      std::conj(alpha * a2) / (conjugate * conjugate * conjugate);
    return vec(u.real() / (2.0 * mu), u.imag() / (2.0 * mu));
  };
  const double sheared = body.inner_stress(rim, 2);
  EXPECT_NEAR(sheared / exact, 1.0, 0.02);
}

/// Where the impedance doubles a wave goes on with two thirds of its velocity and four thirds of its stress.
TEST(Materials, AWaveIsReflectedAsTheImpedancesSay) {
  constexpr int columns = 400;
  constexpr double dx = 0.25 * mm, speed = 0.01;
  RunSetup<2> s = block(columns, 4, 0.0, dx);
  Parameters other = s.parameters;
  other.young_modulus *= 2.0;
  other.density *= 2.0;  // the same celerity, twice the impedance
  add_material(s, other, [](const Vector& x) { return x[0] > 50.0 * mm; });
  add_group(s, {"walls", {std::nullopt, still}, true}, [](const Vector&) { return true; });
  add_group(s, {"driven", {Motion{speed, 1e-6}, still}, true}, [](const Vector& x) { return x[0] < dx; });
  const Material<double> m = make_material(s.parameters, s.setting);
  const double celerity = std::sqrt((m.bulk.lambda + 2.0 * m.bulk.mu) / s.parameters.density);
  Simulation<2> run(s);
  advance(run, static_cast<long long>(80.0 * mm / celerity / run.time_step()));
  const Particles<2>& p = run.particles();
  const auto mean = [&](const Field& f, double from, double to) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      if (p.start[0][i] > from && p.start[0][i] < to) sum += f[i], count += 1.0;
    }
    return sum / count;
  };
  const double first = -s.parameters.density * celerity * speed;
  EXPECT_NEAR(mean(p.stress[0], 5.0 * mm, 15.0 * mm) / first, 1.0, 0.005);
  EXPECT_NEAR(mean(p.stress[0], 30.0 * mm, 45.0 * mm) / first, 4.0 / 3.0, 0.005);
  EXPECT_NEAR(mean(p.stress[0], 55.0 * mm, 70.0 * mm) / first, 4.0 / 3.0, 0.005);
  EXPECT_NEAR(mean(p.velocity[0], 30.0 * mm, 45.0 * mm) / speed, 2.0 / 3.0, 0.005);
  EXPECT_NEAR(mean(p.velocity[0], 55.0 * mm, 70.0 * mm) / speed, 2.0 / 3.0, 0.005);
}

/// The same material under two names is the same run, bit by bit.
TEST(Materials, TwoNamesOfOneMaterialChangeNothing) {
  for (const Variant& v : variants) {
    const RunSetup<2> one = torn(v);
    RunSetup<2> two = one;
    add_material(two, two.parameters, [](const Vector& x) { return x[0] > 12.0 * mm; });
    Simulation<2> a(one), b(two);
    advance(a, 300);
    advance(b, 300);
    ASSERT_GT(a.cracked(), 0U);
    EXPECT_EQ(a.particles().stress, b.particles().stress);
    EXPECT_EQ(a.particles().position, b.particles().position);
  }
}

/// Halves of different stiffness, density and strength are torn apart: momentum and energy stay.
TEST(Materials, MomentumAndEnergyAreConserved) {
  RunSetup<2> s = block(24, 10);
  s.parameters = concrete();
  Parameters other = concrete();
  other.young_modulus *= 0.3;
  other.density *= 0.5;
  other.tensile_strength *= 0.5;
  add_material(s, other, [](const Vector& x) { return x[0] + x[1] > 17.0 * mm; });
  s.options.release_integrity = 0.02;
  s.options.courant = 0.15;
  const double v = 3.0;
  set_velocity(s, [v](const Vector& x) { return vec(x[0] < 12.0 * mm ? -v : v, 0.3 * v * x[1] / (10.0 * mm)); });
  Simulation<2> run(s);
  const Vector before = momentum(run);
  advance(run, 3000);
  EXPECT_GT(run.cracked(), 10U);
  EXPECT_LT((momentum(run) - before).norm(), 1e-11 * before.norm());
  const Energies e = run.energies();
  EXPECT_LT(std::abs(e.error()), 2e-3 * e.kinetic_start);
}

/// A snapshot of a body of two materials goes on bit for bit, and belongs to no other.
TEST(Materials, SnapshotsKnowThem) {
  RunSetup<2> s = torn(variants[0]);
  Parameters other = s.parameters;
  other.young_modulus *= 0.7;
  add_material(s, other, [](const Vector& x) { return x[0] > 12.0 * mm; });
  Simulation<2> a(s), b(s);
  advance(a, 200);
  b.restore(a.snapshot());
  advance(a, 100);
  advance(b, 100);
  EXPECT_EQ(a.particles().stress, b.particles().stress);
  s.materials.of_particle[0] = 1 - s.materials.of_particle[0];
  EXPECT_THROW(Simulation<2>(s).restore(a.snapshot()), std::runtime_error);
}

/// A strip pulled apart breaks where it is weak, at that strength, and dissipates the fracture energy of that place.
TEST(Materials, AWeakPartBreaksAtItsOwnStrengthWithItsOwnEnergy) {
  constexpr int rows = 6;
  RunSetup<2> s = block(30, rows);
  s.parameters = concrete();
  Parameters weak = concrete();
  weak.tensile_strength *= 0.5;
  weak.delta0 *= 0.6;
  add_material(s, weak, [](const Vector& x) { return std::abs(x[0] - 15.0 * mm) < 3.0 * mm; });
  s.options.release_integrity = 0.02;
  add_group(s, {"left", {Motion{-0.001, 1e-4}, std::nullopt}, true}, [](const Vector& x) { return x[0] < 3.0 * mm; });
  add_group(s, {"right", {Motion{0.001, 1e-4}, std::nullopt}, true}, [](const Vector& x) { return x[0] > 27.0 * mm; });
  Simulation<2> run(s);
  const Particles<2>& p = run.particles();
  double peak = 0.0;
  const auto pull_until = [&](double end) {
    while (run.time() < end) {
      ASSERT_TRUE(run.step().ok());
      peak = std::max(peak, run.reaction(1)[0] / (rows * mm));
    }
  };
  pull_until(1.2e-3);
  EXPECT_NEAR(peak / weak.tensile_strength, 1.0, 0.02);
  run.set_drive(0, 0, Motion{-0.01, 2e-4});
  run.set_drive(1, 0, Motion{0.01, 2e-4});
  pull_until(1.2e-3 + 6.0 * weak.delta0 / 0.02);
  for (std::size_t i = 0; i < p.count; ++i) {
    if (s.materials.of_particle[p.id[i]] == 0) {
      EXPECT_NE(p.kind[i], kind::cracked);
    }
  }
  EXPECT_GT(run.cracked(), 4U);
  EXPECT_NEAR(run.energies().fracture / (weak.tensile_strength * weak.delta0 * rows * mm), 1.0, 0.05);
}

TEST(Materials, WhatIsWrongIsSaid) {
  RunSetup<2> s = block(6, 6);
  Parameters other = s.parameters;
  other.cohesion = 1.0;
  add_material(s, other, [](const Vector& x) { return x[0] > 3.0 * mm; });
  ASSERT_EQ(problems(s).size(), 1U);
  EXPECT_NE(problems(s)[0].find("material 1: cohesion"), std::string::npos);
  s.materials.further[0] = s.parameters;
  s.materials.of_particle[3] = 2;
  EXPECT_EQ(problems(s).size(), 1U);
  s.materials.of_particle.clear();
  EXPECT_EQ(problems(s).size(), 1U);
}

}  // namespace
}  // namespace fpz::sph::test
