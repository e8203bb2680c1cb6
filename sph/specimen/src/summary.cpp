#include "fpz/specimen/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fpz/io/material_file.hpp"
#include "fpz/sph/option_table.hpp"
#include "interface_map.hpp"
#include "material_map.hpp"

namespace fpz::specimen {
namespace {

using Json = nlohmann::ordered_json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t peak_row(const History& h) {
  std::size_t best = 0;
  for (std::size_t r = 1; r < h.rows(); ++r) {
    if (h.at(r, "load") > h.at(best, "load")) best = r;
  }
  return best;
}

double slope(const History& h, std::size_t peak) {
  const double top = h.at(peak, "load");
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t r = 0; r < peak; ++r) {
    const double load = h.at(r, "load"), u = h.at(r, "deflection");
    if (load > 0.4 * top) break;
    if (load < 0.1 * top) continue;
    n += 1.0, x += u, y += load, xx += u * u, xy += u * load;
  }
  const double spread = n * xx - x * x;
  return n >= 3.0 && spread > 0.0 ? (n * xy - x * y) / spread : nan;
}

std::string percent(double x) {
  std::ostringstream s;
  s.precision(3);
  s << 100.0 * x << " %";
  return s.str();
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

/// One option of any type as JSON.
Json option_json(double x) { return x; }
template <Worded E>
Json option_json(E value) {
  return fpz::to_string(value);
}
Json option_json(const sph::RveLength& length) {
  return length.rule == sph::RveLength::Rule::number ? Json(length.value) : Json(fpz::to_string(length.rule));
}

Json method_json(const sph::Options<2>& options) {
  Json j;
  sph::for_each_option(options, [&](const sph::OptionInfo& info, const auto& value) {
    if constexpr (requires { option_json(value); }) {
      if (info.in_summary) j[std::string(info.name)] = option_json(value);
    }
  });
  return j;
}

Json material_json(const std::string& name, const Parameters& parameters) {
  Json j = {{"name", name}};
  for (const auto& p : parameter_table<double>) {
    if (p.of_material) j[std::string(p.name)] = parameters.*p.member;
  }
  io::put_choices(j, parameters.choices);
  return j;
}

/// All of them, by the numbers that the frames have.
Json materials_json(const Scene& scene, const sph::RunSetup<2>& setup) {
  Json list = Json::array();
  for (const detail::MaterialShare& share : detail::material_shares(scene, setup)) {
    Json j = material_json(share.name, *share.parameters);
    j["particles"] = share.particles;
    j["area"] = share.area;
    list.push_back(std::move(j));
  }
  return list;
}

Json interfaces_json(const SummaryInput& in) {
  const sph::Particles<2>& p = in.run.particles_now();
  const std::vector<std::size_t> count = detail::interface_particles(in.scene, in.specimen.setup);
  std::vector<std::size_t> cracked(count.size(), 0);
  for (std::size_t i = 0; i < p.count; ++i) {
    if (!in.run.cracked_on_weak_plane(i)) continue;
    ++cracked[static_cast<std::size_t>(in.specimen.setup.weak_planes.of_particle[p.id[i]])];
  }
  Json list = Json::array();
  for (std::size_t k = 0; k < count.size(); ++k) {
    Json j = material_json(in.scene.interfaces[k].name, in.scene.interfaces[k].material);
    j["particles"] = count[k];
    j["cracked"] = cracked[k];
    list.push_back(std::move(j));
  }
  return list;
}

/// The field as asked for, and what its particles have by chance.
Json strength_json(const SummaryInput& in) {
  const StrengthField& field = *in.scene.strength_field;
  const sph::RunSetup<2>& setup = in.specimen.setup;
  double volume = 0.0, mean = 0.0, square = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < setup.arrangement.size(); ++i) {
    if (setup.arrangement.group[i] != sph::Arrangement<2>::specimen) continue;
    const double v = setup.arrangement.volume[i], f = setup.materials.strength_factor[i];
    volume += v, mean += v * f, square += v * f * f, least = std::min(least, f);
  }
  mean /= volume;
  return {{"weibull_modulus", field.weibull_modulus},
          {"correlation_length", field.correlation_length},
          {"seed", field.seed},
          {"mean", mean},
          {"deviation", std::sqrt(std::max(0.0, square / volume - mean * mean))},
          {"least", least}};
}

Json solver_json(const SummaryInput& in) {
  Json j;
  j["type"] = fpz::to_string(in.scene.solver.kind);
  j["pace"] = in.run.pace();
  if (in.result.convergence.empty()) return j;
  Json runs = Json::array();
  for (const ConvergenceRun& r : in.result.convergence) {
    runs.push_back({{"pace", r.pace},
                    {"steps", r.steps},
                    {"failed", r.failed},
                    {"peak_load", number(r.peak_load)},
                    {"change_of_peak", number(r.change_of_peak)},
                    {"change_of_work", number(r.change_of_work)}});
  }
  j["tolerance"] = in.scene.solver.tolerance;
  j["runs"] = runs;
  return j;
}

Json stages_json(const std::vector<EndedStage>& stages) {
  Json list = Json::array();
  for (const EndedStage& s : stages) {
    list.push_back({{"name", s.name},
                    {"ended_by", s.reason},
                    {"begin", s.begin},
                    {"end", s.end},
                    {"kinetic_over_elastic", number(s.kinetic_ratio)}});
  }
  return list;
}

Json energies_json(const History& h) {
  Json j;
  if (h.rows() == 0) return j;
  sph::for_each_energy(
      {}, [&](std::string_view name, double) { j[std::string(name)] = number(h.last("energy_" + std::string(name))); });
  return j;
}

}  // namespace

