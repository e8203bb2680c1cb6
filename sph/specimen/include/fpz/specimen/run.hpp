// Runs a scene into a folder: history, frames, checkpoints, summary.
#pragma once

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
  int threads = 0;           ///< 0: as the scene says
  long long most_steps = 0;  ///< stop after so many steps of this process, with a checkpoint; 0: no limit
  const volatile std::sig_atomic_t* interrupt = nullptr;  ///< not 0: stop with a checkpoint
  std::function<void(const Progress&)> progress;
};

/// What a run has written and measured so far. The part in a checkpoint, besides the state of the particles.
struct RunRecord {
  History history;
  std::vector<Frame> frames;
  std::vector<double> window;  ///< sums of the gauges since the last row
  long long window_steps = 0;
  double peak_load = 0.0;
  std::vector<unsigned char> levels_done;  ///< load levels after the peak, and deflections, that have their frame
  double stepping_seconds = 0.0;           ///< wall time of the steps, over all processes
  double wall_seconds = 0.0;
};

enum class Ending : unsigned char { finished, interrupted, failed };

struct RunResult {
  Ending ending = Ending::finished;
  std::string reason;  ///< which rule ended it, or what failed
  RunRecord record;
  std::vector<std::string> warnings;
  std::string report;  ///< the main figures, for a person
};

/// Files of a run in its folder.
struct RunFiles {
  std::filesystem::path scene, history, summary, checkpoint, frames, crack;
  explicit RunFiles(const std::filesystem::path& folder);
};

/// Throws io::OutputError (unwritable folder, not enough space, files in the way), io::InputError (scene, checkpoint).
[[nodiscard]] RunResult run_scene(const SceneFile& scene, const RunRequest& request);

/// Steps between rows, and how many steps a run takes at most.
struct Schedule {
  double time_step = 0.0;
  long long steps = 0, row_every = 1, frame_every = 0;  ///< frame_every 0: none
};
[[nodiscard]] Schedule schedule_of(const SceneFile& scene, double time_step);

/// A checkpoint: the scene it belongs to, the record and the particles' state.
struct Checkpoint {
  std::string scene_text;
  RunRecord record;
  std::vector<unsigned char> state;
};
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);
/// Throws io::InputError when the file is missing, damaged or of another version.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace fpz::specimen
