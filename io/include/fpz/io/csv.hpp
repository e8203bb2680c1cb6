// Tables of numbers with named columns, read from CSV files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fpz::io {

struct Table {
  std::string origin;  ///< file name, for messages
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< cells that are no numbers are NaN
  std::vector<std::size_t> lines;            ///< of the rows in the file, counted from 1

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// The column of that name, or null.
  [[nodiscard]] const std::vector<double>* find(std::string_view name) const;
  /// The column of that name; throws InputError naming the file and the column.
  [[nodiscard]] const std::vector<double>& at(std::string_view name) const;
};

/// Reads a CSV file with a header line. Throws InputError for an unreadable file, an empty one, or lines of unequal
/// length.
[[nodiscard]] Table read_csv(const std::filesystem::path& file);
[[nodiscard]] Table parse_csv(std::string_view text, const std::string& origin);

}  // namespace fpz::io
