// Pictures of a history, drawn by gnuplot: PNG and SVG.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fpz/io/csv.hpp"

namespace fpz::driver {

/// What the yield surface needs besides the history.
struct YieldSurface {
  double tensile_strength = 0.0;  ///< Pa
  double cohesion = 0.0;          ///< Pa
  double friction_angle_deg = 0.0;
};

struct PlotRequest {
  std::string title;
  std::filesystem::path folder;
  std::optional<YieldSurface> surface;  ///< without it there is no picture of the yield surface
  bool force = false;
};

struct PlotOutcome {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;
};

/// The files that plot_history may write; stress-strain curves of further components only where they are not zero.
[[nodiscard]] std::vector<std::filesystem::path> picture_files(const std::filesystem::path& folder, bool with_surface);

/// Draws all pictures. A missing gnuplot or a picture that did not come out is a warning, never an exception; a file
/// that exists already and may not be replaced throws OutputError.
[[nodiscard]] PlotOutcome plot_history(const io::Table& history, const PlotRequest& request);

/// Title and yield surface from a summary.json; the file need not exist.
void read_plot_facts(const std::filesystem::path& summary, PlotRequest& request);

}  // namespace fpz::driver
