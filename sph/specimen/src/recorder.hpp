// Records the history of a run: sums the gauges up in every step, adds rows.
#pragma once

#include "fpz/specimen/history.hpp"
#include "fpz/specimen/history_columns.hpp"
#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen::detail {

/// The recorder's part of a checkpoint.
struct RecorderState {
  History history;
  std::vector<double> sums;  ///< of the gauges since the last row, in the order of gauge_order()
  long long steps = 0;       ///< since the last row
  double peak_load = 0.0;    ///< largest load of the rows, N
};

template <class Archive, class State>
void transfer(Archive& archive, State& state) requires std::same_as<std::remove_const_t<State>, RecorderState> {
  auto& [history, sums, steps, peak_load] = state;  // a member that is not handed on does not compile
  auto& [columns, values] = history;
  archive(columns), archive(values), archive(sums), archive(steps), archive(peak_load);
}

class Recorder {
 public:
  Recorder(const Scene& scene, const Specimen& specimen);

  /// Takes the gauges of the present step into the means of the next row.
  void accumulate(const sph::Simulation<2>& run);
  /// Gauges as means over the steps since the last row, the rest as it is now.
  void add_row(const sph::Simulation<2>& run);

  [[nodiscard]] const History& history() const { return state_.history; }
  [[nodiscard]] bool has_steps() const { return state_.steps > 0; }  ///< since the last row
  [[nodiscard]] double peak_load() const { return state_.peak_load; }
  [[nodiscard]] bool at_peak() const { return at_peak_; }  ///< the last row has the largest load so far

  [[nodiscard]] const RecorderState& state() const { return state_; }
  void restore(RecorderState state) { state_ = std::move(state); }

 private:
  double thickness_;
  std::vector<const BoundGauge*> gauges_;  ///< in the order of gauge_order(); null: the scene has none of that name
  std::vector<HistoryColumn> columns_;
  RecorderState state_;
  bool at_peak_ = false;
};

}  // namespace fpz::specimen::detail
