#include "fpz/io/csv.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <sstream>

#include "csv_layout.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/problems.hpp"
#include "fpz/io/units.hpp"

namespace fpz::io {
namespace {

using detail::Cell;
using detail::CsvLayout;
using detail::Record;
using detail::Records;
using Kind = CellNotation::Kind;

/// A file at one separator.
struct Candidate {
  CsvSeparator separator = CsvSeparator::comma;
  Records records;
  CsvLayout layout;

  [[nodiscard]] bool is_table() const { return layout.problem.empty(); }
};

/// Does the line of names of a single column look as if it named several?
bool names_are_several(const Candidate& c) {
  if (!c.layout.names || c.separator == CsvSeparator::comma) return false;
  return c.records.list[*c.layout.names].written.find_first_of(",;\t|") != std::string_view::npos;
}

/// Leaves those that could be meant: a line in front of the table may have many of another separator, but it is no
/// table of its own.
void keep_rivals(std::vector<Candidate>& tables) {
  std::size_t most = 0;
  bool named = false;
  for (const Candidate& c : tables) {
    most = std::max(most, c.layout.rows.size());
    named = named || c.layout.names;
  }
  std::erase_if(tables,
                [&](const Candidate& c) { return 2 * c.layout.rows.size() < most || (named && !c.layout.names); });
}

/// The table at the only separator at which it has several columns, or with one column. Throws InputError otherwise.
Candidate choose_separator(std::string_view text, const std::string& origin, const CsvOptions& options) {
  const auto cut = [&](CsvSeparator separator) {
    Candidate c{separator, detail::cut_into_records(text, separator), {}};
    c.layout = find_layout(c.records, separator, options, origin);
    return c;
  };
  if (options.separator) {
    Candidate only = cut(*options.separator);
    if (!only.is_table()) throw InputError(only.layout.problem);
    return only;
  }
  std::vector<Candidate> tables;
  Candidate best;  // of those that are none
  best.layout.problem = origin + ": no rows of numbers";
  std::optional<Candidate> one_column;
  const auto consider = [&](CsvSeparator separator) {
    Candidate c = cut(separator);
    if (!c.is_table()) {
      if (c.layout.numbers > best.layout.numbers) best = std::move(c);
    } else if (c.layout.width > 1) {
      tables.push_back(std::move(c));
    } else if (!one_column) {
      one_column = std::move(c);
    }
  };
  using enum CsvSeparator;
  for (const CsvSeparator separator : {comma, semicolon, tab, bar}) {
    const bool occurs = text.find(detail::character_of(separator)) != std::string_view::npos;
    if (occurs || separator == comma) consider(separator);
  }
  if (tables.empty()) consider(space);  // blanks stand in names, too
  keep_rivals(tables);
  if (tables.size() > 1) {
    throw InputError(origin + ": is a table of " + std::to_string(tables[0].layout.width) +
                     " columns when they are separated by the " + to_string(tables[0].separator) + ", and of " +
                     std::to_string(tables[1].layout.width) + " with the " + to_string(tables[1].separator) +
                     "; say which \"separator\" it has");
  }
  if (!tables.empty()) return std::move(tables.front());
  if (one_column && best.layout.numbers <= one_column->layout.numbers && !names_are_several(*one_column)) {
    return std::move(*one_column);
  }
  throw InputError(best.layout.problem);
}

/// A cell that says something of the decimal mark.
struct Evidence {
  const Record* record = nullptr;
  const Cell* cell = nullptr;

