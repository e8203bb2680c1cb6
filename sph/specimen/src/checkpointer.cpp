#include "checkpointer.hpp"

#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"

namespace fpz::specimen::detail {

void Checkpointer::save(const sph::Simulation<2>& run, const Recorder& recorder, const FrameWriter& frames,
                        const StageKeeper& stages, const WallTimes& seconds) {
  io::write_text(files_.history, recorder.history().to_csv(), true);
  write_checkpoint(files_.checkpoint,
                   {scene_.text, recorder.state(), frames.state(), stages.state(), seconds, run.snapshot()});
  last_ = Clock::now();
}

bool Checkpointer::due() const {
  const double interval = scene_.output.checkpoint_seconds;
  return interval > 0.0 && std::chrono::duration<double>(Clock::now() - last_).count() > interval;
}

void Checkpointer::resume(sph::Simulation<2>& run, Recorder& recorder, FrameWriter& frames, StageKeeper& stages,
                          WallTimes& seconds) const {
  Checkpoint c = read_checkpoint(files_.checkpoint);
  if (c.scene_text != scene_.text) {
    throw io::InputError(files_.checkpoint.string() + ": belongs to another scene (" + files_.scene.string() +
                         " is the one it belongs to; resume with that file)");
  }
  try {
    run.restore(c.snapshot);
  } catch (const std::exception& e) {
    throw io::InputError(files_.checkpoint.string() + ": the checkpoint cannot be used: " + e.what());
  }
  recorder.restore(std::move(c.recorder));
  frames.restore(std::move(c.frames));
  stages.restore(std::move(c.stages));
  seconds = c.seconds;
}

}  // namespace fpz::specimen::detail
