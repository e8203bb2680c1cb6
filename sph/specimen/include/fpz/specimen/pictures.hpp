// Pictures of a run from its files, and of a scene before it runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen {

struct PictureOutcome {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;
};

/// load_deflection, energies, damage (maps at the scene's picture loads), velocity (horizontal, last frame), and
/// convergence where a solver has repeated the run, as PNG and SVG, from history.csv, frames.pvd and scene.json in the
/// folder. Without gnuplot: a warning. Throws
/// io::InputError when the folder holds no run, io::OutputError when pictures are in the way and not `force`.
[[nodiscard]] PictureOutcome draw_run(const std::filesystem::path& folder, bool force);

/// scene: the particles coloured by boundary group, the outline, notches and gauges.
[[nodiscard]] PictureOutcome draw_scene(const Scene& scene, const Specimen& specimen,
                                        const std::filesystem::path& folder, bool force);

}  // namespace fpz::specimen
