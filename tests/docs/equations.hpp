// The table of docs/equation-index.md: which function holds which equation of the paper.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fpz::docs {

/// A place in the code, written `path: name` in the table.
struct CodePlace {
  std::string file;
  std::string name;
};

/// One row "| eq | what | where |".
struct IndexRow {
  int line = 0;
  std::set<int> equations;
  std::vector<CodePlace> places;
};

/// The numbers of a list such as "33", "44-46" or "17, 19-21 and 23" at the begin of the text.
[[nodiscard]] std::set<int> leading_numbers(std::string_view text);

/// All numbers that follow an "eq " or "eqs " in the text.
[[nodiscard]] std::set<int> mentioned_equations(std::string_view text);

/// The rows whose first cell begins with a number.
[[nodiscard]] std::vector<IndexRow> read_equation_index(const std::string& page);

/// Is the name a word of the text?
[[nodiscard]] bool has_word(std::string_view text, std::string_view name);

}  // namespace fpz::docs
