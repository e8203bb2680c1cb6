// A scene run to its end, without pictures of its progress.
#pragma once

#include "fpz/specimen/run.hpp"

namespace fpz::test {

/// In one thread; interrupted and resumed every so many steps (0: never).
inline specimen::RunResult run_to_end(const specimen::Scene& scene, const std::filesystem::path& folder,
                                      long long steps = 0) {
  specimen::RunRequest request;
  request.folder = folder;
  request.most_steps = steps;
  request.threads = 1;
  specimen::RunResult r = specimen::run_scene(scene, request);
  while (r.ending == specimen::Ending::interrupted) {
    request.resume = true;
    r = specimen::run_scene(scene, request);
  }
  return r;
}

}  // namespace fpz::test
