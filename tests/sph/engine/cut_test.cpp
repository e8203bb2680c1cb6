// Cuts: particles on opposite faces never interact, whatever lies between them.
#include <cmath>
#include <limits>
#include <stdexcept>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

Cut<2> line(const Vector& from, const Vector& to) { return {{from, to}, {}}; }
/// From a mouth to a tip.
Cut<2> to_tip(const Vector& mouth, const Vector& tip) { return {{mouth, tip}, {false, true}}; }

TEST(Cut, LinesThatCross) {
  const Cut<2> c = line(vec(0.0, 0.0), vec(0.0, 1.0));
  const auto both_ways = [&c](const Vector& p, const Vector& q) {
    EXPECT_EQ(crosses(c, p, q), crosses(c, q, p));
    return crosses(c, p, q);
  };
  EXPECT_TRUE(both_ways(vec(-0.5, 0.5), vec(0.5, 0.5)));
  EXPECT_TRUE(both_ways(vec(0.5, 0.9), vec(-0.5, 0.2)));
  EXPECT_FALSE(both_ways(vec(-0.5, 1.1), vec(0.5, 1.1)));
  EXPECT_FALSE(both_ways(vec(-0.5, -0.1), vec(0.5, -0.1)));
  EXPECT_FALSE(both_ways(vec(0.1, 0.5), vec(0.5, 0.5)));
  EXPECT_FALSE(both_ways(vec(0.0, 0.5), vec(0.5, 0.5)));  // ends on it
  EXPECT_TRUE(lies_on(c, vec(0.0, 0.5)));
  EXPECT_FALSE(lies_on(c, vec(0.0, 1.0)));
  EXPECT_FALSE(lies_on(c, vec(1e-6, 0.5)));
}

/// Through an end, whatever rounding makes of it.
TEST(Cut, LinesThroughAnEndDoNotCross) {
  for (const double angle : {0.0, 0.3, 1.0, 2.0, 4.0}) {
    const Vector tip = vec(0.16, -0.03);
    const auto turned = [&](double x, double y) {
      return Vector(tip + vec(std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y));
    };
    const Cut<2> c = line(turned(0.0, -8e-3), tip);
    for (const double slope : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const Vector p = turned(-2e-3, -2e-3 * slope);
      const Vector q = turned(2e-3, 2e-3 * slope);
      EXPECT_FALSE(crosses(c, p, q)) << angle << " " << slope;
      EXPECT_TRUE(crosses(c, turned(-2e-3, -2e-3 * slope - 1e-6), turned(2e-3, 2e-3 * slope - 1e-6)));
    }
  }
}

TEST(Cut, SharesAroundATip) {
  constexpr double spacing = 0.1;
  const Cut<2> c = to_tip(vec(0.0, 0.0), vec(0.0, 1.0));
  const auto share = [&](double y, double slope) {
    const Vector p = vec(-0.05, y - 0.05 * slope), q = vec(0.15, y + 0.15 * slope);
    EXPECT_EQ(share_of_bond(c, p, q, spacing), share_of_bond(c, q, p, spacing));
    return share_of_bond(c, p, q, spacing);
  };
  for (const double slope : {-1.0, 0.0, 0.5}) {
    EXPECT_EQ(share(0.9, slope), 0.0);  // more than 0.9 spacings before the tip
    EXPECT_NEAR(share(0.985, slope), 0.5, 1e-12);
    EXPECT_NEAR(share(1.03, slope), 0.8, 1e-12);
    EXPECT_EQ(share(1.07, slope), 1.0);
    EXPECT_EQ(share(0.01, slope), 0.0);  // the mouth is sharp
    EXPECT_EQ(share(-0.01, slope), 1.0);
  }
  EXPECT_EQ(share_of_bond(c, vec(0.05, 0.9), vec(0.1, 0.9), spacing), 1.0);  // on one side
  const std::vector<Cut<2>> both = {c, to_tip(vec(0.1, 0.0), vec(0.1, 1.0))};
  EXPECT_NEAR(share_of_bond(both, vec(-0.05, 0.985), vec(0.15, 0.985), spacing), 0.25, 1e-12);
  EXPECT_EQ(share_of_bond(std::vector<Cut<2>>(), vec(-0.05, 0.9), vec(0.15, 0.9), spacing), 1.0);
}

