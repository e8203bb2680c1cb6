// Where in a table the names, the units and the numbers stand.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "csv_records.hpp"

namespace fpz::io::detail {

struct CsvLayout {
  std::size_t width = 0;             ///< number of columns
  std::optional<std::size_t> names;  ///< record with the column names
  std::optional<std::size_t> units;  ///< record with their units
  std::vector<bool> numeric;         ///< columns of numbers; the others are text
  std::vector<std::size_t> rows;     ///< records with numbers
  std::vector<std::string> remarks;  ///< records left out, as in Table
  std::string problem;               ///< why this is no table; empty for one
  std::size_t numbers = 0;           ///< cells in rows as wide as most, also where there is a problem
};

/// Finds them. `origin` begins what names lines.
[[nodiscard]] CsvLayout find_layout(const Records& records, CsvSeparator separator, const CsvOptions& options,
                                    const std::string& origin);

/// The unit in a cell of a line of units, or in brackets behind a name: "(kN)" and "kN" give "kN". Nothing for other
/// text.
[[nodiscard]] std::optional<std::string> unit_in_cell(std::string_view cell);
[[nodiscard]] std::optional<std::string> unit_in_name(std::string_view name);

/// A name without the unit in brackets behind it.
[[nodiscard]] std::string_view without_unit(std::string_view name);

}  // namespace fpz::io::detail
