#include "frame_writer.hpp"

#include <algorithm>
#include <cstdio>

namespace fpz::specimen::detail {
namespace {

constexpr double just_after_peak = 0.995;  ///< of the peak load: the frame that shows the peak

}  // namespace

FrameWriter::FrameWriter(const Scene& scene, const Specimen& specimen, const RunFiles& files, long long every)
    : scene_(scene), specimen_(specimen), files_(files), every_(every) {
  for (const double f : scene.output.picture_loads) levels_.push_back(f == 1.0 ? just_after_peak : -f);
  state_.levels_done.assign(levels_.size(), 0);
  state_.deflections_done.assign(scene.output.frames_at.size(), 0);
}

void FrameWriter::after_row(const sph::Simulation<2>& run, const Recorder& recorder) {
  bool wanted = every_ > 0 && run.loading_steps() / every_ != state_.interval;
  if (recorder.at_peak())
    std::fill(state_.levels_done.begin(), state_.levels_done.end(), static_cast<unsigned char>(0));
  const auto check = [&](unsigned char& done, bool reached) {
    if (done != 0 || !reached) return;
    done = 1;
    wanted = true;
  };
  if (every_ > 0) state_.interval = run.loading_steps() / every_;
  const double load = recorder.history().last("load"), deflection = recorder.history().last("deflection");
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const bool fallen = levels_[k] > 0.0 && run.cracked() > 0 && load < levels_[k] * recorder.peak_load();
    check(state_.levels_done[k], fallen);
  }
  for (std::size_t k = 0; k < scene_.output.frames_at.size(); ++k) {
    check(state_.deflections_done[k], deflection >= scene_.output.frames_at[k]);
  }
  if (wanted) write(run);
}

void FrameWriter::write_last(const sph::Simulation<2>& run) {
  if (state_.frames.empty() || state_.frames.back().time != run.loading_time()) write(run);
}

double FrameWriter::expected() const {
  return scene_.output.frames + static_cast<double>(levels_.size() + scene_.output.frames_at.size()) + 2.0;
}

void FrameWriter::write(const sph::Simulation<2>& run) {
  char name[40];
  std::snprintf(name, sizeof name, "frame_%05zu.vtu", state_.frames.size());
  write_vtu(files_.frames / name, frame_of(run, specimen_));
  state_.frames.push_back({run.loading_time(), files_.frames.filename().string() + "/" + name});
  write_pvd(files_.collection, state_.frames);
}

}  // namespace fpz::specimen::detail
