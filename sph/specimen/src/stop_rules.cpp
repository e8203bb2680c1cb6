// Every rule is a reader of its key and a test; they are listed in stop_rules.
#include "stop_rules.hpp"

#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

// ---- The time is over

void read_time(const InputReader& r, const Place& stop, StopRules& rules) {
  with_required(r, stop, "time", [&](const Place& p) { rules.time = r.positive(p).value_or(1.0); });
}

bool time_is_over(const StopState& s) { return s.run.steps() >= s.schedule.steps; }

// ---- The deflection reaches a value

void read_deflection(const InputReader& r, const Place& stop, StopRules& rules) {
  with(stop, "deflection", [&](const Place& p) { rules.deflection = r.positive(p); });
}

bool deflection_is_reached(const StopState& s) {
  return s.scene.stop.deflection && s.recorder.history().last("deflection") >= *s.scene.stop.deflection;
}

// ---- The load stays below a part of its peak

void read_load_below(const InputReader& r, const Place& stop, StopRules& rules) {
  with(stop, "load_below", [&](const Place& p) { rules.load_below = r.number_between(p, 0.0, 1.0); });
}

bool load_has_dropped(const StopState& s) {
  constexpr std::size_t rows = 3;  // one alone may be an oscillation
  const History& h = s.recorder.history();
  if (!s.scene.stop.load_below || s.run.cracked() == 0 || h.rows() <= rows + 1) return false;
  if (!(s.recorder.peak_load() > 0.0)) return false;  // what never rose cannot have dropped
  bool below = true;
  for (std::size_t k = 1; k <= rows; ++k) {
    below = below && h.at(h.rows() - k, "load") < *s.scene.stop.load_below * s.recorder.peak_load();
  }
  return below;
}

// ---- The specimen is in pieces

void read_separation(const InputReader& r, const Place& stop, StopRules& rules) {
  with(stop, "separation", [&](const Place& p) { rules.separation = boolean(r, p).value_or(false); });
}

bool is_in_pieces(const StopState& s) {
  constexpr std::size_t every = 10;        // rows: looking takes a while
  constexpr double smallest_piece = 0.02;  // of the specimen
  const History& h = s.recorder.history();
  if (!s.scene.stop.separation || h.rows() % every != 0 || !(h.last("largest_damage") > 0.99)) return false;
  const auto areas = piece_areas(spots(s.run, s.specimen), s.scene.body.notches, s.scene.spacing);
  return areas.size() > 1 && areas[1] > smallest_piece * s.specimen.area;
}

struct StopRule {
  std::string_view key;
  void (*read)(const InputReader& r, const Place& stop, StopRules& rules);
  bool (*met)(const StopState& state);
  const char* reason;
};
constexpr std::array<StopRule, 4> stop_rules = {
    {{"time", read_time, time_is_over, "the time is over (stop.time)"},
     {"deflection", read_deflection, deflection_is_reached, "deflection reached (stop.deflection)"},
     {"load_below", read_load_below, load_has_dropped, "the load has dropped (stop.load_below)"},
     {"separation", read_separation, is_in_pieces, "the specimen is in pieces (stop.separation)"}}};

}  // namespace

void read_stop(const InputReader& r, const Place& place, StopRules& stop) {
  if (!r.object(place, "\"time\"")) return;
  std::vector<std::string_view> keys;
  for (const StopRule& rule : stop_rules) keys.push_back(rule.key);
  r.known_keys(place, keys);
  for (const StopRule& rule : stop_rules) rule.read(r, place, stop);
}

std::string stop_reason(const StopState& state) {
  for (const StopRule& rule : stop_rules) {
    if (rule.met(state)) return rule.reason;
  }
  return {};
}

}  // namespace fpz::specimen::detail
