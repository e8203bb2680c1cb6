#include "notched_reference.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fpz/io/problems.hpp"
#include "fpz/parameters.hpp"
#include "fpz/specimen/history.hpp"

namespace fpz::report {
namespace {

namespace fs = std::filesystem;

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

/// Of the material only these act in pure mode I on a crack without width.
constexpr const char* acting[] = {"young_modulus", "poisson_ratio", "tensile_strength", "delta0", "normal_stiffness"};

/// What the curve of a run must hold for. Supports are the second and the third boundary of its scene.
std::vector<Condition> conditions_of(const Run& run, double roller_width) {
  const specimen::Scene scene = run.parsed_scene();
  std::vector<Condition> list;
  const auto add = [&](const char* name, double value) { list.push_back({name, io::exact(value)}); };
  const auto* box = std::get_if<specimen::Rectangle>(&scene.body.shape);
  list.push_back({"shape", box != nullptr ? "beam" : "semicircular"});
  list.push_back({"setting", to_string(scene.setting)});
  if (box != nullptr) {
    add("length", box->high[0] - box->low[0]);
    add("depth", box->high[1] - box->low[1]);
  } else {
    add("radius", std::get<specimen::HalfDisc>(scene.body.shape).radius);
  }
  add("thickness", scene.thickness);
  add("span", run.setting("boundaries/2/at/0") - run.setting("boundaries/1/at/0"));
  add("notch", run.setting("notches/0/length"));
  add("roller_width", roller_width);
  for (const auto& p : parameter_table<double>) {
    if (!p.of_material) continue;
    const bool acts = std::find(std::begin(acting), std::end(acting), p.name) != std::end(acting);
    list.push_back({std::string(p.name), io::exact(scene.parameters.*p.member), acts});
  }
  return list;
}

/// The curve of a specimen with rollers of some width: data/reference/<specimen>_rollers_<width>mm.csv.
Reference reference(const char* specimen, const Run& run, double roller_width) {
  std::ostringstream name;
  name << specimen << "_rollers_" << 1e3 * roller_width << "mm.csv";
  Reference r;
  r.curve =
      read_reference_curve(fs::path(FPZ_SOURCE_DIR) / "data/reference" / name.str(), conditions_of(run, roller_width));
  r.peak = *std::max_element(r.curve.load.begin(), r.curve.load.end());
  r.stiffness = slope(r.curve.deflection_mid_depth, r.curve.load);
  r.notch_stiffness = slope(r.curve.cmod, r.curve.load);
  return r;
}

}  // namespace

Reference beam_reference(const Run& run, double roller_width) { return reference("beam_3pb", run, roller_width); }

Reference semicircular_reference(const Run& run, double roller_width) { return reference("scb", run, roller_width); }

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
  const Reference fe = beam_reference(run, roller_width(run));
  const io::Table t = run.history();
  const std::vector<double>&way = t.at("deflection"), &load = t.at("load");
  const double end = std::min(*std::max_element(way.begin(), way.end()), fe.curve.deflection_mid_depth.back());
  BeamErrors e;
  e.peak = run.figure("peak_load") / fe.peak - 1.0;
  e.stiffness = run.figure("stiffness") / fe.stiffness - 1.0;
  e.notch_stiffness = notch_stiffness(run) / fe.notch_stiffness - 1.0;
  e.work =
      specimen::work_until(end, way, load) / specimen::work_until(end, fe.curve.deflection_mid_depth, fe.curve.load) -
      1.0;
  return e;
}

}  // namespace fpz::report
