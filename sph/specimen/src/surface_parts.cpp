// Which pieces of a surface a load acts on.
#include <cmath>
#include <numbers>

#include "fpz/specimen/surface_shares.hpp"

namespace fpz::specimen {
namespace {

/// Index of the hole or slot in which the side of a piece lies that is not the body; none: outside of the shape.
struct Neighbour {
  std::optional<std::size_t> hole, notch;
};

Neighbour beyond(const Body& body, const SurfacePiece& piece, double spacing) {
  const Point x = piece.middle() + 0.01 * spacing * piece.normal;
  Neighbour n;
  for (std::size_t k = 0; k < body.holes.size(); ++k) {
    if (contains(body.holes[k], x)) n.hole = k;
  }
  for (std::size_t k = 0; k < body.notches.size(); ++k) {
    if (body.notches[k].width > 0.0 && contains(Shape(Polygon{corners(body.notches[k])}), x)) n.notch = k;
  }
  if (std::holds_alternative<Ring>(body.shape)) {
    const auto& ring = std::get<Ring>(body.shape);
    if ((x - ring.centre).norm() < ring.inner) n.hole = body.holes.size();
  }
  return n;
}

bool in_sector(const SurfacePart::Sector& s, const Point& x) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const Point d = x - s.centre;
  double angle = std::atan2(d[1], d[0]) - s.from;
  angle -= turn * std::floor(angle / turn);
  return angle <= s.to - s.from;
}

/// What is on the rim counts as inside: surfaces are often the side of a box.
bool is_within(const Shape& shape, const Point& x, double margin) {
  const auto [low, high] = extent(shape);
  const bool near = ((x - low).array() >= -margin).all() && ((high - x).array() >= -margin).all();
  if (std::holds_alternative<Rectangle>(shape)) return near;
  const Point inward = 0.5 * (low + high) - x;
  return contains(shape, x) || contains(shape, x + margin * inward.normalized());
}

}  // namespace

std::vector<double> loaded_parts(const Body& body, const std::vector<SurfacePart>& on,
                                 const std::vector<SurfacePiece>& pieces, double spacing) {
  std::vector<double> parts;
  for (const SurfacePiece& piece : pieces) {
    const Neighbour other = beyond(body, piece, spacing);
    const auto inside = [&](const Point& x) {
      return std::any_of(on.begin(), on.end(), [&](const SurfacePart& p) {
        return (!p.outside || (!other.hole && !other.notch)) && (!p.hole || other.hole == p.hole) &&
               (!p.notch || other.notch == p.notch) && (!p.within || is_within(*p.within, x, 1e-6 * spacing)) &&
               (!p.sector || in_sector(*p.sector, x));
      });
    };
    parts.push_back(part_inside(piece, inside));
  }
  return parts;
}

}  // namespace fpz::specimen