  [[nodiscard]] std::string words() const {
    return std::string(cell->text) + " in line " + std::to_string(record->line);
  }
};

struct DecimalEvidence {
  std::array<std::optional<Evidence>, 2> proof, ambiguous;  ///< by the mark
  bool grouped = false;
};

DecimalEvidence collect_evidence(const Candidate& c) {
  DecimalEvidence e;
  const auto note = [](auto& list, std::optional<DecimalMark> mark, const Record& r, const Cell& cell) {
    if (mark && !list[static_cast<std::size_t>(*mark)]) list[static_cast<std::size_t>(*mark)] = Evidence{&r, &cell};
  };
  for (const std::size_t row : c.layout.rows) {
    const Record& r = c.records.list[row];
    for (std::size_t k = 0; k < r.cells.size() && k < c.layout.numeric.size(); ++k) {
      const CellNotation& n = r.cells[k].notation;
      if (!c.layout.numeric[k] || n.kind != Kind::number) continue;
      note(e.proof, n.proves, r, r.cells[k]);
      note(e.ambiguous, n.ambiguous, r, r.cells[k]);
      e.grouped = e.grouped || n.grouped;
    }
  }
  return e;
}

/// Throws InputError when the cells leave it open, or contradict each other.
DecimalMark find_decimal(const Candidate& c, const std::string& origin) {
  const auto [proof, ambiguous, grouped] = collect_evidence(c);
  constexpr auto point = static_cast<std::size_t>(DecimalMark::point);
  constexpr auto comma = static_cast<std::size_t>(DecimalMark::comma);
  const auto refuse = [&](const Evidence& e, const std::string& why) {
    throw InputError(origin + ':' + std::to_string(e.record->line) + ": " + why +
                     "; say \"decimal\": \"point\" or \"decimal\": \"comma\"");
  };
  if (proof[point] && proof[comma]) {
    refuse(*proof[comma],
           proof[comma]->words() + " has a decimal comma, " + proof[point]->words() + " a decimal point");
  }
  if (!proof[point] && !proof[comma]) {
    // Where commas separate, points between groups of digits do not occur.
    const bool commas_separate = c.separator == CsvSeparator::comma && !ambiguous[comma];
    for (const auto& e : {ambiguous[comma], ambiguous[point]}) {
      if (!e || commas_separate) continue;
      std::string whole(e->cell->text);
      std::erase_if(whole, [](char x) { return x == '.' || x == ','; });
      refuse(*e, std::string(e->cell->text) + " can be " + whole + " or a number with three decimals");
    }
    return DecimalMark::point;
  }
  const DecimalMark decimal = proof[point] ? DecimalMark::point : DecimalMark::comma;
  const auto& other = ambiguous[proof[point] ? comma : point];
  if (other && !grouped) {
    const Evidence& sure = proof[point] ? *proof[point] : *proof[comma];
    refuse(*other, other->words() + " has groups of digits if " + sure.words() + " shows the decimal mark, which no " +
                       "other number has");
  }
  return decimal;
}

double value_of(const Record& r, std::size_t column, DecimalMark decimal, bool spaces_group) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (column >= r.cells.size() || r.cells[column].notation.kind != Kind::number) return nan;
  return to_number(r.cells[column].text, decimal, spaces_group).value_or(nan);
}

void take_names(const Candidate& c, Table& table) {
  const CsvLayout& layout = c.layout;
  table.names.resize(layout.width);
  table.units.resize(layout.width);
  const auto cells = [&](std::size_t record, std::vector<std::string>& texts) {
    const Record& r = c.records.list[record];
    for (std::size_t k = 0; k < std::min(layout.width, r.cells.size()); ++k) texts[k] = r.cells[k].text;
  };
  if (layout.names) cells(*layout.names, table.names);
  if (layout.units) cells(*layout.units, table.units);
  for (std::size_t k = 0; k < layout.width; ++k) {
    table.units[k] = layout.units ? detail::unit_in_cell(table.units[k]).value_or("")
                                  : detail::unit_in_name(table.names[k]).value_or("");
  }
}

std::string describe(const Candidate& c, TextEncoding encoding, DecimalMark decimal) {
  const auto line = [&](std::size_t record) { return std::to_string(c.records.list[record].line); };
  const CsvLayout& layout = c.layout;
  std::string text = std::string(to_string(encoding)) + ", " + std::to_string(layout.width) + " columns at each " +
                     to_string(c.separator) + ", decimal " + to_string(decimal) + ", ";
  text += layout.names ? "names in line " + line(*layout.names) : "no names";
  if (layout.units) text += ", units in line " + line(*layout.units);
  text += ", " + std::to_string(layout.rows.size()) + " rows in lines " + line(layout.rows.front()) + " to " +
          line(layout.rows.back());
  return text;
}

}  // namespace

std::optional<std::size_t> Table::index(std::string_view name) const {
  for (const bool bare : {false, true}) {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string_view own = bare ? detail::without_unit(names[k]) : std::string_view(names[k]);
      if (own != name || own.empty()) continue;
      if (found) {
        throw InputError(origin + ": columns " + std::to_string(*found + 1) + " and " + std::to_string(k + 1) +
                         " are both called " + in_quotes(name) + "; give the number of the one that is meant");
      }
      found = k;
    }
    if (found) return found;
  }
  return std::nullopt;
}

const std::vector<double>* Table::find(std::string_view name) const {
  const auto k = index(name);
  if (!k) return nullptr;
  if (!units[*k].empty() && !is_si_unit(units[*k])) {
    throw InputError(origin + ": column " + in_quotes(names[*k]) + " is in " + in_quotes(units[*k]) +
                     "; numbers in SI units are needed here");
  }
  return &columns[*k];
}

std::string Table::no_column(std::string_view name) const {
  std::string text = origin + " has no column " + in_quotes(name);
  if (std::all_of(names.begin(), names.end(), [](const std::string& n) { return n.empty(); })) {
    return text + ": no line names the columns; give a number, 1 to " + std::to_string(names.size());
  }
  for (const std::string& n : names) {
    if (!name.empty() && n.find(name) != std::string::npos) {
      text += "; did you mean " + in_quotes(n) + '?';
      return text + suggestion("", {std::vector<std::string_view>(names.begin(), names.end())});
    }
  }
  return text + suggestion(name, {std::vector<std::string_view>(names.begin(), names.end())});
}

const std::vector<double>& Table::at(std::string_view name) const {
  if (const auto* column = find(name)) return *column;
  throw InputError(no_column(name));
}

Table parse_csv(std::string_view bytes, const std::string& origin, const CsvOptions& options) {
  const DecodedText decoded = decode_text(bytes, origin, options.encoding);
  const Candidate c = choose_separator(decoded.text, origin, options);
  const DecimalMark decimal = options.decimal ? *options.decimal : find_decimal(c, origin);
  Table table;
  table.origin = origin;
  take_names(c, table);
  table.columns.resize(c.layout.width);
  for (const std::size_t row : c.layout.rows) {
    const Record& r = c.records.list[row];
    for (std::size_t k = 0; k < c.layout.width; ++k) {
      table.columns[k].push_back(value_of(r, k, decimal, detail::spaces_group(c.separator)));
    }
    table.lines.push_back(r.line);
  }
  table.notation = describe(c, decoded.encoding, decimal);
  table.remarks = c.layout.remarks;
  return table;
}

Table read_csv(const std::filesystem::path& file, const CsvOptions& options) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw InputError(file.string() + ": cannot be read");
  std::ostringstream text;
  text << in.rdbuf();
  return parse_csv(text.str(), file.string(), options);
}

}  // namespace fpz::io
