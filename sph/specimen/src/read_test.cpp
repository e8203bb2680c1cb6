// Boundaries, gauges, stop conditions, output.
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 8> boundary_keys = {"name",   "at",  "direction", "width",
                                                           "layers", "fit", "velocity",  "elastic"};
constexpr std::array<std::string_view, 2> fits = {"surface", "flat"};
constexpr std::array<std::string_view, 2> components = {"x", "y"};
constexpr std::array<std::string_view, 2> motion_keys = {"speed", "ramp"};
constexpr std::array<std::string_view, 7> gauge_keys = {"force_on",      "displacement_of", "relative_to", "direction",
                                                        "notch_opening", "stress",          "of"};
constexpr std::array<std::string_view, 5> site_keys = {"group", "point", "radius", "low", "high"};
constexpr std::array<std::string_view, 3> stresses = {"xx", "yy", "xy"};
constexpr std::array<std::string_view, 4> stop_keys = {"time", "deflection", "load_below", "separation"};
constexpr std::array<std::string_view, 6> output_keys = {"history_rows",       "frames",  "frames_at", "picture_loads",
                                                         "checkpoint_seconds", "pictures"};
/// Columns of history.csv that gauges must not take.
constexpr std::array<std::string_view, 14> taken = {
    "step",           "time",           "energy_external",   "energy_elastic", "energy_kinetic",    "energy_fracture",
    "energy_viscous", "energy_damping", "energy_artificial", "energy_error",   "damaged_particles", "cracked_particles",
    "largest_damage", "released_bonds"};

sph::Motion read_motion(const InputReader& r, const Place& p) {
  sph::Motion m;
  if (p.value().is(JsonValue::Kind::number)) {
    m.speed = r.number(p).value_or(0.0);
    return m;
  }
  if (!r.object(p, "\"speed\" and \"ramp\"")) return m;
  r.known_keys(p, motion_keys);
  with_required(r, p, "speed", [&](const Place& q) { m.speed = r.number(q).value_or(0.0); });
  with(p, "ramp", [&](const Place& q) { m.ramp = not_negative(r, q).value_or(0.0); });
  return m;
}

Boundary read_boundary(const InputReader& r, const Place& place, const SceneFile& scene) {
  Boundary b;
  if (!r.object(place, "\"name\", \"at\", \"direction\", \"width\" and \"velocity\"")) return b;
  r.known_keys(place, boundary_keys);
  with_required(r, place, "name", [&](const Place& p) { b.name = r.text(p, longest_name).value_or(""); });
  for (const Boundary& other : scene.boundaries) {
    if (!b.name.empty() && other.name == b.name)
      r.problem(place, "two boundaries with the name " + io::in_quotes(b.name));
  }
  // With particles from a file the boundary may be among them.
  if (!scene.particles || place.value().find("at") != nullptr) {
    Platen platen;
    platen.direction = Point(0.0, 1.0);
    with_required(r, place, "at", [&](const Place& p) { platen.at = point(r, p).value_or(platen.at); });
    with_required(r, place, "direction",
                  [&](const Place& p) { platen.direction = direction(r, p).value_or(platen.direction); });
    with_required(r, place, "width", [&](const Place& p) { platen.width = not_negative(r, p).value_or(0.0); });
    with(place, "layers", [&](const Place& p) { platen.layers = r.integer(p, 1, 100).value_or(3); });
    with(place, "fit", [&](const Place& p) { platen.follow_surface = choice(r, p, fits).value_or(0) == 0; });
    b.platen = platen;
  }
  with(place, "elastic", [&](const Place& p) { b.elastic = boolean(r, p).value_or(true); });
  with_required(r, place, "velocity", [&](const Place& p) {
    if (!r.object(p, "the prescribed components, \"x\" or \"y\" (the others are free)")) return;
    r.known_keys(p, components);
    for (std::size_t c = 0; c < 2; ++c) {
      with(p, components[c], [&](const Place& q) { b.velocity[c] = read_motion(r, q); });
    }
  });
  return b;
}

