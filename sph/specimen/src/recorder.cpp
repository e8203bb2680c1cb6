#include "recorder.hpp"

#include <limits>

namespace fpz::specimen::detail {

Recorder::Recorder(const Scene& scene, const Specimen& specimen) : thickness_(scene.thickness) {
  std::vector<std::string> names;
  for (const auto& [name, gauge] : specimen.gauges) names.push_back(name);
  for (const std::string& name : gauge_order(names)) {
    const auto at = specimen.gauges.find(name);
    gauges_.push_back(at == specimen.gauges.end() ? nullptr : &at->second);
  }
  columns_ = history_columns(names);
  for (const HistoryColumn& c : columns_) state_.history.columns.push_back(c.name);
  state_.sums.assign(gauges_.size(), 0.0);
}

void Recorder::accumulate(const sph::Simulation<2>& run) {
  for (std::size_t k = 0; k < gauges_.size(); ++k) {
    if (gauges_[k] != nullptr) state_.sums[k] += gauges_[k]->value(run, thickness_);
  }
  ++state_.steps;
}

void Recorder::add_row(const sph::Simulation<2>& run) {
  std::vector<double> means(gauges_.size(), 0.0);
  for (std::size_t k = 0; k < gauges_.size(); ++k) {
    if (gauges_[k] == nullptr) {
      means[k] = std::numeric_limits<double>::quiet_NaN();
    } else if (state_.steps > 0) {
      means[k] = state_.sums[k] / static_cast<double>(state_.steps);
    }
  }
  const RowSource source{run, run.energies(), thickness_, means};
  for (const HistoryColumn& c : columns_) state_.history.values.push_back(c.value(source));
  state_.sums.assign(gauges_.size(), 0.0);
  state_.steps = 0;
  const double load = state_.history.last("load");
  at_peak_ = load > state_.peak_load;
  if (at_peak_) state_.peak_load = load;
}

}  // namespace fpz::specimen::detail
