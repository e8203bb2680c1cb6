// Measured values of a data set: columns of a CSV file or lists in the specification, their standard deviations, and
// the part of them that is used.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quantity_reader.hpp"

namespace fpz::calibration::detail {

/// A column that a kind of test needs: its name in "columns" or "values", and what it is.
struct Wanted {
  std::string_view name;
  Quantity quantity = Quantity::number;
};

/// Columns in the order in which they were wanted, SI.
struct Curve {
  std::string file;                      ///< as given; empty for lists in the specification
  std::string notation;                  ///< how it was read, as in io::Table
  std::vector<Eigen::VectorXd> columns;  ///< all rows: where the path counts, rows that are not used belong to it
  std::vector<Eigen::Index> used;        ///< rows that "range" and "thin" leave
  Eigen::VectorXd deviation;             ///< of the measured column, all rows
  bool deviation_known = true;
  std::string deviation_words;
};

/// What may be asked of the columns.
struct CurveNeeds {
  std::span<const Wanted> wanted;
  std::size_t measured = 1;             ///< index of the measured column
  std::optional<std::size_t> abscissa;  ///< index of the column that must not fall from row to row unless "cyclic"
  Eigen::Index least_points = 2;
};

/// Keys of a data set that read_curve looks at.
inline constexpr std::array<std::string_view, 12> curve_keys = {"file",    "columns",   "values", "deviation",
                                                                "range",   "thin",      "cyclic", "separator",
                                                                "decimal", "skip_rows", "rows",   "encoding"};

/// Reads them from the data set `set`; other files are looked up in `folder`. Nothing when there is a problem.
[[nodiscard]] std::optional<Curve> read_curve(const Context& c, const std::filesystem::path& folder, const Place& set,
                                              const CurveNeeds& needs);

/// The first of the names that "columns" or "values" has; a problem when it has none.
[[nodiscard]] std::optional<std::size_t> which_column(const Context& c, const Place& set,
                                                      std::span<const Wanted> candidates);

/// Standard deviation of `measured` from the member "deviation" of `set` (number, value with unit, relative, relative
/// to the peak; a column is read by read_curve). Nothing when there is a problem.
struct Deviation {
  Eigen::VectorXd values;
  bool known = true;
  std::string words;
};
[[nodiscard]] std::optional<Deviation> read_deviation(const Context& c, const Place& set, Quantity quantity,
                                                      const Eigen::VectorXd& measured);

}  // namespace fpz::calibration::detail
