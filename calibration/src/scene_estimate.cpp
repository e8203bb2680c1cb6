// How long a fit with scenes will take, before it begins.
#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "fpz/calibration/scene_runs.hpp"
#include "report/display.hpp"
#include "scene_program.hpp"

namespace fpz::calibration {

std::string estimate_of_runs(const Specification& spec, int jobs) {
  // Three rounds on the way are usual: the design with the runs that show the scatter, then what each round adds.
  const auto n = static_cast<double>(std::count_if(spec.parameters.begin(), spec.parameters.end(),
                                                   [](const ParameterSetting& p) { return p.fitted; }));
  const double design = 2.0 + 2.0 * n + 0.5 * n * (n - 1.0);
  const double points = 3.0 * design + 7.0;
  std::vector<std::pair<SceneSource, double>> scenes;  // each once, with the number of its runs
  for (const DataSet& set : spec.data) {
    const auto* data = std::get_if<SceneData>(&set.test);
    if (data == nullptr) continue;
    const double runs = set.role == Role::fit ? points : 1.0;
    for (const SceneSource& source : data->scenes) {
      const auto same = std::find_if(scenes.begin(), scenes.end(), [&](const auto& s) { return s.first == source; });
      if (same == scenes.end()) {
        scenes.emplace_back(source, runs);
      } else {
        same->second = std::max(same->second, runs);
      }
    }
  }
  if (scenes.empty()) return {};
  double seconds = 0.0;
  for (const auto& [source, runs] : scenes) seconds += runs * detail::seconds_of({source, spec.start()});
  const double cores = jobs > 0 ? jobs : static_cast<double>(std::max(1U, std::thread::hardware_concurrency()));
  return std::to_string(scenes.size()) + (scenes.size() == 1 ? " scene" : " scenes") + ", some " +
         detail::digits(std::round(points), 3) + " parameter sets to run: about " + detail::digits(seconds / cores, 2) +
         " s or less on " + detail::digits(cores) + (cores == 1.0 ? " free core" : " free cores") +
         " (runs end when the load has dropped)";
}

}  // namespace fpz::calibration
