// Runs of shipped scenes, coarser than they are shipped, and what their tests ask of them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "fpz/specimen/crack.hpp"
#include "fpz/specimen/run.hpp"
#include "fpz/specimen/summary.hpp"
#include "fpz/specimen/vtu.hpp"
#include "support/temporary_folder.hpp"

namespace fpz::test {

struct ShippedRun {
  specimen::Scene scene;
  specimen::RunResult result;
  std::vector<specimen::Spot> spots;  ///< particles of the specimen at the end
  specimen::Findings found;

  [[nodiscard]] const specimen::History& history() const { return result.history; }
};

/// The particles of the specimen in a frame.
inline std::vector<specimen::Spot> spots_of(const specimen::PointCloud& frame) {
  const auto column = [&](const char* name) -> const std::vector<double>& { return frame.find(name)->values; };
  std::vector<specimen::Spot> spots;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (column("group")[i] >= 0.0) continue;
    specimen::Spot s;
    s.at = {frame.points[3 * i], frame.points[3 * i + 1]};
    s.volume = column("volume")[i];
    s.damage = column("damage")[i];
    if (s.damage > 0.0) s.normal = {column("crack_normal")[3 * i], column("crack_normal")[3 * i + 1]};
    spots.push_back(s);
  }
  return spots;
}

/// A scene of data/scenes with some entries changed, run to its end in one thread without pictures.
inline ShippedRun run_shipped(const std::string& name, specimen::Overrides changes) {
  changes.insert(changes.begin(), {"output.pictures=false", "output.frames=1"});
  ShippedRun r{
      specimen::read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes" / (name + ".json"), changes), {}, {}, {}};
  specimen::RunRequest request;
  request.folder = fresh_path(name);
  request.threads = 1;
  r.result = specimen::run_scene(r.scene, request);
  r.spots = spots_of(specimen::read_vtk(request.folder / r.result.frames.back().file));
  r.found = specimen::findings(r.scene, r.result.history, specimen::opened_length(r.spots, r.scene.spacing), 0.0);
  return r;
}

/// Highest and lowest, leftmost and rightmost place of the particles with a damage above `threshold`.
struct Extent {
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
};
inline Extent cracked_extent(const std::vector<specimen::Spot>& spots, double threshold = 0.5) {
  Extent e;
  for (const specimen::Spot& s : spots) {
    if (s.damage < threshold) continue;
    e.left = std::min(e.left, s.at[0]), e.right = std::max(e.right, s.at[0]);
    e.low = std::min(e.low, s.at[1]), e.high = std::max(e.high, s.at[1]);
  }
  return e;
}

}  // namespace fpz::test
