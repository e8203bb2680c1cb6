// The entry point that the fuzzer and the ordinary test share.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fpz::driver {

/// Reads bytes as a path file. Only InputError, which must have a message, is a proper way to refuse them; any other
/// exception escapes.
void read_as_path_file(const std::uint8_t* data, std::size_t size);

}  // namespace fpz::driver
