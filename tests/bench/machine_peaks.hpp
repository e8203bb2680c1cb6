// What a machine can do at most, to compare loops with.
#pragma once

#include <cstddef>

namespace fpz::bench {

/// Bytes per second that one thread reads and writes in a = b + s c over arrays of `bytes` in all; best of several
/// rounds.
[[nodiscard]] double bandwidth(std::size_t bytes);

/// Multiplications and additions per second, not fused, in registers as wide as the processor has.
[[nodiscard]] double arithmetic();

}  // namespace fpz::bench
