// Platens against the body, its notches and holes, and each other.
#include <cmath>

#include "check_scene.hpp"
#include "surface_depth.hpp"

namespace fpz::specimen::detail {
namespace {

/// The feet of a platen's columns that stand on the body.
struct Footing {
  std::string_view key = "at";  ///< that says where
  std::size_t columns = 0;
  std::vector<Point> feet;
  Point direction = Point::Zero();  ///< outward, of length one
};

Footing footing_of(const Scene& scene, const Platen& platen) {
  Footing f;
  f.direction = platen.direction.normalized();
  for (const std::optional<Point>& foot : platen_feet(scene.body.shape, platen, scene.spacing)) {
    ++f.columns;
    if (foot) f.feet.push_back(*foot);
  }
  return f;
}

std::string body_reach(const Scene& scene) {
  const auto [low, high] = extent(scene.body.shape);
  return "the body reaches from " + brief(low) + " to " + brief(high);
}

void check_footing(const SceneCheck& c, const Place& p, const Platen& platen, const Footing& f) {
  if (f.feet.empty()) {
    return with(p, f.key, [&](const Place& at) {
      c.problem(at, "the platen is off the body: nothing lies on the line through it along \"direction\" = " +
                        brief(platen.direction) + " (" + body_reach(c.scene) + ")" +
                        likely_place(platen.at, c.scene.body.shape));
    });
  }
  constexpr std::size_t least_to_slide = 2;  // columns: a face has places between particles
  if (platen.friction && f.columns < least_to_slide) {
    return at_member(p, "width", [&](const Place& at) {
      c.problem(at,
                "has " + std::to_string(f.columns) +
                    " column of particles, too little for a face that presses and slides (\"friction\"); must be >= " +
                    brief(static_cast<double>(least_to_slide) * c.scene.spacing) + ", or the \"spacing\" smaller");
    });
  }
  if (f.feet.size() == f.columns) return;
  const double width = platen.width * static_cast<double>(f.feet.size()) / static_cast<double>(f.columns);
  with(p, "width", [&](const Place& at) {
    c.problem(at, "the platen reaches beyond the body: " + std::to_string(f.columns - f.feet.size()) + " of its " +
                      std::to_string(f.columns) + " columns miss the surface, which is under it from " +
                      brief(f.feet.front()) + " to " + brief(f.feet.back()) + "; must be about " + brief(width) +
                      " at most there, or \"at\" must move" +
                      likely_length(platen.width, 0.5 * c.scene.spacing, width));
  });
}

/// A platen turns about a point in it or near it.
void check_hinge(const SceneCheck& c, const Place& p, const Boundary& b, const Footing& f) {
  if (!b.hinge) return;
  const auto [low, high] = extent(c.scene.body.shape);
  const double away = (*b.hinge - f.feet[f.feet.size() / 2]).norm(), size = (high - low).maxCoeff();
  if (away <= size) return;
  with(p, "hinge", [&](const Place& at) {
    c.problem(at, "is " + brief(away) + " m from the platen, which stands at " + brief(f.feet[f.feet.size() / 2]) +
                      "; must be <= " + brief(size) + ", the size of the body" +
                      likely_place(*b.hinge, c.scene.body.shape));
  });
}

/// The platen stands where its columns meet the surface from outside; `at` should be near that.
void check_side(const SceneCheck& c, const Place& p, const Platen& platen, const Footing& f) {
  constexpr double near = 2.0, far = 0.25;
  const Point d = platen.direction.normalized();
  const auto [low, high] = extent(c.scene.body.shape);
  const Point foot = f.feet[f.feet.size() / 2];
  const double outward = (foot - platen.at).dot(d);
  if (outward > near * c.scene.spacing && depth(c.scene.body, platen.at) < near * c.scene.spacing) {
    return with(p, "direction", [&](const Place& at) {
      c.problem(at, "points into the body from \"at\" = " + brief(platen.at) +
                        ", so that the platen would stand on the other side, at " + brief(foot) +
                        "; must point outwards");
    });
  }
  if (-outward < far * (high - low).maxCoeff()) return;
  with(p, f.key, [&](const Place& at) {
    c.warn(at, "lies " + brief(-outward) + " m above the surface; the platen stands on it, at " + brief(foot));
  });
}

void check_ground(const SceneCheck& c, const Place& p, const Platen& platen, const Footing& f) {
  const Scene& s = c.scene;
  const Point d = platen.direction.normalized();
  std::size_t hollow = 0;
  for (const Point& foot : f.feet) hollow += contains(s.body, foot - 0.5 * s.spacing * d) ? 0U : 1U;
  const std::string over = std::to_string(hollow) + " of its " + std::to_string(f.columns) +
                           " columns stand over a hole or a slot, where nothing carries them";
  at_member(p, f.key, [&](const Place& at) {
    if (hollow == f.columns) return c.problem(at, over);
    if (hollow > 0) return c.warn(at, over);
    for (std::size_t k = 0; k < s.body.notches.size(); ++k) {
      for (const Point& end : {s.body.notches[k].mouth, s.body.notches[k].tip}) {
        const bool beneath = std::abs((end - f.feet[f.feet.size() / 2]).dot(d)) < s.spacing &&
                             std::abs((end - platen.at).dot(Point(d[1], -d[0]))) < 0.5 * platen.width;
        if (!beneath) continue;
        c.warn(at, "notches[" + std::to_string(k) +
                       "] reaches the surface under the platen, which holds its faces "
                       "together there");
      }
    }
  });
}

void check_overlap(const SceneCheck& c, const Place& p, const Footing& own, const std::vector<Footing>& earlier) {
  for (std::size_t k = 0; k < earlier.size(); ++k) {
    constexpr double one_side = 0.5;  // cosine; platens on two sides of a corner stand apart
    if (own.direction.dot(earlier[k].direction) < one_side) continue;
    double nearest = 1e300;
    for (const Point& a : own.feet) {
      for (const Point& b : earlier[k].feet) nearest = std::min(nearest, (a - b).norm());
    }
    if (nearest > 0.9 * c.scene.spacing) continue;
    at_member(p, own.key, [&](const Place& at) {
      c.problem(at, "the platen lies on the one of boundary " + io::in_quotes(c.scene.boundaries[k].name) +
                        ": they touch the surface at the same places, " + brief(own.feet.front()) + " to " +
                        brief(own.feet.back()));
    });
  }
}

}  // namespace

void check_boundaries(const SceneCheck& c) {
  std::vector<Footing> earlier;
  for_entries(c, "boundaries", [&](const Place& p, std::size_t k) {
    earlier.emplace_back();
    const std::vector<Platen> all_places = platens_of(c.scene.boundaries[k]);
    for (const Platen& platen : all_places) {
      Footing f = footing_of(c.scene, platen);
      if (&platen != &all_places.front()) f.key = "also_at";
      check_footing(c, p, platen, f);
      if (f.feet.size() == f.columns) {
        check_side(c, p, platen, f);
        check_hinge(c, p, c.scene.boundaries[k], f);
        check_ground(c, p, platen, f);
        check_overlap(c, p, f, earlier);
      }
      earlier.back().direction = f.direction;
      earlier.back().feet.insert(earlier.back().feet.end(), f.feet.begin(), f.feet.end());
    }
  });
}

}  // namespace fpz::specimen::detail
