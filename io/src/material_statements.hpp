// What a material file states: read, checked against each other, and turned into parameters.
#pragma once

#include <string_view>

#include "fpz/io/material_file.hpp"

namespace fpz::io::detail {

/// Is it the key of a quantity that a material file may state?
[[nodiscard]] bool is_statement(std::string_view key);

/// Adds the quantities that the object at `place` states; false when one has a problem.
[[nodiscard]] bool read_statements(const InputReader& reader, const Place& place, MaterialFile& material);

/// Is there enough to determine every parameter? What is missing is a problem.
[[nodiscard]] bool require_statements(const InputReader& reader, const Place& place);

/// Adds statements to those of `whole` and takes away what determines the same parameters.
void replace_statements(const MaterialFile& given, MaterialFile& whole);

/// Fills in parameters, locations and conversions from the statements, of which there must be enough. What is stated
/// twice, and what no parameters can have, are problems.
void resolve(MaterialFile& material, Problems& problems);

}  // namespace fpz::io::detail
