#include "csv_layout.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "fpz/io/problems.hpp"
#include "fpz/io/units.hpp"

namespace fpz::io::detail {
namespace {

using Kind = CellNotation::Kind;

std::string count_of(std::size_t n, const char* what) { return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s"); }

/// Would the cell fall into several numbers at another separator? Then this separator is the wrong one.
bool falls_into_numbers(std::string_view text) {
  for (const std::string_view at : {"\t ", ";", "|", ","}) {
    std::size_t pieces = 0;
    bool all = true;
    for (std::size_t begin = 0; begin <= text.size() && all;) {
      const std::size_t end = std::min(text.find_first_of(at, begin), text.size());
      const std::string_view piece = text.substr(begin, end - begin);
      begin = end + 1;
      if (piece.empty()) continue;
      all = notation_of(piece, false).kind == Kind::number;
      ++pieces;
    }
    if (all && pieces > 1) return true;
  }
  return false;
}

class LayoutFinder {
 public:
  LayoutFinder(const Records& records, CsvSeparator separator, const CsvOptions& options, const std::string& origin)
      : records_(records.list), separator_(separator), options_(options), origin_(origin) {}

  CsvLayout find() {
    skip();
    if (!count_columns() || !find_clean_rows() || !find_names()) return std::move(layout_);
    take_rows();
    if (layout_.problem.empty()) check_text_columns();
    return std::move(layout_);
  }

 private:
  [[nodiscard]] std::string at(const Record& r) const { return origin_ + ':' + std::to_string(r.line) + ": "; }
  bool fail(const std::string& text) {
    layout_.problem = text;
    return false;
  }

  void skip() {
    if (!options_.skip_rows) return;
    while (begin_ < records_.size() && records_[begin_].line <= *options_.skip_rows) ++begin_;
  }

  /// The width that most lines with numbers have, and which of the columns hold numbers.
  bool count_columns() {
    std::map<std::size_t, std::size_t> votes;
    for (std::size_t k = begin_; k < records_.size(); ++k) {
      if (records_[k].numbers > 0) ++votes[records_[k].cells.size()];
    }
    if (votes.empty()) return fail(origin_ + ": no rows of numbers");
    raw_width_ = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second || (a.second == b.second && a.first < b.first);
                 })->first;
    std::vector<std::size_t> numbers(raw_width_), texts(raw_width_);
    for (std::size_t k = begin_; k < records_.size(); ++k) {
      const Record& r = records_[k];
      if (r.numbers == 0 || r.cells.size() != raw_width_) continue;
      layout_.numbers += r.numbers;
      layout_.width = std::max(layout_.width, r.filled);
      for (std::size_t c = 0; c < raw_width_; ++c) {
        numbers[c] += r.cells[c].notation.kind == Kind::number ? 1U : 0U;
        texts[c] += r.cells[c].notation.kind == Kind::text ? 1U : 0U;
      }
    }
    for (std::size_t c = 0; c < raw_width_; ++c) layout_.numeric.push_back(numbers[c] > 0 && numbers[c] >= texts[c]);
    return true;
  }

  [[nodiscard]] bool fits(const Record& r) const { return r.filled <= raw_width_ && r.cells.size() >= layout_.width; }

  /// Numbers where numbers belong, and no text there.
  [[nodiscard]] bool is_clean(const Record& r) const {
    if (!fits(r) || r.numbers == 0) return false;
    bool any = false;
    for (std::size_t c = 0; c < std::min(r.cells.size(), raw_width_); ++c) {
      if (!layout_.numeric[c]) continue;
      if (r.cells[c].notation.kind == Kind::text) return false;
      any = any || r.cells[c].notation.kind == Kind::number;
    }
    return any;
  }

  bool find_clean_rows() {
    first_ = begin_;
    while (first_ < records_.size() && !is_clean(records_[first_])) ++first_;
    if (first_ == records_.size()) return fail(origin_ + ": no rows of numbers");
    last_ = records_.size() - 1;
    while (!is_clean(records_[last_])) --last_;
    return true;
  }

