#include "fpz/sph/cut.hpp"

#include <cmath>

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

}  // namespace

bool crosses(const Cut<2>& cut, const Point& p, const Point& q) {
  const Place a = place(cut, p);
  const Place b = place(cut, q);
  const bool opposite =
      (a.across > tolerance && b.across < -tolerance) || (a.across < -tolerance && b.across > tolerance);
  return opposite && between_the_ends((a.across * b.along - b.across * a.along) / (a.across - b.across));
}

bool lies_on(const Cut<2>& cut, const Point& x) {
  const Place a = place(cut, x);
  return std::abs(a.across) <= tolerance && between_the_ends(a.along);
}

}  // namespace fpz::sph
