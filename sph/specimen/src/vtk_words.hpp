// Words and numbers of a text, one after the other.
#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace fpz::specimen::detail {

class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  std::string_view next() {
    const auto begin = text_.find_first_not_of(blanks, at_);
    if (begin == std::string_view::npos) return at_ = text_.size(), std::string_view();
    const auto end = std::min(text_.find_first_of(blanks, begin), text_.size());
    at_ = end;
    return text_.substr(begin, end - begin);
  }
  std::optional<double> number() {
    const std::string_view w = next();
    double x = 0.0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), x);
    if (w.empty() || error != std::errc() || end != w.data() + w.size()) return std::nullopt;
    return x;
  }
  /// To the end of the line; its text.
  std::string_view line() {
    const auto begin = at_;
    const auto end = std::min(text_.find('\n', at_), text_.size());
    at_ = std::min(end + 1, text_.size());
    return text_.substr(begin, end - begin);
  }
  /// The next bytes as they are; fewer when the text ends.
  std::string_view bytes(std::size_t count) {
    const std::string_view all = text_.substr(at_, count);
    at_ += all.size();
    return all;
  }

 private:
  static constexpr const char* blanks = " \t\r\n";
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace fpz::specimen::detail
