#include "csv_records.hpp"

#include <algorithm>
#include <optional>

namespace fpz::io::detail {
namespace {

constexpr std::size_t most_lines_of_a_cell = 20;

bool is_break(char c) { return c == '\n' || c == '\r'; }

/// Place behind the line break at `at`: \n, \r\n or \r.
std::size_t behind_break(std::string_view text, std::size_t at) {
  return at + (text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\n' ? 2 : 1);
}

class Cutter {
 public:
  Cutter(std::string_view text, CsvSeparator separator)
      : text_(text), separator_(character_of(separator)), spaces_group_(spaces_group(separator)) {}

  Records cut() {
    while (at_ < text_.size()) read_record();
    return std::move(records_);
  }

 private:
  [[nodiscard]] bool is_blank(char c) const {
    return c == ' ' || c == '\f' || c == '\v' || (c == '\t' && separator_ != '\t');
  }
  [[nodiscard]] bool at_end_of_line() const { return at_ >= text_.size() || is_break(text_[at_]); }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  void read_record() {
    Record r;
    r.line = line_;
    const std::size_t begin = at_;
    r.written = text_.substr(begin, text_.find_first_of("\r\n", begin) - begin);
    skip_blanks();
    while (!at_end_of_line()) {
      add_cell(r, read_cell());
      if (at_end_of_line()) break;
      if (separator_ == ' ') continue;
      ++at_;  // the separator
      if (at_end_of_line()) add_cell(r, {});
    }
    if (at_ < text_.size()) at_ = behind_break(text_, at_);
    ++line_;
    if (r.filled == 0) return;
    take_comment_sign(r);
    records_.list.push_back(std::move(r));
  }

  /// A line that begins with # may name the columns but has no numbers.
  static void take_comment_sign(Record& r) {
    std::string_view& first = r.cells.front().text;
    if (!first.starts_with('#') || r.cells.front().notation.kind != CellNotation::Kind::text) return;
    r.commented = true;
    r.numbers = 0;
    first.remove_prefix(std::min(first.find_first_not_of("# "), first.size()));
    if (first.empty() && r.cells.size() > 1) {
      r.cells.erase(r.cells.begin());
      --r.filled;
    }
    for (Cell& c : r.cells) c.notation.kind = CellNotation::Kind::text;
  }

  void add_cell(Record& r, std::string_view text) const {
    r.cells.push_back({text, notation_of(text, spaces_group_)});
    if (!text.empty()) r.filled = r.cells.size();
    if (r.cells.back().notation.kind == CellNotation::Kind::number) ++r.numbers;
  }

  /// Leaves the place at the separator or the end of the line, and behind blanks where those separate.
  std::string_view read_cell() {
    skip_blanks();
    if (!at_end_of_line() && text_[at_] == '"') {
      if (const auto quoted = read_quoted()) return *quoted;
    }
    const std::size_t begin = at_;
    while (!at_end_of_line() && text_[at_] != separator_ && !(separator_ == ' ' && is_blank(text_[at_]))) ++at_;
    std::size_t end = at_;
    while (end > begin && is_blank(text_[end - 1])) --end;
    skip_blanks();
    return text_.substr(begin, end - begin);
  }

  /// Nothing, and the place unchanged, when the quote does not enclose a cell.
  std::optional<std::string_view> read_quoted() {
    const std::size_t begin = at_ + 1;
    std::size_t lines = 0;
    bool doubled = false;
    std::size_t end = begin;
    for (; end < text_.size(); ++end) {
      if (is_break(text_[end])) {
        if (++lines > most_lines_of_a_cell) return std::nullopt;
        end = behind_break(text_, end) - 1;
      }
      if (text_[end] != '"') continue;
      if (end + 1 >= text_.size() || text_[end + 1] != '"') break;
      doubled = true;
      ++end;
    }
    if (end >= text_.size()) return std::nullopt;
    std::size_t next = end + 1;
    const bool blank_follows = next < text_.size() && is_blank(text_[next]);
    while (next < text_.size() && is_blank(text_[next])) ++next;
    const bool ends = next >= text_.size() || is_break(text_[next]) || text_[next] == separator_ ||
                      (separator_ == ' ' && blank_follows);
    if (!ends) return std::nullopt;
    at_ = next;
    line_ += lines;
    std::string_view inside = text_.substr(begin, end - begin);
    const auto blank = [](char c) { return c == ' ' || c == '\t' || is_break(c); };
    while (!inside.empty() && blank(inside.front())) inside.remove_prefix(1);
    while (!inside.empty() && blank(inside.back())) inside.remove_suffix(1);
    if (!doubled && lines == 0) return inside;
    return records_.unquoted.emplace_back(without_doubled_quotes(inside));
  }

  /// Line breaks become blanks.
  static std::string without_doubled_quotes(std::string_view inside) {
    std::string plain;
    for (std::size_t k = 0; k < inside.size(); ++k) {
      if (is_break(inside[k])) {
        k = behind_break(inside, k) - 1;
        plain += ' ';
        continue;
      }
      plain += inside[k];
      if (inside[k] == '"' && k + 1 < inside.size() && inside[k + 1] == '"') ++k;
    }
    return plain;
  }

  std::string_view text_;
  char separator_;
  bool spaces_group_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  Records records_;
};

}  // namespace

bool Record::has_text() const {
  return std::any_of(cells.begin(), cells.end(),
                     [](const Cell& c) { return c.notation.kind == CellNotation::Kind::text; });
}

char character_of(CsvSeparator separator) {
  switch (separator) {
    case CsvSeparator::comma:
      return ',';
    case CsvSeparator::semicolon:
      return ';';
    case CsvSeparator::tab:
      return '\t';
    case CsvSeparator::bar:
      return '|';
    case CsvSeparator::space:
      break;
  }
  return ' ';
}

bool spaces_group(CsvSeparator separator) {
  return separator != CsvSeparator::space && separator != CsvSeparator::comma;
}

Records cut_into_records(std::string_view text, CsvSeparator separator) { return Cutter(text, separator).cut(); }

}  // namespace fpz::io::detail
