#include <nlohmann/json.hpp>

#include "fpz/driver/run.hpp"
#include "fpz/io/material_file.hpp"
#include "fpz/io/output.hpp"

namespace fpz::driver {
namespace {

using Json = nlohmann::ordered_json;

Json material_json(const Test& test) {
  Json j = {{"name", test.material_name}};
  for (const ParameterInfo<double>& p : parameter_table<double>) j[std::string(p.name)] = test.parameters.*p.member;
  io::put_choices(j, test.parameters.choices);
  if (!test.conversions.empty()) j["conversions"] = test.conversions;
  j["snap_back_length_mode1"] = snap_back_length(test.parameters, test.setting);
  return j;
}

Json by_component(const char* prefix, const std::array<double, 6>& values) {
  Json j;
  for (std::size_t c = 0; c < 6; ++c) j[prefix + std::string(component_names[c])] = values[c];
  return j;
}

Json onset_json(const std::optional<Onset>& onset) {
  if (!onset) return nullptr;
  Json j = {{"time", onset->time}, {"normal", onset->normal}, {"normal_angle_deg", onset->angle_deg}};
  j["strain"] = by_component("eps_", onset->strain);
  j["stress"] = by_component("sig_", onset->stress);
  return j;
}

Json peaks_json(const Summary& s) {
  Json j;
  for (std::size_t c = 0; c < 6; ++c) {
    j["sig_" + std::string(component_names[c])] = {{"max", s.highest[c].value},
                                                   {"max_time", s.highest[c].time},
                                                   {"min", s.lowest[c].value},
                                                   {"min_time", s.lowest[c].time}};
  }
  return j;
}

}  // namespace

std::string to_json(const Test& test, const Result& result) {
  const Summary& s = result.summary;
  Json j;
  j["test"] = test.name;
  j["version"] = FPZ_VERSION;
  j["status"] = result.status;
  if (!result.ok()) j["message"] = result.message;
  std::vector<std::string> warnings = test.warnings;
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  j["warnings"] = warnings;
  j["units"] =
      "SI: stress Pa, energy per volume J/m^3, energy per crack area J/m^2, angles in degrees; time counts stages";
  j["setting"] = to_string(test.setting);
  j["material"] = material_json(test);
  j["integrator"] = {{"method", to_string(test.options.method)}, {"tolerance", test.options.tolerance}};
  j["stages"] = test.stages.size();
  j["rows"] = result.history.size();
  j["peak_stress"] = peaks_json(s);
  j["onset"] = onset_json(s.onset);
  j["final_damage"] = s.damage;
  j["energy"] = {{"work", s.work},
                 {"stored", s.stored},
                 {"least_stored", s.least_stored.value},
                 {"dissipated", s.dissipated},
                 {"relative_balance_residual", s.energy_balance}};
  j["fracture"] = {{"work_per_area", s.fracture_work_per_area},
                   {"dissipated_per_area", s.fracture_dissipated_per_area}};
  j["counts"] = {{"updates", s.counts.updates},
                 {"iterations", s.counts.iterations},
                 {"substeps", s.counts.substeps},
                 {"halvings", s.counts.halvings}};
  j["wall_seconds"] = s.wall_seconds;
  return j.dump(2) + "\n";
}

void write_summary(const std::filesystem::path& file, const Test& test, const Result& result, bool force) {
  io::write_text(file, to_json(test, result), force);
}

std::string folder_name(const std::string& test_name) {
  std::string name = test_name;
  for (char& c : name) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    if (!plain) c = '_';
  }
  if (name.empty() || name.front() == '.') name.insert(name.begin(), '_');
  return name;
}

}  // namespace fpz::driver
