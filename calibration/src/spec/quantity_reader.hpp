// Numbers with units in a specification, and values judged as they are read.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/io/input_reader.hpp"
#include "fpz/io/plausibility.hpp"
#include "fpz/io/quantity_reader.hpp"
#include "fpz/words.hpp"

namespace fpz::calibration::detail {

using io::InputReader;
using io::JsonValue;
using io::Judgement;
using io::Place;
using io::Quantity;
using io::Typical;
using io::typical_parameter;
using io::Unit;
using io::Verdict;
using io::Written;
namespace typical = io::typical;

/// What reading needs everywhere.
struct Context {
  const InputReader& reader;
  std::vector<std::string>& warnings;

  void problem(const Place& at, const std::string& text) const { reader.problem(at, text); }
  void warn(const Place& at, const std::string& text) const { warnings.push_back(reader.where(at) + ' ' + text); }
  /// Impossible values are problems, doubtful ones warnings.
  void judge(const Place& at, std::string_view what, const Written& value, const Typical& typical) const;
};

/// The unit that the member "unit" of an object names, SI without it; nothing when there is no such unit.
[[nodiscard]] std::optional<Unit> read_unit(const Context& c, const Place& object, Quantity quantity);

/// A number (SI) or {"value": x, "unit": "..."}; `also` are further keys that the object may have.
[[nodiscard]] std::optional<Written> read_written(const Context& c, const Place& at, Quantity quantity,
                                                  const std::vector<std::string_view>& also = {});

/// The same, judged under the name of its key; must be positive unless the range starts below.
[[nodiscard]] std::optional<double> read_judged(const Context& c, const Place& at, const Typical& typical);

/// The member of that name in `units` (all lengths of a geometry share one), judged. Zero is not judged when
/// `zero_allowed`. Nothing when it is missing (a problem if `required`).
[[nodiscard]] std::optional<double> read_member(const Context& c, const Place& object, std::string_view key,
                                                const Unit& unit, const Typical& typical, bool required,
                                                bool zero_allowed = false);

/// One of the names; an unknown one is a problem with a suggestion. Returns its index.
[[nodiscard]] std::optional<std::size_t> read_choice(const Context& c, const Place& at, const char* what,
                                                     std::span<const std::string_view> names);

/// The value of an enumeration by its word, one of `allowed`.
template <Worded E>
[[nodiscard]] std::optional<E> read_word(const Context& c, const Place& at, const char* what,
                                         std::initializer_list<E> allowed) {
  std::vector<std::string_view> names;
  for (const E value : allowed) names.emplace_back(to_string(value));
  const std::optional<std::size_t> k = read_choice(c, at, what, names);
  if (!k) return std::nullopt;
  return allowed.begin()[*k];
}

/// The same, any of its values.
template <Worded E>
[[nodiscard]] std::optional<E> read_word(const Context& c, const Place& at, const char* what) {
  std::vector<std::string_view> names;
  for (const Word<E>& word : Words<E>::list) names.emplace_back(word.text);
  const std::optional<std::size_t> k = read_choice(c, at, what, names);
  if (!k) return std::nullopt;
  return Words<E>::list[*k].value;
}

[[nodiscard]] std::optional<bool> read_boolean(const Context& c, const Place& at);

}  // namespace fpz::calibration::detail
