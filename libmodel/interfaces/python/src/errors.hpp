// From the library's failures and warnings to Python's.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "fpz/io/input_error.hpp"
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

/// Calls f, which reads such input; what it finds wrong is said without the line.
template <class F>
auto saying_no_line(const std::string& origin, F&& f) {
  try {
    return f();
  } catch (const io::InputError& e) {
    throw io::InputError(without_line(e.what(), origin));
  }
}

}  // namespace fpz::python
