// Collects what is wrong with input files, so that a person sees all of it at once.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fpz::io {

/// Text from a file as it may be shown in a message: quoted, control characters escaped, shortened when long.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The same without the quotes.
[[nodiscard]] std::string shown(std::string_view text);

/// Shortest text that reads back as the same number.
[[nodiscard]] std::string exact(double x);

/// The valid name that was probably meant, or an empty view when none is similar. Letter case and '-' for '_' count as
/// equal; otherwise the fewest insertions, deletions, replacements and swaps win.
[[nodiscard]] std::string_view nearest_name(std::string_view name, std::span<const std::string_view> valid);

/// `; did you mean "a"? (valid: a, b, c)`, without the question when no name is similar.
[[nodiscard]] std::string suggestion(std::string_view name, std::span<const std::string_view> valid);

/// Problems of an input file and of the files that it names.
class Problems {
 public:
  explicit Problems(std::size_t limit) : limit_(limit) {}

  /// Records a problem once, however often it is found (an inherited value is looked at by every test). `line` 0 stands
  /// for the whole file. Throws InputError when the limit is reached.
  void add(const std::string& file, std::size_t line, const std::string& text);

  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] std::size_t size() const { return list_.size(); }

  /// Throws InputError with one line per problem, ordered by file and line, if there is any.
  void throw_if_any() const;

 private:
  struct Problem {
    std::size_t file;
    std::size_t line;
    std::string text;  ///< complete: file, line, place, message
  };

  [[noreturn]] void fail() const;

  std::size_t limit_;
  std::vector<std::string> files_;
  std::vector<Problem> list_;
};

}  // namespace fpz::io
