// Runs of scenes by the particle program, kept in a folder.
#pragma once

#include <filesystem>

#include "fpz/calibration/scene_data.hpp"
#include "fpz/calibration/specification.hpp"

namespace fpz::calibration {

struct SceneRunOptions {
  std::filesystem::path folder;  ///< one folder per run in it, named after its scene, material and this program
  int jobs = 0;                  ///< runs at the same time, each in a process of its own; 0: one per core
};

/// Makes runs that are not in the folder yet and goes on with those that were interrupted. A run in the folder counts
/// when its scene, its material and the program itself (by the bytes of the executable) are the same and its history is
/// what was written; a damaged one is made again. Throws io::InputError where the program was built without the
/// particle method, io::OutputError for a folder that cannot be written.
[[nodiscard]] RunScenes scene_runner(const SceneRunOptions& options);

/// About how long the runs of a fit take, in words, by timing one step of each scene.
[[nodiscard]] std::string estimate_of_runs(const Specification& specification, int jobs);

}  // namespace fpz::calibration
