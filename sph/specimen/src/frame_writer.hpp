// Writes frames: at equal intervals, at deflections asked for, and where the load has fallen to given parts of its
// peak.
#pragma once

#include "fpz/specimen/run.hpp"
#include "recorder.hpp"

namespace fpz::specimen::detail {

/// The frame writer's part of a checkpoint.
struct FrameWriterState {
  std::vector<Frame> frames;
  long long interval = 0;                       ///< of the loading, in which the last row was
  std::vector<unsigned char> levels_done;       ///< parts of the peak load that have their frame since the last peak
  std::vector<unsigned char> deflections_done;  ///< the same of the deflections
};

template <class Archive, class State>
void transfer(Archive& archive, State& state) requires std::same_as<std::remove_const_t<State>, FrameWriterState> {
  auto& [frames, interval, levels_done, deflections_done] = state;  // a member that is not handed on does not compile
  archive(frames), archive(interval), archive(levels_done), archive(deflections_done);
}

class FrameWriter {
 public:
  /// `every`: steps between frames at equal intervals; 0: none.
  FrameWriter(const Scene& scene, const Specimen& specimen, const RunFiles& files, long long every);

  /// Writes a frame when one is due after the row that the recorder has just added.
  void after_row(const sph::Simulation<2>& run, const Recorder& recorder);
  /// Writes the first frame; the last one, unless there is one of this time.
  void write_first(const sph::Simulation<2>& run) { write(run); }
  void write_last(const sph::Simulation<2>& run);

  [[nodiscard]] const std::vector<Frame>& frames() const { return state_.frames; }
  /// How many frames a run writes, about; more when the load rises again after it has fallen.
  [[nodiscard]] double expected() const;

  /// Steps between frames at equal intervals; 0: none.
  void set_interval(long long every) { every_ = every; }

  [[nodiscard]] const FrameWriterState& state() const { return state_; }
  void restore(FrameWriterState state) { state_ = std::move(state); }

 private:
  void write(const sph::Simulation<2>& run);

  const Scene& scene_;
  const Specimen& specimen_;
  const RunFiles& files_;
  long long every_;
  std::vector<double> levels_;  ///< parts of the peak load at which a frame is written; <= 0: none
  FrameWriterState state_;
};

}  // namespace fpz::specimen::detail
