#include "fpz/calibration/scene_data.hpp"

#include <algorithm>
#include <cmath>

#include "words.hpp"

namespace fpz::calibration {
namespace {

const std::vector<double>* column(const SceneOutcome& o, const std::string& name) {
  const auto at = std::find(o.columns.begin(), o.columns.end(), name);
  return at == o.columns.end() ? nullptr : &o.readings[static_cast<std::size_t>(at - o.columns.begin())];
}

/// `y` where `x` first reaches `at`, on straight lines between the rows; nothing when it does not.
std::optional<double> first_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(x[k] >= at)) continue;
    if (k == 0) return y[0];
    const double part = (at - x[k - 1]) / (x[k] - x[k - 1]);
    return y[k - 1] + part * (y[k] - y[k - 1]);
  }
  return std::nullopt;
}

}  // namespace

Prediction readings_of(const SceneData& data, const std::vector<SceneOutcome>& outcomes) {
  Prediction out;
  out.values.resize(static_cast<Eigen::Index>(data.values.size()));
  for (std::size_t k = 0; k < data.values.size(); ++k) {
    const SceneValue& v = data.values[k];
    const SceneOutcome& o = outcomes[v.scene];
    const std::string name = data.scenes[v.scene].file.filename().string();
    if (!o.failure.empty()) return failed(name + ": " + o.failure);
    const std::vector<double>* y = column(o, v.gauge);
    const std::vector<double>* x = v.abscissa.empty() ? y : column(o, v.abscissa);
    if (y == nullptr || x == nullptr) return failed(name + ": the run has no column \"" + v.gauge + '"');
    double& value = out.values[static_cast<Eigen::Index>(k)];
    if (v.abscissa.empty()) {
      value = *std::max_element(y->begin(), y->end());
    } else if (const auto reading = first_at(*x, *y, v.at)) {
      value = *reading;
    } else {
      return failed(name + ": the run ended (" + o.ending + ") at " + v.abscissa + " = " +
                    detail::number(*std::max_element(x->begin(), x->end())) + ", before the reading at " +
                    detail::number(v.at) + "; use \"range\", or let it run longer by \"set\"");
    }
    if (!std::isfinite(value)) return failed(name + ": the run gives no finite " + v.gauge);
  }
  return out;
}

Prediction predict(const SceneData& data, const Parameters& parameters, bool derivatives) {
  if (!data.surface) return failed("the scene has not been run");
  return predict(*data.surface, parameters, derivatives);
}

}  // namespace fpz::calibration
