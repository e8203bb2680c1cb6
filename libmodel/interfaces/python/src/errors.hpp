// From the library's failures and warnings to Python's.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "fpz/types.hpp"

namespace fpz::python {

namespace py = pybind11;

/// Lets the library's exceptions arrive as those of fpz/_errors.py.
void register_errors();

/// Raises fpz.UpdateError.
[[noreturn]] void raise_update_error(const std::string& message, Status status,
                                     std::optional<std::size_t> index = std::nullopt);

/// Each line as an fpz.FpzWarning at the caller's line. Raises when the caller has made warnings errors.
void warn(const std::vector<std::string>& lines);

/// Input that is a Python object is one line of JSON text: "origin:1: " says nothing then, and is shortened.
[[nodiscard]] std::string without_line(std::string text, const std::string& origin);

}  // namespace fpz::python
