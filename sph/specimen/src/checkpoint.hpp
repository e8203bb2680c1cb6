// A checkpoint: the file from which a run goes on bit for bit. It holds the scene, the parts of recorder, frame
// writer, stage keeper and pace keeper, the wall times, and a snapshot: the state of the particles as the engine makes
// bytes of it.
//
// Every struct in it has one function transfer() for both directions, which takes the struct apart by name: a member
// that is left out does not compile.
#pragma once

#include "frame_writer.hpp"
#include "pace_keeper.hpp"
#include "recorder.hpp"
#include "stage_keeper.hpp"

namespace fpz::specimen {

template <class Archive, class F>
void transfer(Archive& archive, F& frame) requires std::same_as<std::remove_const_t<F>, Frame> {
  auto& [time, file] = frame;
  archive(time), archive(file);
}

template <class Archive, class W>
void transfer(Archive& archive, W& seconds) requires std::same_as<std::remove_const_t<W>, WallTimes> {
  auto& [stepping, all] = seconds;
  archive(stepping), archive(all);
}

}  // namespace fpz::specimen

namespace fpz::specimen::detail {

struct Checkpoint {
  std::string scene_text;
  RecorderState recorder;
  FrameWriterState frames;
  StageState stages;
  PaceState pace;
  long long row_every = 1, frame_every = 0;  ///< steps: those of its own end, also when the run goes on to a later one
  WallTimes seconds;
  std::vector<unsigned char> snapshot;
};

template <class Archive, class C>
void transfer(Archive& archive, C& checkpoint) requires std::same_as<std::remove_const_t<C>, Checkpoint> {
  auto& [scene_text, recorder, frames, stages, pace, row_every, frame_every, seconds, snapshot] = checkpoint;
  archive(scene_text), archive(recorder), archive(frames), archive(stages), archive(pace);
  archive(row_every), archive(frame_every), archive(seconds), archive(snapshot);
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);
/// Throws io::InputError when the file is missing, damaged or of another version.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace fpz::specimen::detail
