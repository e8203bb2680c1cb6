#include "fpz/io/decimal_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>

namespace fpz::io {
namespace {

constexpr std::array<std::string_view, 12> missing_words = {"",     "-",    "--",  "---", "n/a",  "N/A",
                                                            "n.a.", "#N/A", "#NV", "NA",  "NULL", "null"};
/// Signs and blanks of Unicode that programs put in numbers, and what they mean.
constexpr std::array<std::pair<std::string_view, char>, 5> unicode_signs = {
    {{"\xE2\x88\x92", '-'}, {"\xC2\xA0", ' '}, {"\xE2\x80\xAF", ' '}, {"\xE2\x80\x89", ' '}, {"\xE2\x80\x99", '\''}}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool all_digits(std::string_view s) { return !s.empty() && std::all_of(s.begin(), s.end(), is_digit); }

/// A number's text in plain signs, cut into its parts.
struct Parts {
  bool negative = false;
  std::string body;      ///< digits, marks and groups
  std::string exponent;  ///< with its sign; empty without one
};

std::string plain_signs(std::string_view cell) {
  std::string text;
  for (std::size_t k = 0; k < cell.size();) {
    const auto found = std::find_if(unicode_signs.begin(), unicode_signs.end(),
                                    [&](const auto& s) { return cell.substr(k).starts_with(s.first); });
    text += found != unicode_signs.end() ? found->second : cell[k];
    k += found != unicode_signs.end() ? found->first.size() : 1;
  }
  return text;
}

std::optional<Parts> parts_of(std::string_view cell) {
  std::string text = plain_signs(cell);
  Parts p;
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) {
    p.negative = text.front() == '-';
    text.erase(0, 1);
  }
  const std::size_t e = text.find_first_of("eEdD");
  p.body = text.substr(0, e);
  if (e != std::string::npos) {
    p.exponent = text.substr(e + 1);
    const bool sign = !p.exponent.empty() && (p.exponent.front() == '+' || p.exponent.front() == '-');
    if (!all_digits(std::string_view(p.exponent).substr(sign ? 1 : 0))) return std::nullopt;
  }
  if (p.body.empty() || !std::any_of(p.body.begin(), p.body.end(), is_digit)) return std::nullopt;
  if (p.body.find_first_not_of("0123456789.,' ") != std::string::npos) return std::nullopt;
  return p;
}

/// Digits in groups set off by `mark`: one to three that do not begin with 0, then three each.
bool well_grouped(std::string_view digits, char mark) {
  const std::size_t first = digits.find(mark);
  if (first == std::string_view::npos || first == 0 || first > 3 || digits.front() == '0') return false;
  for (std::string_view rest = digits.substr(first); !rest.empty(); rest.remove_prefix(4)) {
    if (rest.front() != mark || rest.size() < 4 || !all_digits(rest.substr(1, 3))) return false;
  }
  return all_digits(digits.substr(0, first));
}

/// Takes groups that apostrophes or spaces set off together; false when they are no groups.
bool take_groups(std::string& body, bool spaces_group, bool& taken) {
  const std::size_t end = std::min(body.find_first_of(".,"), body.size());
  const std::size_t at = body.find_first_of("' ");
  taken = at != std::string::npos;
  if (!taken) return true;
  const char mark = body[at];
  if (mark == ' ' && !spaces_group) return false;
  if (at >= end || !well_grouped(std::string_view(body).substr(0, end), mark)) return false;
  std::erase(body, mark);
  return body.find_first_of("' ") == std::string::npos;
}

/// Readings of digits with points and commas: each is the plain number ("1234.5"), or empty when impossible.
std::string reading(std::string_view body, DecimalMark decimal) {
  const char point = decimal == DecimalMark::point ? '.' : ',';
  const char group = decimal == DecimalMark::point ? ',' : '.';
  const std::size_t at = body.find(point);
  std::string whole(body.substr(0, at));
  const std::string_view fraction = at == std::string_view::npos ? std::string_view() : body.substr(at + 1);
  if (!fraction.empty() && !all_digits(fraction)) return {};
  if (whole.find(group) != std::string::npos) {
    if (!well_grouped(whole, group)) return {};
    std::erase(whole, group);
  }
  if (whole.empty() && fraction.empty()) return {};
  std::string text = std::move(whole);
  if (text.empty()) text += '0';
  if (!fraction.empty()) text.append(".").append(fraction);
  return text;
}

/// NaN and infinities, as programs print them.
std::optional<double> special(std::string_view cell) {
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  if (cell.find_first_of("nN") == std::string_view::npos) return std::nullopt;
  double x = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return x;
}

/// A number with a decimal point as programs print it: whether its point can only be the decimal one. Nothing for
/// other text.
std::optional<bool> plain_number(std::string_view cell) {
  double x = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  const std::size_t point = cell.find('.');
  if (point == std::string_view::npos) return false;
  const std::size_t digits = cell.find_first_not_of("0123456789", point + 1);
  const std::size_t behind = std::min(digits, cell.size()) - point - 1;
  const bool could_group = behind == 3 && point <= 4 && digits == std::string_view::npos;
  if (could_group) return std::nullopt;
  return true;
}

}  // namespace

CellNotation notation_of(std::string_view cell, bool spaces_group) {
  using Kind = CellNotation::Kind;
  CellNotation n;
  if (std::find(missing_words.begin(), missing_words.end(), cell) != missing_words.end()) {
    n.kind = Kind::missing;
    return n;
  }
  if (const std::optional<bool> point = plain_number(cell)) {
    n.kind = Kind::number;
    if (*point) n.proves = DecimalMark::point;
    return n;
  }
  if (special(cell)) {
    n.kind = Kind::number;
    return n;
  }
  std::optional<Parts> p = parts_of(cell);
  bool groups_taken = false;
  if (!p || !take_groups(p->body, spaces_group, groups_taken)) return n;
  const bool as_point = !reading(p->body, DecimalMark::point).empty();
  const bool as_comma = !reading(p->body, DecimalMark::comma).empty();
  if (!as_point && !as_comma) return n;
  n.kind = Kind::number;
  const std::size_t mark = p->body.find_last_of(".,");
  if (mark == std::string::npos) return n;
  const DecimalMark own = p->body[mark] == '.' ? DecimalMark::point : DecimalMark::comma;
  // Both readings are possible for one mark with three digits behind it; other groups or an exponent exclude one.
  if (as_point && as_comma && !groups_taken && p->exponent.empty()) {
    n.ambiguous = own;
    return n;
  }
  if (as_point && as_comma) {
    n.proves = own;
  } else {
    n.proves = as_point ? DecimalMark::point : DecimalMark::comma;
    n.grouped = p->body.find(as_point ? ',' : '.') != std::string::npos;
  }
  return n;
}

std::optional<double> to_number(std::string_view cell, DecimalMark decimal, bool spaces_group) {
  double plain = 0.0;
  const auto [stop, wrong] = std::from_chars(cell.data(), cell.data() + cell.size(), plain);
  const bool has_point = cell.find('.') != std::string_view::npos;
  if (wrong == std::errc() && stop == cell.data() + cell.size() && (decimal == DecimalMark::point || !has_point)) {
    return plain;
  }
  if (const auto x = special(cell)) return x;
  std::optional<Parts> p = parts_of(cell);
  bool groups_taken = false;
  if (!p || !take_groups(p->body, spaces_group, groups_taken)) return std::nullopt;
  const std::string digits = reading(p->body, decimal);
  if (digits.empty()) return std::nullopt;
  std::string text;
  if (p->negative) text += '-';
  text += digits;
  if (!p->exponent.empty()) text.append("e").append(p->exponent);
  double x = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return x;
}

}  // namespace fpz::io
