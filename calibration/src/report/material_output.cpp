#include <nlohmann/json.hpp>

#include "fpz/calibration/report.hpp"
#include "fpz/io/material_file.hpp"

namespace fpz::calibration {
namespace {

using Json = nlohmann::ordered_json;

Json fitted_json(const Calibration& all) {
  Json list = Json::object();
  const FitResult& r = all.result;
  for (std::size_t k = 0; k < all.problem.parameters.size(); ++k) {
    const FitParameter& p = all.problem.parameters[k];
    const auto i = static_cast<Eigen::Index>(k);
    if (i >= r.values.size()) break;
    Json entry = {{"value", r.values[i]}, {"unit", p.unit}};
    if (i < r.standard_error.size()) entry["standard_error"] = r.standard_error[i];
    if (i < r.correlated_error.size()) entry["correlated_error"] = r.correlated_error[i];
    if (i < r.lower_limit.size()) entry["confidence_interval"] = {r.lower_limit[i], r.upper_limit[i]};
    list[p.name] = entry;
  }
  return list;
}

Json fixed_json(const Calibration& all) {
  Json list = Json::object();
  for (std::size_t k = 0; k < parameter_info.size(); ++k) {
    const ParameterSetting& s = all.specification.parameters[k];
    if (s.fitted) continue;
    const std::string from = s.slope_of ? "initial slope of the data set \"" + *s.slope_of + '"' : s.origin;
    list[std::string(parameter_info[k].name)] = {{"value", s.value}, {"from", from}};
  }
  return list;
}

Json data_json(const Calibration& all) {
  Json list = Json::array();
  for (const DataSet& d : all.specification.data) {
    Json entry = {{"name", d.name}, {"kind", d.kind}, {"role", to_string(d.role)}};
    entry["points"] = d.measured.size();
    if (!d.file.empty()) entry["file"] = std::filesystem::path(d.file).filename().string();
    if (!d.source.empty()) entry["source"] = d.source;
    list.push_back(entry);
  }
  return list;
}

}  // namespace

std::string material_json(const Calibration& all) {
  const Specification& spec = all.specification;
  Json j;
  j["name"] = spec.material_name;
  j["source"] = "fitted by fpz-calibrate " FPZ_VERSION " to the data sets named in provenance";
  j["units"] =
      "SI: young_modulus, tensile_strength, cohesion in Pa; density in kg/m^3; angles in degrees; delta0 in m; "
      "stiffnesses in Pa/m; poisson_ratio dimensionless";
  if (!all.result.usable()) {
    j["notes"] = "NOT USABLE: " + all.result.message;
  }
  for (const auto& key : io::material_keys) j[std::string(key.name)] = all.parameters.*key.member;
  io::put_choices(j, all.parameters.choices);
  j["provenance"] = {{"program", "fpz-calibrate"},
                     {"version", FPZ_VERSION},
                     {"specification", spec.file.filename().string()},
                     {"setting", to_string(spec.setting)},
                     {"status", to_string(all.result.status)},
                     {"confidence", spec.options.confidence},
                     {"fitted", fitted_json(all)},
                     {"fixed", fixed_json(all)},
                     {"data", data_json(all)}};
  return j.dump(2) + "\n";
}

}  // namespace fpz::calibration
