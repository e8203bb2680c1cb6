// The disc of data/scenes/disc.json, elastic, against the closed form of even pressure.
#include <cmath>
#include <numbers>

#include "fpz/specimen/specimen.hpp"
#include "fpz/specimen/surface_load.hpp"
#include "fpz/sph/static_equilibrium.hpp"
#include "patch_trials.hpp"

namespace fpz::report {
namespace {

using specimen::Point;
constexpr double pi = std::numbers::pi;

/// Two opposite radial line loads of 1 N per metre along +-d: Flamant's radial stress from either, and an even tension
/// that frees the rim.
Eigen::Matrix2d under_line_loads(const Point& x, const Point& d, double radius) {
  Eigen::Matrix2d s = Eigen::Matrix2d::Identity() / (pi * radius);
  for (const double side : {1.0, -1.0}) {
    const Point from = x - side * radius * d, inward = -side * d;
    const double square = from.squaredNorm();
    s -= 2.0 / pi * from.dot(inward) / (square * square) * from * from.transpose();
  }
  return s;
}

/// The particles of the specimen alone, with the pressure of 1 N per metre on them.
sph::StaticLoad<2> press(sph::RunSetup<2>& s, double radius, double half_angle) {
  sph::Arrangement<2> alone;
  alone.spacing = s.arrangement.spacing;
  alone.surface = s.arrangement.surface;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    if (s.arrangement.group[i] < 0) alone.add(s.arrangement.position[i], s.arrangement.volume[i]);
  }
  s.arrangement = alone;
  s.groups.clear();
  constexpr int pieces = 400;
  std::vector<specimen::PointForce> forces;
  const double force = half_angle / (pieces * std::sin(half_angle));
  for (int k = 0; k < pieces; ++k) {
    const double angle = 0.5 * pi + half_angle * ((2.0 * k + 1.0) / pieces - 1.0);
    for (const double side : {1.0, -1.0}) {
      const Point normal = side * Point(std::cos(angle), std::sin(angle));
      forces.push_back({radius * normal, -force * normal});
    }
  }
  return {specimen::share_out(forces, s.arrangement), {}};
}

/// The platens of the scene moved by a millionth of what they move in a second.
sph::StaticLoad<2> move_platens(const sph::RunSetup<2>& s) {
  sph::StaticLoad<2> load;
  for (const int g : s.arrangement.group) {
    Point u = Point::Zero();
    for (int c = 0; g >= 0 && c < 2; ++c) {
      const auto& drive = s.groups[static_cast<std::size_t>(g)].drive[static_cast<std::size_t>(c)];
      if (drive) u[c] = 1e-6 * drive->table.value.back();
    }
    load.displacement.push_back(u);
  }
  return load;
}

}  // namespace

Tensor<double, 2> stress_under_pressure(const Point& x, double radius, double half_angle) {
  constexpr int pieces = 64;
  Eigen::Matrix2d s = Eigen::Matrix2d::Zero();
  for (int k = 0; k < pieces; ++k) {
    const double angle = 0.5 * pi + half_angle * ((2.0 * k + 1.0) / pieces - 1.0);
    s += under_line_loads(x, Point(std::cos(angle), std::sin(angle)), radius);
  }
  s *= half_angle / (pieces * std::sin(half_angle));
  return Tensor<double, 2>(s(0, 0), s(1, 1), s(0, 1));
}

DiscErrors loaded_disc_errors(const specimen::Pattern& pattern, double spacing, DiscLoad load) {
  specimen::Scene scene = specimen::read_scene(std::string(FPZ_SOURCE_DIR) + "/data/scenes/disc.json",
                                               {"spacing=" + std::to_string(spacing)});
  scene.pattern = pattern;
  sph::RunSetup<2> s = specimen::make_specimen(scene).setup;
  s.options.threads = 1;
  const double radius = specimen::extent(scene.body.shape).second[0];  // about the origin
  const double half_angle = std::asin(0.5 * scene.boundaries.front().platen->width / radius);
  const sph::StaticLoad<2> given = load == DiscLoad::pressure ? press(s, radius, half_angle) : move_platens(s);
  const sph::StaticState<2> state = sph::StaticBody<2>(s).equilibrium(given);
  const double force = load == DiscLoad::pressure ? 1.0 : 0.5 * (state.reaction[1][1] - state.reaction[0][1]);
  const double unit = force / (pi * radius);
  ErrorSum across, along;
  double centre = 0.0, exact_centre = 0.0;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const Point& x = s.arrangement.position[i];
    if (s.arrangement.group[i] >= 0 || x.norm() > 0.6 * radius) continue;
    const Tensor<double, 2> exact = force * stress_under_pressure(x, radius, half_angle);
    across.add((state.stress[i][0] - exact[0]) / unit);
    along.add((state.stress[i][1] - exact[1]) / (3.0 * unit));
    if (x.norm() > 2.0 * spacing) continue;
    centre += state.stress[i][0];
    exact_centre += exact[0];
  }
  return {across.errors(), along.errors(), centre / exact_centre};
}

}  // namespace fpz::report
