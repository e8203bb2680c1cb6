// The body of a specimen: a shape minus holes and notches, in the plane.
#pragma once

#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "fpz/sph/cut.hpp"
#include "fpz/types.hpp"

namespace fpz::specimen {

using Point = Vec<double, 2>;

struct Rectangle {
  Point low = Point::Zero(), high = Point::Zero();
};
struct Disc {
  Point centre = Point::Zero();
  double radius = 0.0;
};
/// The half above its centre: the flat side is y = centre.y.
struct HalfDisc {
  Point centre = Point::Zero();
  double radius = 0.0;
};
struct Ring {
  Point centre = Point::Zero();
  double inner = 0.0, outer = 0.0;
};
/// Simple (not self-crossing), in either sense of rotation.
struct Polygon {
  std::vector<Point> corners;
};
using Shape = std::variant<Rectangle, Disc, HalfDisc, Ring, Polygon>;

/// A straight slot from its mouth on the surface to its tip, square at the tip. Width 0 is a cut: no material is
/// missing. The slot reaches backwards beyond its mouth by its width, so that an inclined one opens the surface fully;
/// an internal one, whose mouth is in the body, ends there as it does at the tip.
struct Notch {
  Point mouth = Point::Zero(), tip = Point::Zero();
  double width = 0.0;
  double asked_width = 0.0;                       ///< narrower than a spacing where `width` is 0 in its place
  bool internal = false;                          ///< the mouth is in the body: both ends are tips
  std::optional<double> friction_angle_deg = {};  ///< of its faces; none: that of the material
};

struct Body {
  Shape shape;
  std::vector<Shape> holes;
  std::vector<Notch> notches;
};

/// Twice the area of the triangle 0, a, b: positive when it is counter-clockwise.
[[nodiscard]] inline double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
/// The point of the straight piece from a to b that is nearest to x.
[[nodiscard]] Point nearest_on(const Point& a, const Point& b, const Point& x);

[[nodiscard]] bool contains(const Shape& shape, const Point& x);
/// In the shape, and in no hole and no slot.
[[nodiscard]] bool contains(const Body& body, const Point& x);

/// Where the horizontal line at height y is inside the body: begin and end of its pieces, disjoint, ascending.
[[nodiscard]] std::vector<std::pair<double, double>> chord(const Body& body, double y);

/// Lowest and highest coordinates.
[[nodiscard]] std::pair<Point, Point> extent(const Shape& shape);

/// Exact, m^2.
[[nodiscard]] double area(const Shape& shape);
/// Area of what contains() holds for, m^2; relative error below 1e-7 (sum over horizontal lines, exact on each).
[[nodiscard]] double area(const Body& body);

/// The corners of a slot; four, or none for width 0.
[[nodiscard]] std::vector<Point> corners(const Notch& notch);

/// Unit vector along the notch, from mouth to tip, and the one to its left.
[[nodiscard]] Point along(const Notch& notch);
[[nodiscard]] Point across(const Notch& notch);

/// The centre line of the notch, with sharp ends.
[[nodiscard]] sph::Cut<2> cut_of(const Notch& notch);
/// The same in a body: an end of a notch without width is a tip where the body goes on half a spacing beyond it.
[[nodiscard]] sph::Cut<2> cut_in(const Body& body, const Notch& notch, double spacing);

/// The surface of the body in pieces no longer than `step` (m): what of its outlines has the body on one side only.
/// Lines that close end where they begin; notches without width are not among them.
[[nodiscard]] std::vector<std::vector<Point>> surface_lines(const Body& body, double step);

/// Closed lines for drawing: outer boundary first, then holes and slots.
[[nodiscard]] std::vector<std::vector<Point>> outlines(const Body& body);

}  // namespace fpz::specimen
