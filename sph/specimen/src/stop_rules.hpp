// When a run ends: the rules of a scene's "stop", how they are read and when they are met.
#pragma once

#include "fpz/specimen/run.hpp"
#include "recorder.hpp"

namespace fpz::specimen::detail {

/// What the rules look at, after a row has been added.
struct StopState {
  const Scene& scene;
  const Specimen& specimen;
  const Schedule& schedule;
  const sph::Simulation<2>& run;
  const Recorder& recorder;
};

/// Which rule ends the run, in words; empty when none does.
[[nodiscard]] std::string stop_reason(const StopState& state);

}  // namespace fpz::specimen::detail
