// Repeats one update from a capture file (fpz/capture.hpp).
#pragma once

#include <filesystem>
#include <string>

#include "fpz/options.hpp"

namespace fpz::driver {

struct Replay {
  Status captured = Status::ok;  ///< what the captured update returned
  Status now = Status::ok;       ///< what the same update returns now
  std::string text;              ///< begin state, outcome with this and the other integrators, end state

  [[nodiscard]] bool ok() const { return now == Status::ok; }
};

/// Throws InputError for a file that is no capture, naming the key that is missing or wrong.
[[nodiscard]] Replay replay(const std::filesystem::path& capture);

}  // namespace fpz::driver
