#include "checkpointer.hpp"

#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

/// A scene without what ends its last stage.
std::string without_end(const std::string& scene) {
  const io::ReadLimits limits;
  io::Problems ignored(limits.problems);
  io::JsonValue root;
  if (!io::parse_json(scene, "", limits, ignored, root)) return scene;
  io::JsonValue* stages = member(root, "stages");
  io::JsonValue& last = stages != nullptr && !stages->items.empty() ? stages->items.back() : root;
  std::erase_if(last.items, [](const io::JsonValue& v) { return v.key == "stop"; });
  return to_text(root);
}

}  // namespace

void Checkpointer::save(const sph::Simulation<2>& run, const Recorder& recorder, const FrameWriter& frames,
                        const StageKeeper& stages, const PaceKeeper& pace, const Schedule& schedule,
                        const WallTimes& seconds) {
  io::write_text(files_.history, recorder.history().to_csv(), true);
  write_checkpoint(files_.checkpoint, {scene_.text, recorder.state(), frames.state(), stages.state(), pace.state(),
                                       schedule.row_every, schedule.frame_every, seconds, run.snapshot()});
  last_ = Clock::now();
}

bool Checkpointer::due() const {
  const double interval = scene_.output.checkpoint_seconds;
  return interval > 0.0 && std::chrono::duration<double>(Clock::now() - last_).count() > interval;
}

void Checkpointer::resume(sph::Simulation<2>& run, Recorder& recorder, FrameWriter& frames, StageKeeper& stages,
                          PaceKeeper& pace, Schedule& schedule, WallTimes& seconds) const {
  Checkpoint c = read_checkpoint(files_.checkpoint);
  if (c.scene_text == scene_.text && std::filesystem::exists(files_.summary)) {
    throw io::InputError(files_.checkpoint.string() +
                         ": the run has come to its end; --resume goes on to a later one (\"stop\" of the last stage)");
  }
  if (c.scene_text != scene_.text && without_end(c.scene_text) != without_end(scene_.text)) {
    throw io::InputError(files_.checkpoint.string() + ": belongs to another scene (" + files_.scene.string() +
                         " is the one it belongs to; resume with that file, in which only \"stop\" of the last stage "
                         "may differ)");
  }
  try {
    run.restore(c.snapshot);
  } catch (const std::exception& e) {
    throw io::InputError(files_.checkpoint.string() + ": the checkpoint cannot be used: " + e.what());
  }
  recorder.restore(std::move(c.recorder));
  frames.restore(std::move(c.frames));
  stages.restore(std::move(c.stages));
  pace.restore(c.pace);
  schedule.row_every = c.row_every;
  schedule.frame_every = c.frame_every;
  frames.set_interval(c.frame_every);
  seconds = c.seconds;
  std::filesystem::remove(files_.summary);  // of the earlier end
}

}  // namespace fpz::specimen::detail