void group_name(const InputReader& r, const Place& p, const SceneFile& scene, std::string& name) {
  const auto text = r.text(p, longest_name);
  if (!text) return;
  name = *text;
  std::vector<std::string_view> valid;
  for (const Boundary& b : scene.boundaries) valid.push_back(b.name);
  if (std::find(valid.begin(), valid.end(), name) != valid.end()) return;
  r.problem(p, "there is no boundary " + io::in_quotes(name) + io::suggestion(name, valid));
}

Site read_site(const InputReader& r, const Place& place, const SceneFile& scene) {
  Site s;
  if (place.value().is(JsonValue::Kind::string)) {
    group_name(r, place, scene, s.group);
    return s;
  }
  if (!r.object(place, "\"group\", or \"point\" (and \"radius\"), or \"low\" and \"high\"")) return s;
  r.known_keys(place, site_keys);
  const bool group = place.value().find("group") != nullptr;
  const bool point_given = place.value().find("point") != nullptr;
  const bool box = place.value().find("low") != nullptr || place.value().find("high") != nullptr;
  if (group + point_given + box != 1) {
    r.problem(place, "needs one of \"group\", \"point\" (and \"radius\"), or \"low\" and \"high\"");
    return s;
  }
  if (group) with(place, "group", [&](const Place& p) { group_name(r, p, scene, s.group); });
  if (point_given) {
    with(place, "point", [&](const Place& p) { s.centre = point(r, p).value_or(s.centre); });
    with(place, "radius", [&](const Place& p) { s.radius = not_negative(r, p).value_or(0.0); });
  }
  if (box) {
    s.box.emplace();
    with_required(r, place, "low", [&](const Place& p) { s.box->low = point(r, p).value_or(s.box->low); });
    with_required(r, place, "high", [&](const Place& p) { s.box->high = point(r, p).value_or(s.box->high); });
  }
  return s;
}

/// A list of what f reads, or a single one.
template <class F>
void one_or_more(const InputReader& r, const Place& p, F&& f) {
  if (!p.value().is(JsonValue::Kind::array)) return f(p);
  if (!r.array(p, "sites")) return;
  for (const JsonValue& item : p.value().items) f(Place(p, item));
}

DisplacementGauge notch_opening(const InputReader& r, const Place& p, const SceneFile& scene) {
  DisplacementGauge g;
  const auto& notches = scene.body.notches;
  if (notches.empty()) {
    r.problem(p, "there is no notch");
    return g;
  }
  const Notch& n = notches[static_cast<std::size_t>(r.integer(p, 0, static_cast<int>(notches.size()) - 1).value_or(0))];
  const double offset = 0.5 * n.width + 0.5 * scene.spacing;
  g.direction = across(n);
  g.of.centre = n.mouth + offset * g.direction;
  g.relative_to.emplace_back().centre = n.mouth - offset * g.direction;
  return g;
}

std::optional<Gauge> read_gauge(const InputReader& r, const Place& place, const SceneFile& scene) {
  if (!r.object(place, "\"force_on\", \"displacement_of\", \"notch_opening\" or \"stress\"")) return std::nullopt;
  r.known_keys(place, gauge_keys);
  const auto has = [&](std::string_view key) { return place.value().find(key) != nullptr; };
  if (has("force_on") + has("displacement_of") + has("notch_opening") + has("stress") != 1) {
    r.problem(place, "needs one of \"force_on\", \"displacement_of\", \"notch_opening\" and \"stress\"");
    return std::nullopt;
  }
  const auto refuse = [&](std::initializer_list<std::string_view> useless) {
    for (const std::string_view key : useless) {
      with(place, key, [&](const Place& p) { r.problem(p, "is not used by this kind of gauge"); });
    }
  };
  Point along = Point::Zero();
  const auto read_direction = [&] {
    with_required(r, place, "direction", [&](const Place& p) { along = direction(r, p).value_or(along); });
  };
  std::optional<Gauge> gauge;
  with(place, "notch_opening", [&](const Place& p) {
    refuse({"direction", "of", "relative_to"});
    gauge = notch_opening(r, p, scene);
  });
  with(place, "force_on", [&](const Place& p) {
    refuse({"of", "relative_to"});
    read_direction();
    ForceGauge g{{}, along};
    one_or_more(r, p, [&](const Place& q) { group_name(r, q, scene, g.groups.emplace_back()); });
    gauge = g;
  });
  with(place, "displacement_of", [&](const Place& p) {
    refuse({"of"});
    read_direction();
    DisplacementGauge g{read_site(r, p, scene), {}, along};
    with(place, "relative_to", [&](const Place& q) {
      one_or_more(r, q, [&](const Place& s) { g.relative_to.push_back(read_site(r, s, scene)); });
    });
    gauge = g;
  });
  with(place, "stress", [&](const Place& p) {
    refuse({"direction", "relative_to"});
    StressGauge g;
    g.component = static_cast<int>(choice(r, p, stresses).value_or(0));
    with_required(r, place, "of", [&](const Place& q) { g.of = read_site(r, q, scene); });
    gauge = g;
  });
  return gauge;
}

