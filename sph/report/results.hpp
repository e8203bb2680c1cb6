// The runs of the validation sweeps as their folders hold them.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/io/csv.hpp"
#include "fpz/io/json_locator.hpp"
#include "fpz/specimen/scene.hpp"
#include "fpz/specimen/vtu.hpp"

namespace fpz::report {

/// A run that has ended: finished, or failed on the way.
struct Run {
  std::string sweep, series, label;
  double value = 0.0;  ///< of the sweep's parameter; NaN where it is no number
  std::filesystem::path folder;
  io::JsonValue scene, summary;

  /// A number of the summary or of the scene by its path, as in "energies/fracture" or "boundaries/0/width"; NaN when
  /// it is null or not there.
  [[nodiscard]] double figure(std::string_view path) const;
  [[nodiscard]] double setting(std::string_view path) const;
  /// A string of the scene, or `otherwise` when the scene leaves it out.
  [[nodiscard]] std::string choice(std::string_view path, const std::string& otherwise) const;
  [[nodiscard]] bool finished() const;
  [[nodiscard]] std::string reason() const;
  [[nodiscard]] std::size_t warnings() const;

  [[nodiscard]] io::Table history() const;
  [[nodiscard]] specimen::Scene parsed_scene() const;
  [[nodiscard]] std::vector<specimen::Frame> frames() const;
  [[nodiscard]] specimen::PointCloud cloud(const specimen::Frame& frame) const;
};

/// The runs of one sweep in its order; those that have not ended are missing.
struct SweepRuns {
  std::size_t planned = 0;  ///< 0: the sweep has not been started
  std::vector<Run> runs;

  [[nodiscard]] const Run* find(std::string_view series, std::string_view label) const;
  [[nodiscard]] std::vector<const Run*> of(std::string_view series) const;
};

/// Reads <folder>/<name>/sweep.csv and the runs that it lists. Throws io::InputError for files that cannot be read.
[[nodiscard]] SweepRuns load_sweep(const std::filesystem::path& folder, const std::string& name);

struct Results {
  std::filesystem::path folder;
  SweepRuns beam_spacing, beam_fine, beam_rollers, beam_rate, beam_methods, beam_methods_fine;
  SweepRuns scb_angles, scb_updated, ring_diameters;
  SweepRuns solver_beam, solver_scb;
  SweepRuns method_dogbone, method_compression, method_disc, method_beam;

  [[nodiscard]] std::vector<const SweepRuns*> all() const;
};

[[nodiscard]] Results load_results(const std::filesystem::path& folder);

/// The first crack of a run.
struct Onset {
  double load = NAN, deflection = NAN;           ///< of the row in which the first particle is cracked
  specimen::Point at = specimen::Point::Zero();  ///< the most damaged particle of the first frame that shows damage
};
/// Nothing when no particle has cracked.
[[nodiscard]] std::optional<Onset> first_crack(const Run& run);

/// The row of a history at which the load first falls to `fraction` of its peak after it; 1: the peak. The last row
/// when it never does.
[[nodiscard]] std::size_t row_after_peak(const io::Table& history, double fraction);

/// The frame nearest to a time. `frames` must not be empty.
[[nodiscard]] const specimen::Frame& frame_at(const std::vector<specimen::Frame>& frames, double time);

}  // namespace fpz::report