/// What all bonds of a row across the cut keep, as they lie one spacing apart, follows the tip and not the particles.
TEST(Cut, SharesSumToTheLengthBeyondTheTip) {
  constexpr double spacing = 0.1;
  const auto kept = [&](double tip, double shift) {
    double sum = 0.0;
    for (int k = -20; k < 20; ++k) {
      const double y = (k + shift) * spacing;
      sum += share_of_bond(to_tip(vec(0.0, -4.0), vec(0.0, tip)), vec(-0.05, y), vec(0.05, y), spacing);
    }
    return sum;
  };
  for (const double shift : {0.0, 0.2, 0.5, 0.7}) {
    for (const double tip : {0.0, 0.03, 0.06}) {
      // A ramp of one and a half spacings leaves a sixth of a bond; one of one spacing nothing, a jump a whole one.
      EXPECT_NEAR(kept(tip, shift) - kept(0.0, 0.0), shift - tip / spacing, 0.17) << tip << " " << shift;
    }
  }
}

constexpr Configuration configurations[] = {Configuration::reference, Configuration::updated};

/// Two blocks side by side without a gap, the right one first at rest, the left one shaken; a cut between them, whose
/// faces pass through each other.
RunSetup<2> two_blocks(Configuration configuration) {
  RunSetup<2> s = block(16, 10);
  s.options.contact_stiffness = 0.0;
  s.options.configuration = configuration;
  s.arrangement.cuts = {line(vec(8e-3, -1e-3), vec(8e-3, 11e-3))};
  set_velocity(s, [](const Vector& x) {
    return x[0] > 8e-3 ? vec(0.0, 0.0) : vec(0.5 * std::sin(300.0 * x[1]), 0.3 * std::cos(400.0 * x[0]));
  });
  return s;
}

/// The shaken block moves as it does alone, the other one not at all; without the cut it does.
TEST(Cut, BlocksOnOppositeSidesDoNotFeelEachOther) {
  for (const Configuration c : configurations) {
    const RunSetup<2> s = two_blocks(c);
    RunSetup<2> alone = s;
    alone.arrangement.cuts.clear();
    const RunSetup<2> joined = alone;
    alone.arrangement = {};
    alone.arrangement.spacing = s.arrangement.spacing;
    alone.velocity.clear();
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < s.arrangement.size(); ++k) {
      if (s.arrangement.position[k][0] > 8e-3) continue;
      left.push_back(k);
      alone.arrangement.add(s.arrangement.position[k], s.arrangement.volume[k]);
      alone.velocity.push_back(s.velocity[k]);
    }
    Simulation<2> a(s), b(alone), bridged(joined);
    const double dt = b.time_step();
    ASSERT_NEAR(a.time_step(), dt, 1e-12 * dt);
    advance(a, 200);
    advance(b, 200);
    advance(bridged, 200);
    double moved = 0.0;
    for (std::size_t k = 0; k < s.arrangement.size(); ++k) {
      if (s.arrangement.position[k][0] < 8e-3) continue;
      EXPECT_EQ(a.particles().position[0][a.slot(k)], s.arrangement.position[k][0]);
      EXPECT_EQ(a.particles().position[1][a.slot(k)], s.arrangement.position[k][1]);
      moved = std::max(moved, std::abs(bridged.particles().velocity[0][bridged.slot(k)]));
    }
    EXPECT_GT(moved, 0.01);
    for (std::size_t k = 0; k < left.size(); ++k) {
      for (std::size_t d = 0; d < 2; ++d) {
        EXPECT_NEAR(a.particles().velocity[d][a.slot(left[k])], b.particles().velocity[d][b.slot(k)], 1e-12);
      }
    }
  }
}

