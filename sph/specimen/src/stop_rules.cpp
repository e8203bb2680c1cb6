// Every rule is a reader of its key and a test; they are listed in stop_rules.
#include "stop_rules.hpp"

#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

// ---- The time is over

void read_time(const InputReader& r, const Place& stop, const Scene&, StopRules& rules) {
  with_required(r, stop, "time", [&](const Place& p) { rules.time = r.positive(p).value_or(1.0); });
}

bool time_is_over(const StopState& s) { return s.steps >= steps_within(s.stage.stop.time, s.time_step); }

// ---- The deflection reaches a value

void read_deflection(const InputReader& r, const Place& stop, const Scene&, StopRules& rules) {
  with(stop, "deflection", [&](const Place& p) { rules.deflection = r.positive(p); });
}

bool deflection_is_reached(const StopState& s) {
  return s.stage.stop.deflection && s.recorder.history().last("deflection") >= *s.stage.stop.deflection;
}

// ---- The load stays below a part of its peak

void read_load_below(const InputReader& r, const Place& stop, const Scene&, StopRules& rules) {
  with(stop, "load_below", [&](const Place& p) { rules.load_below = r.number_between(p, 0.0, 1.0); });
}

bool load_has_dropped(const StopState& s) {
  constexpr std::size_t rows = 3;  // one alone may be an oscillation
  const History& h = s.recorder.history();
  if (!s.stage.stop.load_below || s.run.cracked() == 0 || h.rows() <= rows + 1) return false;
  // What never rose cannot have dropped: noise is less than a particle bears.
  const double of_a_particle = s.scene.parameters.tensile_strength * s.scene.spacing * s.scene.thickness;
  if (!(s.recorder.peak_load() > 1e-3 * of_a_particle)) return false;
  bool below = true;
  for (std::size_t k = 1; k <= rows; ++k) {
    below = below && h.at(h.rows() - k, "load") < *s.stage.stop.load_below * s.recorder.peak_load();
  }
  return below;
}

// ---- The specimen is in pieces

void read_separation(const InputReader& r, const Place& stop, const Scene&, StopRules& rules) {
  with(stop, "separation", [&](const Place& p) { rules.separation = boolean(r, p).value_or(false); });
}

bool is_in_pieces(const StopState& s) {
  constexpr std::size_t every = 10;        // rows: looking takes a while
  constexpr double smallest_piece = 0.02;  // of the specimen
  const History& h = s.recorder.history();
  if (!s.stage.stop.separation || h.rows() % every != 0 || !(h.last("largest_damage") > 0.99)) return false;
  const auto areas = piece_areas(spots(s.run, s.specimen), s.scene.body.notches, s.scene.spacing);
  return areas.size() > 1 && areas[1] > smallest_piece * s.specimen.area;
}

// ---- A gauge is above or below a value

void read_gauge_limits(const InputReader& r, const Place& stop, const Scene& scene, StopRules& rules) {
  constexpr std::array<std::string_view, 2> keys = {"above", "below"};
  with(stop, "gauges", [&](const Place& p) {
    if (!r.object(p, "gauges by their names")) return;
    std::vector<std::string_view> names;
    for (const auto& [name, gauge] : scene.gauges) names.push_back(name);
    for (const JsonValue& item : p.value().items) {
      const Place q(p, item);
      if (!scene.gauges.contains(item.key)) {
        r.problem(q, "there is no gauge " + io::in_quotes(item.key) + io::suggestion(item.key, names));
        continue;
      }
      if (!r.object(q, "\"above\" or \"below\"")) continue;
      r.known_keys(q, keys);
      for (const std::string_view key : keys) {
        with(q, key, [&](const Place& limit) {
          rules.gauges.push_back({item.key, key == "above", r.number(limit).value_or(0.0)});
        });
      }
    }
  });
}

bool gauge_is_beyond(const StopState& s) {
  const History& h = s.recorder.history();
  return s.rows > 0 && std::any_of(s.stage.stop.gauges.begin(), s.stage.stop.gauges.end(), [&](const GaugeLimit& g) {
           const double value = h.last(g.gauge);
           return g.above ? value > g.value : value < g.value;
         });
}

// ---- The specimen is at rest

void read_kinetic_below(const InputReader& r, const Place& stop, const Scene&, StopRules& rules) {
  with(stop, "kinetic_below", [&](const Place& p) { rules.kinetic_below = r.number_between(p, 0.0, 1.0); });
}

/// s after the begin of the stage: what the stage changes has come to its end.
double end_of_changes(const StopState& s) {
  double end = 0.0;
  const auto see = [&](const Actuations& drive) {
    for (const auto& a : drive) {
      if (a) end = std::max(end, a->course.duration());
    }
  };
  const bool first = &s.stage == &s.scene.stages.front();
  for (const auto& [g, drive] : s.stage.boundaries) see(drive);
  for (const auto& [k, course] : s.stage.loads) end = std::max(end, course.duration());
  if (!first) return end;
  for (const Boundary& b : s.scene.boundaries) see(b.drive);
  for (const SurfaceLoad& load : s.scene.loads) end = std::max(end, load.course.duration());
  return end;
}

/// Over a while: a specimen that vibrates is without motion twice in a period.
bool is_at_rest(const StopState& s) {
  constexpr double part_of_the_time = 0.05;
  constexpr std::size_t least_rows = 10;
  if (!s.stage.stop.kinetic_below || s.rows < least_rows) return false;
  const double now = static_cast<double>(s.steps) * s.time_step;
  const double window = part_of_the_time * s.stage.stop.time;
  if (now < end_of_changes(s) + window) return false;
  const History& h = s.recorder.history();
  for (std::size_t k = 1; k <= s.rows; ++k) {
    const std::size_t row = h.rows() - k;
    if (k > least_rows && h.at(row, "time") < h.last("time") - window) break;
    if (!(h.at(row, "energy_kinetic") < *s.stage.stop.kinetic_below * h.at(row, "energy_elastic"))) return false;
  }
  return true;
}

struct StopRule {
  std::string_view key;
  void (*read)(const InputReader& r, const Place& stop, const Scene& scene, StopRules& rules);
  bool (*met)(const StopState& state);
  const char* reason;
};
constexpr std::array<StopRule, 6> stop_rules = {
    {{"time", read_time, time_is_over, "the time is over (stop.time)"},
     {"deflection", read_deflection, deflection_is_reached, "deflection reached (stop.deflection)"},
     {"load_below", read_load_below, load_has_dropped, "the load has dropped (stop.load_below)"},
     {"separation", read_separation, is_in_pieces, "the specimen is in pieces (stop.separation)"},
     {"gauges", read_gauge_limits, gauge_is_beyond, "a gauge has reached its limit (stop.gauges)"},
     {"kinetic_below", read_kinetic_below, is_at_rest, "the specimen is at rest (stop.kinetic_below)"}}};

}  // namespace

void read_stop(const InputReader& r, const Place& place, const Scene& scene, StopRules& stop) {
  if (!r.object(place, "\"time\"")) return;
  std::vector<std::string_view> keys;
  for (const StopRule& rule : stop_rules) keys.push_back(rule.key);
  r.known_keys(place, keys);
  for (const StopRule& rule : stop_rules) rule.read(r, place, scene, stop);
}

std::string stop_reason_of_time() { return stop_rules.front().reason; }

std::string stop_reason(const StopState& state) {
  for (const StopRule& rule : stop_rules) {
    if (rule.met(state)) return rule.reason;
  }
  return {};
}

}  // namespace fpz::specimen::detail
