#include "beam_reference.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "fpz/io/input_error.hpp"

namespace fpz::report {
namespace {

using calibration::NotchedSpecimen;
using calibration::SpecimenShape;

/// Least squares through the points between 10 and 40 % of the peak, on the way up. NaN for fewer than two.
double slope(const std::vector<double>& way, const std::vector<double>& load) {
  const auto top = std::max_element(load.begin(), load.end());
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (auto at = load.begin(); at < top && *at <= 0.4 * *top; ++at) {
    if (*at < 0.1 * *top) continue;
    const double u = way[static_cast<std::size_t>(at - load.begin())];
    n += 1.0, x += u, y += *at, xx += u * u, xy += u * *at;
  }
  return n >= 2.0 ? (n * xy - x * y) / (n * xx - x * x) : std::nan("");
}

Reference compute(const NotchedSpecimen& specimen, Parameters parameters) {
  parameters.rve_length = 1e-3;  // does not enter a crack without width, but must be valid
  Reference r;
  r.curve = calibration::fracture_curve(specimen, parameters);
  if (!r.curve.failure.empty()) throw io::InputError("the finite-element reference failed: " + r.curve.failure);
  r.peak = *std::max_element(r.curve.load.begin(), r.curve.load.end());
  r.stiffness = slope(r.curve.deflection_mid_depth, r.curve.load);
  r.notch_stiffness = slope(r.curve.cmod, r.curve.load);
  return r;
}

}  // namespace

Reference beam_reference(const Run& run, double roller_width) {
  const specimen::SceneFile scene = run.scene_file();
  const auto& box = std::get<specimen::Rectangle>(scene.body.shape);
  NotchedSpecimen s;
  s.shape = SpecimenShape::beam;
  s.length = box.high[0] - box.low[0];
  s.depth = box.high[1] - box.low[1];
  s.thickness = scene.thickness;
  s.span = run.setting("boundaries/2/at/0") - run.setting("boundaries/1/at/0");
  s.notch = run.setting("notches/0/length");
  s.roller_width = roller_width;
  s.setting = scene.setting;
  return compute(s, scene.parameters);
}

Reference semicircular_reference(const Run& run, double roller_width) {
  const specimen::SceneFile scene = run.scene_file();
  NotchedSpecimen s;
  s.shape = SpecimenShape::semicircular;
  s.radius = std::get<specimen::HalfDisc>(scene.body.shape).radius;
  s.thickness = scene.thickness;
  s.span = run.setting("boundaries/2/at/0") - run.setting("boundaries/1/at/0");
  s.notch = run.setting("notches/0/length");
  s.roller_width = roller_width;
  s.setting = scene.setting;
  return compute(s, scene.parameters);
}

double roller_width(const Run& run) {
  const double spacing = run.setting("spacing");
  const long columns = std::lround(run.setting("boundaries/0/width") / spacing);
  return columns > 1 ? static_cast<double>(columns) * spacing : 0.0;
}

double notch_stiffness(const Run& run) {
  const io::Table t = run.history();
  return slope(t.at("cmod"), t.at("load"));
}

BeamErrors beam_errors(const Run& run) {
  static std::map<double, Reference> known;  // condensing the beam takes a while; all runs have one beam and E, G
  const double width = std::round(1e6 * roller_width(run)) * 1e-6;
  auto at = known.find(width);
  if (at == known.end()) at = known.emplace(width, beam_reference(run, width)).first;
  const Reference& fe = at->second;
  return {run.figure("peak_load") / fe.peak - 1.0, run.figure("stiffness") / fe.stiffness - 1.0,
          notch_stiffness(run) / fe.notch_stiffness - 1.0, run.figure("fracture_energy_ratio") - 1.0};
}

}  // namespace fpz::report
