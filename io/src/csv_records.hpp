// The lines of a table cut into cells at one separator.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/io/csv.hpp"

namespace fpz::io::detail {

struct Cell {
  std::string_view text;  ///< without blanks and quotes around it
  CellNotation notation;
};

/// One line, or several where a quoted cell has line breaks. Blank lines are left out.
struct Record {
  std::size_t line = 0;      ///< counted from 1
  std::vector<Cell> cells;   ///< all of them
  std::size_t filled = 0;    ///< up to the last cell that is not empty
  std::size_t numbers = 0;   ///< cells that are numbers
  bool commented = false;    ///< began with #, which is taken off; its cells are text
  std::string_view written;  ///< the first line as it stands

  [[nodiscard]] bool has_text() const;
};

/// Refers to the text it was cut from; `unquoted` keeps cells whose quotes had to be taken apart.
struct Records {
  std::vector<Record> list;
  std::deque<std::string> unquoted;
};

/// The character of a separator; ' ' stands for any number of blanks.
[[nodiscard]] char character_of(CsvSeparator separator);

/// May digits be grouped by spaces in a table with that separator?
[[nodiscard]] bool spaces_group(CsvSeparator separator);

[[nodiscard]] Records cut_into_records(std::string_view text, CsvSeparator separator);

}  // namespace fpz::io::detail