Findings findings(const Scene& scene, const History& h, double opened, double alternation,
                  std::optional<double> fracture_energy) {
  Findings f;
  f.alternation = alternation;
  f.fracture_energy = fracture_energy.value_or(scene.parameters.tensile_strength * scene.parameters.delta0);
  f.crack_area = opened * scene.thickness;
  if (h.rows() == 0) return f;
  const std::size_t peak = peak_row(h);
  f.peak_load = h.at(peak, "load");
  f.deflection_at_peak = h.at(peak, "deflection");
  f.stiffness = slope(h, peak);
  if (scene.toughness) f.toughness = stress_intensity(*scene.toughness, scene.thickness, f.peak_load);
  f.fracture_energy_ratio = f.crack_area > 0.0 ? h.last("energy_fracture") / (f.crack_area * f.fracture_energy) : nan;
  const bool has_support = scene.gauges.contains("support");
  f.imbalance = has_support ? 0.0 : nan;
  double work = 0.0, error = 0.0, least = 0.0;
  for (std::size_t r = 0; r < h.rows(); ++r) {
    work = std::max(work, std::abs(h.at(r, "energy_external")));
    error = std::max(error, std::abs(h.at(r, "energy_error")));
    least = std::min(least, h.at(r, "energy_elastic"));
    const double motion = h.at(r, "energy_kinetic") - h.at(0, "energy_kinetic") + h.at(r, "energy_viscous");
    if (work > 0.0) f.motion_ratio = std::max(f.motion_ratio, motion / work);
    const double load = h.at(r, "load");
    const double internal = h.at(r, "energy_elastic") + h.at(r, "energy_fracture");
    const double ratio = internal > 0.0 ? h.at(r, "energy_kinetic") / internal : 0.0;
    if (r > peak) f.kinetic_ratio_after = std::max(f.kinetic_ratio_after, ratio);
    if (r > peak || load < 0.5 * f.peak_load) continue;
    f.kinetic_ratio = std::max(f.kinetic_ratio, ratio);
    if (has_support) f.imbalance = std::max(f.imbalance, std::abs(load - h.at(r, "support")) / f.peak_load);
  }
  f.balance_error = work > 0.0 ? error / work : 0.0;
  f.least_elastic = work > 0.0 ? least / work : 0.0;
  return f;
}

std::string error_of_the_model(const Scene& scene, const Findings& f) {
  constexpr double negligible = 0.01;  // a balance is not known better
  if (f.least_elastic >= -negligible) return "";
  const bool published = scene.parameters.choices.cohesive_zone == CohesiveZone::published;
  return "the stored energy falls to " + percent(f.least_elastic) +
         " of the external work: an error of the model, which gives back energy that nobody put in" +
         (published ? "; the springs of the published zone are preloaded at onset: use \"cohesive_zone\": "
                      "\"consistent\", or stiffer springs"
                    : "");
}

