// Tables of numbers with named columns, read from the text files of programs, spreadsheets and testing machines.
//
// What a file does not say is found where only one reading is possible: encoding, separator, decimal mark, the lines
// before the column names, units below them, names that are repeated further down, remarks behind the last row. What
// can be read in two ways is refused with the line, the cause, and the option that settles it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/io/decimal_number.hpp"
#include "fpz/io/text_encoding.hpp"
#include "fpz/words.hpp"

namespace fpz::io {

enum class CsvSeparator : std::uint8_t {
  comma,
  semicolon,
  tab,
  bar,
  space  ///< any number of blanks
};

/// What a person may say of a file; what is left out is found.
struct CsvOptions {
  std::optional<CsvSeparator> separator;
  std::optional<DecimalMark> decimal;
  std::optional<std::size_t> skip_rows;  ///< lines before the one with the column names (or the first numbers)
  std::optional<std::size_t> rows;       ///< read at most so many rows of numbers
  std::optional<TextEncoding> encoding;
};

struct Table {
  std::string origin;                        ///< file name, for messages
  std::vector<std::string> names;            ///< as in the file; all empty where no line names the columns
  std::vector<std::string> units;            ///< from a line of units or brackets in a name; empty: not stated
  std::vector<std::vector<double>> columns;  ///< cells that are no numbers are NaN
  std::vector<std::size_t> lines;            ///< of the rows in the file, counted from 1
  std::string notation;                      ///< how the file was read, in words
  std::vector<std::string> remarks;          ///< lines left out behind or between the rows; each names file and line

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// The index of the column of that name, written as in the file or without a unit in brackets. Throws InputError when
  /// several have it.
  [[nodiscard]] std::optional<std::size_t> index(std::string_view name) const;
  /// The column of that name, or null. Throws as index(), and where the file states a unit that is not SI.
  [[nodiscard]] const std::vector<double>* find(std::string_view name) const;
  /// The same; no column of that name throws InputError, too.
  [[nodiscard]] const std::vector<double>& at(std::string_view name) const;
  /// Why there is no column of that name, and which there are.
  [[nodiscard]] std::string no_column(std::string_view name) const;
};

/// Reads a table from a file or from its bytes. Throws InputError for an unreadable file, one without rows of numbers,
/// lines of unequal length, and what can be read in several ways.
[[nodiscard]] Table read_csv(const std::filesystem::path& file, const CsvOptions& options = {});
[[nodiscard]] Table parse_csv(std::string_view bytes, const std::string& origin, const CsvOptions& options = {});

}  // namespace fpz::io

template <>
struct fpz::Words<fpz::io::CsvSeparator> {
  using K = io::CsvSeparator;
  static constexpr Word<K> list[] = {
      {K::comma, "comma"}, {K::semicolon, "semicolon"}, {K::tab, "tab"}, {K::bar, "bar"}, {K::space, "space"}};
};