void require_kind(const InputReader& r, const Place& place, const SceneFile& scene, const std::string& name,
                  bool force) {
  const auto at = scene.gauges.find(name);
  if (at == scene.gauges.end()) return;
  if (std::holds_alternative<ForceGauge>(at->second) == force &&
      std::holds_alternative<DisplacementGauge>(at->second) == !force) {
    return;
  }
  r.problem(Place(place, *place.value().find(name)), force ? "must measure a force" : "must measure a displacement");
}

}  // namespace

void read_boundaries(const InputReader& r, const Place& place, SceneFile& scene) {
  if (!r.array(place, "boundaries")) return;
  for (const JsonValue& item : place.value().items) {
    scene.boundaries.push_back(read_boundary(r, Place(place, item), scene));
  }
}

void read_gauges(const InputReader& r, const Place& place, SceneFile& scene) {
  if (!r.object(place, "\"load\" and \"deflection\"")) return;
  for (const JsonValue& member : place.value().items) {
    const Place p(place, member);
    const bool plain = !member.key.empty() && member.key.size() <= 40 &&
                       member.key.find_first_not_of(
                           "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
    if (!plain) r.problem(p, "names of gauges have at most 40 letters, digits and underscores");
    if (std::find(taken.begin(), taken.end(), member.key) != taken.end()) r.problem(p, "this column exists already");
    if (auto gauge = read_gauge(r, p, scene)) scene.gauges.emplace(member.key, *gauge);
  }
  (void)r.required(place, "load");
  (void)r.required(place, "deflection");
  require_kind(r, place, scene, "load", true);
  require_kind(r, place, scene, "support", true);
  require_kind(r, place, scene, "deflection", false);
  require_kind(r, place, scene, "cmod", false);
}

void read_stop(const InputReader& r, const Place& place, StopRules& stop) {
  if (!r.object(place, "\"time\"")) return;
  r.known_keys(place, stop_keys);
  with_required(r, place, "time", [&](const Place& p) { stop.time = r.positive(p).value_or(1.0); });
  with(place, "deflection", [&](const Place& p) { stop.deflection = r.positive(p); });
  with(place, "load_below", [&](const Place& p) { stop.load_below = r.number_between(p, 0.0, 1.0); });
  with(place, "separation", [&](const Place& p) { stop.separation = boolean(r, p).value_or(false); });
}

void read_output(const InputReader& r, const Place& place, OutputRules& o) {
  if (!r.object(place, "output choices")) return;
  r.known_keys(place, output_keys);
  with(place, "history_rows", [&](const Place& p) { o.history_rows = r.integer(p, 10, 1'000'000).value_or(1000); });
  with(place, "frames", [&](const Place& p) { o.frames = r.integer(p, 0, 100'000).value_or(0); });
  with(place, "checkpoint_seconds", [&](const Place& p) { o.checkpoint_seconds = not_negative(r, p).value_or(60.0); });
  with(place, "pictures", [&](const Place& p) { o.pictures = boolean(r, p).value_or(true); });
  const auto list = [&](std::string_view key, double low, double high, std::vector<double>& values) {
    with(place, key, [&](const Place& p) {
      if (!p.value().is(JsonValue::Kind::array)) return r.problem(p, "expected an array of numbers");
      values.clear();
      for (const JsonValue& item : p.value().items) {
        if (const auto x = r.number_between(Place(p, item), low, high, true)) values.push_back(*x);
      }
    });
  };
  list("frames_at", 0.0, 1e6, o.frames_at);
  list("picture_loads", -1.0, 1.0, o.picture_loads);
}

}  // namespace fpz::specimen::detail