namespace {

/// A gauge that goes the wrong way is turned round: nothing that is derived from it means what its name says.
void warn_of_signs(const History& h, std::vector<std::string>& list) {
  for (const char* name : {"load", "deflection"}) {
    double least = 0.0, largest = 0.0;
    for (std::size_t r = 0; r < h.rows(); ++r) {
      least = std::min(least, h.at(r, name));
      largest = std::max(largest, h.at(r, name));
    }
    if (-least <= largest) continue;
    std::ostringstream s;
    s << "gauges." << name << ".direction: the " << name << " falls to " << least << " and rises to " << largest
      << " only: it points the wrong way, and peak, stiffness and what else follows from it are wrong; turn it round";
    list.push_back(s.str());
  }
}

/// A 2-D setting looks at planes through the out-of-plane axis only.
void warn_of_unseen_planes(const Scene& scene, const History& h, std::vector<std::string>& list) {
  constexpr double noticed = 3.0;  // particles
  double most = 0.0;
  std::size_t first = h.rows();
  for (std::size_t r = h.rows(); r-- > 0;) {
    const double failing = h.at(r, "failing_out_of_plane");
    most = std::max(most, failing);
    if (failing >= noticed) first = r;
  }
  if (first == h.rows()) return;
  std::ostringstream s;
  s << "setting = \"" << to_string(scene.setting) << "\": up to " << most
    << " particles would have cracked on planes inclined out of the plane, which it does not look at, from "
    << h.at(first, "time") << " s on (load " << h.at(first, "load") << " N): strengths beyond that are too high";
  if (scene.setting == Setting::plane_stress) s << "; a thick specimen is nearer to \"plane_strain\"";
  list.push_back(s.str());
}

}  // namespace

std::vector<std::string> warnings_of(const Scene& scene, const History& h, const Findings& f) {
  std::vector<std::string> list;
  warn_of_signs(h, list);
  warn_of_unseen_planes(scene, h, list);
  if (h.rows() > 1 && peak_row(h) + 1 == h.rows()) {
    list.push_back("the load was still rising at the end: the peak load is not reached");
  }
  if (f.kinetic_ratio > 0.02) {
    list.push_back("not quasi-static: kinetic energy reaches " + percent(f.kinetic_ratio) +
                   " of the internal energy before the peak; load more slowly or with a longer ramp");
  }
  if (f.kinetic_ratio_after > 0.1) {
    list.push_back("the failure is dynamic: kinetic energy reaches " + percent(f.kinetic_ratio_after) +
                   " of the internal energy after the peak; the load there includes inertia");
  }
  if (f.motion_ratio > 1.0) {
    list.push_back("brittle collapse: kinetic and viscous energy reach " + percent(f.motion_ratio) +
                   " of the external work, more than was put in until then; what follows is no quasi-static test");
  }
  constexpr double ratio_low = 0.7, ratio_high = 1.25;
  if (f.fracture_energy_ratio < ratio_low || f.fracture_energy_ratio > ratio_high) {
    list.push_back("the fracture dissipated " + percent(f.fracture_energy_ratio) + " of crack area times G: " +
                   (f.fracture_energy_ratio > 1.0 ? "shear, friction or crushing took energy as well, or the crack is "
                                                    "wider than its band (\"rve_length\")"
                                                  : "rows of particles crack side by side, or the crack has not opened "
                                                    "fully"));
  }
  if (f.alternation > 0.1) {
    list.push_back("neighbouring rows of uncracked particles alternate by " + percent(f.alternation) +
                   " of the largest opening: the crack may be in several places, a sub-lattice in each; a stronger "
                   "\"zero_energy_control\" or a smaller spacing may help");
  }
  if (f.imbalance > 0.02) {
    list.push_back("load and support differ by up to " + percent(f.imbalance) +
                   " of the peak before it: inertia carries the difference; load more slowly");
  }
  if (f.balance_error > 0.01) {
    list.push_back("the energy balance drifts by " + percent(f.balance_error) +
                   " of the external work; a smaller \"courant\" may help");
  }
  const double work = h.rows() > 0 ? h.last("energy_external") : 0.0;
  if (scene.options.damping > 0.0) {
    list.push_back("local damping of " + percent(scene.options.damping) + " is on; it took " +
                   percent(work > 0.0 ? h.last("energy_damping") / work : 0.0) + " of the external work");
  }
  if (scene.options.mass_scale > 1.0) {
    std::ostringstream s;
    s << "inertia is multiplied by " << scene.options.mass_scale
      << " (mass_scale): times and velocities of free motion are not real";
    list.push_back(s.str());
  }
  return list;
}

std::string report_of(const Findings& f) {
  std::ostringstream s;
  s.precision(4);
  s << "  peak load " << f.peak_load << " N at " << 1e6 * f.deflection_at_peak << " um, stiffness " << f.stiffness
    << " N/m\n"
    << "  dissipated over crack area times G: " << f.fracture_energy_ratio << " (crack area " << 1e6 * f.crack_area
    << " mm^2)\n";
  if (f.toughness) s << "  toughness K_I " << f.toughness->K_I << ", K_II " << f.toughness->K_II << " Pa sqrt(m)\n";
  s << "  kinetic over internal energy " << percent(f.kinetic_ratio) << " before the peak, "
    << percent(f.kinetic_ratio_after) << " after; balance error " << percent(f.balance_error) << "\n";
  return s.str();
}

