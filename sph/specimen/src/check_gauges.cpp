// Sites of gauges against the body, and what gauges compare.
#include "check_scene.hpp"
#include "surface_depth.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr double far_from_the_body = 2.0;  ///< spacings

void check_point(const SceneCheck& c, const Place& p, const Point& x) {
  const Scene& s = c.scene;
  const auto [low, high] = extent(s.body.shape);
  const double away = -depth(s.body, x);
  if (away <= far_from_the_body * s.spacing) return;
  c.problem(p, "is " + brief(away) + " m outside the body; must be in it, or within two spacings (" +
                   brief(far_from_the_body * s.spacing) + " m) of it (the body reaches from " + brief(low) + " to " +
                   brief(high) + ", its nearest point is " + brief(nearest_on_surface(s.body, x)) + ")" +
                   likely_place(x, s.body.shape));
}

void check_radius(const SceneCheck& c, const Place& p, double radius) {
  const auto [low, high] = extent(c.scene.body.shape);
  const double smallest = (high - low).minCoeff();
  if (radius < 0.5 * smallest) return;
  c.warn(p, "takes the mean over more than half the width of the body (" + brief(smallest) + " m)" +
                likely_length(radius, 0.0, 0.25 * smallest));
}

void check_box(const SceneCheck& c, const Place& site, const Rectangle& box) {
  const auto [low, high] = extent(c.scene.body.shape);
  if ((box.low.array() > box.high.array()).any()) {
    return at_member(site, "low", [&](const Place& p) {
      c.problem(p, "must be below and to the left of \"high\" = " + brief(box.high));
    });
  }
  if ((box.high.array() >= low.array()).all() && (box.low.array() <= high.array()).all()) return;
  at_member(site, "low", [&](const Place& p) {
    c.problem(p, "the box is outside the body, which reaches from " + brief(low) + " to " + brief(high));
  });
}

void check_site(const SceneCheck& c, const Place& place, const Site& site) {
  if (site.box) return check_box(c, place, *site.box);
  if (!site.group.empty()) return;
  at_member(place, "point", [&](const Place& p) { check_point(c, p, site.centre); });
  at_member(place, "radius", [&](const Place& p) { check_radius(c, p, site.radius); });
}

/// One place, or each of a list, with the sites that were read from them.
void check_sites(const SceneCheck& c, const Place& p, const std::vector<Site>& sites) {
  if (!p.value().is(JsonValue::Kind::array)) {
    if (!sites.empty()) check_site(c, p, sites.front());
    return;
  }
  for (std::size_t k = 0; k < sites.size(); ++k) check_site(c, Place(p, p.value().items[k]), sites[k]);
}

/// The faces of a slot that ends in the body do not open at its ends.
void check_opening(const SceneCheck& c, const Place& p) {
  const auto k = static_cast<std::size_t>(p.value().number);
  const Notch& n = c.scene.body.notches[k];
  if (!n.internal) return;
  const double beside = 0.5 * n.width + 0.5 * c.scene.spacing;
  const Point middle = 0.5 * (n.mouth + n.tip);
  const auto site = [&](double side) {
    return R"({"point": )" + brief(Point(middle + side * beside * across(n))) + "}";
  };
  c.problem(p, "the mouth of notches[" + io::shown(p.value().text) + "] is " + brief(depth(c.scene.body, n.mouth)) +
                   " m inside the body: both ends are tips, where nothing opens; take the middle instead: "
                   R"({"displacement_of": )" +
                   site(1.0) + R"(, "relative_to": )" + site(-1.0) + R"(, "direction": )" + brief(across(n)) + "}");
}

bool same(const Site& a, const Site& b) {
  if (a.box || b.box) return a.box && b.box && a.box->low == b.box->low && a.box->high == b.box->high;
  return a.group == b.group && a.centre == b.centre && a.radius == b.radius;
}

void check_displacement(const SceneCheck& c, const Place& gauge, const DisplacementGauge& g) {
  with(gauge, "displacement_of", [&](const Place& p) {
    check_sites(c, p, {g.of});
    if (g.relative_to.size() == 1 && same(g.of, g.relative_to.front())) {
      c.problem(p, "the same as \"relative_to\": the difference is always 0");
    }
  });
  with(gauge, "relative_to", [&](const Place& p) { check_sites(c, p, g.relative_to); });
}

}  // namespace

void check_gauges(const SceneCheck& c) {
  with(c.root, "gauges", [&](const Place& gauges) {
    for (const JsonValue& member : gauges.value().items) {
      const auto gauge = c.scene.gauges.find(member.key);
      if (gauge == c.scene.gauges.end()) continue;
      const Place p(gauges, member);
      if (const auto* d = std::get_if<DisplacementGauge>(&gauge->second)) check_displacement(c, p, *d);
      with(p, "notch_opening", [&](const Place& opening) { check_opening(c, opening); });
      const Site* site = site_of(gauge->second);
      for (const std::string_view key : {"of", "rotation_of"}) {
        with(p, key, [&](const Place& of) {
          if (site != nullptr) check_sites(c, of, {*site});
        });
      }
    }
  });
}

}  // namespace fpz::specimen::detail
