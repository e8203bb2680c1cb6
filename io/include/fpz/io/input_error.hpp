// What reading of a person's input can end with, and what a file may ask for at most.
#pragma once

#include <cstddef>
#include <stdexcept>

namespace fpz::io {

/// Bad input: what() has one line per problem, which names the file, the place in it (line and key path), the value,
/// and the constraint or nearest valid name.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Limits of a file, so that a slip (or malice) ends in a message and not in exhausted memory.
struct ReadLimits {
  std::size_t bytes = std::size_t{64} << 20;
  std::size_t depth = 64;          ///< nesting of objects and arrays
  std::size_t values = 2'000'000;  ///< JSON values
  std::size_t problems = 100;      ///< reading stops when so many problems were found
};

}  // namespace fpz::io
