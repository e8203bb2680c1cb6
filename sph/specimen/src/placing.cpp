#include "fpz/specimen/placing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "cell_areas.hpp"
#include "scattered.hpp"

namespace fpz::specimen {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double most_particles = 2e8;

/// One volume for all, with the area of the body as the sum.
void share_area(sph::Arrangement<2>& a, const Body& body) {
  std::fill(a.volume.begin(), a.volume.end(), area(body) / static_cast<double>(a.size()));
}

/// Number of cells nearest to length/spacing for which no particle lies on a cut: its side would be an accident.
int cells(const Body& body, const Rectangle& r, int component, double spacing) {
  const double length = r.high[component] - r.low[component];
  const int nearest = std::max(1, static_cast<int>(std::lround(length / spacing)));
  for (const int n : {nearest, nearest + 1, nearest - 1}) {
    const double pitch = length / std::max(n, 1);
    const bool clear = std::all_of(body.notches.begin(), body.notches.end(), [&](const Notch& notch) {
      if (notch.width > 0.0 || std::abs(across(notch)[component]) < 1.0 - 1e-9) return true;
      const double cell = (notch.mouth[component] - r.low[component]) / pitch;
      return std::abs(cell - std::floor(cell) - 0.5) > 0.25;
    });
    if (n > 0 && clear) return n;
  }
  return nearest;
}

sph::Arrangement<2> fitted_lattice(const Body& body, const Rectangle& r, double spacing) {
  sph::Arrangement<2> a;
  a.spacing = spacing;
  const int nx = cells(body, r, 0, spacing), ny = cells(body, r, 1, spacing);
  const Point size = r.high - r.low;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Point x(r.low[0] + (i + 0.5) * size[0] / nx, r.low[1] + (j + 0.5) * size[1] / ny);
      if (contains(body, x)) a.add(x, 1.0);
    }
  }
  share_area(a, body);
  return a;
}

sph::Arrangement<2> lattice(const Body& body, const Pattern& pattern, double spacing) {
  sph::Arrangement<2> a;
  a.spacing = spacing;
  const bool turned = pattern.kind == Pattern::Kind::lattice;
  const Point u = turned ? Point(std::cos(pattern.angle), std::sin(pattern.angle)) : Point(1.0, 0.0);
  const Point v = turned ? Point(-u[1], u[0]) : Point(-std::tan(pattern.angle), 1.0);
  const auto [low, high] = extent(body.shape);
  // Lattice coordinates of the corners of the extent bound those of the body.
  Point first = Point::Constant(1e300), last = Point::Constant(-1e300);
  for (const Point& corner : {low, high, Point(low[0], high[1]), Point(high[0], low[1])}) {
    const Point d = corner - pattern.origin;
    const double determinant = u[0] * v[1] - u[1] * v[0];
    const Point c((d[0] * v[1] - d[1] * v[0]) / determinant / spacing,
                  (u[0] * d[1] - u[1] * d[0]) / determinant / spacing);
    first = first.cwiseMin(c).eval();
    last = last.cwiseMax(c).eval();
  }
  for (auto j = static_cast<long>(std::floor(first[1])); j <= static_cast<long>(std::ceil(last[1])); ++j) {
    for (auto i = static_cast<long>(std::floor(first[0])); i <= static_cast<long>(std::ceil(last[0])); ++i) {
      const Point x =
          pattern.origin + spacing * ((static_cast<double>(i) + 0.5) * u + (static_cast<double>(j) + 0.5) * v);
      if (contains(body, x)) a.add(x, 1.0);
    }
  }
  share_area(a, body);
  return a;
}

/// Rings between two radii. Even numbers of particles, one at the top: symmetric about both axes. A disc has one
/// particle in its middle.
void add_rings(sph::Arrangement<2>& a, const Body& body, const Point& centre, double inner, double outer, bool half) {
  const double middle = inner > 0.0 ? inner : 0.5 * outer / (std::floor(outer / a.spacing) + 0.5);
  const int rings = std::max(1, static_cast<int>(std::lround((outer - middle) / a.spacing)));
  const double pitch = (outer - middle) / rings;
  if (inner <= 0.0 && !half && contains(body, centre)) a.add(centre, pi * middle * middle);
  for (int k = 0; k < rings; ++k) {
    const double near = middle + k * pitch, far = near + pitch, radius = 0.5 * (near + far);
    const int half_count = std::max(1, static_cast<int>(std::lround(pi * radius / a.spacing)));
    const double volume = pi * (far * far - near * near) / (2.0 * half_count);
    for (int i = 0; i < (half ? half_count : 2 * half_count); ++i) {
      // A half disc has its particles half a step away from the flat side as well.
      const double angle = (half ? 0.0 : 0.5 * pi) + pi * (i + 0.5) / half_count;
      const Point x(centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle));
      if (contains(body, x)) a.add(x, volume);
    }
  }
}

