// Numbers with units in JSON: a number in SI, or {"value": 3.9, "unit": "MPa"}.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "fpz/io/input_reader.hpp"
#include "fpz/io/plausibility.hpp"

namespace fpz::io {

/// The unit that the member "unit" of an object names, SI without it; a problem, and nothing, when there is no such
/// unit.
[[nodiscard]] std::optional<Unit> read_unit(const InputReader& reader, const Place& object, Quantity quantity);

/// A number (SI) or {"value": x, "unit": "..."}; `also` are further keys that the object may have.
[[nodiscard]] std::optional<Written> read_written(const InputReader& reader, const Place& at, Quantity quantity,
                                                  const std::vector<std::string_view>& also = {});

/// A number with its unit as one writes it in a command: "100mm", "30 GPa", "1.2MPa.sqrt(m)". Throws InputError, whose
/// text begins with `what`, when there is no such number or unit.
[[nodiscard]] Written written_in(std::string_view text, Quantity quantity, const std::string& what);

}  // namespace fpz::io
