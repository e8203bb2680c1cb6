// How many threads work is given to.
#pragma once

#include <cstddef>

namespace fpz {

/// `requested` where it is positive; otherwise all that OpenMP offers, which is one without OpenMP.
[[nodiscard]] int thread_count(int requested);

/// Points of a batch that a thread takes at once. Cracked points cost twenty times an elastic one and come in clusters:
/// small pieces share them out.
inline constexpr std::ptrdiff_t points_at_once = 256;

}  // namespace fpz
