// Prescribed motions: whether they strain the specimen, how fast, and whether gauges see them with the right sign.
#include <cmath>
#include <functional>

#include "check_scene.hpp"
#include "fpz/material.hpp"

namespace fpz::specimen::detail {
namespace {

/// What drives one component of a boundary until the end of the run.
struct Course {
  bool forced = false;     ///< by a force; its motion is not known before
  double push = 0.0;       ///< of a force its mean, N; else 0
  double travel = 0.0;     ///< of a motion, m
  double path = 0.0;       ///< the same with all motion counted positive, m
  double top_speed = 0.0;  ///< largest magnitude, m/s

  /// It does not come back on its way.
  [[nodiscard]] bool one_way() const { return std::abs(travel) >= 0.999 * path; }
};

Course course_of(const Actuation& actuation, double time) {
  constexpr int steps = 2000;
  const sph::TimeTable table = actuation.course.starting(0.0, 0.0);
  const double step = time / steps;
  Course c;
  c.forced = actuation.kind == sph::Drive::Kind::force;
  for (int k = 0; k < steps; ++k) {
    const double from = table.at(k * step), to = table.at((k + 1) * step), mean = 0.5 * (from + to);
    const bool is_place = actuation.kind == sph::Drive::Kind::displacement;
    const double way = is_place ? to - from : mean * step;
    if (c.forced) {
      c.push += mean / steps;
      continue;
    }
    c.travel += way;
    c.path += std::abs(way);
    c.top_speed = std::max(c.top_speed, is_place ? std::abs(way) / step : std::max(std::abs(from), std::abs(to)));
  }
  return c;
}

using Courses = std::vector<std::array<std::optional<Course>, 2>>;

Courses courses_of(const Scene& scene) {
  Courses all;
  for (const Boundary& b : scene.boundaries) {
    auto& own = all.emplace_back();
    for (std::size_t k = 0; k < 2; ++k) {
      if (b.drive[k]) own[k] = course_of(*b.drive[k], scene.stop.time);
    }
  }
  return all;
}

/// Forces act besides prescribed motions: what moves where, and against what, is not known before.
bool has_forces(const Scene& scene, const Courses& all) {
  const auto forced = [](const auto& course) { return course && course->forced; };
  return scene.options.gravity.norm() > 0.0 || !scene.loads.empty() ||
         std::any_of(all.begin(), all.end(),
                     [&](const auto& own) { return std::any_of(own.begin(), own.end(), forced); });
}

// ---- Whether anything is strained

/// The courses of all boundaries that prescribe a component differ from each other.
bool strains(const Courses& all, std::size_t component) {
  std::optional<Course> first;
  for (const auto& own : all) {
    if (!own[component]) continue;
    if (first && (first->travel != own[component]->travel || first->path != own[component]->path)) return true;
    first = own[component];
  }
  return false;
}

void check_motion(const SceneCheck& c, const Courses& all) {
  double fastest = 0.0;
  for (const auto& own : all) {
    for (const auto& course : own) fastest = course ? std::max(fastest, course->top_speed) : fastest;
  }
  if (has_forces(c.scene, all) || all.size() < 2 || strains(all, 0) || strains(all, 1)) return;
  with(c.root, "boundaries", [&](const Place& p) {
    c.problem(p, fastest > 0.0 ? "all boundaries move alike, so that nothing is strained; one must move against another"
                               : "no boundary moves, and there is neither a load nor gravity: nothing loads the "
                                 "specimen");
  });
}

// ---- How fast, how long

/// Stress of the wave that a wall makes which suddenly moves at the speed 1 m/s, Pa s/m.
double impedance(const Scene& scene) {
  const Elasticity<double> bulk = make_material(scene.parameters, scene.setting).bulk;
  return std::sqrt((bulk.lambda + 2.0 * bulk.mu) * scene.parameters.density);
}

void check_speed(const SceneCheck& c, const Place& driven, const Course& course) {
  constexpr double millimetres = 1e-3;
  const Scene& s = c.scene;
  const double shocking = s.parameters.tensile_strength / impedance(s), sound = impedance(s) / s.parameters.density;
  at_member(driven, "speed", [&](const Place& p) {
    const std::string speed = brief(course.top_speed);
    if (course.top_speed >= sound) {
      c.problem(p, "moves at " + speed + " m/s; must be < " + brief(sound) + ", the speed of sound in this material");
    } else if (course.top_speed > shocking) {
      std::string text = "a start at " + speed + " m/s sends a wave into the specimen whose stress is " +
                         brief(1e-6 * course.top_speed * impedance(s)) +
                         " MPa, above the tensile strength: a dynamic test; should be well below " + brief(shocking) +
                         " m/s for a quasi-static one";
      if (course.top_speed * millimetres < shocking) {
        text += "; " + speed + " mm/s was perhaps meant: write " + brief(millimetres * course.top_speed);
      }
      c.warn(p, text);
    }
  });
}

void check_ramp(const SceneCheck& c, const Place& driven, const Actuation& actuation) {
  if (actuation.course.duration() <= c.scene.stop.time) return;
  at_member(driven, "ramp", [&](const Place& p) {
    c.warn(p, "takes " + brief(actuation.course.duration()) +
                  " s, longer than stop.time = " + brief(c.scene.stop.time) + " s: its end is never reached");
  });
}

void check_drives(const SceneCheck& c, const Courses& all) {
  for_entries(c, "boundaries", [&](const Place& p, std::size_t k) {
    for (const char* key : {"velocity", "displacement", "force"}) {
      with(p, key, [&](const Place& drive) {
        for (std::size_t j = 0; j < 2; ++j) {
          with(drive, component_names[j], [&](const Place& driven) {
            check_speed(c, driven, *all[k][j]);
            check_ramp(c, driven, *c.scene.boundaries[k].drive[j]);
          });
        }
      });
    }
  });
}

/// Before a wave has crossed the body, nothing that a test measures has happened.
void check_time(const SceneCheck& c) {
  if (c.scene.particles) return;
  const auto [low, high] = extent(c.scene.body.shape);
  const double crossing = (high - low).maxCoeff() * c.scene.parameters.density / impedance(c.scene);
  if (c.scene.stop.time >= crossing) return;
  with(c.root, "stop", [&](const Place& stops) {
    with(stops, "time", [&](const Place& p) {
      c.warn(p, "shorter than the " + brief(crossing) + " s that a wave takes to cross the body");
    });
  });
}

/// A run that only its time ends should not tear the specimen to shreds.
void check_travel(const SceneCheck& c, const Courses& all) {
  constexpr double too_far = 0.1;
  const StopRules& stop = c.scene.stop;
  if (stop.deflection || stop.load_below || stop.separation || c.scene.particles) return;
  const auto [low, high] = extent(c.scene.body.shape);
  const double size = (high - low).maxCoeff();
  double farthest = 0.0;
  for (const auto& own : all) {
    for (const auto& course : own) farthest = course ? std::max(farthest, std::abs(course->travel)) : farthest;
  }
  if (farthest < too_far * size) return;
  with(c.root, "stop", [&](const Place& stops) {
    with(stops, "time", [&](const Place& p) {
      c.warn(p, "until then a boundary moves by " + brief(farthest) + " m, " + brief(100.0 * farthest / size) +
                    " % of the size of the body");
    });
  });
}

// ---- Signs

/// The component along which a direction points, when it is one.
std::optional<std::size_t> axis_of(const Point& direction) {
  constexpr double along = 0.999;
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::abs(direction[static_cast<int>(k)]) > along) return k;
  }
  return std::nullopt;
}