sph::Arrangement<2> rings(const Body& body, double spacing) {
  sph::Arrangement<2> a;
  a.spacing = spacing;
  if (const auto* d = std::get_if<Disc>(&body.shape)) {
    add_rings(a, body, d->centre, 0.0, d->radius, false);
  } else if (const auto* h = std::get_if<HalfDisc>(&body.shape)) {
    add_rings(a, body, h->centre, 0.0, h->radius, true);
  } else if (const auto* r = std::get_if<Ring>(&body.shape)) {
    add_rings(a, body, r->centre, r->inner, r->outer, false);
  } else {
    throw std::invalid_argument("rings need a disc, a half disc or a ring");
  }
  double sum = 0.0;
  for (const double v : a.volume) sum += v;
  const double scale = area(body) / sum;  // 1 up to rounding, unless holes or notches cut the rings
  for (double& v : a.volume) v *= scale;
  return a;
}

/// Distance from `start` backwards along `d` to the first point of the shape; negative when there is none.
double first_hit(const Shape& shape, const Point& start, const Point& d, double length) {
  constexpr int steps = 4000;
  double outside = 0.0;
  for (int k = 1; k <= steps; ++k) {
    double inside = length * k / steps;
    if (!contains(shape, start - inside * d)) {
      outside = inside;
      continue;
    }
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (outside + inside);
      (contains(shape, start - middle * d) ? inside : outside) = middle;
    }
    return inside;
  }
  return -1.0;
}

/// Particles whose cells are known: rings, and a lattice that fills its rectangle.
bool is_in_order(const Body& body, const Pattern& pattern) {
  if (pattern.move > 0.0 || pattern.kind == Pattern::Kind::scattered) return false;
  const bool whole =
      std::holds_alternative<Rectangle>(body.shape) && body.holes.empty() &&
      std::all_of(body.notches.begin(), body.notches.end(), [](const Notch& n) { return n.width <= 0.0; });
  return pattern.kind == Pattern::Kind::rings || (pattern.fit && pattern.angle == 0.0 && whole);
}

/// Volumes are the areas of the cells. Where the surface cuts a lattice, it leaves larger and smaller parts of cells,
/// and particles as near to it as chance has it: these move to the middle of their part.
void take_cells(sph::Arrangement<2>& a, const Body& body, bool to_the_middle) {
  const std::vector<detail::Cell> cells = detail::cells(body, a.position, a.spacing);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a.volume[i] = cells[i].area;
    if (to_the_middle && cells[i].cut) a.position[i] = cells[i].centroid;
  }
}

sph::Arrangement<2> places(const Body& body, const Pattern& pattern, double spacing) {
  if (pattern.kind == Pattern::Kind::scattered) return detail::scatter(body, pattern.seed, spacing);
  if (pattern.kind == Pattern::Kind::rings) return rings(body, spacing);
  const auto* r = std::get_if<Rectangle>(&body.shape);
  if (pattern.fit && r != nullptr && pattern.angle == 0.0) return fitted_lattice(body, *r, spacing);
  return lattice(body, pattern, spacing);
}

}  // namespace

sph::Arrangement<2> place_specimen(const Body& body, const Pattern& pattern, double spacing) {
  const auto [low, high] = extent(body.shape);
  if ((high - low).prod() / (spacing * spacing) > most_particles) {
    throw std::invalid_argument("the spacing is so small that there would be more than 2e8 particles");
  }
  sph::Arrangement<2> a = places(body, pattern, spacing);
  if (a.size() == 0) throw std::invalid_argument("the spacing is so large that no particle fits into the body");
  if (pattern.move > 0.0) detail::move_at_random(a, body, pattern.move * spacing, pattern.seed);
  const bool lattice = pattern.kind == Pattern::Kind::lattice || pattern.kind == Pattern::Kind::sheared;
  if (!is_in_order(body, pattern)) take_cells(a, body, lattice && pattern.move == 0.0);
  return a;
}

namespace {

/// Columns of a platen and the distance between them, m.
std::pair<int, double> columns_of(const Platen& platen, double spacing) {
  const int columns = std::max(1, static_cast<int>(std::lround(platen.width / spacing)));
  return {columns, platen.width > 0.0 ? platen.width / columns : spacing};
}

}  // namespace

