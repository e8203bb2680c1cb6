// In place of scene_runs.cpp where the particle method is not built.
#include "fpz/calibration/scene_runs.hpp"
#include "fpz/io/input_error.hpp"
#include "scene_program.hpp"

namespace fpz::calibration {
namespace {

[[noreturn]] void refuse() {
  throw io::InputError(
      "data of the kind \"scene\" need the particle method, and this fpz-calibrate was built without it: configure "
      "with "
      "-DFPZ_BUILD_SPH=ON");
}

}  // namespace

namespace detail {

SceneFacts facts_of(const SceneSource& /*source*/) { refuse(); }
double seconds_of(const SceneRun& /*run*/) { refuse(); }

}  // namespace detail

RunScenes scene_runner(const SceneRunOptions& /*options*/) { return {}; }

}  // namespace fpz::calibration