  bool find_names() {
    const std::size_t clean = first_;
    if (clean == begin_) return true;  // no line names the columns
    std::size_t k = clean - 1;
    if (options_.skip_rows) {
      k = begin_;
    } else {
      while (k > begin_ && records_[k].numbers > 0 && records_[k].cells.size() == raw_width_) --k;
    }
    const Record& r = records_[k];
    if (!fits(r)) return wrong_width(clean, r);
    if (r.numbers > 0 && !options_.skip_rows) {
      return fail(at(r) + "the line above the numbers should name the columns but has numbers in it (" +
                  shown(r.written) + "); say with \"skip_rows\" how many lines stand before the one with the names");
    }
    layout_.names = k;
    first_ = k + 1;
    if (options_.skip_rows) {
      if (first_ < clean && is_unit_row(records_[first_])) layout_.units = first_++;
    } else if (k > begin_ && is_unit_row(r) && is_name_row(records_[k - 1])) {
      layout_.units = k;
      layout_.names = k - 1;
    }
    layout_.width = std::max(layout_.width, records_[*layout_.names].filled);
    return true;
  }

  bool wrong_width(std::size_t row, const Record& names) {
    const std::size_t cells = records_[row].cells.size();
    std::string text = at(records_[row]) + count_of(cells, "cell") + ", the header (line " +
                       std::to_string(names.line) + ") has " + std::to_string(names.cells.size());
    if (separator_ == CsvSeparator::comma && cells == 2 * names.cells.size()) {
      text +=
          "; if the decimal mark is a comma as the separator seems to be, write the numbers in quotes or separate them "
          "otherwise (\"separator\")";
    }
    text += "; if no line names the columns, say \"skip_rows\": " + std::to_string(records_[row].line - 1) +
            " and give columns by their numbers";
    return fail(text);
  }

  [[nodiscard]] bool is_name_row(const Record& r) const { return r.numbers == 0 && r.has_text() && fits(r); }

  /// At least half of its cells are units.
  [[nodiscard]] bool is_unit_row(const Record& r) const {
    if (r.numbers > 0 || !r.has_text() || !fits(r)) return false;
    std::size_t filled = 0, units = 0;
    for (const Cell& c : r.cells) {
      if (c.text.empty()) continue;
      ++filled;
      units += c.notation.kind == Kind::missing || unit_in_cell(c.text) ? 1U : 0U;
    }
    return 2 * units >= filled;
  }

  [[nodiscard]] static bool same(const Record& a, const Record& b) {
    return a.cells.size() == b.cells.size() &&
           std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(),
                      [](const Cell& x, const Cell& y) { return x.text == y.text; });
  }
  [[nodiscard]] bool repeats_head(const Record& r) const {
    return (layout_.names && same(r, records_[*layout_.names])) || (layout_.units && same(r, records_[*layout_.units]));
  }

  void take_rows() {
    for (std::size_t k = first_; k < records_.size() && layout_.problem.empty(); ++k) {
      if (options_.rows && layout_.rows.size() == *options_.rows) return;
      const Record& r = records_[k];
      if (is_row(r, k)) {
        layout_.rows.push_back(k);
      } else if (k > last_) {
        return leave_rest(k);
      } else {
        leave_between(r);
      }
    }
    if (layout_.rows.empty() && layout_.problem.empty()) fail(origin_ + ": no rows of numbers");
  }

  /// A line with numbers as wide as the others. Behind the last clean row a text in the first column of numbers begins
  /// a remark ("Maximum; 2.4"); between the rows a text in place of a number is a bad cell.
  [[nodiscard]] bool is_row(const Record& r, std::size_t k) const {
    if (r.numbers == 0 || !fits(r)) return false;
    if (k <= last_) return true;
    for (std::size_t c = 0; c < r.cells.size() && c < raw_width_; ++c) {
      if (layout_.numeric[c]) return r.cells[c].notation.kind != Kind::text;
    }
    return false;
  }

  void leave_between(const Record& r) {
    if (repeats_head(r)) {
      layout_.remarks.push_back(at(r) + "the line of column names or units again; left out");
    } else if (r.numbers > 0) {
      fail(at(r) + count_of(r.cells.size(), "cell") + ", the other rows have " + std::to_string(layout_.width));
    } else if (!r.commented && is_name_row(r) && layout_.width > 1 && r.filled == layout_.width) {
      fail(at(r) + "another line of column names below the first rows (" + shown(r.written) +
           "): two tables in one file? Say with \"skip_rows\" and \"rows\" which lines are meant");
    } else if (r.has_text()) {
      layout_.remarks.push_back(at(r) + "no numbers; left out: " + shown(r.written));
    }
  }

