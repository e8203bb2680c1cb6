#include "fpz/io/csv.hpp"

#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

#include "fpz/io/input_error.hpp"

namespace fpz::io {
namespace {

std::string_view trim(std::string_view s) {
  const char* blanks = " \t\r\"";
  const auto first = s.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

double to_number(std::string_view cell) {
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  double x = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
  return error == std::errc() && end == cell.data() + cell.size() ? x : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const std::vector<double>* Table::find(std::string_view name) const {
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == name) return &columns[k];
  }
  return nullptr;
}

const std::vector<double>& Table::at(std::string_view name) const {
  if (const auto* column = find(name)) return *column;
  throw InputError(origin + ": no column \"" + std::string(name) + "\"");
}

Table parse_csv(std::string_view text, const std::string& origin) {
  Table table;
  table.origin = origin;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (trim(line).empty()) continue;
    const auto cells = split(line);
    if (table.names.empty()) {
      table.names.assign(cells.begin(), cells.end());
      table.columns.resize(cells.size());
      continue;
    }
    if (cells.size() != table.names.size()) {
      throw InputError(origin + ", line " + std::to_string(number) + ": " + std::to_string(cells.size()) +
                       " cells, the header has " + std::to_string(table.names.size()));
    }
    for (std::size_t k = 0; k < cells.size(); ++k) table.columns[k].push_back(to_number(cells[k]));
    table.lines.push_back(number);
  }
  if (table.rows() == 0) throw InputError(origin + ": no rows");
  return table;
}

Table read_csv(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw InputError(file.string() + ": cannot be read");
  std::ostringstream text;
  text << in.rdbuf();
  return parse_csv(text.str(), file.string());
}

}  // namespace fpz::io
