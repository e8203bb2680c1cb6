// When a run ends: the rules of a scene's "stop", how they are read and when they are met.
#pragma once

#include "fpz/specimen/run.hpp"
#include "recorder.hpp"

namespace fpz::specimen::detail {

/// What the rules look at, after a row has been added.
struct StopState {
  const Scene& scene;
  const Specimen& specimen;
  const Stage& stage;
  const sph::Simulation<2>& run;
  const Recorder& recorder;
  long long steps;   ///< of the stage so far
  double time_step;  ///< s
  std::size_t rows;  ///< of the stage so far
};

/// Which rule ends the stage, in words; empty when none does.
[[nodiscard]] std::string stop_reason(const StopState& state);
/// What it says when the time is over.
[[nodiscard]] std::string stop_reason_of_time();

}  // namespace fpz::specimen::detail