/// In the updated configuration the faces stay apart when the lists are made anew: a block that slides along a cut for
/// many spacings meets no resistance.
TEST(Cut, HoldsWhenListsAreMadeAnew) {
  RunSetup<2> s = two_blocks(Configuration::updated);
  set_velocity(s, [](const Vector& x) { return vec(0.0, x[0] > 8e-3 ? 0.0 : 100.0); });
  Simulation<2> run(s);
  advance(run, 300);
  EXPECT_GT(run.neighbour_builds(), 5);
  const Particles<2>& p = run.particles();
  for (std::size_t i = 0; i < p.count; ++i) {
    EXPECT_NEAR(p.velocity[1][i], p.start[0][i] > 8e-3 ? 0.0 : 100.0, 1e-9);
    EXPECT_LT(std::abs(p.stress[1][i]), 10.0);  // rounding of 45 GPa
  }
}

/// A block with an edge cut that ends in the body, pulled across the cut at its ends.
RunSetup<2> edge_cut(Configuration configuration) {
  RunSetup<2> s = block(24, 12);
  s.options.configuration = configuration;
  s.arrangement.cuts = {line(vec(12e-3, 0.0), vec(12e-3, 6e-3))};
  set_velocity(s, [](const Vector& x) { return vec(x[0] > 12e-3 ? 0.02 : -0.02, 0.0); });
  return s;
}

TEST(Cut, EndingInTheBodyOpensItsFacesAndLoadsItsTip) {
  for (const Configuration c : configurations) {
    const RunSetup<2> s = edge_cut(c);
    Simulation<2> run(s);
    advance(run, 60);
    const Particles<2>& p = run.particles();
    const double strain = 2.0 * 0.02 * run.time() / 1e-3;  // of what lies between the halves at first
    double face = 0.0, tip = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      const Vector x = vec(p.start[0][i], p.start[1][i]);
      if (std::abs(x[0] - 12e-3) > 1e-3) continue;
      if (x[1] < 4e-3) face = std::max(face, std::abs(p.stress[0][i]));
      if (x[1] > 6e-3 && x[1] < 7e-3) tip = std::max(tip, p.stress[0][i]);
    }
    EXPECT_GT(tip, 5.0 * face);
    EXPECT_GT(tip, 0.01 * strain * s.parameters.young_modulus);
  }
}

RunSetup<2> edge_cut_with_tip() {
  RunSetup<2> s = edge_cut(Configuration::reference);
  s.arrangement.cuts = {to_tip(vec(12e-3, 0.0), vec(12e-3, 6.3e-3))};
  return s;
}

/// Bonds that are there in part take nothing from the gradient: linear fields are exact, whatever the vectors.
TEST(Cut, LinearFieldsAreExactAroundATip) {
  Mat<double, 2, 2> rate;
  rate << 0.3, -0.2, 0.5, 0.1;
  for (const Gradient gradient : {Gradient::kernel, Gradient::consistent}) {
    RunSetup<2> s = edge_cut_with_tip();
    s.options.gradient = gradient;
    set_velocity(s, [&](const Vector& x) { return Vector(rate * x); });
    Simulation<2> run(s);
    advance(run, 1);
    const Particles<2>& p = run.particles();
    for (std::size_t i = 0; i < p.count; ++i) {
      const double g[] = {p.gradient[0][i], p.gradient[1][i], p.gradient[2][i], p.gradient[3][i]};
      for (int k = 0; k < 4; ++k) EXPECT_NEAR(g[k] / run.time(), rate(k / 2, k % 2), 1e-9);
    }
  }
}

