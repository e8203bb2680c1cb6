// What every kind of gauge provides: how it is read from a scene, and how it finds its particles.
#pragma once

#include "scene_reader.hpp"

namespace fpz::specimen::detail {

/// How a gauge is read. A new kind is a file with one of these, and a line in read_gauges.cpp.
struct GaugeKind {
  std::string_view key;                    ///< tells the kind, as in "force_on"
  std::span<const std::string_view> uses;  ///< further keys
  /// `gauge` is the whole object, `value` what stands at `key`.
  Gauge (*read)(const InputReader& r, const Place& gauge, const Place& value, const Scene& scene);
};
extern const GaugeKind force_gauge, displacement_gauge, notch_opening_gauge, stress_gauge, strain_gauge, rotation_gauge,
    sum_gauge;

/// What a sum needs of the other gauges of the scene, when all are read.
void check_sum(const InputReader& r, const Place& gauge, const Scene& scene);

/// "direction" of a gauge, a unit vector; zero when something is wrong with it.
[[nodiscard]] Point read_gauge_direction(const InputReader& r, const Place& gauge);

/// The name of a boundary of the scene.
[[nodiscard]] std::string read_group_name(const InputReader& r, const Place& place, const Scene& scene);
[[nodiscard]] Site read_site(const InputReader& r, const Place& place, const Scene& scene);

/// Calls read(place) for a single thing, or for each of a list.
template <class F>
void one_or_more(const InputReader& r, const Place& place, F&& read) {
  if (!place.value().is(JsonValue::Kind::array)) return read(place);
  if (!r.array(place, "sites")) return;
  for (const JsonValue& item : place.value().items) read(Place(place, item));
}

/// Where a gauge finds its particles; `name` is that of the gauge.
struct GaugeBinding {
  const Scene& scene;
  const sph::Arrangement<2>& arrangement;
  const std::string& name;
};
/// Throws io::InputError when a site has no particle.
[[nodiscard]] BoundGauge bind(const ForceGauge& gauge, const GaugeBinding& to);
[[nodiscard]] BoundGauge bind(const DisplacementGauge& gauge, const GaugeBinding& to);
[[nodiscard]] BoundGauge bind(const OpeningGauge& gauge, const GaugeBinding& to);
[[nodiscard]] BoundGauge bind(const StressGauge& gauge, const GaugeBinding& to);
[[nodiscard]] BoundGauge bind(const StrainGauge& gauge, const GaugeBinding& to);
[[nodiscard]] BoundGauge bind(const RotationGauge& gauge, const GaugeBinding& to);
[[nodiscard]] BoundGauge bind(const SumGauge& gauge, const GaugeBinding& to);

/// Indices of the particles of a site. Throws io::InputError when there are none in its box.
[[nodiscard]] std::vector<std::size_t> particles_of(const Site& site, const GaugeBinding& to);

}  // namespace fpz::specimen::detail
