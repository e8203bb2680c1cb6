#include "fpz/io/problems.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "fpz/io/input_error.hpp"

namespace fpz::io {
namespace {

constexpr std::size_t max_shown = 80;

char folded(char c) {
  if (c == '-') return '_';
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string folded(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = folded(c);
  return result;
}

/// Optimal string alignment distances (insertions, deletions, replacements, swaps of neighbours) of `a` to the first
/// j characters of `b`, for all j.
std::vector<std::size_t> distances(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last;
}

bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

void append_escaped(std::string& out, char c) {
  constexpr std::string_view hex = "0123456789abcdef";
  const auto u = static_cast<unsigned char>(c);
  if (!is_control(u)) {
    out += c;
  } else {
    out += "\\x";
    out += hex[u >> 4];
    out += hex[u & 15];
  }
}

}  // namespace

std::string shown(std::string_view text) {
  std::size_t n = text.size();
  if (n > max_shown) {
    n = max_shown;
    while (n > 0 && (static_cast<unsigned char>(text[n]) & 0xc0) == 0x80) --n;  // do not cut a UTF-8 character
  }
  std::string out;
  for (const char c : text.substr(0, n)) append_escaped(out, c);
  if (n < text.size()) out += "...";
  return out;
}

std::string in_quotes(std::string_view text) { return '"' + shown(text) + '"'; }

std::string exact(double x) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), x);
  return {text.data(), result.ptr};
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> valid) {
  if (name.empty() || name.size() > max_shown) return {};
  const std::string given = folded(name);
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(1, (given.size() + 1) / 3) + 1;
  for (const std::string_view candidate : valid) {
    const std::string other = folded(candidate);
    const std::vector<std::size_t> to_prefixes = distances(given, other);
    std::size_t d = to_prefixes.back();
    // An abbreviation or an appended unit ("young", "delta0_mm") is closer than its length says.
    if (given.size() >= 3) d = std::min(d, 1 + *std::min_element(to_prefixes.begin(), to_prefixes.end()));
    if (other.size() >= 3 && given.starts_with(other)) d = std::min<std::size_t>(d, 1);
    if (std::is_permutation(given.begin(), given.end(), other.begin(), other.end())) d = 0;  // "yx" means "xy"
    if (d < best_distance) {
      best_distance = d;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view name, std::span<const std::string_view> valid) {
  std::string text;
  const std::string_view nearest = nearest_name(name, valid);
  if (!nearest.empty()) text += "; did you mean \"" + std::string(nearest) + "\"?";
  text += " (valid: ";
  for (std::size_t k = 0; k < valid.size(); ++k) {
    if (k > 0) text += ", ";
    text += valid[k];
  }
  return text + ')';
}

void Problems::add(const std::string& file, std::size_t line, const std::string& text) {
  auto known = std::find(files_.begin(), files_.end(), file);
  if (known == files_.end()) known = files_.insert(known, file);
  Problem p{static_cast<std::size_t>(known - files_.begin()), line, file + ':'};
  if (line > 0) p.text += std::to_string(line) + ':';
  p.text += ' ' + text;
  for (const Problem& other : list_) {
    if (other.text == p.text) return;
  }
  list_.push_back(std::move(p));
  if (list_.size() >= limit_) fail();
}

void Problems::throw_if_any() const {
  if (!list_.empty()) fail();
}

void Problems::fail() const {
  std::vector<Problem> sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) {
    return a.file != b.file ? a.file < b.file : a.line < b.line;
  });
  std::string text;
  for (const Problem& p : sorted) {
    if (!text.empty()) text += '\n';
    text += p.text;
  }
  if (list_.size() >= limit_) text += "\nreading stopped after " + std::to_string(list_.size()) + " problems";
  throw InputError(text);
}

}  // namespace fpz::io
