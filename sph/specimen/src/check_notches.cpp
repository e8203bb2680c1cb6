// Notches against the body: where they begin and end.
#include <cmath>
#include <numbers>

#include "check_scene.hpp"
#include "surface_depth.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr double beyond_the_body = 2.0;  ///< spacings that a cut through the body may reach beyond it
constexpr double at_the_surface = 0.5;   ///< spacings within which a mouth is on the surface

/// One notch, and the parts of its centre line in the body.
struct NotchLine {
  const Notch& notch;
  double length;
  std::vector<std::pair<double, double>> parts;
};

/// The angle, as scenes count it, that leads from a point of the surface straight into the body.
double inward_angle(const Body& body, const Point& x, double step) {
  double best = 0.0, deepest = -1e300;
  for (int degrees = -180; degrees < 180; degrees += 5) {
    const double a = degree * degrees;
    const double reached = depth(body, x + step * Point(-std::sin(a), std::cos(a)));
    if (reached > deepest * (1.0 + 1e-9)) deepest = reached, best = degrees;
  }
  return best;
}

void refuse_outside(const SceneCheck& c, const Place& p, const NotchLine& line) {
  const Scene& s = c.scene;
  const double away = -depth(s.body, line.notch.mouth);
  if (away <= beyond_the_body * s.spacing) {
    return at_member(p, "angle_deg", [&](const Place& at) {
      c.problem(at, "the notch points out of the body from its mouth " + brief(line.notch.mouth) +
                        "; must lead into it, as " + brief(inward_angle(s.body, line.notch.mouth, 4.0 * s.spacing)) +
                        " does (degrees from +y, counter-clockwise)");
    });
  }
  const auto [low, high] = extent(s.body.shape);
  with(p, "mouth", [&](const Place& at) {
    c.problem(at, "the notch is outside the body, its mouth by " + brief(away) +
                      " m; must lie on the surface (the body reaches from " + brief(low) + " to " + brief(high) +
                      ", and its nearest point is " + brief(nearest_on_surface(s.body, line.notch.mouth)) + ")" +
                      likely_place(line.notch.mouth, s.body.shape));
  });
}

void check_mouth(const SceneCheck& c, const Place& p, const NotchLine& line) {
  const double spacing = c.scene.spacing, before = line.parts.front().first;
  if (before <= at_the_surface * spacing) return;
  const Point entry = line.notch.mouth + before * along(line.notch);
  const std::string text = "the mouth is outside the body, which the notch enters " + brief(before) +
                           " m further on: \"length\" counts from the mouth; put it at " + brief(entry);
  with(p, "mouth",
       [&](const Place& at) { before > beyond_the_body* spacing ? c.problem(at, text) : c.warn(at, text); });
}

void check_length(const SceneCheck& c, const Place& p, const NotchLine& line) {
  const double spacing = c.scene.spacing, end = line.parts.back().second;
  with(p, "length", [&](const Place& at) {
    if (line.length - end > beyond_the_body * spacing) {
      c.problem(at, "the notch is longer than the body, which it leaves after " + brief(end) + " m; must be <= that" +
                        likely_length(line.length, spacing, end));
    } else if (line.length < spacing) {
      c.warn(at, "shorter than a spacing (" + brief(spacing) + "): particles cannot follow it" +
                     likely_length(line.length, spacing, end));
    }
    if (line.parts.size() > 1 && line.parts[1].first - line.parts[0].second > at_the_surface * spacing) {
      c.warn(at, "the notch runs through a hole or a bay of the body from " +
                     brief(Point(line.notch.mouth + line.parts[0].second * along(line.notch))) + " to " +
                     brief(Point(line.notch.mouth + line.parts[1].first * along(line.notch))));
    }
  });
}

/// The closed line of the surface of shape and holes that is nearest to a point, by its number.
std::size_t line_of(const Body& body, const Point& x) {
  const auto lines = outlines(without_notches(body));
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double distance = distance_to(lines[k], x);
    if (distance < least) least = distance, nearest = k;
  }
  return nearest;
}

