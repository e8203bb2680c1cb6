// Disc and ring under diametral load against the exact series of elasticity: whole stress fields, order of convergence.
#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>

#include "fpz/specimen/placing.hpp"
#include "fpz/specimen/surface_load.hpp"
#include "fpz/sph/static_equilibrium.hpp"
#include "sph/engine/setups.hpp"

namespace fpz::sph::test {
namespace {

using specimen::Point;
constexpr double pi = std::numbers::pi;

/// Ring of outer radius 1 and inner radius `inner` under two opposite radial forces P per thickness at theta = 0 and
/// pi, each spread evenly over an arc of half-angle `arc`. Stresses in units of P/(pi R), as polar components (r,
/// theta, r theta). Airy function of order m = 2, 4, ...: (A r^m + B r^-m + C r^(m+2) + D r^(2-m)) cos(m theta); its
/// constants from the tractions of both circles.
struct RingSeries {
  RingSeries(double inner_radius, double arc) : inner(inner_radius) {
    constexpr int terms = 60;
    const double a2 = inner * inner;
    lame = -1.0 / (1.0 - a2);
    for (int m = 2; m <= 2 * terms; m += 2) {
      Eigen::Matrix4d equations;
      Eigen::Vector4d load = Eigen::Vector4d::Zero();
      load[0] = -2.0 * (arc > 0.0 ? std::sin(m * arc) / (m * arc) : 1.0);
      equations.row(0) = radial(m, 1.0), equations.row(1) = shear(m, 1.0);
      equations.row(2) = radial(m, inner), equations.row(3) = shear(m, inner);
      constants.push_back(equations.fullPivLu().solve(load));
    }
  }
  // Factors of A, B, C, D; B and D are scaled with inner^m so that none overflows.
  [[nodiscard]] Eigen::RowVector4d radial(int m, double r) const {
    const double n = m, up = std::pow(r, n), down = std::pow(inner / r, n);
    return {-n * (n - 1) * up / (r * r), -n * (n + 1) * down / (r * r), -(n - 2) * (n + 1) * up,
            -(n + 2) * (n - 1) * down};
  }
  [[nodiscard]] Eigen::RowVector4d hoop(int m, double r) const {
    const double n = m, up = std::pow(r, n), down = std::pow(inner / r, n);
    return {n * (n - 1) * up / (r * r), n * (n + 1) * down / (r * r), (n + 2) * (n + 1) * up, (n - 2) * (n - 1) * down};
  }
  [[nodiscard]] Eigen::RowVector4d shear(int m, double r) const {
    const double n = m, up = std::pow(r, n), down = std::pow(inner / r, n);
    return {n * (n - 1) * up / (r * r), -n * (n + 1) * down / (r * r), n * (n + 1) * up, -n * (n - 1) * down};
  }
  [[nodiscard]] Eigen::Vector3d operator()(double r, double theta) const {
    const double a2 = inner * inner / (r * r);
    Eigen::Vector3d s(lame * (1.0 - a2), lame * (1.0 + a2), 0.0);
    for (std::size_t k = 0; k < constants.size(); ++k) {
      const int m = 2 * (static_cast<int>(k) + 1);
      s[0] += radial(m, r).dot(constants[k]) * std::cos(m * theta);
      s[1] += hoop(m, r).dot(constants[k]) * std::cos(m * theta);
      s[2] += shear(m, r).dot(constants[k]) * std::sin(m * theta);
    }
    return s;
  }

