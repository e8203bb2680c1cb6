// Runs the tests of a path file: mixed strain-stress control of one material point.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fpz/driver/history.hpp"
#include "fpz/driver/path_file.hpp"

namespace fpz::driver {

/// Where a run is; given to the observer after every row.
struct Progress {
  int stage = 0;
  int stages = 0;
  double time = 0.0;  ///< counts stages
  double damage = 0.0;
};
using Observer = std::function<void(const Progress&)>;

/// Largest or smallest value of a stress component and when it was met.
struct Peak {
  double value = 0.0;  ///< Pa, or J/m^3
  double time = 0.0;
};

/// The point of the path at which the fracture appeared.
struct Onset {
  double time = 0.0;
  std::array<double, 6> strain{};
  std::array<double, 6> stress{};  ///< Pa
  std::array<double, 3> normal{};
  double angle_deg = 0.0;  ///< of the normal from x: signed about z, in (-90, 90], in 2-D; 0 to 90 in 3-D
};

struct Counts {
  long updates = 0;     ///< calls of the constitutive update, rejected ones included
  long iterations = 0;  ///< of the integrator
  long substeps = 0;    ///< of the integrator
  long halvings = 0;    ///< increments or parts of them that had to be halved
};

struct Summary {
  std::array<Peak, 6> highest{};
  std::array<Peak, 6> lowest{};
  std::optional<Onset> onset;
  double damage = 0.0;
  double stored = 0.0;                        ///< J/m^3
  Peak least_stored;                          ///< the smallest of all rows, J/m^3, and its time
  double dissipated = 0.0;                    ///< J/m^3
  double work = 0.0;                          ///< J/m^3
  double energy_balance = 0.0;                ///< (work - stored - dissipated) over the largest of them
  double fracture_work_per_area = 0.0;        ///< int t.du from onset, J/m^2
  double fracture_dissipated_per_area = 0.0;  ///< J/m^2
  Counts counts;
  double wall_seconds = 0.0;
};

/// What became of a test. After a failure the history ends with the last good state and `message` says what happened.
/// A stored energy below zero by more than a hundredth of G per crack area is an error of the model: the history is
/// complete then, but it has energy that nobody put in.
struct Result {
  History history;
  Summary summary;
  std::string status = "ok";  ///< "ok", the name of a Status, "load_limit" or "negative_energy"
  std::string message;
  std::vector<std::string> warnings;  ///< doubtful about the path, found while it ran

  [[nodiscard]] bool ok() const { return status == "ok"; }
};

/// Runs a test from the unstrained state. Throws InputError for a stage whose controls do not determine the strains.
[[nodiscard]] Result run_test(const Test& test, const Observer& observer = {});

/// Text of summary.json.
[[nodiscard]] std::string to_json(const Test& test, const Result& result);

/// Writes summary.json.
void write_summary(const std::filesystem::path& file, const Test& test, const Result& result, bool force);

/// The folder-safe form of a test's name.
[[nodiscard]] std::string folder_name(const std::string& test_name);

}  // namespace fpz::driver
