// Cracked particles: the library's curve, separation, energy.
#include <cmath>

#include "fpz/energy.hpp"
#include "fpz/update.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double spacing = 1e-3;

/// Two particles, one prescribed to stand, the other to leave at `speed` (m/s): uniform strain u/spacing in both.
RunSetup<2> pair(const Parameters& parameters, Configuration configuration, double speed, bool oblique) {
  RunSetup<2> s;
  s.parameters = parameters;
  s.options.configuration = configuration;
  s.options.threads = 1;
  s.options.viscosity_alpha = 0.0;
  s.options.artificial_stress = 0.0;
  s.options.rve_length = {RveLength::Rule::spacing, 0.0};
  s.arrangement.spacing = spacing;
  s.arrangement.add(vec(0.0, 0.0), spacing * spacing, 0);
  s.arrangement.add(vec(spacing, 0.0), spacing * spacing, 1);
  const Motion still{0.0, 0.0};
  const Motion slide{oblique ? 0.5 * speed : 0.0, 0.0};
  s.groups = {{"still", {still, still}, false}, {"moving", {Motion{speed, 0.0}, slide}, false}};
  return s;
}

/// The pair follows the library's single point on the strain path that its rotation and stretch prescribe.
void follow(const Parameters& parameters, Configuration configuration, bool oblique) {
  RunSetup<2> s = pair(parameters, configuration, 0.4, oblique);
  Simulation<2> run(s);
  Parameters p = parameters;
  p.rve_length = spacing;
  const Material<double> m = make_material(p, s.setting);
  fpz::Options o;
  o.method = Method::implicit;
  State2 point;
  bool cracked = false;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(run.step().ok());
    const Particles<2>& all = run.particles();
    Tensor<double, 2> increment;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto e = static_cast<int>(c);
      increment[e] = configuration == Configuration::updated ? all.strain[c][1] : all.strain[c][1] - point.strain[e];
    }
    ASSERT_TRUE(update<2>(m, o, point, increment, point).ok());
    if (configuration == Configuration::updated) {
      Mat<double, 2, 2> q;
      q << all.rotation[0][1], -all.rotation[1][1], all.rotation[1][1], all.rotation[0][1];
      rotate<double, 2>(point, q);
    }
    cracked = cracked || point.cracked;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(all.stress[c][i], point.stress[static_cast<int>(c)], 1e-9 * p.tensile_strength) << "step " << k;
      }
    }
  }
  EXPECT_TRUE(cracked);
  EXPECT_LT(point.crack.integrity, 0.5);
}

TEST(Fracture, PairInTensionFollowsTheLibrary) {
  for (const Configuration c : {Configuration::reference, Configuration::updated}) follow(concrete(), c, false);
}

TEST(Fracture, PairInMixedModeFollowsTheLibrary) {
  for (const Configuration c : {Configuration::reference, Configuration::updated}) {
    follow(concrete(), c, true);
    follow(fpz::test::table2(), c, true);  // inclined plane
  }
}

/// A single column of particles, and a column of pairs, torn apart between prescribed ends.
RunSetup<2> column(int rows, RveLength::Rule rule) {
  constexpr int columns = 12;
  RunSetup<2> s = block(columns, rows, 0.0, spacing);
  s.parameters = concrete();
  s.options.rve_length.rule = rule;
  s.options.damping = 0.3;
  const double speed = 0.05;
  const Motion still{0.0, 0.0};
  add_group(s, {"left", {Motion{-speed, 5e-4}, still}, true}, [](const Vector& x) { return x[0] < 2.0 * spacing; });
  add_group(s, {"right", {Motion{speed, 5e-4}, still}, true},
            [](const Vector& x) { return x[0] > (columns - 2) * spacing; });
  return s;
}

