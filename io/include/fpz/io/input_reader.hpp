// Reads JSON values of an expected type and range; what does not fit becomes a problem at its place.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "fpz/io/json_locator.hpp"
#include "fpz/io/problems.hpp"

namespace fpz::io {

/// ASCII letters in lower case: names that differ in case only are one folder on some systems.
[[nodiscard]] std::string lower_case(std::string text);

class InputReader {
 public:
  InputReader(std::string file, const ReadLimits& limits, Problems& problems)
      : file_(std::move(file)), limits_(limits), problems_(problems) {}

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const ReadLimits& limits() const { return limits_; }
  [[nodiscard]] Problems& problems() const { return problems_; }

  void problem(const Place& place, const std::string& text) const;

  /// `file:line: path`, for messages that are no problems.
  [[nodiscard]] std::string where(const Place& place) const;

  /// True for a non-empty object.
  [[nodiscard]] bool object(const Place& place, const char* content) const;
  /// True for a non-empty array.
  [[nodiscard]] bool array(const Place& place, const char* content) const;

  /// Refuses members of an object whose names are neither in `valid` nor accepted by `also`.
  void known_keys(const Place& object, std::span<const std::string_view> valid,
                  const std::function<bool(const JsonValue&)>& also = {}) const;

  /// The member of that name; its absence is a problem.
  [[nodiscard]] const JsonValue* required(const Place& object, std::string_view key) const;

  [[nodiscard]] std::optional<double> number(const Place& place) const;
  /// A number with lower < x < upper, or <= where the limits are included.
  [[nodiscard]] std::optional<double> number_between(const Place& place, double lower, double upper,
                                                     bool included = false) const;
  [[nodiscard]] std::optional<double> positive(const Place& place) const;
  [[nodiscard]] std::optional<int> integer(const Place& place, int lower, int upper) const;
  /// A string of at most `longest` bytes that is not empty.
  [[nodiscard]] std::optional<std::string> text(const Place& place, std::size_t longest) const;

 private:
  std::string file_;
  const ReadLimits& limits_;
  Problems& problems_;
};

}  // namespace fpz::io
