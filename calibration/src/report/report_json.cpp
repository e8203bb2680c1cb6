#include <nlohmann/json.hpp>

#include "fpz/calibration/report.hpp"

namespace fpz::calibration {
namespace {

using Json = nlohmann::ordered_json;  // NaN and infinity become null

Json list(const Eigen::VectorXd& v) { return std::vector<double>(v.data(), v.data() + v.size()); }

Json matrix(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) rows.push_back(list(m.row(i).transpose()));
  return rows;
}

Json value_or_null(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

bool contains(const std::vector<int>& indices, std::size_t k) {
  for (const int i : indices) {
    if (static_cast<std::size_t>(i) == k) return true;
  }
  return false;
}

Json parameter_json(const Calibration& all, std::size_t k) {
  const FitResult& r = all.result;
  const FitParameter& p = all.problem.parameters[k];
  const auto i = static_cast<Eigen::Index>(k);
  const auto entry = [i](const Eigen::VectorXd& v) { return i < v.size() ? Json(v[i]) : Json(nullptr); };
  Json j = {{"name", p.name},
            {"symbol", p.symbol},
            {"unit", p.unit},
            {"value", entry(r.values)},
            {"standard_error", entry(r.standard_error)},
            {"correlated_error", entry(r.correlated_error)},
            {"lower_limit", entry(r.lower_limit)},
            {"upper_limit", entry(r.upper_limit)},
            {"start", p.start},
            {"lower_bound", p.lower},
            {"upper_bound", p.upper},
            {"at_bound", contains(r.at_lower_bound, k)   ? Json("lower")
                         : contains(r.at_upper_bound, k) ? Json("upper")
                                                         : Json(nullptr)}};
  j["prior"] = p.prior ? Json{{"mean", p.prior->mean}, {"deviation", p.prior->deviation}} : Json(nullptr);
  return j;
}

Json fixed_json(const Calibration& all) {
  Json fixed = Json::array();
  for (std::size_t k = 0; k < parameter_info.size(); ++k) {
    const ParameterSetting& s = all.specification.parameters[k];
    if (s.fitted) continue;
    Json j = {{"name", parameter_info[k].name}, {"unit", parameter_info[k].unit}, {"value", s.value}};
    if (s.from_slope) {
      j["from"] = "initial slope of \"" + *s.slope_of + '"';
      j["standard_error"] = s.from_slope->standard_error;
      j["notes"] = s.from_slope->words;
    } else {
      j["from"] = s.origin;
    }
    fixed.push_back(j);
  }
  fixed.push_back({{"name", "density"}, {"unit", "kg/m^3"}, {"value", all.specification.density}});
  return fixed;
}

Json law_json(const SizeEffectLaw& law) {
  if (!law.ok()) return {{"failure", law.failure}};
  return {{"failure", nullptr},
          {"G_f", law.energy},
          {"G_f_standard_error", law.energy_error},
          {"c_f", law.length},
          {"c_f_standard_error", law.length_error},
          {"correlation", law.correlation},
          {"load", list(law.load)}};
}

Json size_effect_json(const SizeEffect& e) {
  Json points = Json::array();
  for (const SizeEffectPoint& p : e.points) {
    points.push_back({{"size", p.size},
                      {"k", p.geometry.k},
                      {"k_slope", p.geometry.slope},
                      {"k_from", p.geometry.source},
                      {"nominal_stress", p.stress},
                      {"model_nominal_stress", p.model_stress},
                      {"apparent_toughness", p.toughness},
                      {"model_apparent_toughness", p.model_toughness}});
  }
  return {{"plane_modulus", e.plane_modulus},
          {"toughness", e.toughness},
          {"total_energy", e.total_energy},
          {"initial_energy", e.initial_energy},
          {"similar", e.similar},
          {"law", law_json(e.law)},
          {"law_of_model", law_json(e.of_model)},
          {"points", points},
          {"curve", {{"size", e.curve.size}, {"model_nominal_stress", e.curve.model_stress}}}};
}

Json data_set_json(const Calibration& all, const Comparison& c, const DataSetResult* result) {
  const DataSet& set = all.specification.data[c.data_set];
  Json j = {{"name", set.name},
            {"kind", set.kind},
            {"role", to_string(set.role)},
            {"file", set.file.empty() ? Json(nullptr) : Json(set.file)},
            {"source", set.source.empty() ? Json(nullptr) : Json(set.source)},
            {"points", set.measured.size()},
            {"weight", set.weight},
            {"deviation_from", set.deviation_words},
            {"deviation_known", set.deviation_known},
            {"failure", c.ok() ? Json(nullptr) : Json(c.failure)}};
  if (!set.is_curve()) j["labels"] = set.labels;
  j["abscissa"] = list(set.abscissa);
  j["measured"] = list(set.measured);
  if (!c.ok()) return j;
  j["deviation"] = list(c.deviation);
  j["predicted"] = list(c.predicted);
  j["band"] = list(c.band);
  j["residuals"] = list(c.residuals);
  j["measured_peak"] = c.measured_peak;
  j["predicted_peak"] = c.predicted_peak;
  j["peak_error"] = c.peak_error;
  j["rms_over_peak"] = c.rms_over_peak;
  if (c.size_effect) j["size_effect"] = size_effect_json(*c.size_effect);
  if (result == nullptr) return j;
  j["standardised"] = list(result->standardised);
  j["noise_factor"] = result->noise_factor;
  j["root_mean_square"] = result->root_mean_square;
  j["reduced_chi_squared"] = result->reduced_chi_squared;
  j["autocorrelation"] = result->autocorrelation;
  j["effective_points"] = result->effective_points;
  return j;
}

Json data_json(const Calibration& all) {
  Json sets = Json::array();
  std::size_t next = 0;
  for (const Comparison& c : all.comparisons) {
    const bool fitted = all.specification.data[c.data_set].role == Role::fit;
    const DataSetResult* result = fitted && next < all.result.data.size() ? &all.result.data[next++] : nullptr;
    sets.push_back(data_set_json(all, c, result));
  }
  return sets;
}

Json starts_json(const FitResult& r) {
  Json starts = Json::array();
  for (const StartResult& s : r.starts) {
    starts.push_back({{"start", list(s.start)},
                      {"end", list(s.end)},
                      {"cost", s.cost},
                      {"converged", s.converged},
                      {"iterations", s.iterations},
                      {"message", s.message}});
  }
  return starts;
}

Json profiles_json(const Calibration& all) {
  Json profiles = Json::array();
  for (const Profile& p : all.result.profiles) {
    profiles.push_back({{"parameter", all.problem.parameters[static_cast<std::size_t>(p.parameter)].name},
                        {"values", list(p.values)},
                        {"excess", list(p.excess)},
                        {"threshold", p.threshold},
                        {"lower", value_or_null(p.lower)},
                        {"upper", value_or_null(p.upper)}});
  }
  return profiles;
}

Json scenes_json(const SceneFitSummary& s) {
  return {{"parameter_sets_run", s.runs}, {"used_by_the_surface", s.used}, {"failed", s.failed},
          {"rounds", s.rounds},           {"relative_scatter", s.scatter}, {"standard_error_from_runs", list(s.error)},
          {"progress", s.words}};
}

Json energies_json(const TwoEnergies& e) {
  Json freed = Json::array();
  for (const FreedParameter& f : e.freed) {
    freed.push_back({{"parameter", info(f.range.parameter).name},
                     {"lower", f.range.lower},
                     {"upper", f.range.upper},
                     {"value", value_or_null(f.match.value)},
                     {"least_energy", f.match.least},
                     {"largest_energy", f.match.largest},
                     {"sensitivity", f.sensitivity},
                     {"delta0", value_or_null(f.delta0)},
                     {"words", f.words}});
  }
  return {{"failure", e.ok() ? Json(nullptr) : Json(e.failure)},
          {"delta0_from_mode_one", e.delta0_one},
          {"delta0_from_mode_two", e.delta0_two},
          {"mode_two_energy_at_delta0_from_mode_one", e.two_at_one},
          {"mode_one_energy_at_delta0_from_mode_two", e.one_at_two},
          {"consistent", e.consistent},
          {"freed", freed},
          {"statements", e.statements}};
}

}  // namespace

std::string report_json(const Calibration& all) {
  const FitResult& r = all.result;
  Json j;
  j["name"] = all.specification.name;
  j["description"] = all.specification.description;
  j["program"] = "fpz-calibrate";
  j["version"] = FPZ_VERSION;
  j["specification"] = all.specification.file.filename().string();
  j["units"] = "SI; angles in degrees; compressive strengths positive";
  j["status"] = to_string(r.status);
  j["usable"] = r.usable();
  j["message"] = r.message;
  j["setting"] = to_string(all.specification.setting);
  j["confidence"] = all.specification.options.confidence;
  j["seed"] = all.specification.options.seed;
  j["parameters"] = Json::array();
  for (std::size_t k = 0; k < all.problem.parameters.size(); ++k) j["parameters"].push_back(parameter_json(all, k));
  j["fixed"] = fixed_json(all);
  j["derived"] = Json::array();
  for (const Derived& d : all.derived) {
    j["derived"].push_back({{"name", d.name},
                            {"symbol", d.symbol},
                            {"unit", d.unit},
                            {"value", d.value},
                            {"standard_error", d.standard_error}});
  }
  j["reference_values"] = Json::array();
  for (const ReferenceComparison& c : all.references) {
    j["reference_values"].push_back({{"parameter", c.reference.parameter},
                                     {"value", c.reference.value},
                                     {"source", c.reference.source},
                                     {"fitted", c.fitted},
                                     {"relative_difference", c.relative}});
  }
  j["cost"] = r.cost;
  j["degrees_of_freedom"] = r.degrees_of_freedom;
  j["covariance"] = matrix(r.covariance);
  j["correlation"] = matrix(r.correlation);
  j["singular_values"] = list(r.singular_values);
  j["undetermined"] = Json::array();
  for (const UndeterminedDirection& d : r.undetermined) {
    j["undetermined"].push_back(
        {{"singular_value", d.singular_value}, {"direction", list(d.direction)}, {"words", d.words}});
  }
  j["data"] = data_json(all);
  j["starts"] = starts_json(r);
  j["distinct_minima"] = r.distinct_minima;
  j["profiles"] = profiles_json(all);
  j["scene_runs"] = all.scenes ? scenes_json(*all.scenes) : Json(nullptr);
  j["conversions"] = all.specification.conversions;
  j["fracture_energies"] = all.energies ? energies_json(*all.energies) : Json(nullptr);
  j["warnings"] = all.warnings;
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fpz::calibration
