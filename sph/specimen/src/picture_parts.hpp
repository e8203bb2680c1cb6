// What the pictures of runs and of sweeps have in common.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fpz/io/picture.hpp"
#include "fpz/specimen/pictures.hpp"
#include "fpz/specimen/vtu.hpp"
#include "particle_map.hpp"

namespace fpz::specimen::detail {

inline constexpr const char* blue = "#1F5FA8";
inline constexpr const char* red = "#C0392B";
inline constexpr const char* green = "#2E8B57";
inline constexpr const char* grey = "#808080";

/// gnuplot's style of a curve.
[[nodiscard]] std::string line(const char* colour, const char* dash = "");

[[nodiscard]] std::string text_of(double x, int digits = 3);

/// One panel with the legend of its series below.
[[nodiscard]] io::Picture with_legend(const std::string& name, const io::Panel& panel, int columns);

/// Positions of the particles of a frame.
[[nodiscard]] std::vector<Point> positions(const PointCloud& cloud);

/// A field of a frame; throws io::InputError when it is not there.
[[nodiscard]] const PointData& field(const PointCloud& cloud, const char* name);

/// The damage of a frame, in the classes of damage_classes().
[[nodiscard]] ParticleMap damage_map(const PointCloud& cloud, std::string title);
[[nodiscard]] const std::vector<ColourClass>& damage_classes();

/// Draws the pictures into a folder; one that fails becomes a warning.
void write_pictures(const std::vector<io::Picture>& pictures, const std::filesystem::path& folder, bool force,
                    PictureOutcome& outcome);

/// True, with a warning, when there is no gnuplot.
[[nodiscard]] bool gnuplot_missing(PictureOutcome& outcome);

}  // namespace fpz::specimen::detail