/// Momentum and energy do not mind them either.
TEST(Cut, ATipKeepsMomentumAndEnergy) {
  Simulation<2> run(edge_cut_with_tip());
  advance(run, 300);
  const Particles<2>& p = run.particles();
  Vector momentum = Vector::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    momentum += p.mass[i] * vec(p.velocity[0][i], p.velocity[1][i]);
    size += p.mass[i] * std::hypot(p.velocity[0][i], p.velocity[1][i]);
  }
  EXPECT_LT(momentum.norm(), 1e-11 * size);
  const Energies e = run.energies();
  EXPECT_GT(e.elastic, 0.0);
  EXPECT_LT(std::abs(e.error()), 1e-3 * e.kinetic_start);
}

/// Turned and mirrored set-ups with a cut move alike, with lines through the tip of the cut among the bonds.
TEST(Cut, RotationAndMirrorSymmetry) {
  for (const Configuration c : configurations) {
    RunSetup<2> s = edge_cut(c);
    s.arrangement.cuts[0].is_tip = {false, true};
    set_velocity(s, [](const Vector& x) { return vec(0.3 * std::sin(300.0 * x[0]) + 20.0 * x[1], -15.0 * x[0]); });
    Simulation<2> a(s);
    advance(a, 100);
    for (const double angle : {0.0, 0.7, -2.0}) {
      Mat<double, 2, 2> q;
      q << -std::cos(angle), -std::sin(angle), -std::sin(angle), std::cos(angle);
      RunSetup<2> t = s;
      for (Vector& x : t.arrangement.position) x = q * x;
      for (Vector& x : t.arrangement.cuts[0].corner) x = q * x;
      for (Vector& u : t.velocity) u = q * u;
      Simulation<2> b(t);
      EXPECT_EQ(a.mean_neighbours(), b.mean_neighbours());
      advance(b, 100);
      for (std::size_t k = 0; k < s.arrangement.size(); ++k) {
        const std::size_t i = a.slot(k), j = b.slot(k);
        const Vector ua = q * vec(a.particles().velocity[0][i], a.particles().velocity[1][i]);
        const Vector ub = vec(b.particles().velocity[0][j], b.particles().velocity[1][j]);
        EXPECT_LT((ua - ub).norm(), 1e-9) << angle;
      }
    }
  }
}

/// Boundary particles are kept apart like the others.
TEST(Cut, SeparatesBoundaryParticles) {
  RunSetup<2> s = two_blocks(Configuration::reference);
  s.velocity.clear();
  const Motion still{0.0, 0.0};
  add_group(s, {"platen", {Motion{0.5, 0.0}, still}, true}, [](const Vector& x) { return x[0] < 8e-3; });
  Simulation<2> run(s);
  advance(run, 50);
  EXPECT_EQ(run.reaction(0).norm(), 0.0);
  EXPECT_EQ(run.energies().external, 0.0);
}

TEST(Cut, ProblemsAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RunSetup<2> s = block(4, 4);
  EXPECT_TRUE(problems(s).empty());
  s.arrangement.cuts = {line(vec(2e-3, 0.0), vec(2e-3, 2e-3)), line(vec(1.0, 1.0), vec(1.0, 1.0)),
                        line(vec(nan, 0.0), vec(1.0, 1.0)), line(vec(0.5e-3, 0.0), vec(0.5e-3, 1e-3))};
  const std::vector<std::string> found = problems(s);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NE(found[0].find("cut 1: has no length"), std::string::npos);
  EXPECT_NE(found[1].find("cut 2: an end is not finite"), std::string::npos);
  EXPECT_NE(found[2].find("cut 3: particle 0 lies on it"), std::string::npos);
}

TEST(Cut, SnapshotOfOtherCutsIsRefused) {
  RunSetup<2> s = edge_cut(Configuration::reference);
  Simulation<2> run(s);
  advance(run, 10);
  Simulation<2> same(s);
  same.restore(run.snapshot());
  EXPECT_EQ(same.snapshot(), run.snapshot());
  s.arrangement.cuts[0].corner[1][1] = 5e-3;
  Simulation<2> other(s);
  EXPECT_THROW(other.restore(run.snapshot()), std::runtime_error);
}

}  // namespace
}  // namespace fpz::sph::test
