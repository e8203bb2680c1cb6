// The displacement of a site against others.
#include "gauge_kinds.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::string_view uses[] = {"relative_to", "direction"};

Gauge read(const InputReader& r, const Place& gauge, const Place& value, const Scene& scene) {
  DisplacementGauge g;
  g.direction = read_gauge_direction(r, gauge);
  g.of = read_site(r, value, scene);
  with(gauge, "relative_to", [&](const Place& p) {
    one_or_more(r, p, [&](const Place& site) { g.relative_to.push_back(read_site(r, site, scene)); });
  });
  return g;
}

Point mean_displacement(const sph::Simulation<2>& run, const std::vector<std::size_t>& ids) {
  const sph::Particles<2>& p = run.motions_now();
  Point sum = Point::Zero();
  for (const std::size_t id : ids) {
    const std::size_t i = run.slot(id);
    sum += Point(p.position[0][i] - p.start[0][i], p.position[1][i] - p.start[1][i]);
  }
  return sum / static_cast<double>(ids.size());
}

}  // namespace

const GaugeKind displacement_gauge = {"displacement_of", uses, read};

BoundGauge bind(const DisplacementGauge& gauge, const GaugeBinding& to) {
  const std::vector<std::size_t> of = particles_of(gauge.of, to);
  std::vector<std::vector<std::size_t>> others;
  for (const Site& s : gauge.relative_to) others.push_back(particles_of(s, to));
  std::vector<std::vector<std::size_t>> sites = {of};
  sites.insert(sites.end(), others.begin(), others.end());
  const auto value = [of, others, direction = gauge.direction](const sph::Simulation<2>& run, double /*thickness*/) {
    Point u = mean_displacement(run, of);
    for (const auto& ids : others) u -= mean_displacement(run, ids) / static_cast<double>(others.size());
    return u.dot(direction);
  };
  return {value, sites};
}

}  // namespace fpz::specimen::detail
