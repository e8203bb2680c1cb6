#include "equations.hpp"

#include <cctype>
#include <charconv>
#include <optional>
#include <sstream>

namespace fpz::docs {
namespace {

/// Takes a prefix off the text if it has it.
bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream parts(line.substr(1));
  for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(cell);
  return cells;
}

/// Every `path: name` in backticks.
std::vector<CodePlace> places_of(const std::string& cell) {
  std::vector<CodePlace> places;
  std::istringstream parts(cell);
  bool quoted = false;
  for (std::string part; std::getline(parts, part, '`'); quoted = !quoted) {
    const std::size_t colon = part.find(": ");
    if (quoted && colon != std::string::npos) places.push_back({part.substr(0, colon), part.substr(colon + 2)});
  }
  return places;
}

}  // namespace

std::set<int> leading_numbers(std::string_view text) {
  std::set<int> numbers;
  do {
    const std::optional<int> first = take_number(text);
    if (!first) break;
    std::optional<int> last = first;
    if (text.size() > 1 && text[0] == '-' && std::isdigit(static_cast<unsigned char>(text[1])) != 0) {
      take(text, "-");
      last = take_number(text);
    }
    for (int k = *first; k <= *last; ++k) numbers.insert(k);
  } while (take(text, ", ") || take(text, " and "));
  return numbers;
}

std::set<int> mentioned_equations(std::string_view text) {
  std::set<int> numbers;
  for (std::string_view word : {"eq ", "eqs ", "Eq "}) {
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
      if (at == 0 || !is_name(text[at - 1])) numbers.merge(leading_numbers(text.substr(at + word.size())));
    }
  }
  return numbers;
}

std::vector<IndexRow> read_equation_index(const std::string& page) {
  std::vector<IndexRow> rows;
  std::istringstream lines(page);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.starts_with("| ")) continue;
    const std::vector<std::string> cells = cells_of(line);
    IndexRow row{number, leading_numbers(std::string_view(line).substr(2)), {}};
    if (row.equations.empty()) continue;
    if (cells.size() >= 3) row.places = places_of(cells[2]);
    rows.push_back(row);
  }
  return rows;
}

bool has_word(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_name(text[at - 1])) && (end == text.size() || !is_name(text[end]))) return true;
  }
  return false;
}

}  // namespace fpz::docs
