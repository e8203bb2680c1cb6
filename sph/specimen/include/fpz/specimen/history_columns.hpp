// The columns of history.csv: the one list of their names, units, meanings and values.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/sph/simulation.hpp"

namespace fpz::specimen {

/// A gauge whose name has a meaning: it steers stop conditions and pictures or is compared with others, and has a
/// column in every history.
struct SteeringGauge {
  std::string_view name;
  bool is_force = false;  ///< a ForceGauge; else a DisplacementGauge or an OpeningGauge
  bool required = false;
  std::string_view text;
};
inline constexpr std::array<SteeringGauge, 4> steering_gauges = {{
    {"deflection", false, true, "gauge `deflection`"},
    {"load", true, true, "gauge `load`"},
    {"support", true, false, "gauge `support`"},
    {"cmod", false, false, "gauge `cmod`: opening of the notch"},
}};

/// What the values of a row come from.
struct RowSource {
  const sph::Simulation<2>& run;
  sph::Energies energies;                  ///< of the run, J/m
  double thickness = 0.0;                  ///< m
  const std::vector<double>& gauge_means;  ///< in the order of gauge_order()
};

struct HistoryColumn {
  std::string name;
  std::string unit;  ///< SI; empty: a pure number
  std::string text;  ///< one line for tables
  std::function<double(const RowSource&)> value;
};

/// The order of the gauges: the steering ones, then those of `gauges` that are none.
[[nodiscard]] std::vector<std::string> gauge_order(const std::vector<std::string>& gauges);

/// All columns of a run with these gauges, in order.
[[nodiscard]] std::vector<HistoryColumn> history_columns(const std::vector<std::string>& gauges);

/// Whether a column of every run that is no gauge has this name.
[[nodiscard]] bool is_computed_column(std::string_view name);

}  // namespace fpz::specimen