bool moves(const Courses& all, std::size_t axis) {
  return std::any_of(all.begin(), all.end(), [&](const auto& own) { return own[axis] && own[axis]->path > 0.0; });
}

/// Indices of boundaries by their names.
std::vector<std::size_t> indices(const Scene& scene, const std::vector<std::string>& names) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < scene.boundaries.size(); ++k) {
    if (std::find(names.begin(), names.end(), scene.boundaries[k].name) != names.end()) all.push_back(k);
  }
  return all;
}

bool is_among(const std::vector<std::size_t>& list, std::size_t k) {
  return std::find(list.begin(), list.end(), k) != list.end();
}

/// Least and largest travel of some boundaries in a component, along a sign; nothing when one of them is free.
struct Range {
  double least = 1e300, largest = -1e300;
};
std::optional<Range> travels(const Courses& all, std::size_t axis, double sign,
                             const std::function<bool(std::size_t)>& wanted, bool free_allowed) {
  Range r;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!wanted(k)) continue;
    if (!all[k][axis] || all[k][axis]->forced) {
      if (!free_allowed) return std::nullopt;
      continue;
    }
    const double way = sign * all[k][axis]->travel;
    r.least = std::min(r.least, way), r.largest = std::max(r.largest, way);
  }
  if (r.least > r.largest) return std::nullopt;
  return r;
}

/// What holds a boundary on its motion acts along that motion, seen from the boundaries that it moves against: with
/// motions along one axis only, and slow ones, by the work that loads a specimen at rest.
void check_force_sign(const SceneCheck& c, const Place& gauge, const ForceGauge& g, const Courses& all) {
  const auto axis = axis_of(g.direction);
  if (!axis) return;
  const std::string name(component_names[*axis]);
  const double sign = g.direction[static_cast<int>(*axis)] > 0.0 ? 1.0 : -1.0;
  const std::vector<std::size_t> own = indices(c.scene, g.groups);
  with(gauge, "direction", [&](const Place& p) {
    const bool is_free = std::none_of(own.begin(), own.end(), [&](std::size_t k) { return all[k][*axis]; });
    if (is_free) {
      return c.problem(p, "nothing drives or holds \"force_on\" in " + name + ", so that its force there is always 0");
    }
    double push = 0.0;
    for (const std::size_t k : own) push += all[k][*axis] ? sign * all[k][*axis]->push : 0.0;
    if (push < 0.0) {
      return c.problem(p, "points against the force on \"force_on\"; must be " + brief(Point(-g.direction)));
    }
    if (has_forces(c.scene, all)) return;
    const auto held = travels(
        all, *axis, sign, [&](std::size_t k) { return is_among(own, k); }, true);
    if (!held) return;
    const auto others = travels(
        all, *axis, sign, [&](std::size_t k) { return !is_among(own, k); }, true);
    if (!moves(all, *axis) && moves(all, 1 - *axis) && gauge.value().key == "load") {
      return c.warn(
          p, "nothing moves along it; the prescribed motions are along " + std::string(component_names[1 - *axis]));
    }
    const Range against = others.value_or(Range{0.0, 0.0});
    if (held->largest > against.least || held->least >= against.largest) return;
    const std::string text =
        "points against the motion of \"force_on\" (seen from the other boundaries), so that the "
        "force is negative; must be " +
        brief(Point(-g.direction));
    moves(all, 1 - *axis) ? c.warn(p, text) : c.problem(p, text);
  });
}

