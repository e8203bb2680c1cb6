// Numbers in the notations of several countries: decimal point or comma, digits in groups of three.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "fpz/words.hpp"

namespace fpz::io {

enum class DecimalMark : std::uint8_t { point, comma };

/// What a cell of a table is, and what it says about the notation of its numbers.
struct CellNotation {
  enum class Kind : std::uint8_t { missing, number, text };

  Kind kind = Kind::text;
  std::optional<DecimalMark> proves;     ///< the decimal mark, where only one reading is possible
  std::optional<DecimalMark> ambiguous;  ///< 1,234 or 1.234: the mark in it may be the decimal one or part groups
  bool grouped = false;                  ///< surely has a point or a comma between groups of digits
};

/// Missing: empty, "-", "n/a" and the like. A number may have a sign, an exponent (e, E, d, D), a decimal mark, and
/// digits in groups of three set off by points, commas, apostrophes or, if `spaces_group`, spaces.
[[nodiscard]] CellNotation notation_of(std::string_view cell, bool spaces_group);

/// The number in a cell (NaN and infinities as well) when its decimal mark is that; nothing where it is none.
[[nodiscard]] std::optional<double> to_number(std::string_view cell, DecimalMark decimal, bool spaces_group);

}  // namespace fpz::io

template <>
struct fpz::Words<fpz::io::DecimalMark> {
  using K = io::DecimalMark;
  static constexpr Word<K> list[] = {{K::point, "point"}, {K::comma, "comma"}};
};
