// The folder of a run: what an earlier one has left there, and whether there is space.
#pragma once

#include "fpz/specimen/run.hpp"

namespace fpz::specimen::detail {

/// Removes what an earlier run left: its extra frames must not be taken for new ones.
void clear_earlier_run(const RunFiles& files);

/// Removes temporary files of a process that was killed while it wrote one.
void remove_leftovers(const std::filesystem::path& folder, const RunFiles& files);

/// Throws io::OutputError when the disk has less than `bytes` left.
void require_space(const std::filesystem::path& folder, double bytes);

}  // namespace fpz::specimen::detail
