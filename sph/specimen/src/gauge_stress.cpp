// The mean stress of a site.
#include "gauge_kinds.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::string_view uses[] = {"of"};

Gauge read(const InputReader& r, const Place& gauge, const Place& value, const Scene& scene) {
  StressGauge g;
  g.component = choice<PlaneComponent>(r, value).value_or(PlaneComponent::xx);
  with_required(r, gauge, "of", [&](const Place& p) { g.of = read_site(r, p, scene); });
  return g;
}

}  // namespace

const GaugeKind stress_gauge = {"stress", uses, read};

BoundGauge bind(const StressGauge& gauge, const GaugeBinding& to) {
  const std::vector<std::size_t> of = particles_of(gauge.of, to);
  const auto component = static_cast<std::size_t>(gauge.component);
  const auto value = [of, component](const sph::Simulation<2>& run, double /*thickness*/) {
    double sum = 0.0;
    for (const std::size_t id : of) sum += run.particles_now().stress[component][run.slot(id)];
    return sum / static_cast<double>(of.size());
  };
  return {value, {of}};
}

}  // namespace fpz::specimen::detail
