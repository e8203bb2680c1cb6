// The tip of a cut against the handbook: an edge-cracked plate in tension, at rest. From the energy that the cut adds
// follows how long it is elastically, whatever the particles do; its tip is moved and the particles shifted.
#include <cmath>
#include <numbers>

#include "fpz/specimen/placing.hpp"
#include "fpz/sph/static_equilibrium.hpp"
#include "sph/engine/setups.hpp"

namespace fpz::sph::test {
namespace {

using specimen::Notch;
using specimen::Pattern;
using specimen::Point;

constexpr double width = 1.0, half_length = 1.5;  // m, of the plate; the cut goes across, from (0, 0)
constexpr double spacing = 0.05;

specimen::Body plate() {
  specimen::Body body;
  body.shape = specimen::Rectangle{Point(-half_length, 0.0), Point(half_length, width)};
  return body;
}

/// Forces on the particles near both ends with the resultant of an even tension of 1 Pa: at half of the width, although
/// the particles may lie elsewhere.
StaticLoad<2> tension(const Arrangement<2>& a) {
  constexpr double end = 1.1;  // m
  StaticLoad<2> load;
  load.force.assign(a.size(), Vector::Zero());
  for (const double side : {-1.0, 1.0}) {
    const auto sum = [&](auto&& term) {
      double total = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (side * a.position[i][0] > end) total += a.volume[i] * term(a.position[i][1]);
      }
      return total;
    };
    const double volume = sum([](double) { return 1.0; });
    const double middle = sum([](double y) { return y; }) / volume;
    const double inertia = sum([&](double y) { return (y - middle) * (y - middle); });
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vector& x = a.position[i];
      if (side * x[0] <= end) continue;
      const double even = width / volume;
      const double turning = width * (0.5 * width - middle) * (x[1] - middle) / inertia;
      load.force[i][0] = side * a.volume[i] * (even + turning);
    }
  }
  return load;
}

/// Elastic energy of the plate, J/m, made of the particles `a`.
double energy(const specimen::Body& body, Arrangement<2> a, const std::vector<Cut<2>>& cuts) {
  RunSetup<2> s;
  s.parameters = unbreakable();
  s.options.threads = 1;
  s.arrangement = std::move(a);
  s.arrangement.cuts = cuts;
  s.arrangement.surface = specimen::surface_lines(body, 0.25 * spacing);
  const StaticLoad<2> load = tension(s.arrangement);
  const StaticState<2> state = StaticBody<2>(s).equilibrium(load);
  double twice = 0.0;
  for (std::size_t i = 0; i < load.force.size(); ++i) twice += load.force[i].dot(state.displacement[i]);
  return 0.5 * twice;
}

/// What a cut of length a adds to the energy, J/m: the integral of K^2 (1 - nu^2)/E, K = sqrt(pi a) F(a/W) (Tada,
/// within 0.5 %).
double added_energy(double length) {
  constexpr int steps = 2000;
  const Parameters p = unbreakable();
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double a = length * (k + 0.5) / steps, t = 0.5 * std::numbers::pi * a / width;
    const double factor =
        std::sqrt(std::tan(t) / t) * (0.752 + 2.02 * a / width + 0.37 * std::pow(1.0 - std::sin(t), 3)) / std::cos(t);
    sum += std::numbers::pi * a * factor * factor * length / steps;
  }
  return sum * (1.0 - p.poisson_ratio * p.poisson_ratio) / p.young_modulus;
}

/// Length that the notch has by its energy, less its own, in spacings; a cut, or a slot so many spacings wide.
double excess_length(const Pattern& pattern, double length, bool sharp = false, double spacings_wide = 0.0) {
  specimen::Body body = plate();
  const double slot_width = spacings_wide * spacing;
  const Notch notch{Point(0.0, 0.0), Point(0.0, length), slot_width, slot_width};
  body.notches = {notch};
  const Arrangement<2> a = specimen::place_specimen(body, pattern, spacing);
  Cut<2> cut = specimen::cut_in(body, notch, spacing);
  EXPECT_FALSE(cut.is_tip[0]);
  EXPECT_EQ(cut.is_tip[1], notch.width <= 0.0);
  if (sharp) cut.is_tip = {};
  const Arrangement<2> whole = notch.width > 0.0 ? specimen::place_specimen(plate(), pattern, spacing) : a;
  const double added = energy(body, a, {cut}) - energy(plate(), whole, {});
  double low = 0.0, high = 0.8 * width;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (added_energy(middle) < added ? low : high) = middle;
  }
  return (low - length) / spacing;
}

struct Range {
  double least = 1e300, most = -1e300;
  void take(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

/// Of the tip moved over a spacing.
Range over_a_spacing(const Pattern& pattern, bool sharp = false, double spacings_wide = 0.0) {
  Range r;
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    r.take(excess_length(pattern, (5.0 + part) * spacing, sharp, spacings_wide));
  }
  return r;
}

Pattern lattice(double x, double y, double angle_deg = 0.0) {
  Pattern p;
  p.kind = Pattern::Kind::lattice;
  p.origin = spacing * Point(x, y);
  p.angle = angle_deg * std::numbers::pi / 180.0;
  p.fit = false;
  return p;
}

TEST(CutTip, IsWhereItWasAskedForOnALattice) {
  for (const Point& shift : {Point(0.0, 0.0), Point(0.45, 0.0), Point(0.3, 0.2), Point(0.2, 0.5), Point(0.2, 0.8)}) {
    const Range r = over_a_spacing(lattice(shift[0], shift[1]));
    EXPECT_GT(r.least, -0.13) << shift.transpose();
    EXPECT_LT(r.most, 0.15) << shift.transpose();
  }
  const Range sharp = over_a_spacing(lattice(0.0, 0.0), true);
  EXPECT_GT(sharp.most - sharp.least, 0.4);  // what it would be
}

TEST(CutTip, IsWhereItWasAskedForOnTurnedAndScatteredParticles) {
  for (const double angle : {10.0, 20.0, 30.0, 45.0}) {
    const Range r = over_a_spacing(lattice(0.4, 0.3, angle));
    EXPECT_GT(r.least, -0.2) << angle;
    EXPECT_LT(r.most, 0.2) << angle;
  }
  Pattern p;
  p.kind = Pattern::Kind::scattered;
  for (const std::uint64_t seed : {1U, 2U}) {
    p.seed = seed;
    const Range r = over_a_spacing(p);
    EXPECT_GT(r.least, -0.2) << seed;
    EXPECT_LT(r.most, 0.25) << seed;
  }
}

/// A slot w wide acts as if it were 0.19 w longer (slots of 3 and 6 spacings with 60 across the plate), and the
/// particles at its end make that 0.2 spacings more.
TEST(CutTip, SlotsEndWhereTheyWereAskedFor) {
  for (const double wide : {1.0, 2.0, 3.0}) {
    Range all;
    for (const Point& shift : {Point(0.15, 0.0), Point(0.2, 0.5), Point(0.4, 0.8)}) {
      const Range r = over_a_spacing(lattice(shift[0], shift[1]), false, wide);
      all.take(r.least);
      all.take(r.most);
    }
    EXPECT_LT(all.most - all.least, 0.25) << wide;
    EXPECT_NEAR(0.5 * (all.least + all.most), 0.19 * wide + 0.2, 0.1) << wide;
  }
}

}  // namespace
}  // namespace fpz::sph::test