std::vector<std::optional<Point>> platen_feet(const Shape& shape, const Platen& platen, double spacing) {
  const Point d = platen.direction.normalized();
  const Point t(d[1], -d[0]);
  const auto [columns, pitch] = columns_of(platen, spacing);
  const auto [low, high] = extent(shape);
  const double size = (high - low).norm(), away = (platen.at - 0.5 * (low + high)).norm();
  const double reach = 2.0 * std::max(size, 0.5 * size + away);
  std::vector<std::optional<Point>> feet;
  for (int k = 0; k < columns; ++k) {
    const Point line = platen.at + (k + 0.5 - 0.5 * columns) * pitch * t;
    const double hit = first_hit(shape, line + 0.5 * reach * d, d, reach);
    feet.push_back(hit < 0.0 ? std::nullopt : std::optional<Point>(line + (0.5 * reach - hit) * d));
  }
  return feet;
}

std::vector<PlatenColumn> platen_columns(const Shape& shape, const Platen& platen, double spacing) {
  const Point d = platen.direction.normalized();
  const Point t(d[1], -d[0]);
  std::vector<PlatenColumn> columns;
  double outermost = -1e300, middle = 0.0;
  for (const std::optional<Point>& foot : platen_feet(shape, platen, spacing)) {
    if (!foot) throw std::invalid_argument("one of the columns of the platen misses the body");
    columns.push_back({*foot, *foot});
    const double height = (*foot - platen.at).dot(d);
    if (height > outermost + 1e-9 * spacing) outermost = height, middle = (*foot - platen.at).dot(t);
  }
  if (platen.fit == Platen::Fit::surface) return columns;
  const bool symmetric = std::abs((columns.front().foot - columns.back().foot).dot(d)) < 1e-6 * spacing;
  if (symmetric) middle = 0.0;
  for (PlatenColumn& c : columns) {
    double height = outermost;
    if (platen.fit == Platen::Fit::jaw) {
      const double aside = (c.foot - platen.at).dot(t) - middle, r = platen.jaw_radius;
      if (std::abs(aside) >= r) throw std::invalid_argument("the platen is wider than its jaw");
      height = std::max(outermost - (r - std::sqrt(r * r - aside * aside)), (c.foot - platen.at).dot(d));
    }
    c.face += (height - (c.foot - platen.at).dot(d)) * d;
  }
  return columns;
}

std::vector<sph::Cut<2>> contact_of(const Shape& shape, const Platen& platen, double spacing) {
  constexpr double overlap = 0.1;  // of a column: no gap between the pieces of a bent contact
  const Point d = platen.direction.normalized();
  const Point t(d[1], -d[0]);
  const double pitch = columns_of(platen, spacing).second;
  const std::vector<PlatenColumn> columns = platen_columns(shape, platen, spacing);
  const auto cut = [&](const Point& from, const Point& to, double gap) {
    sph::Cut<2> c;
    c.corner = {from, to};
    c.width = c.gap = gap;
    c.friction = *platen.friction;
    return c;
  };
  const Point first = columns.front().face, last = columns.back().face;
  const Point along = columns.size() > 1 ? Point((last - first).normalized()) : t;
  const bool straight = std::all_of(columns.begin(), columns.end(), [&](const PlatenColumn& c) {
    const Point x = c.face - first;
    return std::abs(x[0] * along[1] - x[1] * along[0]) < 1e-6 * spacing && (c.face - c.foot).norm() < 1e-6 * spacing;
  });
  const double half = 0.5 * pitch / std::max(0.1, std::abs(along.dot(t)));
  if (straight) return {cut(first - half * along, last + half * along, 0.0)};
  std::vector<sph::Cut<2>> cuts;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Point chord = columns[std::min(k + 1, columns.size() - 1)].face - columns[k > 0 ? k - 1 : 0].face;
    const Point side = (0.5 + overlap) * pitch / std::max(0.1, chord.normalized().dot(t)) * chord.normalized();
    const double gap = (columns[k].face - columns[k].foot).norm() * std::abs(chord.normalized().dot(t));
    const Point middle = 0.5 * (columns[k].face + columns[k].foot);
    cuts.push_back(cut(middle - side, middle + side, gap < 1e-6 * spacing ? 0.0 : gap));
  }
  return cuts;
}

void place_platen(sph::Arrangement<2>& a, const Shape& shape, const Platen& platen, int group) {
  const Point d = platen.direction.normalized();
  const double pitch = columns_of(platen, a.spacing).second;
  for (const PlatenColumn& column : platen_columns(shape, platen, a.spacing)) {
    for (int layer = 0; layer < platen.layers; ++layer) {
      a.add(column.face + (layer + 0.5) * a.spacing * d, pitch * a.spacing, group);
    }
  }
}

}  // namespace fpz::specimen
