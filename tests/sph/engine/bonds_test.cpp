// The order of the particles and the forms in which their bonds are kept: alike bonds once, neighbours in a row at
// once.
#include <algorithm>
#include <random>

#include "bond_rows.hpp"
#include "engine.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using detail::Engine;

/// A disc of 60 spacings on a lattice turned by an angle, in random order.
Arrangement<2> turned_disc(double degrees) {
  constexpr double spacing = 2e-3, radius = 30.0;
  Arrangement<2> a;
  a.spacing = spacing;
  const double angle = degrees * M_PI / 180.0;
  std::vector<Vector> points;
  for (int i = -45; i <= 45; ++i) {
    for (int j = -45; j <= 45; ++j) {
      const Vector x = vec(std::cos(angle) * i - std::sin(angle) * j, std::sin(angle) * i + std::cos(angle) * j);
      if (x.norm() < radius) points.push_back(spacing * (x + vec(3.3, 7.7)));
    }
  }
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  for (const Vector& x : points) a.add(x, spacing * spacing);
  return a;
}

RunSetup<2> setup_of(Arrangement<2> arrangement) {
  RunSetup<2> s;
  s.parameters = concrete();
  s.arrangement = std::move(arrangement);
  s.options.threads = 1;
  return s;
}

double part_of(const std::vector<int>& places) {
  const auto found = std::count_if(places.begin(), places.end(), [](int p) { return p >= 0; });
  return static_cast<double>(found) / static_cast<double>(places.size());
}

detail::Bonds<2> bonds_of(const RunSetup<2>& s) {
  detail::RunData<2> run(s, 1.0);
  detail::NeighbourLists lists =
      detail::find_neighbours<2>(run.team, run.particles.start, run.particles.count, kernel_support * run.h);
  detail::Bonds<2> bonds;
  const detail::BondRows<2> rows(run, lists, bonds);
  return bonds;
}

/// Whatever the direction of the lattice and the outline: most columns are in a row, and inside the body whole blocks
/// share a stencil, all of them one or a few.
TEST(Bonds, ALatticeIsKeptAsStencils) {
  for (const double degrees : {0.0, 20.0, 45.0, 77.0, 90.0}) {
    const detail::Bonds<2> bonds = bonds_of(setup_of(turned_disc(degrees)));
    EXPECT_GT(part_of(bonds.run), 0.7) << degrees;
    EXPECT_GT(part_of(bonds.shared), 0.2) << degrees;
    EXPECT_LE(bonds.stencil_weight[0].size(), 20U) << degrees;
  }
}

TEST(Bonds, AnIrregularArrangementIsNot) {
  RunSetup<2> s = block(40, 40, 0.2);
  const detail::Bonds<2> bonds = bonds_of(s);
  EXPECT_LT(part_of(bonds.run), 0.02);
  EXPECT_EQ(part_of(bonds.shared), 0.0);
}

/// Stencils, neighbours in a row and neighbours anywhere are three ways to the same bits.
TEST(Bonds, TheFormDoesNotChangeABit) {
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::best}) {
    RunSetup<2> s = torn_block();
    s.options.instruction_set = set;
    std::vector<Fields<2>> velocity;
    std::size_t cracked = 0;
    for (const int form : {0, 1, 2}) {
      Engine<2> e(s, 0.5 * time_step(s));
      detail::View<2>& v = e.run.view;
      std::vector<int> none(static_cast<std::size_t>(v.bonds.column[e.run.particles.blocks()]), -1);
      EXPECT_GT(std::count_if(v.bonds.shared, v.bonds.shared + e.run.particles.blocks(), [](int k) { return k >= 0; }),
                40);
      if (form > 0) v.bonds.shared = v.control_bonds.shared = none.data();
      if (form > 1) v.bonds.run = v.control_bonds.run = none.data();
      for (int k = 0; k < 500; ++k) {
        const Outcome o = e.step();
        ASSERT_TRUE(o.ok()) << o.message();
      }
      velocity.push_back(e.run.particles.velocity);
      cracked = static_cast<std::size_t>(std::count(e.run.particles.kind.begin(), e.run.particles.kind.end(), 1.0));
    }
    EXPECT_GT(cracked, 10U);
    EXPECT_EQ(velocity[1], velocity[0]);
    EXPECT_EQ(velocity[2], velocity[0]);
  }
}

TEST(Bonds, AlikeLinesGetTheSameBits) {
  detail::AlikeBonds alike(1e-3);
  const Vector line = alike(vec(0.3 - 0.299, 1e-3));
  EXPECT_EQ(alike(vec(0.7 - 0.699, 1e-3)), line);
  EXPECT_EQ(alike(vec(0.699 - 0.7, -1e-3)), -line);
  EXPECT_NE(alike(vec(1.0000001e-3, 1e-3)), line);
}

}  // namespace
}  // namespace fpz::sph::test