/// Where a displacement gauge goes between boundaries that move as prescribed, per unit of its direction.
void check_displacement_sign(const SceneCheck& c, const Place& gauge, const DisplacementGauge& g, const Courses& all) {
  const auto axis = axis_of(g.direction);
  if (!axis) return;
  const double sign = g.direction[static_cast<int>(*axis)] > 0.0 ? 1.0 : -1.0;
  const auto of_sites = [&](const std::vector<Site>& sites) -> std::optional<Range> {
    std::vector<std::string> names;
    for (const Site& s : sites) {
      if (s.group.empty()) return std::nullopt;
      names.push_back(s.group);
    }
    const std::vector<std::size_t> list = indices(c.scene, names);
    return travels(
        all, *axis, sign, [&](std::size_t k) { return is_among(list, k); }, false);
  };
  const auto base = g.relative_to.empty() ? std::optional<Range>(Range{0.0, 0.0}) : of_sites(g.relative_to);
  const auto own = of_sites({g.of});
  const auto any = has_forces(c.scene, all) ? std::nullopt
                                            : travels(
                                                  all, *axis, sign, [](std::size_t) { return true; }, true);
  if (!base || base->least != base->largest) return;
  with(gauge, "direction", [&](const Place& p) {
    const std::string turned = "; must be " + brief(Point(-g.direction));
    if (own && own->largest == base->least) {
      c.problem(p, "the boundary does not move that way (seen from \"relative_to\"): always 0");
    } else if (own && own->largest < base->least) {
      c.problem(p, "points against the motion of the boundary: the deflection would be negative" + turned);
    } else if (!own && any && any->largest <= base->least && any->least < base->least) {
      c.warn(p, "points against the motion of all boundaries: the deflection will be negative" + turned);
    }
  });
}

/// The deflection at which a run stops must come within its time.
void check_reach(const SceneCheck& c, const Courses& all) {
  const auto* g = std::get_if<DisplacementGauge>(&c.scene.gauges.at("deflection"));
  const auto axis = g != nullptr ? axis_of(g->direction) : std::nullopt;
  if (!axis || !c.scene.stop.deflection || has_forces(c.scene, all)) return;
  const auto any = travels(
      all, *axis, 1.0, [](std::size_t) { return true; }, true);
  if (!any) return;
  const double most = std::max(any->largest, 0.0) - std::min(any->least, 0.0);
  if (*c.scene.stop.deflection <= most) return;
  with(c.root, "stop", [&](const Place& stop) {
    with(stop, "deflection", [&](const Place& p) {
      c.warn(p, "is not reached before stop.time = " + brief(c.scene.stop.time) +
                    " s, until which boundaries move against each other by " + brief(most) + " m" +
                    likely_length(*c.scene.stop.deflection, 1e-3 * most, most));
    });
  });
}

void check_signs(const SceneCheck& c, const Courses& all) {
  const bool one_way = std::all_of(all.begin(), all.end(), [](const auto& own) {
    return std::all_of(own.begin(), own.end(), [](const auto& course) { return !course || course->one_way(); });
  });
  if (!one_way) return;
  check_reach(c, all);
  with(c.root, "gauges", [&](const Place& gauges) {
    for (const char* name : {"load", "support"}) {
      const auto at = c.scene.gauges.find(name);
      if (at == c.scene.gauges.end()) continue;
      const auto* force = std::get_if<ForceGauge>(&at->second);
      with(gauges, name, [&](const Place& p) {
        if (force != nullptr) check_force_sign(c, p, *force, all);
      });
    }
    const auto at = c.scene.gauges.find("deflection");
    if (at == c.scene.gauges.end()) return;
    const auto* displacement = std::get_if<DisplacementGauge>(&at->second);
    with(gauges, "deflection", [&](const Place& p) {
      if (displacement != nullptr) check_displacement_sign(c, p, *displacement, all);
    });
  });
}

}  // namespace

void check_loading(const SceneCheck& c) {
  const Courses all = courses_of(c.scene);
  const std::size_t before = c.reader.problems().size();
  const bool in_stages = c.root.value().find("stages") != nullptr;  // the first alone says little
  if (!in_stages) check_motion(c, all);
  check_drives(c, all);
  check_time(c);
  check_travel(c, all);
  if (c.reader.problems().size() == before && !in_stages) check_signs(c, all);
}

}  // namespace fpz::specimen::detail
