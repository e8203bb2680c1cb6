// The gauges of a scene.
#include "fpz/specimen/history_columns.hpp"
#include "gauge_kinds.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<const GaugeKind*, 7> gauge_kinds = {
    &force_gauge, &displacement_gauge, &notch_opening_gauge, &stress_gauge, &strain_gauge, &rotation_gauge, &sum_gauge};

/// Keys of all kinds, each once.
std::vector<std::string_view> all_keys() {
  std::vector<std::string_view> keys;
  const auto add = [&](std::string_view key) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  };
  for (const GaugeKind* k : gauge_kinds) {
    add(k->key);
    for (const std::string_view key : k->uses) add(key);
  }
  return keys;
}

/// "a", "b", "c" <last> "d": the keys that tell the kinds.
std::string kinds_text(const char* last) {
  std::string text;
  for (std::size_t k = 0; k < gauge_kinds.size(); ++k) {
    if (k > 0) text += k + 1 == gauge_kinds.size() ? std::string(" ") + last + " " : ", ";
    text += io::in_quotes(gauge_kinds[k]->key);
  }
  return text;
}

std::optional<Gauge> read_gauge(const InputReader& r, const Place& place, const Scene& scene) {
  if (!r.object(place, kinds_text("or").c_str())) return std::nullopt;
  const std::vector<std::string_view> keys = all_keys();
  r.known_keys(place, keys);
  const GaugeKind* kind = nullptr;
  int kinds = 0;
  for (const GaugeKind* k : gauge_kinds) {
    if (place.value().find(k->key) != nullptr) kind = k, ++kinds;
  }
  if (kinds != 1) {
    r.problem(place, "needs one of " + kinds_text("and"));
    return std::nullopt;
  }
  for (const std::string_view key : keys) {
    if (key == kind->key || std::find(kind->uses.begin(), kind->uses.end(), key) != kind->uses.end()) continue;
    with(place, key, [&](const Place& p) { r.problem(p, "is not used by this kind of gauge"); });
  }
  return kind->read(r, place, Place(place, *place.value().find(kind->key)), scene);
}

/// Whether a gauge measures a force, or a displacement; a sum does so if all its terms do.
bool measures_what(const Gauge& gauge, bool force, const Scene& scene) {
  if (const auto* sum = std::get_if<SumGauge>(&gauge)) {
    const auto fits = [&](const SumGauge::Term& t) {
      const auto at = scene.gauges.find(t.gauge);
      return at != scene.gauges.end() && !std::holds_alternative<SumGauge>(at->second) &&
             measures_what(at->second, force, scene);
    };
    return sum->over.empty() && std::all_of(sum->terms.begin(), sum->terms.end(), fits);
  }
  if (force) return std::holds_alternative<ForceGauge>(gauge);
  return std::holds_alternative<DisplacementGauge>(gauge) || std::holds_alternative<OpeningGauge>(gauge);
}

/// A gauge whose name has a meaning must be there and measure what the name says.
void require_kind(const InputReader& r, const Place& place, const Scene& scene, const SteeringGauge& wanted) {
  const auto at = scene.gauges.find(std::string(wanted.name));
  if (at == scene.gauges.end()) return;
  if (measures_what(at->second, wanted.is_force, scene)) return;
  r.problem(Place(place, *place.value().find(wanted.name)),
            wanted.is_force ? "must measure a force" : "must measure a displacement");
}

}  // namespace

Point read_gauge_direction(const InputReader& r, const Place& gauge) {
  Point along = Point::Zero();
  with_required(r, gauge, "direction", [&](const Place& p) { along = direction(r, p).value_or(along); });
  return along;
}

void read_gauges(const InputReader& r, const Place& place, Scene& scene) {
  if (!r.object(place, "\"load\" and \"deflection\"")) return;
  for (const JsonValue& member : place.value().items) {
    const Place p(place, member);
    const bool plain = !member.key.empty() && member.key.size() <= 40 &&
                       member.key.find_first_not_of(
                           "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
    if (!plain) r.problem(p, "names of gauges have at most 40 letters, digits and underscores");
    if (is_computed_column(member.key)) r.problem(p, "this column exists already");
    if (auto gauge = read_gauge(r, p, scene)) scene.gauges.emplace(member.key, *gauge);
  }
  for (const JsonValue& member : place.value().items) check_sum(r, Place(place, member), scene);
  for (const SteeringGauge& g : steering_gauges) {
    if (g.required) (void)r.required(place, g.name);
  }
  for (const SteeringGauge& g : steering_gauges) require_kind(r, place, scene, g);
}

}  // namespace fpz::specimen::detail