/// A notch from one place of a surface to another of the same leaves two pieces. With a friction angle of its own it is
/// meant as a joint.
void check_division(const SceneCheck& c, const Place& p, const NotchLine& line) {
  const Scene& s = c.scene;
  const bool from_surface =
      line.parts.front().first > 0.0 || depth(s.body, line.notch.mouth) < at_the_surface * s.spacing;
  const bool to_surface = depth(s.body, line.notch.tip) < at_the_surface * s.spacing;
  const bool joint = line.notch.width <= 0.0 && p.value().find("friction_angle_deg") != nullptr;
  if (!from_surface || !to_surface || joint || line.parts.size() > 1) return;
  if (line_of(s.body, line.notch.mouth) != line_of(s.body, line.notch.tip)) return;
  with(p, "length", [&](const Place& at) {
    c.warn(at,
           line.notch.width > 0.0
               ? "the slot goes from surface to surface and divides the body: nothing holds its parts together"
               : "the cut goes from surface to surface and divides the body: only contact holds its parts together; "
                 "if a joint is meant, give it a \"friction_angle_deg\"");
  });
}

/// Where nothing presses the faces together, none of them slides.
void check_friction(const SceneCheck& c, const Place& p) {
  if (c.scene.options.configuration == sph::Configuration::reference) return;
  with(p, "friction_angle_deg", [&](const Place& at) {
    c.problem(at,
              "faces press on each other and slide in the configuration reference only, and pass through each other "
              "with method.configuration = updated: leave one of them out");
  });
}

void check_width(const SceneCheck& c, const Place& p, const Notch& notch) {
  const auto [low, high] = extent(c.scene.body.shape);
  const double widest = (high - low).minCoeff();
  if (notch.asked_width < widest) return;
  with(p, "width", [&](const Place& at) {
    if (!at.value().is(JsonValue::Kind::number)) return;  // as wide as the spacing makes it
    c.problem(at, "the slot is wider than the body; must be < " + brief(widest) +
                      likely_length(notch.asked_width, 0.0, 0.5 * widest));
  });
}

/// A tip that ends in a hole is none.
void check_tip(const SceneCheck& c, const Place& p, const NotchLine& line) {
  for (std::size_t k = 0; k < c.scene.body.holes.size(); ++k) {
    if (!contains(c.scene.body.holes[k], line.notch.tip)) continue;
    with(p, "length", [&](const Place& at) {
      c.warn(at, "the notch ends in holes[" + std::to_string(k) +
                     "]: its tip is no crack tip, and the notch opens into the hole");
    });
  }
}

void check_notch(const SceneCheck& c, const Place& p, std::size_t k) {
  const Notch& n = c.scene.body.notches[k];
  for (std::size_t j = 0; j < k; ++j) {
    const Notch& other = c.scene.body.notches[j];
    if (other.mouth == n.mouth && other.tip == n.tip) c.problem(p, "the same as notches[" + std::to_string(j) + "]");
  }
  const double length = (n.tip - n.mouth).norm();
  const NotchLine line{n, length, parts_inside(c.scene.body, n.mouth, n.tip)};
  const double least = std::min(at_the_surface * c.scene.spacing, 0.5 * length);
  double inside = 0.0;
  for (const auto& [from, to] : line.parts) inside += to - from;
  if (inside < least) return refuse_outside(c, p, line);
  check_mouth(c, p, line);
  check_length(c, p, line);
  check_width(c, p, n);
  check_tip(c, p, line);
  check_friction(c, p);
  check_division(c, p, line);
}

}  // namespace

void check_notches(const SceneCheck& c) {
  for_entries(c, "notches", [&](const Place& p, std::size_t k) { check_notch(c, p, k); });
}

}  // namespace fpz::specimen::detail
