// Runs a scene into a folder: history, frames, checkpoints, summary.
#pragma once

#include <cmath>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fpz/specimen/history.hpp"
#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen {

struct Progress {
  double fraction = 0.0;  ///< 0 to 1, of the time or of the deflection at which the run stops, whichever is further
  double seconds = 0.0;   ///< wall time since the start of this process
  double time = 0.0;      ///< s, of the run
  double load = 0.0;      ///< N
  std::size_t damaged = 0;
  double steps_per_second = 0.0;
};

struct RunRequest {
  std::filesystem::path folder;
  bool force = false;
  bool resume = false;
  bool keep_checkpoint = false;  ///< also when the run has finished: it can go on to a later end
  int threads = 0;               ///< 0: as the scene says
  long long most_steps = 0;      ///< stop after so many steps of this process, with a checkpoint; 0: no limit
  const volatile std::sig_atomic_t* interrupt = nullptr;  ///< not 0: stop with a checkpoint
  std::function<void(const Progress&)> progress;
  std::function<void(const std::vector<std::string>&)> warn;  ///< told before the first step what is doubtful
};

enum class Ending : unsigned char { finished, interrupted, failed };

/// Wall times over all processes of a run, s.
struct WallTimes {
  double stepping = 0.0;  ///< spent in steps
  double all = 0.0;
};

/// A stage that is over.
struct EndedStage {
  std::string name;
  std::string reason;             ///< which rule ended it
  double begin = 0.0, end = 0.0;  ///< s
  double kinetic_ratio = 0.0;     ///< kinetic over elastic energy at its end; NaN where nothing is strained
};

/// One of the runs of a solver that repeats them (Solver::Kind::converged).
struct ConvergenceRun {
  double pace = 0.0;
  long long steps = 0;
  double seconds = 0.0;  ///< of wall time
  bool failed = false;
  double peak_load = 0.0;                ///< N
  double change_of_peak = std::nan("");  ///< from the run before, relative; NaN where there is none
  double change_of_work = std::nan("");  ///< the same of the area under load over deflection, as far as both go
};

struct RunResult {
  Ending ending = Ending::finished;
  std::string reason;  ///< which rule ended it, or what failed
  History history;
  std::vector<Frame> frames;
  WallTimes seconds;
  std::vector<EndedStage> stages;
  std::vector<ConvergenceRun> convergence;  ///< empty: the solver does not repeat runs
  std::string solver_report;                ///< what the solver found, in words; may be empty
  std::vector<std::string> warnings;
  std::string report;  ///< the main figures, for a person
};

/// Files of a run in its folder.
struct RunFiles {
  std::filesystem::path scene, history, summary, checkpoint, crack;
  std::filesystem::path frames;      ///< a folder
  std::filesystem::path collection;  ///< names and times of the frames
  explicit RunFiles(const std::filesystem::path& folder);
};

/// Throws io::OutputError (unwritable folder, not enough space, files in the way), io::InputError (scene, checkpoint).
[[nodiscard]] RunResult run_scene(const Scene& scene, const RunRequest& request);

/// Steps between rows, and how many steps a run takes at most.
struct Schedule {
  double time_step = 0.0;
  long long steps = 0, row_every = 1, frame_every = 0;  ///< frame_every 0: none
};
[[nodiscard]] Schedule schedule_of(const Scene& scene, double time_step);
/// What a time step (s) far below that of eq 32 means; empty when it is not.
[[nodiscard]] std::string warning_of_time_step(const sph::RunSetup<2>& setup, double time_step);
/// Steps after which a time (s) is over.
[[nodiscard]] long long steps_within(double time, double time_step);

}  // namespace fpz::specimen

namespace fpz {

template <>
struct Words<specimen::Ending> {
  static constexpr Word<specimen::Ending> list[] = {{specimen::Ending::finished, "finished"},
                                                    {specimen::Ending::interrupted, "interrupted"},
                                                    {specimen::Ending::failed, "failed"}};
};

}  // namespace fpz
