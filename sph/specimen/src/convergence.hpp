// A slow test run again and again, each time half as fast, until its results stay as they are (solver.hpp).
#pragma once

#include <functional>

#include "fpz/specimen/run.hpp"

namespace fpz::specimen::detail {

/// Runs it once at the pace of its solver; `judge` is told the result before it is summed up.
using RunOnce = std::function<RunResult(const Scene&, const RunRequest&, const std::function<void(RunResult&)>& judge)>;

[[nodiscard]] RunResult run_to_convergence(const Scene& scene, const RunRequest& request, const RunOnce& run_once);

/// What is known of the runs: a row each, and the history of run n (from 0 on).
[[nodiscard]] std::filesystem::path convergence_table(const std::filesystem::path& folder);
[[nodiscard]] std::filesystem::path history_of_run(const std::filesystem::path& folder, std::size_t n);

/// Removes them, of an earlier run in the folder.
void forget_runs(const std::filesystem::path& folder);

}  // namespace fpz::specimen::detail
