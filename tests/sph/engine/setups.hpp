// Small bodies that several tests of the particle method use.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "fpz/sph/simulation.hpp"
#include "support/materials.hpp"

namespace fpz::sph::test {

using Vector = Vec<double, 2>;

inline Vector vec(double x, double y) {
  Vector v;
  v << x, y;
  return v;
}

/// Concrete of Table 2 with a cohesion that cracks in mode I.
inline Parameters concrete() {
  Parameters p = fpz::test::table2();
  p.cohesion = 5e6;
  return p;
}

/// The same, too strong to crack.
inline Parameters unbreakable() {
  Parameters p = concrete();
  p.tensile_strength = 1e12;
  p.cohesion = 1e13;
  return p;
}

/// columns x rows lattice of spacing 1 mm with its corner at the origin, optionally moved at random by up to `jitter`
/// spacings, with volumes that vary alike.
inline RunSetup<2> block(int columns, int rows, double jitter = 0.0, double spacing = 1e-3) {
  RunSetup<2> s;
  s.parameters = unbreakable();
  s.arrangement.spacing = spacing;
  add_lattice<2>(s.arrangement, vec(0.0, 0.0), vec(columns * spacing, rows * spacing));
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  if (jitter > 0.0) {
    for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
      s.arrangement.position[i] += spacing * vec(shift(rng), shift(rng));
      s.arrangement.volume[i] *= 1.0 + shift(rng);
    }
  }
  s.options.threads = 1;
  return s;
}

/// Start velocities from a field of the position.
inline void set_velocity(RunSetup<2>& s, const std::function<Vector(const Vector&)>& field) {
  s.velocity.clear();
  for (const Vector& x : s.arrangement.position) s.velocity.push_back(field(x));
}

/// Puts the particles for which `inside` holds into a new group.
inline void add_group(RunSetup<2>& s, const Group<2>& group, const std::function<bool(const Vector&)>& inside) {
  const int index = static_cast<int>(s.groups.size());
  s.groups.push_back(group);
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    if (inside(s.arrangement.position[i])) s.arrangement.group[i] = index;
  }
}

/// Steps, failing the test on the first bad step.
inline void advance(Simulation<2>& run, long long steps) {
  for (long long k = 0; k < steps; ++k) {
    const Outcome o = run.step();
    ASSERT_TRUE(o.ok()) << o.message();
  }
}

inline Vector momentum(const Simulation<2>& run) {
  const Particles<2>& p = run.particles();
  Vector sum = vec(0.0, 0.0);
  for (std::size_t i = 0; i < p.count; ++i) sum += p.mass[i] * vec(p.velocity[0][i], p.velocity[1][i]);
  return sum;
}

/// Both configurations and momentum forms.
struct Variant {
  Configuration configuration;
  MomentumForm momentum;
};
inline constexpr Variant variants[] = {{Configuration::reference, MomentumForm::adjoint},
                                       {Configuration::reference, MomentumForm::paper},
                                       {Configuration::updated, MomentumForm::adjoint},
                                       {Configuration::updated, MomentumForm::paper}};

/// A notched block torn at its ends: cracks grow, some particles crack early.
inline RunSetup<2> torn(const Variant& v) {
  RunSetup<2> s = block(30, 14);
  s.parameters = concrete();
  s.options.configuration = v.configuration;
  s.options.momentum = v.momentum;
  s.options.damping = 0.05;
  s.options.release_integrity = 0.3;
  RunSetup<2> notched = s;
  notched.arrangement = {};
  notched.arrangement.spacing = s.arrangement.spacing;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const Vector& x = s.arrangement.position[i];
    if (x[1] < 5e-3 && std::abs(x[0] - 15e-3) < 1e-3) continue;
    notched.arrangement.add(x, s.arrangement.volume[i]);
  }
  add_group(notched, {"left", {Motion{-1.0, 1e-6}, Motion{0.0, 0.0}}, true},
            [](const Vector& x) { return x[0] < 3e-3; });
  add_group(notched, {"right", {Motion{1.0, 1e-6}, std::nullopt}, true}, [](const Vector& x) { return x[0] > 27e-3; });
  return notched;
}

/// A block with a notch, torn at its ends until cracks have rewritten many rows.
inline RunSetup<2> torn_block() {
  RunSetup<2> s = block(64, 40);
  s.parameters = concrete();
  s.options.release_integrity = 0.3;
  s.arrangement.cuts.push_back({{vec(32e-3, -1e-3), vec(32e-3, 10e-3)}, {false, true}});
  add_group(s, {"left", {Motion{-1.0, 1e-6}, Motion{0.0, 0.0}}, true}, [](const Vector& x) { return x[0] < 3e-3; });
  add_group(s, {"right", {Motion{1.0, 1e-6}, std::nullopt}, true}, [](const Vector& x) { return x[0] > 61e-3; });
  return s;
}

/// The lowest two rows rest, the highest two of a body of this height (m) follow `top`: groups 0 and 1.
inline void hold_ends(RunSetup<2>& s, double height, const Group<2>& top) {
  const double rows = 2.0 * s.arrangement.spacing;
  add_group(s, {"bottom", {Motion{}, Motion{}}, true}, [=](const Vector& x) { return x[1] < rows; });
  add_group(s, top, [=](const Vector& x) { return x[1] > height - rows; });
}

/// Mean force by which group 1 is held between two times, s.
inline Vector mean_force(Simulation<2>& run, double from, double until) {
  Vector sum = vec(0.0, 0.0);
  double count = 0.0;
  while (run.time() < until) {
    const Outcome o = run.step();
    EXPECT_TRUE(o.ok()) << o.message();
    if (!o.ok()) break;
    if (run.time() < from) continue;
    sum += run.reaction(1);
    count += 1.0;
  }
  return sum / count;
}

}  // namespace fpz::sph::test
