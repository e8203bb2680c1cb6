// A sweep: one scene run many times with entries changed (docs/scenes.md, "Sweeps").
#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fpz/specimen/pictures.hpp"
#include "fpz/specimen/scene.hpp"

namespace fpz::specimen {

struct SweepRun {
  std::size_t series = 0;        ///< index of the series
  std::string label;             ///< of the parameter's value
  double value = 0.0;            ///< of the parameter; NaN where it is no number
  std::filesystem::path folder;  ///< relative to the output folder: <series>/<label>
  Scene scene;
};

/// Points or a line from a table, drawn with the results in the pictures of the same columns.
struct SweepReference {
  std::string name;
  std::string x, y;  ///< columns of sweep.csv
  bool points = false;
  std::vector<std::pair<double, double>> values;
};

struct SweepPicture {
  enum class Kind : unsigned char {
    columns,  ///< a column of sweep.csv over another one
    curves,   ///< load over deflection, one picture per series
    maps      ///< damage at the end of every run, one picture per series
  };
  Kind kind = Kind::columns;
  std::string x = "value", y;
};

struct Sweep {
  std::string name;
  std::string parameter, unit;      ///< of the quantity that varies
  std::vector<std::string> series;  ///< names
  std::vector<SweepRun> runs;       ///< series after series
  std::vector<SweepReference> references;
  std::vector<SweepPicture> pictures;
};

/// Reads a sweep and all its scenes, and places their particles. `common` is applied to every scene after the sweep's
/// own "set", before what distinguishes the runs. Throws io::InputError with all problems.
[[nodiscard]] Sweep read_sweep(const std::filesystem::path& file, const Overrides& common = {});

enum class RunStatus : unsigned char { waiting, running, finished, failed, interrupted };

/// A row of sweep.csv.
struct SweepRow {
  RunStatus status = RunStatus::waiting;
  bool kept = false;            ///< finished or failed earlier with the same scene, not repeated
  std::string reason;           ///< why it failed, or why its pictures are missing
  std::vector<double> figures;  ///< in the order of figure_names(); NaN what is not known
};

/// The columns of sweep.csv that are numbers, from "value" on.
[[nodiscard]] const std::vector<std::string>& figure_names();

struct SweepProgress {
  std::size_t all = 0, done = 0, running = 0;
  double seconds = 0.0;    ///< since the start
  double remaining = 0.0;  ///< s, if the runs to come take as long as those before; NaN at the start
};

struct SweepRequest {
  std::filesystem::path folder;
  int jobs = 0;        ///< runs at the same time; 0: one per core
  bool force = false;  ///< replace runs of other scenes, repeat failed ones
  bool pictures = true;
  const volatile std::sig_atomic_t* interrupt = nullptr;  ///< not 0: end all runs with checkpoints
  std::function<void(const SweepProgress&)> progress;
};

struct SweepResult {
  std::vector<SweepRow> rows;  ///< in the order of Sweep::runs
  PictureOutcome pictures;
  [[nodiscard]] std::size_t count(RunStatus status) const;
};

/// Runs what has not been run yet, each run in a process of its own with one thread, and writes sweep.csv and the
/// pictures. Runs with a checkpoint go on from it. Throws io::OutputError: unwritable folder, runs of another scene in
/// the way.
[[nodiscard]] SweepResult run_sweep(const Sweep& sweep, const SweepRequest& request);

/// The pictures of a sweep from the folders of its runs. Those of runs that have not finished are left out.
[[nodiscard]] PictureOutcome draw_sweep(const Sweep& sweep, const std::vector<SweepRow>& rows,
                                        const std::filesystem::path& folder);

}  // namespace fpz::specimen

namespace fpz {

template <>
struct Words<specimen::RunStatus> {
  static constexpr Word<specimen::RunStatus> list[] = {{specimen::RunStatus::waiting, "waiting"},
                                                       {specimen::RunStatus::running, "running"},
                                                       {specimen::RunStatus::finished, "finished"},
                                                       {specimen::RunStatus::failed, "failed"},
                                                       {specimen::RunStatus::interrupted, "interrupted"}};
};

}  // namespace fpz
