// What a JSON file says of a table that it names: keys beside the file's name.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "fpz/io/csv.hpp"
#include "fpz/io/input_reader.hpp"

namespace fpz::io {

inline constexpr std::array<std::string_view, 5> csv_option_keys = {"separator", "decimal", "skip_rows", "rows",
                                                                    "encoding"};

/// A separator or a decimal mark from its word or the character itself; nothing where it is neither.
[[nodiscard]] std::optional<CsvSeparator> csv_separator(std::string_view text);
[[nodiscard]] std::optional<DecimalMark> csv_decimal(std::string_view text);

/// Reads those of them that the object at `place` has; what is wrong is a problem. Separators and decimal marks may be
/// words or the characters themselves.
[[nodiscard]] CsvOptions read_csv_options(const InputReader& reader, const Place& place);

}  // namespace fpz::io
