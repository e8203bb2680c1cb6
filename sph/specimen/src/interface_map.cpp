#include "interface_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "fpz/io/problems.hpp"

namespace fpz::specimen::detail {
namespace {

using Arrangement = sph::Arrangement<2>;
using Planes = sph::WeakPlanes<2>;

Point normal_of(const Bedding& b) { return {-std::sin(b.angle), std::cos(b.angle)}; }

/// Unit normal of the line at x, where that is beside it and no further than `reach`.
std::optional<Point> plane_beside(const std::vector<Point>& line, const Point& x, double reach) {
  constexpr double corner = 0.5;  // of the reach: how far a piece goes on beyond a corner of the line
  std::optional<Point> normal;
  double nearest = reach * (1.0 + 1e-9);
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Point u = (line[k + 1] - line[k]).normalized(), n(-u[1], u[0]);
    const double length = (line[k + 1] - line[k]).norm(), along = u.dot(x - line[k]),
                 away = std::abs(n.dot(x - line[k]));
    const double before = k > 0 ? corner * reach : 0.0, beyond = k + 2 < line.size() ? corner * reach : 0.0;
    if (along < -before || along > length + beyond || away > nearest) continue;
    nearest = away;
    normal = n;
  }
  return normal;
}

std::optional<Point> plane_beside(const Bedding& b, const Point& x, double reach) {
  const Point n = normal_of(b);
  const double planes = n.dot(x - b.origin) / b.spacing;
  if (std::abs(planes - std::round(planes)) * b.spacing > reach * (1.0 + 1e-9)) return std::nullopt;
  return n;
}

/// Pieces of a straight line from a to b that are in the body.
void add_pieces(std::vector<std::vector<Point>>& pieces, const Body& body, const Point& a, const Point& b,
                double step) {
  const int count = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
  std::vector<Point> piece;
  for (int k = 0; k <= count; ++k) {
    const Point x = a + (b - a) * k / count;
    if (contains(body, x)) {
      piece.push_back(x);
      continue;
    }
    if (piece.size() > 1) pieces.push_back(piece);
    piece.clear();
  }
  if (piece.size() > 1) pieces.push_back(piece);
}

}  // namespace

void assign_interfaces(const Scene& scene, sph::RunSetup<2>& setup) {
  if (scene.interfaces.empty()) return;
  const Arrangement& a = setup.arrangement;
  const double reach = interface_reach * scene.spacing;
  Planes& planes = setup.weak_planes;
  planes.of_particle.assign(a.size(), Planes::none);
  planes.normal.assign(a.size(), Point(1.0, 0.0));
  for (std::size_t k = 0; k < scene.interfaces.size(); ++k) {
    const Interface& f = scene.interfaces[k];
    planes.parameters.push_back(f.material);
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a.group[i] != Arrangement::specimen) continue;
      const auto normal =
          f.bedding ? plane_beside(*f.bedding, a.position[i], reach) : plane_beside(f.line, a.position[i], reach);
      if (!normal) continue;
      planes.of_particle[i] = static_cast<int>(k);
      planes.normal[i] = *normal;
    }
  }
  const std::vector<std::size_t> count = interface_particles(scene, setup);
  for (std::size_t k = 0; k < count.size(); ++k) {
    if (count[k] > 0) continue;
    throw std::invalid_argument(
        "interfaces[" + std::to_string(k) + "] = " + io::in_quotes(scene.interfaces[k].name) +
        ": no particle is beside it: it is outside the body, or later interfaces take its place");
  }
}

std::vector<std::vector<Point>> lines_in_body(const Interface& f, const Body& body, double step) {
  std::vector<std::vector<Point>> pieces;
  for (std::size_t k = 0; k + 1 < f.line.size(); ++k) add_pieces(pieces, body, f.line[k], f.line[k + 1], step);
  if (!f.bedding) return pieces;
  const auto [low, high] = extent(body.shape);
  const Point n = normal_of(*f.bedding), u(n[1], -n[0]), middle = 0.5 * (low + high);
  const double half = 0.5 * (high - low).norm(), first = n.dot(middle - f.bedding->origin);
  const double spacing = f.bedding->spacing;
  for (double p = std::ceil((first - half) / spacing); p * spacing <= first + half; p += 1.0) {
    const Point foot = middle + (p * spacing - first) * n;
    add_pieces(pieces, body, foot - half * u, foot + half * u, step);
  }
  return pieces;
}

std::vector<std::size_t> interface_particles(const Scene& scene, const sph::RunSetup<2>& setup) {
  std::vector<std::size_t> count(scene.interfaces.size(), 0);
  for (const int k : setup.weak_planes.of_particle) {
    if (k >= 0) ++count[static_cast<std::size_t>(k)];
  }
  return count;
}

}  // namespace fpz::specimen::detail
