#include "fpz/specimen/history_columns.hpp"

#include <algorithm>

namespace fpz::specimen {
namespace {

double largest_damage(const sph::Simulation<2>& run) {
  const sph::Particles<2>& p = run.motions_now();
  double largest = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] == sph::kind::cracked) largest = std::max(largest, 1.0 - p.point[i].crack.integrity);
  }
  return largest;
}

/// Before the steering gauges.
std::vector<HistoryColumn> leading() {
  return {{"step", "", "steps since the start", [](const RowSource& s) { return static_cast<double>(s.run.steps()); }},
          {"time", "s", "time of the loading since the start (that of the body at pace 1)",
           [](const RowSource& s) { return s.run.loading_time(); }}};
}

std::vector<HistoryColumn> energies() {
  std::vector<HistoryColumn> list;
  for (const sph::EnergyTerm& term : sph::energy_terms) {
    if (term.role == sph::EnergyRole::initial) continue;
    list.push_back({"energy_" + std::string(term.name), "J", std::string(term.text),
                    [member = term.member](const RowSource& s) { return s.thickness * (s.energies.*member); }});
  }
  list.push_back({"energy_error", "J", "what the balance of the energies lacks",
                  [](const RowSource& s) { return s.thickness * s.energies.error(); }});
  return list;
}

std::vector<HistoryColumn> counts() {
  return {
      {"damaged_particles", "", "particles that have cracked",
       [](const RowSource& s) { return static_cast<double>(s.run.cracked()); }},
      {"largest_damage", "", "largest D of all particles", [](const RowSource& s) { return largest_damage(s.run); }},
      {"released_bonds", "", "bonds that have been cut",
       [](const RowSource& s) { return static_cast<double>(s.run.released_bonds()); }},
      {"failing_out_of_plane", "",
       "uncracked particles that would have cracked in 3-D, on planes inclined out of the plane",
       [](const RowSource& s) { return static_cast<double>(s.run.failing_out_of_plane()); }}};
}

HistoryColumn gauge(const std::string& name, std::size_t k, std::string_view unit, std::string_view text) {
  return {name, std::string(unit), std::string(text), [k](const RowSource& s) { return s.gauge_means[k]; }};
}

}  // namespace

std::vector<std::string> gauge_order(const std::vector<std::string>& gauges) {
  std::vector<std::string> order;
  for (const SteeringGauge& g : steering_gauges) order.emplace_back(g.name);
  for (const std::string& name : gauges) {
    if (std::find(order.begin(), order.end(), name) == order.end()) order.push_back(name);
  }
  return order;
}

std::vector<HistoryColumn> history_columns(const std::vector<std::string>& gauges) {
  std::vector<HistoryColumn> columns = leading();
  const auto append = [&](const std::vector<HistoryColumn>& more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  for (std::size_t k = 0; k < steering_gauges.size(); ++k) {
    const SteeringGauge& g = steering_gauges[k];
    columns.push_back(gauge(std::string(g.name), k, g.is_force ? "N" : "m", g.text));
  }
  append(energies());
  append(counts());
  const std::vector<std::string> order = gauge_order(gauges);
  for (std::size_t k = steering_gauges.size(); k < order.size(); ++k) {
    columns.push_back(gauge(order[k], k, "N, m, Pa, rad or 1", "gauge of the scene"));
  }
  return columns;
}

bool is_computed_column(std::string_view name) {
  for (const SteeringGauge& g : steering_gauges) {
    if (g.name == name) return false;
  }
  const std::vector<HistoryColumn> columns = history_columns({});
  return std::any_of(columns.begin(), columns.end(), [&](const HistoryColumn& c) { return c.name == name; });
}

}  // namespace fpz::specimen