void column_follows(int rows) {
  const RunSetup<2> s = column(rows, RveLength::Rule::spacing);
  Simulation<2> run(s);
  fpz::Options o;
  o.method = Method::implicit;
  Material<double> m = make_material(s.parameters, s.setting);
  const Particles<2>& all = run.particles();
  std::vector<State2> points(all.count);
  double peak = 0.0;
  for (int k = 0; k < 9000; ++k) {
    ASSERT_TRUE(run.step().ok());
    peak = std::max(peak, run.reaction(1)[0] / (rows * spacing));
    for (std::size_t i = 0; i < all.count; ++i) {
      Tensor<double, 2> increment;
      for (std::size_t c = 0; c < 3; ++c) {
        increment[static_cast<int>(c)] = all.strain[c][i] - points[i].strain[static_cast<int>(c)];
      }
      if (all.kind[i] == kind::elastic) {
        points[i].strain += increment;
        points[i].stress = m.bulk.stress<double, 2>(points[i].strain);
      } else {
        set_rve_length(m, all.length[i]);
        ASSERT_TRUE(update<2>(m, o, points[i], increment, points[i]).ok());
      }
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(all.stress[c][i], points[i].stress[static_cast<int>(c)], 1e-9 * s.parameters.tensile_strength)
            << "step " << k << " particle " << all.id[i];
      }
    }
  }
  double integrity = 1.0;
  for (const State2& point : points) integrity = std::min(integrity, point.crack.integrity);
  EXPECT_LT(integrity, 0.1);
  EXPECT_NEAR(peak / s.parameters.tensile_strength, 1.0, 0.02);
}

TEST(Fracture, EveryParticleOfAColumnFollowsTheLibrary) {
  column_follows(1);
  column_follows(2);
}

double least_integrity(const Particles<2>& p) {
  double least = 1.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] == kind::cracked) least = std::min(least, p.point[i].crack.integrity);
  }
  return least;
}

/// With H measured while it opens, the particles of a crack have one jump, that of the body, and their volumes over H
/// add up to its area, however many of them share it. In a column of pairs the neighbours of each lie on one side: what
/// they make of the opening along the crack must not become a shear.
TEST(Fracture, RowsOfACrackHaveItsJumpAndItsArea) {
  for (const int rows : {1, 2}) {
    RunSetup<2> s = column(rows, RveLength::Rule::band);
    s.parameters.cohesion *= 2.0;  // mode I: the plane across the column
    Simulation<2> run(s);
    const Particles<2>& p = run.particles();
    for (int k = 0; k < 8000 && least_integrity(p) > 0.2; ++k) ASSERT_TRUE(run.step().ok());

    const double area = rows * spacing;
    const std::size_t left = run.slot(0), right = run.slot(s.arrangement.size() - 1);
    double opening = (p.position[0][right] - p.start[0][right]) - (p.position[0][left] - p.start[0][left]);
    for (std::size_t i = 0; i < p.count; ++i) {  // less what the stress stretches between the ends
      if (p.kind[i] != kind::elastic) opening -= p.stress[0][i] / s.parameters.young_modulus * p.volume[i] / area;
    }
    double shared = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      if (p.kind[i] != kind::cracked || p.point[i].crack.integrity > 0.9) continue;
      EXPECT_NEAR(p.point[i].crack.jump[0] / opening, 1.0, 0.02) << rows;
      shared += p.volume[i] / p.length[i];
    }
    EXPECT_NEAR(shared / area, 1.0, 0.02) << rows;
    EXPECT_GT(opening, s.parameters.delta0);
    const double dissipated = 1.0 - std::exp(-opening / s.parameters.delta0);
    EXPECT_NEAR(run.energies().fracture / (s.parameters.tensile_strength * s.parameters.delta0 * area), dissipated,
                0.02);
  }
}

/// Opening mode I to far beyond separation dissipates sigma_t delta0 per area, H wide: the exact fracture energy.
TEST(Fracture, PairDissipatesTheFractureEnergy) {
  RunSetup<2> s = pair(concrete(), Configuration::reference, 0.4, false);
  s.options.release_integrity = 0.0;
  Simulation<2> run(s);
  advance(run, 4000);
  const double opening = run.particles().point[0].crack.jump[0];
  const double exact = s.parameters.tensile_strength * s.parameters.delta0 * spacing;
  const Energies e = run.energies();
  EXPECT_GT(opening, 10.0 * s.parameters.delta0);
  EXPECT_NEAR(e.fracture / (2.0 * exact), 1.0, 2e-3);  // two particles, each with its crack
}

