// What a run will take, from a short one.
#pragma once

#include <string>

#include "fpz/specimen/run.hpp"

namespace fpz::specimen {

struct Estimate {
  Schedule schedule;
  long long most_steps = 0;             ///< at the pace of the solver, where that is constant
  long long likely_steps = 0;           ///< of them to stop.deflection at the fastest prescribed speed, else all
  double step_seconds = 0.0;            ///< wall time of one step, uncracked
  double step_processor_seconds = 0.0;  ///< processor time of it, all threads: what others run beside does not count
  double memory = 0.0;                  ///< bytes, resident now
  double disk = 0.0;                    ///< bytes of frames and checkpoint
  double mean_neighbours = 0.0;
};

/// Runs the specimen for about half a second.
[[nodiscard]] Estimate estimate(const Scene& scene, const Specimen& specimen, int threads);
[[nodiscard]] std::string estimate_text(const Scene& scene, const Specimen& specimen, const Estimate& e);

}  // namespace fpz::specimen
