// The force that holds boundary groups.
#include "gauge_kinds.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::string_view uses[] = {"direction"};

Gauge read(const InputReader& r, const Place& gauge, const Place& value, const Scene& scene) {
  ForceGauge g;
  g.direction = read_gauge_direction(r, gauge);
  one_or_more(r, value, [&](const Place& p) { g.groups.push_back(read_group_name(r, p, scene)); });
  return g;
}

}  // namespace

const GaugeKind force_gauge = {"force_on", uses, read};

BoundGauge bind(const ForceGauge& gauge, const GaugeBinding& to) {
  std::vector<std::size_t> groups;
  for (const std::string& wanted : gauge.groups) {
    for (std::size_t k = 0; k < to.scene.boundaries.size(); ++k) {
      if (to.scene.boundaries[k].name == wanted) groups.push_back(k);
    }
  }
  const auto value = [groups, direction = gauge.direction](const sph::Simulation<2>& run, double thickness) {
    Point sum = Point::Zero();
    for (const std::size_t k : groups) sum += run.reaction(k);
    return thickness * sum.dot(direction);
  };
  return {value, {}};
}

}  // namespace fpz::specimen::detail
