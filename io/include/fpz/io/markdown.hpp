// Lines of prose of a Markdown page: how long they are, and breaking those that are too long.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fpz::io {

/// The longest line of prose on the pages of the documentation, in characters.
inline constexpr std::size_t longest_line = 120;

struct LongLine {
  int number = 0;          ///< counts from 1
  std::size_t length = 0;  ///< characters, targets of links not counted
};

/// Lines of prose with more than `most` characters: not those of code blocks, tables and pictures.
[[nodiscard]] std::vector<LongLine> long_lines(const std::string& page, std::size_t most = longest_line);

/// The page with every paragraph and entry of a list that has such a line filled again. The page as shown stays the
/// same.
[[nodiscard]] std::string wrap_prose(const std::string& page, std::size_t most = longest_line);

}  // namespace fpz::io