/// In `updated` an opening of a sixth of the spacing makes the particles a sixth larger, and the work done on them too.
TEST(Fracture, EnergyBalancesWhereParticlesGrowByTheirCracks) {
  RunSetup<2> s = pair(concrete(), Configuration::updated, 0.4, false);
  Simulation<2> run(s);
  advance(run, 4000);
  const Energies e = run.energies();
  EXPECT_GT(run.particles().point[0].crack.jump[0], 0.15 * spacing);
  EXPECT_GT(e.fracture, 0.9 * e.external);
  EXPECT_LT(std::abs(e.error()), 1e-3 * e.external);
}

/// A bar whose two middle columns may crack is torn by opposite velocities of its halves. Bonds across the open crack
/// are cut and the halves fly apart: momentum zero in all, no force between them in the end, energy balanced, the
/// fracture energy of one crack dissipated by the two columns whose H is their common width.
TEST(Fracture, TwoPiecesFlyApart) {
  RunSetup<2> s = block(24, 6, 0.0, spacing);
  s.parameters = concrete();
  s.options.courant = 0.15;
  s.options.release_integrity = 0.02;
  s.options.rve_length = {RveLength::Rule::number, 2.0 * spacing};
  add_group(s, {"left", {}, true}, [](const Vector& x) { return x[0] < 11e-3; });
  add_group(s, {"right", {}, true}, [](const Vector& x) { return x[0] > 13e-3; });
  const double v = 4.0;
  set_velocity(s, [v](const Vector& x) { return vec(x[0] < 12e-3 ? -v : v, 0.0); });
  Simulation<2> run(s);
  advance(run, 4000);
  const Particles<2>& p = run.particles();
  const auto half = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      if (p.start[0][i] > 12e-3) sum += p.mass[i] * p.velocity[0][i];
    }
    return sum;
  };
  const double first = half();
  advance(run, 2000);
  const double start = s.parameters.density * 72e-6 * v;
  const double gap = p.position[0][run.slot(23)] - p.position[0][run.slot(0)] - 23e-3;
  EXPECT_GT(gap, 0.9 * 2.0 * v * run.time());
  EXPECT_LT(momentum(run).norm(), 1e-12 * start);
  EXPECT_NEAR(half() / first, 1.0, 1e-9);
  EXPECT_GT(run.released_bonds(), 0);
  const Energies e = run.energies();
  EXPECT_LT(std::abs(e.error()), 1e-3 * e.kinetic_start);
  // Cut at an integrity of 2 %: that much of the energy is not dissipated.
  const double exact = s.parameters.tensile_strength * s.parameters.delta0 * 6e-3;
  EXPECT_NEAR(e.fracture / exact, 0.98, 0.03);
}

/// Largest principal stress over the strength in the middle of a block that flies apart in both directions, a little
/// faster in x, up to the time (s) at which the surfaces are felt there.
double largest_stress(double reorientation_damage, double until) {
  RunSetup<2> s = block(24, 24, 0.0, spacing);
  s.parameters = concrete();
  s.options.courant = 0.01;  // the other plane is seen a step late
  s.options.reorientation_damage = reorientation_damage;
  const double rate = 200.0;
  set_velocity(s, [&](const Vector& x) { return vec(rate * (x[0] - 12e-3), 0.97 * rate * (x[1] - 12e-3)); });
  Simulation<2> run(s);
  double most = 0.0;
  while (run.time() < until) {
    EXPECT_TRUE(run.step().ok());
    const Particles<2>& p = run.particles();
    for (std::size_t i = 0; i < p.count; ++i) {
      if (std::hypot(p.start[0][i] - 12e-3, p.start[1][i] - 12e-3) > 2e-3) continue;
      const double half = 0.5 * (p.stress[0][i] - p.stress[1][i]);
      most = std::max(most, 0.5 * (p.stress[0][i] + p.stress[1][i]) + std::hypot(half, p.stress[2][i]));
    }
  }
  EXPECT_GT(run.cracked(), 100U);
  return most / s.parameters.tensile_strength;
}

/// A particle that has cracked across x bears no more than its strength along y, where it fails next.
TEST(Fracture, YoungCracksTakeThePlaneThatFails) {
  const double until = 1.5e-6;
  EXPECT_GT(largest_stress(0.0, until), 1.5);
  EXPECT_LT(largest_stress(0.02, until), 1.02);
}

}  // namespace
}  // namespace fpz::sph::test
