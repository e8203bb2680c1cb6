// The "stages" array of a path file: controls, constraints, stopping conditions, repetitions.
#pragma once

#include <optional>
#include <vector>

#include "fpz/driver/path_file.hpp"
#include "fpz/io/input_reader.hpp"

namespace fpz::driver::detail {

using io::InputReader;
using io::JsonValue;
using io::Place;

/// A stage, or a list of entries that is repeated.
struct StageEntry {
  Stage stage;  ///< used when `entries` is empty
  std::vector<StageEntry> entries;
  int repeat = 1;
};

/// Stages and increments after expansion. Doubles, since nested repetitions overflow integers; exact up to 2^53.
struct StageCount {
  double stages = 0.0;
  double increments = 0.0;
};

/// The entries of the array at `place`; nothing when there is a problem in it.
[[nodiscard]] std::optional<std::vector<StageEntry>> read_stages(const InputReader& reader, const Place& place,
                                                                 Setting setting);

[[nodiscard]] StageCount count_stages(const std::vector<StageEntry>& entries);

/// Appends the stages in the order in which they are run.
void expand_stages(const std::vector<StageEntry>& entries, std::vector<Stage>& stages);

}  // namespace fpz::driver::detail
