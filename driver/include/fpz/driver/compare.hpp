// Comparison of a history with a reference CSV.
#pragma once

#include <string>
#include <vector>

#include "fpz/io/csv.hpp"

namespace fpz::driver {

struct CompareOptions {
  double stress_tolerance =
      1e-6;  ///< of stresses and tractions, relative to stress_scale; also of energies, to the largest one
  double stress_scale = 0.0;       ///< Pa; 0: the largest stress or traction in the reference
  double damage_tolerance = 1e-6;  ///< of D and of the normal's components
  double jump_tolerance = 1e-6;    ///< of jumps, relative to the largest jump in the reference
  double strain_tolerance = 1e-9;  ///< of strains, relative to the largest strain in the reference
};

/// Largest difference found in one column.
struct ColumnDifference {
  std::string column;
  double difference = 0.0;  ///< in the column's unit
  double relative = 0.0;    ///< over the column's scale; NaN when a cell is not a number
  double tolerance = 0.0;   ///< what `relative` is held against
  double time = 0.0;        ///< where
  double value = 0.0;
  double reference = 0.0;
  [[nodiscard]] bool ok() const { return relative <= tolerance; }
};

struct Comparison {
  std::vector<ColumnDifference> columns;
  std::vector<std::string> problems;  ///< missing columns, rows without a counterpart
  std::size_t rows = 0;
  std::size_t interpolated = 0;  ///< rows of the reference whose time the history does not have
  [[nodiscard]] bool ok() const;
  [[nodiscard]] std::string report() const;
};

/// Compares every known column of the reference. Rows are matched by time; names are those of history.csv or
/// T,sxx,..,D,tn,ts1,ts2,un,us1,us2.
[[nodiscard]] Comparison compare_histories(const io::Table& history, const io::Table& reference,
                                           const CompareOptions& options);

}  // namespace fpz::driver
