// Planes with a strength of their own against closed forms: Jaeger's plane of weakness, tension across a joint.
#include <algorithm>
#include <cmath>

#include "fpz/material.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double mm = 1e-3;

/// Rock whose surface is nearly Coulomb's line: its tensile vertex is next to the apex of the line.
Parameters coulomb(double cohesion, double friction_angle_deg) {
  Parameters p = concrete();
  p.cohesion = cohesion;
  p.friction_angle_deg = friction_angle_deg;
  p.tensile_strength = 0.999 * cohesion / std::tan(degree * friction_angle_deg);
  return p;
}

/// Particles for which `inside` holds get a plane with this normal.
void add_plane(RunSetup<2>& s, const Parameters& p, const Vector& normal,
               const std::function<bool(const Vector&)>& inside) {
  s.weak_planes.parameters.push_back(p);
  for (const Vector& x : s.arrangement.position) {
    s.weak_planes.of_particle.push_back(inside(x) ? 0 : WeakPlanes<2>::none);
    s.weak_planes.normal.push_back(normal);
  }
}

/// The axial stress (compression positive) at which a bedded block under lateral pressure first cracks, and whether on
/// its bedding. The velocity is a linear field, so that the middle is strained evenly without platens until waves come
/// from its surfaces; the lateral stress stays.
struct Onset {
  double axial = 0.0;
  bool on_plane = false;
};
Onset onset_of_bedding(double beta_deg, const Parameters& rock, const Parameters& plane, double pressure) {
  constexpr int columns = 50;
  constexpr double rate = 500.0;  // 1/s
  RunSetup<2> s = block(columns, columns);
  s.parameters = rock;
  s.options.courant = 0.02;
  const double beta = degree * beta_deg;  // from the direction of the axial stress, x, to the normal of the plane
  add_plane(s, plane, vec(std::cos(beta), std::sin(beta)), [](const Vector&) { return true; });
  const Elasticity<double> bulk = make_material(rock, s.setting).bulk;
  const double lateral = bulk.lambda / (bulk.lambda + 2.0 * bulk.mu);
  const Vector middle = vec(0.5 * columns * mm, 0.5 * columns * mm);
  set_velocity(s, [&](const Vector& x) {
    const Vector r = x - middle;
    return vec(-rate * r[0], lateral * rate * r[1]);
  });
  s.initial_stress << -pressure, -pressure, 0.0;
  Simulation<2> run(s);
  const Particles<2>& p = run.particles();
  std::vector<std::size_t> inner;
  for (std::size_t id = 0; id < s.arrangement.size(); ++id) {
    if ((s.arrangement.position[id] - middle).norm() < 2.0 * mm) inner.push_back(run.slot(id));
  }
  Onset onset;
  const auto cracked = [&](std::size_t i) { return p.kind[i] == kind::cracked; };
  for (int k = 0; k < 2000; ++k) {
    const double before = -p.stress[0][inner.front()];
    if (!run.step().ok()) break;
    const auto first = std::find_if(inner.begin(), inner.end(), cracked);
    if (first == inner.end()) continue;
    onset.axial = before;  // of the step before; a step is half a per cent of it
    onset.on_plane = run.cracked_on_weak_plane(*first);
    break;
  }
  return onset;
}

/// sigma_1 = sigma_3 + 2 (c + sigma_3 tan phi)/((1 - tan phi cot beta) sin 2 beta), beta between the normal of the
/// plane and sigma_1, and not above the strength of the rock without bedding (Jaeger 1960).
TEST(WeakPlanes, StrengthOfABeddedBlockIsJaegers) {
  const Parameters rock = coulomb(12e6, 40.0), plane = coulomb(4e6, 25.0);
  constexpr double pressure = 5e6;
  const double k = std::tan(degree * (45.0 + 20.0)), tan_phi = std::tan(degree * 25.0);
  const double intact = pressure * k * k + 2.0 * rock.cohesion * k;
  int on_plane = 0, in_rock = 0;
  for (const double beta_deg : {10.0, 30.0, 45.0, 57.5, 70.0, 85.0}) {
    const double beta = degree * beta_deg, denominator = (1.0 - tan_phi / std::tan(beta)) * std::sin(2.0 * beta);
    double exact = intact;
    if (denominator > 0.0) {
      exact = std::min(exact, pressure + 2.0 * (plane.cohesion + pressure * tan_phi) / denominator);
    }
    const Onset onset = onset_of_bedding(beta_deg, rock, plane, pressure);
    EXPECT_NEAR(onset.axial / exact, 1.0, 0.02) << beta_deg;
    EXPECT_EQ(onset.on_plane, exact < intact) << beta_deg;
    (onset.on_plane ? on_plane : in_rock) += 1;
  }
  EXPECT_EQ(on_plane, 3);
  EXPECT_EQ(in_rock, 3);
}

