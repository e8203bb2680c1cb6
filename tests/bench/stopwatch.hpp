// The clock of the benchmarks.
#pragma once

#include <chrono>

namespace fpz::bench {

/// s, from some moment on.
inline double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace fpz::bench
