// Strips and discs under stresses that are even or linear.
#include <cmath>

#include "fpz/specimen/surface_load.hpp"
#include "fpz/sph/static_equilibrium.hpp"
#include "patch_setup.hpp"
#include "patch_trials.hpp"

namespace fpz::report {
namespace {

using specimen::Point;

constexpr double young = 30e9, poisson = 0.2;  // Pa; what they are does not matter
constexpr double length = 2.0, height = 1.0;   // m
constexpr std::array fields = {PatchField::tension, PatchField::bending};

/// sigma_xx, Pa, at a distance y from the middle: 1 at most. All other components are zero.
double exact_stress(PatchField field, double y) { return field == PatchField::tension ? 1.0 : -2.0 * y; }

/// Displacement with that stress in plane strain, m, about the middle.
Point exact_displacement(PatchField field, const Point& x) {
  const double e = young / (1.0 - poisson * poisson), nu = poisson / (1.0 - poisson);
  if (field == PatchField::tension) return Point(x[0], -nu * x[1]) / e;
  return Point(-2.0 * x[0] * x[1], x[0] * x[0] + nu * x[1] * x[1]) / e;
}

/// Traction of the exact stress on a line.
void add_traction(std::vector<specimen::PointForce>& forces, PatchField field, const Point& from, const Point& to) {
  constexpr int pieces = 4;  // per piece of the surface line, a quarter of a spacing
  const Point step = (to - from) / pieces;
  for (int k = 0; k < pieces; ++k) {
    const Point at = from + (k + 0.5) * step;
    forces.push_back({at, Point(exact_stress(field, at[1]) * step[1], 0.0)});  // outward normal times length: (dy, -dx)
  }
}

/// Of the lines whose pieces are in `acts`; lines run counter-clockwise.
template <class Acts>
sph::StaticLoad<2> traction_load(const sph::RunSetup<2>& s, PatchField field, const Acts& acts) {
  std::vector<specimen::PointForce> forces;
  for (const auto& line : s.arrangement.surface) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      if (acts(line[k], line[k + 1])) add_traction(forces, field, line[k], line[k + 1]);
    }
  }
  return {specimen::share_out(forces, s.arrangement), {}};
}

Tensor<double, 2> difference(const sph::StaticState<2>& state, std::size_t i, PatchField field, const Point& x) {
  Tensor<double, 2> d = state.stress[i];
  d[0] -= exact_stress(field, x[1]);
  return d;
}

void hold_ends(sph::RunSetup<2>& s) {
  const sph::Motion still{0.0, 0.0};
  s.groups = {{"ends", {still, still}, true}};
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    if (0.5 * length - std::abs(s.arrangement.position[i][0]) < 2.4 * s.arrangement.spacing) s.arrangement.group[i] = 0;
  }
}

PatchErrors strip_errors_of(const sph::RunSetup<2>& s, const sph::StaticState<2>& state, PatchField field) {
  ErrorSum inside, surface, ends;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    if (s.arrangement.group[i] >= 0) continue;
    const Point& x = s.arrangement.position[i];
    const bool middle = std::abs(x[0]) < 0.25 * length;
    const bool deep = 0.5 * height - std::abs(x[1]) > 3.0 * s.arrangement.spacing;
    (!middle ? ends : deep ? inside : surface).add(difference(state, i, field, x), 1.0);
  }
  return {inside.errors(), surface.errors(), ends.errors()};
}

}  // namespace

BothFields strip_errors(const specimen::Pattern& pattern, int rows, StripEnds ends, sph::Gradient gradient) {
  specimen::Body body;
  body.shape = specimen::Rectangle{Point(-0.5 * length, -0.5 * height), Point(0.5 * length, 0.5 * height)};
  sph::RunSetup<2> s = patch_setup(body, pattern, height / rows);
  s.parameters.young_modulus = young, s.parameters.poisson_ratio = poisson;
  s.options.gradient = gradient;
  if (ends == StripEnds::held) hold_ends(s);
  sph::StaticBody<2> solved(s);
  BothFields all;
  for (std::size_t n = 0; n < fields.size(); ++n) {
    sph::StaticLoad<2> load;
    if (ends == StripEnds::traction) {
      load = traction_load(s, fields[n], [](const Point& a, const Point& b) {
        return std::abs(a[0] - b[0]) < 1e-9 && std::abs(a[0]) > 0.5 * length - 1e-9;
      });
    } else {
      for (const Point& x : s.arrangement.position) load.displacement.push_back(exact_displacement(fields[n], x));
    }
    all[n] = strip_errors_of(s, solved.equilibrium(load), fields[n]);
  }
  return all;
}

BothFields disc_errors(const specimen::Pattern& pattern, int rows) {
  specimen::Body body;
  body.shape = specimen::Disc{Point::Zero(), 0.5 * height};
  sph::RunSetup<2> s = patch_setup(body, pattern, height / rows);
  sph::StaticBody<2> solved(s);
  BothFields all;
  for (std::size_t n = 0; n < fields.size(); ++n) {
    const auto state = solved.equilibrium(traction_load(s, fields[n], [](const Point&, const Point&) { return true; }));
    ErrorSum inside, surface;
    for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
      const Point& x = s.arrangement.position[i];
      const bool deep = x.norm() < 0.6 * 0.5 * height;
      (deep ? inside : surface).add(difference(state, i, fields[n], x), 1.0);
    }
    all[n] = {inside.errors(), surface.errors(), ErrorSum().errors()};
  }
  return all;
}

}  // namespace fpz::report