/// A strip of strong rock with a joint across, pulled apart: the joint's strength, its energy, and nothing else cracks.
RunSetup<2> jointed_strip() {
  RunSetup<2> s = block(30, 8);
  s.parameters = concrete();
  s.parameters.tensile_strength *= 4.0, s.parameters.cohesion *= 4.0;
  add_plane(s, concrete(), vec(1.0, 0.0), [](const Vector& x) { return std::abs(x[0] - 15.0 * mm) < 1.6 * mm; });
  s.options.release_integrity = 0.02;
  add_group(s, {"left", {Motion{-0.002, 1e-4}, std::nullopt}, true}, [](const Vector& x) { return x[0] < 3.0 * mm; });
  add_group(s, {"right", {Motion{0.002, 1e-4}, std::nullopt}, true}, [](const Vector& x) { return x[0] > 27.0 * mm; });
  return s;
}

TEST(WeakPlanes, AJointOpensAtItsStrengthWithItsEnergy) {
  const RunSetup<2> s = jointed_strip();
  const Parameters& joint = s.weak_planes.parameters[0];
  Simulation<2> run(s);
  double peak = 0.0;
  while (run.time() < 1.2e-3) {
    ASSERT_TRUE(run.step().ok());
    peak = std::max(peak, run.reaction(1)[0] / (8.0 * mm));
  }
  EXPECT_NEAR(peak / joint.tensile_strength, 1.0, 0.03);
  run.set_drive(0, 0, Motion{-0.01, 2e-4});
  run.set_drive(1, 0, Motion{0.01, 2e-4});
  while (run.time() < 1.2e-3 + 6.0 * joint.delta0 / 0.02) ASSERT_TRUE(run.step().ok());
  for (std::size_t i = 0; i < run.particles().count; ++i) {
    EXPECT_EQ(run.particles().kind[i] == kind::cracked, run.cracked_on_weak_plane(i));
  }
  EXPECT_GT(run.cracked(), 15U);
  EXPECT_NEAR(run.energies().fracture / (joint.tensile_strength * joint.delta0 * 8.0 * mm), 1.0, 0.05);
  EXPECT_LT(std::abs(run.energies().error()), 1e-3 * run.energies().external);
}

/// A plane as strong as the rock, along the crack that the rock chooses, changes nothing but the name of the crack.
TEST(WeakPlanes, APlaneOfTheRocksOwnStrengthOpensAsTheRockDoes) {
  RunSetup<2> one = jointed_strip();
  one.parameters = concrete();
  RunSetup<2> other = one;
  other.weak_planes = {};
  Simulation<2> a(one), b(other);
  for (int k = 0; k < 9000; ++k) {
    ASSERT_TRUE(a.step().ok());
    ASSERT_TRUE(b.step().ok());
  }
  ASSERT_GT(b.cracked(), 0U);
  EXPECT_NEAR(a.reaction(1)[0], b.reaction(1)[0], 0.02 * concrete().tensile_strength * 8.0 * mm);
}

TEST(WeakPlanes, SnapshotsKnowWhoHasCrackedOnThem) {
  const RunSetup<2> s = jointed_strip();
  Simulation<2> a(s), b(s);
  advance(a, 11000);
  ASSERT_GT(a.cracked(), 10U);
  const std::vector<unsigned char> early = b.snapshot();
  b.restore(a.snapshot());
  advance(a, 200);
  advance(b, 200);
  EXPECT_EQ(a.particles().stress, b.particles().stress);
  b.restore(early);
  EXPECT_FALSE(b.cracked_on_weak_plane(b.slot(14)));
}

TEST(WeakPlanes, WhatIsWrongIsSaid) {
  RunSetup<2> s = jointed_strip();
  s.options.configuration = Configuration::updated;
  ASSERT_EQ(problems(s).size(), 1U);
  EXPECT_NE(problems(s)[0].find("weak planes: need the configuration reference"), std::string::npos);
  s = jointed_strip();
  s.weak_planes.of_particle[3] = 1;
  s.weak_planes.normal[130].setZero();
  s.weak_planes.of_particle[130] = 0;
  EXPECT_EQ(problems(s).size(), 2U);
  s = jointed_strip();
  s.weak_planes.parameters[0].cohesion = 1.0;
  ASSERT_EQ(problems(s).size(), 1U);
  EXPECT_NE(problems(s)[0].find("weak plane 0: cohesion"), std::string::npos);
}

}  // namespace
}  // namespace fpz::sph::test
