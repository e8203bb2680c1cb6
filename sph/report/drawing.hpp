// The pictures of the report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fpz/io/picture.hpp"
#include "results.hpp"

namespace fpz::report {

/// Styles of curves and points, one after the other.
[[nodiscard]] std::string curve_style(std::size_t k);
[[nodiscard]] std::string point_style(std::size_t k);
inline constexpr const char* reference_style = "lines lw 2 dt 2 lc rgb '#202020'";

/// Load (kN) over deflection (um) of a run.
[[nodiscard]] io::Series load_curve(const Run& run, const std::string& title, const std::string& style);

/// Cracked particles of a run in the outline of its specimen.
struct CrackMap {
  std::string title;
  specimen::PointCloud cloud;
  specimen::Scene scene;
};
[[nodiscard]] CrackMap crack_map(const Run& run, const specimen::Frame& frame, const std::string& title);

/// Maps side by side in so many columns, all with one scale.
[[nodiscard]] io::Picture crack_picture(const std::string& name, const std::vector<CrackMap>& maps, int columns);

/// Panels side by side, each with its legend below.
[[nodiscard]] io::Picture panels(const std::string& name, const std::vector<io::Panel>& list);

/// Where the pictures go: drawn in one folder, the .png copied to another one.
struct Gallery {
  std::filesystem::path work, images;
  /// Draws, and returns the line of Markdown that shows the picture, or one that says why there is none.
  [[nodiscard]] std::string show(const io::Picture& picture, const std::string& name, const std::string& caption) const;
};

}  // namespace fpz::report