std::string summary_text(const SummaryInput& in) {
  const History& h = in.result.history;
  const Findings& f = in.findings;
  const sph::Particles<2>& p = in.run.particles_now();
  Json j;
  j["scene"] = in.scene.name;
  j["version"] = FPZ_VERSION;
  j["compiler"] = __VERSION__;
  j["status"] = fpz::to_string(in.result.ending);
  j["reason"] = in.result.reason;
  j["stages"] = stages_json(in.result.stages);
  j["warnings"] = in.result.warnings;
  std::vector<std::string> doubtful = in.scene.warnings;
  doubtful.insert(doubtful.end(), in.specimen.warnings.begin(), in.specimen.warnings.end());
  j["scene_warnings"] = doubtful;
  j["units"] = "SI; forces and energies for the whole thickness";
  j["peak_load"] = number(f.peak_load);
  j["deflection_at_peak"] = number(f.deflection_at_peak);
  j["stiffness"] = number(f.stiffness);
  j["fracture_energy_ratio"] = number(f.fracture_energy_ratio);
  j["crack_area"] = number(f.crack_area);
  j["toughness_K_I"] = f.toughness ? number(f.toughness->K_I) : Json(nullptr);
  j["toughness_K_II"] = f.toughness ? number(f.toughness->K_II) : Json(nullptr);
  j["fracture_energy_G"] = f.fracture_energy;
  Json cracks = Json::array();
  for (const CrackPath& path : in.paths) {
    cracks.push_back({{"length", path.length()},
                      {"from", {path.points.front()[0], path.points.front()[1]}},
                      {"to", {path.points.back()[0], path.points.back()[1]}}});
  }
  j["cracks"] = cracks;
  j["pieces_area"] = in.pieces;
  Json slots = Json::array();
  for (std::size_t k = 0; k < in.specimen.slots.size(); ++k) {
    if (in.scene.body.notches[k].asked_width <= 0.0) continue;
    const SlotOfParticles& slot = in.specimen.slots[k];
    slots.push_back({{"notch", k}, {"width", number(slot.width)}, {"length", number(slot.length)}});
  }
  j["slots_of_particles"] = slots;
  j["alternation_over_opening"] = number(f.alternation);
  j["energies"] = energies_json(h);
  j["energy_balance_error"] = number(f.balance_error);
  j["kinetic_over_internal"] = {{"before_peak", number(f.kinetic_ratio)},
                                {"after_peak", number(f.kinetic_ratio_after)}};
  j["load_support_imbalance"] = number(f.imbalance);
  j["material"] = material_json(in.scene.material_name, in.scene.parameters);
  if (!in.scene.conversions.empty()) j["conversions"] = in.scene.conversions;
  if (!in.scene.further_materials.empty()) j["materials"] = materials_json(in.scene, in.specimen.setup);
  if (!in.scene.interfaces.empty()) j["interfaces"] = interfaces_json(in);
  if (in.scene.strength_field) j["strength_field"] = strength_json(in);
  j["setting"] = to_string(in.scene.setting);
  j["method"] = method_json(in.scene.options);
  j["solver"] = solver_json(in);
  j["spacing"] = in.scene.spacing;
  j["thickness"] = in.scene.thickness;
  j["specimen_area"] = in.specimen.area;
  j["particles"] = p.count;
  j["mean_neighbours"] = in.run.mean_neighbours();
  j["neighbour_builds"] = in.run.neighbour_builds();
  j["released_bonds"] = in.run.released_bonds();
  j["damaged_particles"] = in.run.cracked();
  j["time"] = in.run.loading_time();
  j["time_step"] = in.run.time_step();
  j["steps"] = in.run.steps();
  j["rows"] = h.rows();
  j["frames"] = in.result.frames.size();
  j["wall_seconds"] = in.result.seconds.all;
  j["stepping_seconds"] = in.result.seconds.stepping;
  j["particle_steps_per_second"] =
      in.result.seconds.stepping > 0.0
          ? Json(static_cast<double>(p.count) * static_cast<double>(in.run.steps()) / in.result.seconds.stepping)
          : Json(nullptr);
  return j.dump(2) + "\n";
}

}  // namespace fpz::specimen
