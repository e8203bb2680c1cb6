// Saves a run from time to time, and takes it up again.
#pragma once

#include <chrono>

#include "checkpoint.hpp"

namespace fpz::specimen::detail {

class Checkpointer {
 public:
  Checkpointer(const Scene& scene, const RunFiles& files) : scene_(scene), files_(files) {}

  /// Writes history and checkpoint, each whole under a temporary name: at any moment both files are complete.
  void save(const sph::Simulation<2>& run, const Recorder& recorder, const FrameWriter& frames,
            const StageKeeper& stages, const PaceKeeper& pace, const Schedule& schedule, const WallTimes& seconds);
  /// Whether the interval of the scene has passed since the last save().
  [[nodiscard]] bool due() const;
  /// Puts the run where its checkpoint was written; rows and frames keep their distances. Throws io::InputError when
  /// there is no usable one of this scene, which may differ in what ends its last stage.
  void resume(sph::Simulation<2>& run, Recorder& recorder, FrameWriter& frames, StageKeeper& stages, PaceKeeper& pace,
              Schedule& schedule, WallTimes& seconds) const;

 private:
  using Clock = std::chrono::steady_clock;

  const Scene& scene_;
  const RunFiles& files_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace fpz::specimen::detail
