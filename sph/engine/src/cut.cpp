#include "fpz/sph/cut.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fpz::sph {

namespace {

using Point = Vec<double, 2>;

constexpr double tolerance = 1e-9;  // of the length of the cut

/// Coordinates of a point along the cut (0 to 1) and across it, in units of the cut's length.
struct Place {
  double along, across;
};

Place place(const Cut<2>& cut, const Point& x) {
  const Point d = cut.corner[1] - cut.corner[0];
  const Point r = x - cut.corner[0];
  const double square = d.squaredNorm();
  return {r.dot(d) / square, (d[0] * r[1] - d[1] * r[0]) / square};
}

bool between_the_ends(double along) { return along > tolerance && along < 1.0 - tolerance; }

/// Where the straight line from p to q passes the line of the cut, as a place along it; nothing unless they lie on
/// opposite sides.
std::optional<double> passage(const Cut<2>& cut, const Point& p, const Point& q) {
  const Place a = place(cut, p);
  const Place b = place(cut, q);
  const bool opposite =
      (a.across > tolerance && b.across < -tolerance) || (a.across < -tolerance && b.across > tolerance);
  if (!opposite) return std::nullopt;
  return (a.across * b.along - b.across * a.along) / (a.across - b.across);
}

}  // namespace

bool crosses(const Cut<2>& cut, const Point& p, const Point& q) {
  const std::optional<double> along = passage(cut, p, q);
  return along && between_the_ends(*along);
}

double share_of_bond(const Cut<2>& cut, const Point& p, const Point& q, double spacing) {
  constexpr double none_before = 0.9, whole_beyond = 0.6;  // spacings from the tip
  const std::optional<double> along = passage(cut, p, q);
  if (!along) return 1.0;
  const std::size_t end = *along < 0.5 ? 0 : 1;
  if (!cut.is_tip[end]) return between_the_ends(*along) ? 0.0 : 1.0;
  const double length = (cut.corner[1] - cut.corner[0]).norm();
  const double beyond = (end == 0 ? -*along : *along - 1.0) * length / spacing;
  return std::clamp((beyond + none_before) / (none_before + whole_beyond), 0.0, 1.0);
}

double share_of_bond(const std::vector<Cut<2>>& cuts, const Point& p, const Point& q, double spacing) {
  double share = 1.0;
  for (const Cut<2>& cut : cuts) share *= share_of_bond(cut, p, q, spacing);
  return share;
}

bool lies_on(const Cut<2>& cut, const Point& x) {
  const Place a = place(cut, x);
  return std::abs(a.across) <= tolerance && between_the_ends(a.along);
}

}  // namespace fpz::sph
