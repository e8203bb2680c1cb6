// Interfaces against the body and its materials.
#include <algorithm>

#include "check_scene.hpp"
#include "interface_map.hpp"

namespace fpz::specimen::detail {
namespace {

void check_line(const SceneCheck& c, const Place& p, const Interface& f) {
  if (!lines_in_body(f, c.scene.body, 0.5 * c.scene.spacing).empty()) return;
  const auto [low, high] = extent(c.scene.body.shape);
  c.reader.problem(p, "from " + brief(f.line.front()) + " to " + brief(f.line.back()) +
                          ": it is outside the body, which reaches from " + brief(low) + " to " + brief(high) +
                          likely_place(f.line.front(), c.scene.body.shape));
}

void check_bedding(const SceneCheck& c, const Place& p, const Interface& f) {
  const auto [low, high] = extent(c.scene.body.shape);
  const double size = (high - low).norm(), closest = 2.0 * interface_reach * c.scene.spacing;
  if (lines_in_body(f, c.scene.body, 0.5 * c.scene.spacing).empty()) {
    return c.problem(p, "no plane " + brief(f.bedding->spacing) + " m apart goes through the body" +
                            likely_length(f.bedding->spacing, closest, size));
  }
  if (f.bedding->spacing < closest) {
    c.warn(p, "planes are " + brief(f.bedding->spacing) + " m apart, less than three spacings: every particle is on " +
                  "one, and cracks may be anywhere along them");
  }
}

/// An interface has a strength; the particles that it goes through keep their elasticity.
void check_elasticity(const SceneCheck& c, const Place& p, const Parameters& m) {
  const auto is_of = [&](const Parameters& rock) {
    return m.young_modulus == rock.young_modulus && m.poisson_ratio == rock.poisson_ratio && m.density == rock.density;
  };
  bool known = is_of(c.scene.parameters);
  for (const Region& region : c.scene.regions) {
    known = known || is_of(c.scene.further_materials[region.material - 1].parameters);
  }
  if (known) return;
  c.warn(p, "its young_modulus = " + brief(m.young_modulus) + ", poisson_ratio = " + brief(m.poisson_ratio) +
                " and density = " + brief(m.density) +
                " have no effect: what lies beside an interface keeps those of its own material; for a layer that is "
                "softer use a region");
}

void check_weakness(const SceneCheck& c, const Place& p, const Parameters& m) {
  const auto is_as_strong_as = [&](const Parameters& rock) {
    return m.tensile_strength >= rock.tensile_strength && m.cohesion >= rock.cohesion &&
           m.friction_angle_deg >= rock.friction_angle_deg;
  };
  bool weaker = !is_as_strong_as(c.scene.parameters);
  for (const Region& region : c.scene.regions) {
    weaker = weaker || !is_as_strong_as(c.scene.further_materials[region.material - 1].parameters);
  }
  if (!weaker) c.warn(p, "the interface is as strong as the material beside it, and has no effect");
}

}  // namespace

void check_interfaces(const SceneCheck& c) {
  for_entries(c, "interfaces", [&](const Place& p, std::size_t k) {
    const Interface& f = c.scene.interfaces[k];
    with(p, "line", [&](const Place& at) { check_line(c, at, f); });
    with(p, "bedding", [&](const Place& at) { check_bedding(c, at, f); });
    with(p, "material", [&](const Place& at) {
      check_weakness(c, at, f.material);
      check_elasticity(c, at, f.material);
    });
  });
}

}  // namespace fpz::specimen::detail