  /// What stands behind the rows must be text: a line of numbers there is a row that is not whole.
  void leave_rest(std::size_t from) {
    for (std::size_t k = from; k < records_.size(); ++k) {
      const Record& r = records_[k];
      if (r.numbers > 0 && !r.has_text()) {
        fail(at(r) + count_of(r.cells.size(), "cell") + ", the other rows have " + std::to_string(layout_.width) +
             "; a row that is not whole is refused: remove it, or say with \"rows\" how many to read");
        return;
      }
    }
    const Record& r = records_[from];
    const bool one = from + 1 == records_.size();
    layout_.remarks.push_back(
        at(r) + (one ? "text behind the rows; left out: " : "text behind the rows from here on; left out: ") +
        shown(r.written));
  }

  /// A column of text is one with letters or of times; one that would be numbers at another separator is none.
  void check_text_columns() {
    for (std::size_t c = 0; c < layout_.width; ++c) {
      if (c < layout_.numeric.size() && layout_.numeric[c]) continue;
      std::size_t texts = 0, several = 0;
      for (const std::size_t row : layout_.rows) {
        const Record& r = records_[row];
        if (c >= r.cells.size() || r.cells[c].notation.kind != Kind::text) continue;
        ++texts;
        several += falls_into_numbers(r.cells[c].text) ? 1U : 0U;
      }
      if (2 * several <= texts) continue;
      fail(at(records_[layout_.rows.front()]) + "the cells of column " + std::to_string(c + 1) +
           " are several numbers each; say which \"separator\" the file has");
      return;
    }
  }

  const std::vector<Record>& records_;
  CsvSeparator separator_;
  const CsvOptions& options_;
  const std::string& origin_;
  CsvLayout layout_;
  std::size_t begin_ = 0;      // first record that is not skipped
  std::size_t raw_width_ = 0;  // cells of most rows, with empty ones behind the last column
  std::size_t first_ = 0;      // first record that may be a row
  std::size_t last_ = 0;       // last clean row
};

/// Units that columns may have and that no quantity of a fit needs.
constexpr std::array<std::string_view, 20> further_units = {"s",    "sec",  "secs", "ms", "min", "h",  "Sek",
                                                            "Sek.", "sec.", "%",    "V",  "mV",  "Hz", "K",
                                                            "°C",   "µε",   "kg",   "g",  "lbf", "in"};

bool is_known_unit(std::string_view text) {
  if (std::find(further_units.begin(), further_units.end(), text) != further_units.end()) return true;
  return is_unit(text);
}

struct Bracketed {
  std::size_t begin = 0;  ///< of the opening bracket
  std::string_view inside;
};

/// "name (kN)", "name [kN]": the last bracket, at the end.
std::optional<Bracketed> bracket_at_end(std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  const char open = text.back() == ')' ? '(' : text.back() == ']' ? '[' : '\0';
  if (open == '\0') return std::nullopt;
  std::size_t depth = 0;  // of brackets: MPa.sqrt(m)
  for (std::size_t k = text.size(); k-- > 0;) {
    depth += text[k] == text.back() ? 1U : 0U;
    if (text[k] == open && --depth == 0) return Bracketed{k, text.substr(k + 1, text.size() - k - 2)};
  }
  return std::nullopt;
}

std::string_view without_end_blanks(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

CsvLayout find_layout(const Records& records, CsvSeparator separator, const CsvOptions& options,
                      const std::string& origin) {
  return LayoutFinder(records, separator, options, origin).find();
}

std::optional<std::string> unit_in_cell(std::string_view cell) {
  if (is_known_unit(cell)) return std::string(cell);
  const auto bracket = bracket_at_end(cell);
  if (bracket && bracket->begin == 0) return std::string(bracket->inside);
  return std::nullopt;
}

std::optional<std::string> unit_in_name(std::string_view name) {
  const auto bracket = bracket_at_end(name);
  if (!bracket || bracket->begin == 0 || !is_known_unit(bracket->inside)) return std::nullopt;
  return std::string(bracket->inside);
}

std::string_view without_unit(std::string_view name) {
  if (!unit_in_name(name)) return name;
  return without_end_blanks(name.substr(0, bracket_at_end(name)->begin));
}

}  // namespace fpz::io::detail