  double inner;
  double lame;
  std::vector<Eigen::Vector4d> constants;
};

TEST(Elastostatics, SeriesGivesTheKnownStresses) {
  // Hoop stress at the hole on the load line, d/D = 0.1 .. 0.5.
  const double known[] = {6.385, 7.598, 9.856, 13.68, 20.31};
  for (int k = 0; k < 5; ++k) {
    const double inner = 0.1 * (k + 1);
    EXPECT_NEAR(RingSeries(inner, 0.0)(inner, 0.0)[1], known[k], 6e-4 * known[k]) << inner;
  }
  // Centre of the disc: 2P/(pi D) across, -6P/(pi D) along the load.
  const Eigen::Vector3d centre = RingSeries(1e-6, 0.0)(1e-3, 0.0);
  EXPECT_NEAR(centre[1], 1.0, 2e-5);
  EXPECT_NEAR(centre[0], -3.0, 2e-5);
}

/// Stresses of the series, in the units of P/(pi R), as components xx, yy, xy.
Eigen::Vector3d cartesian(const RingSeries& series, const Point& x) {
  const double r = x.norm(), c = x[0] / r, n = x[1] / r;
  const Eigen::Vector3d e = series(r, std::atan2(x[1], x[0]));
  return {c * c * e[0] + n * n * e[1] - 2.0 * c * n * e[2], n * n * e[0] + c * c * e[1] + 2.0 * c * n * e[2],
          c * n * (e[0] - e[1]) + (c * c - n * n) * e[2]};
}

struct Comparison {
  double error = 0.0;   ///< of the stresses at r < 0.7 (disc: 0.5), root mean square, over that of the exact ones
  double along = 0.0;   ///< near the centre (disc), or the hole on the load line (ring): mean stress along the load ...
  double across = 0.0;  ///< ... and across it (ring: hoop stress), over the exact ones
};

/// Of stresses in the order of the arrangement, under the load P (N per metre).
template <class Stress>
Comparison compare(const Arrangement<2>& a, const RingSeries& series, double load, const Stress& stress_of) {
  const double inner = series.inner > 1e-3 ? series.inner : 0.0;
  double difference = 0.0, square = 0.0;
  Eigen::Vector3d near = Eigen::Vector3d::Zero(), near_exact = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point& x = a.position[i];
    const double r = x.norm();
    if (a.group[i] >= 0 || r > (inner > 0.0 ? 0.7 : 0.5) || r < 1e-9) continue;
    const Eigen::Vector3d exact = load / pi * cartesian(series, x), stress = stress_of(i);
    difference += a.volume[i] * (stress - exact).squaredNorm();
    square += a.volume[i] * exact.squaredNorm();
    if (r > inner + 0.15 || std::abs(x[1]) > 0.15) continue;
    near += a.volume[i] * stress;
    near_exact += a.volume[i] * exact;
  }
  return {std::sqrt(difference / square), near[0] / near_exact[0], near[1] / near_exact[1]};
}

constexpr double half_width = 0.1;  // m, of the platens or of the chord under pressure

/// A ring of radius 1 m (a disc for inner = 0).
RunSetup<2> ring(double inner, double spacing, const specimen::Pattern& pattern) {
  specimen::Body body;
  body.shape = specimen::Ring{Point::Zero(), inner, 1.0};
  RunSetup<2> s;
  s.parameters = unbreakable();
  s.arrangement = specimen::place_specimen(body, pattern, spacing);
  s.arrangement.surface = specimen::surface_lines(body, 0.25 * spacing);
  s.options.threads = 1;
  return s;
}

/// Pressed along x between two narrow platens.
Comparison pressed(double inner, double spacing, specimen::Pattern::Kind kind) {
  constexpr double speed = 1e-3;  // m/s: strains stay far below one
  constexpr double ramp = 0.01;   // s, twenty times the travel of a wave across it: no oscillation to speak of
  specimen::Pattern pattern;
  pattern.kind = kind;
  RunSetup<2> s = ring(inner, spacing, pattern);
  const specimen::Disc disc{Point::Zero(), 1.0};
  specimen::place_platen(s.arrangement, disc, {Point(1.0, 0.0), Point(1.0, 0.0), 2.0 * half_width, 3}, 0);
  specimen::place_platen(s.arrangement, disc, {Point(-1.0, 0.0), Point(-1.0, 0.0), 2.0 * half_width, 3}, 1);
  const Motion still{0.0, 0.0};
  s.groups = {{"right", {Motion{-speed, ramp}, still}, true}, {"left", {Motion{speed, ramp}, still}, true}};
  s.options.courant = 0.9;
  Simulation<2> run(s);
  advance(run, static_cast<long long>(1.2 * ramp / run.time_step()));
  const double load = 0.5 * (run.reaction(1)[0] - run.reaction(0)[0]);
  const Particles<2>& p = run.particles();
  return compare(s.arrangement, RingSeries(std::max(inner, 1e-6), std::asin(half_width)), load,
                 [&](std::size_t id) { return Eigen::Vector3d(p.stress_of(run.slot(id))); });
}

/// At rest under the pressure of the series.
Comparison under_pressure(double spacing, const specimen::Pattern& pattern, Gradient gradient = Gradient::consistent) {
  RunSetup<2> s = ring(0.0, spacing, pattern);
  s.options.gradient = gradient;
  const double arc = std::asin(half_width);
  std::vector<specimen::PointForce> forces;
  constexpr int pieces = 400;
  for (int k = 0; k < pieces; ++k) {
    const double angle = arc * ((2.0 * k + 1.0) / pieces - 1.0);
    for (const double side : {1.0, -1.0}) {
      const Point normal = side * Point(std::cos(angle), std::sin(angle));
      forces.push_back({normal, -normal / pieces});
    }
  }
  StaticLoad<2> load;
  load.force = specimen::share_out(forces, s.arrangement);
  const StaticState<2> state = StaticBody<2>(s).equilibrium(load);
  return compare(s.arrangement, RingSeries(1e-6, arc), 1.0,
                 [&](std::size_t id) { return Eigen::Vector3d(state.stress[id]); });
}

/// The stresses of a disc converge with more than the first order, however its particles lie.
TEST(Elastostatics, DiscUnderEvenPressure) {
  using Kind = specimen::Pattern::Kind;
  std::map<std::string, specimen::Pattern> patterns;
  patterns["lattice"].kind = Kind::lattice;
  patterns["turned"].angle = pi / 9.0;
  patterns["moved"].move = 0.3;
  patterns["rings"].kind = Kind::rings;
  patterns["scattered"].kind = Kind::scattered;
  for (const auto& [name, p] : patterns) {
    const Comparison coarse = under_pressure(0.1, p), fine = under_pressure(0.04, p);
    const double order = std::log(coarse.error / fine.error) / std::log(0.1 / 0.04);
    RecordProperty("order_" + name, std::to_string(order));
    EXPECT_GT(order, 1.5) << name;
    EXPECT_LT(fine.error, 0.015) << name;
    EXPECT_NEAR(fine.along, 1.0, 0.01) << name;
    EXPECT_NEAR(fine.across, 1.0, 0.01) << name;
  }
  // The gradients of the kernel do not converge on moved particles.
  EXPECT_GT(under_pressure(0.04, patterns["moved"], Gradient::kernel).error, 0.1);
}

/// Bonded platens do not press evenly, at any spacing; the centre hardly feels it.
TEST(Elastostatics, DiscBetweenPlatens) {
  const Comparison fine = pressed(0.0, 0.05, specimen::Pattern::Kind::lattice);
  EXPECT_NEAR(fine.across, 1.0, 0.02);
  EXPECT_NEAR(fine.along, 1.0, 0.02);
}

/// Ring-wise particles: the whole stress field converges, with about the first order.
TEST(Elastostatics, RingBetweenPlatens) {
  for (const double inner : {0.3, 0.5}) {
    const Comparison coarse = pressed(inner, 0.1, specimen::Pattern::Kind::rings);
    const Comparison fine = pressed(inner, 0.05, specimen::Pattern::Kind::rings);
    const double order = std::log2(coarse.error / fine.error);
    RecordProperty(inner < 0.4 ? "order_hole_0.3" : "order_hole_0.5", std::to_string(order));
    EXPECT_NEAR(fine.across, 1.0, 0.06) << inner;
    EXPECT_LT(std::abs(fine.across - 1.0), 0.5 * std::abs(coarse.across - 1.0)) << inner;
    EXPECT_GT(order, 0.8) << inner;
    EXPECT_LT(fine.error, 0.11) << inner;
  }
}

}  // namespace
}  // namespace fpz::sph::test
