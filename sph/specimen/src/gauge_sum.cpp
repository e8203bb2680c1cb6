// Sums of other gauges times factors: means, differences, nominal stresses, ratios of forces.
#include "gauge_kinds.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::string_view uses[] = {"over"};

std::vector<SumGauge::Term> read_terms(const InputReader& r, const Place& place) {
  std::vector<SumGauge::Term> terms;
  if (!r.object(place, "names of gauges with their factors")) return terms;
  for (const JsonValue& member : place.value().items) {
    if (const auto factor = r.number(Place(place, member))) terms.push_back({member.key, *factor});
  }
  return terms;
}

Gauge read(const InputReader& r, const Place& gauge, const Place& value, const Scene& /*scene*/) {
  SumGauge g;
  g.terms = read_terms(r, value);
  with(gauge, "over", [&](const Place& p) { g.over = read_terms(r, p); });
  return g;
}

/// The names that stand in a sum must be gauges that measure something themselves.
void check_terms(const InputReader& r, const Place& sum, const Scene& scene) {
  std::vector<std::string_view> valid;
  for (const auto& [name, gauge] : scene.gauges) {
    if (!std::holds_alternative<SumGauge>(gauge)) valid.push_back(name);
  }
  for (const JsonValue& member : sum.value().items) {
    if (std::find(valid.begin(), valid.end(), member.key) != valid.end()) continue;
    const bool is_sum = scene.gauges.count(member.key) > 0;
    r.problem(Place(sum, member), is_sum ? "is a sum itself; must be a gauge that measures something"
                                         : "there is no such gauge" + io::suggestion(member.key, valid));
  }
}

struct BoundTerm {
  BoundGauge gauge;
  double factor;
};

double total(const std::vector<BoundTerm>& terms, const sph::Simulation<2>& run, double thickness) {
  double sum = 0.0;
  for (const BoundTerm& t : terms) sum += t.factor * t.gauge.value(run, thickness);
  return sum;
}

}  // namespace

const GaugeKind sum_gauge = {"sum_of", uses, read};

void check_sum(const InputReader& r, const Place& gauge, const Scene& scene) {
  with(gauge, "sum_of", [&](const Place& p) { check_terms(r, p, scene); });
  with(gauge, "over", [&](const Place& p) { check_terms(r, p, scene); });
}

BoundGauge bind(const SumGauge& gauge, const GaugeBinding& to) {
  std::vector<std::vector<std::size_t>> sites;
  const auto bound = [&](const std::vector<SumGauge::Term>& terms) {
    std::vector<BoundTerm> list;
    for (const SumGauge::Term& t : terms) {
      const auto bind_kind = [&](const auto& kind) {
        return bind(kind, GaugeBinding{to.scene, to.arrangement, t.gauge});
      };
      list.push_back({std::visit(bind_kind, to.scene.gauges.at(t.gauge)), t.factor});
      const auto& of_term = list.back().gauge.sites;
      sites.insert(sites.end(), of_term.begin(), of_term.end());
    }
    return list;
  };
  const std::vector<BoundTerm> above = bound(gauge.terms), below = bound(gauge.over);
  const auto value = [above, below](const sph::Simulation<2>& run, double thickness) {
    const double sum = total(above, run, thickness);
    return below.empty() ? sum : sum / total(below, run, thickness);
  };
  return {value, sites};
}

}  // namespace fpz::specimen::detail
