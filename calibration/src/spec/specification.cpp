#include "fpz/calibration/specification.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "data_set_reader.hpp"
#include "fpz/driver/run.hpp"
#include "parameter_reader.hpp"

namespace fpz::calibration {
namespace detail {
namespace {

using io::Problems;

constexpr std::size_t longest_name = 200;
constexpr std::size_t longest_text = 4000;
constexpr std::array<std::string_view, 11> file_keys = {
    "name", "description", "source",  "setting", "material",        "parameters",
    "fit",  "data",        "options", "notes",   "reference_values"};
constexpr std::array<std::string_view, 6> option_keys = {"starts",   "seed",           "confidence",
                                                         "profiles", "profile_points", "max_iterations"};
constexpr std::array<std::string_view, 3> reference_keys = {"value", "unit", "source"};

class SpecificationReader {
 public:
  SpecificationReader(const std::filesystem::path& origin, const io::ReadLimits& limits)
      : origin_(origin), problems_(limits.problems), reader_(origin.string(), limits, problems_) {}

  Specification read(std::string_view text) {
    Specification spec;
    spec.file = origin_;
    JsonValue root;
    if (parse_json(text, reader_.file(), reader_.limits(), problems_, root)) {
      const Place place(root);
      if (reader_.object(place, "the keys of a specification")) read_root(place, spec);
    }
    problems_.throw_if_any();
    spec.warnings = std::move(warnings_);
    return spec;
  }

 private:
  void read_root(const Place& root, Specification& spec) {
    reader_.known_keys(root, file_keys);
    const auto text = [&](std::string_view key, std::size_t longest, std::string otherwise) {
      const JsonValue* v = root.value().find(key);
      return v != nullptr ? reader_.text(Place(root, *v), longest).value_or(otherwise) : otherwise;
    };
    const std::string stem = origin_.stem().string();
    spec.name = text("name", longest_name, stem.empty() ? "calibration" : stem);
    spec.description = text("description", longest_text, "");
    (void)text("source", longest_text, "");
    (void)text("notes", longest_text, "");
    spec.material_name = spec.name;
    if (const JsonValue* v = root.value().find("setting")) {
      const auto plane = {Setting::plane_strain, Setting::plane_stress};
      spec.setting = read_word<Setting>(context_, Place(root, *v), "setting", plane).value_or(spec.setting);
    }
    const std::filesystem::path folder = origin_.parent_path();
    const ParameterEntries entries = read_parameters(context_, folder, root, spec);
    if (problems_.empty()) check_start(context_, spec, entries);
    read_data(root, folder, spec);
    if (const JsonValue* v = root.value().find("options")) read_options(Place(root, *v), spec);
    if (const JsonValue* v = root.value().find("reference_values")) read_references(Place(root, *v), spec);
    if (!problems_.empty()) return;
    resolve_slope(entries, spec);
    check_whole(root, spec);
    read_profiles(root, spec);
  }

  void read_data(const Place& root, const std::filesystem::path& folder, Specification& spec) {
    const JsonValue* list = reader_.required(root, "data");
    if (list == nullptr) return;
    const Place at(root, *list);
    if (!reader_.array(at, "data sets")) return;
    std::set<std::string> folders;
    for (const JsonValue& item : list->items) {
      const Place place(at, item);
      std::optional<DataSet> set = read_data_set({context_, folder, spec.setting}, place);
      if (!set) continue;
      // Files are named after the sets, on some file systems whatever the letter case.
      if (!folders.insert(io::lower_case(driver::folder_name(set->name))).second) {
        reader_.problem(place, "two data sets would share the file name " + io::in_quotes(set->name));
      }
      spec.data.push_back(std::move(*set));
    }
  }

  void read_options(const Place& at, Specification& spec) {
    if (!reader_.object(at, "options of the fit")) return;
    reader_.known_keys(at, option_keys);
    FitOptions& o = spec.options;
    const auto integer = [&](std::string_view key, int lower, int upper, int& target) {
      if (const JsonValue* v = at.value().find(key)) {
        target = reader_.integer(Place(at, *v), lower, upper).value_or(target);
      }
    };
    int seed = static_cast<int>(o.seed);
    integer("starts", 1, 1000, o.starts);
    integer("seed", 0, 2'000'000'000, seed);
    integer("max_iterations", 1, 100'000, o.max_iterations);
    integer("profile_points", 5, 201, o.profile_points);
    o.seed = static_cast<std::uint64_t>(seed);
    if (const JsonValue* v = at.value().find("confidence")) {
      o.confidence = reader_.number_between(Place(at, *v), 0.5, 0.9999, true).value_or(o.confidence);
    }
  }

  void read_references(const Place& at, Specification& spec) {
    if (!reader_.object(at, "values per parameter")) return;
    std::vector<std::string_view> names;
    for (const ParameterInfo<double>& p : parameter_info) names.push_back(p.name);
    reader_.known_keys(at, names);
    for (const JsonValue& member : at.value().items) {
      const auto index = parameter_index(member.key);
      if (!index) continue;
      const Place place(at, member);
      const Typical typical = typical_parameter(member.key);
      const auto x = read_written(context_, place, typical.quantity, {"source"});
      if (!x) continue;
      context_.judge(place, member.key, *x, typical);
      ReferenceValue reference{member.key, x->si, ""};
      if (member.is(JsonValue::Kind::object)) {
        if (const JsonValue* v = member.find("source")) {
          reference.source = reader_.text(Place(place, *v), longest_text).value_or("");
        }
      }
      spec.references.push_back(std::move(reference));
    }
  }

  void resolve_slope(const ParameterEntries& entries, Specification& spec) {
    ParameterSetting& e = spec.parameters[static_cast<std::size_t>(Parameter::young_modulus)];
    if (!entries.slope || !e.slope_of) return;
    const io::Location& at = entries.slope->at;
    const auto problem = [&](const std::string& text) {
      problems_.add(at.file, at.line, at.path + ".from_initial_slope: " + text);
    };
    const auto named = [&](const DataSet& d) { return d.name == *e.slope_of; };
    const auto set = std::find_if(spec.data.begin(), spec.data.end(), named);
    if (set == spec.data.end()) {
      std::vector<std::string_view> names;
      for (const DataSet& d : spec.data) names.push_back(d.name);
      return problem("no data set " + io::in_quotes(*e.slope_of) + io::suggestion(*e.slope_of, names));
    }
    const std::optional<ModulusEstimate> estimate =
        std::visit([&](const auto& test) { return modulus_from_slope(test, set->measured, spec.start()); }, set->test);
    if (!estimate) return problem("a data set of kind \"" + set->kind + "\" has no initial slope");
    const ModulusEstimate& modulus = *estimate;
    if (!modulus.failure.empty()) return problem(modulus.failure);
    const Typical typical = typical_parameter("young_modulus");
    const Judgement j = judge("the modulus from the initial slope of \"" + set->name + '"',
                              {modulus.value, modulus.value, si_unit(typical.quantity)}, typical);
    if (j.verdict == Verdict::impossible) return problem(j.text + "; check the units of load and displacement");
    if (j.verdict == Verdict::doubtful) warnings_.push_back(at.file + ':' + std::to_string(at.line) + ": " + j.text);
    if (e.fitted) {
      // Bounds that the specification gives are kept, default ones follow the start.
      const auto old = default_bounds(Parameter::young_modulus, e.value);
      const auto now = default_bounds(Parameter::young_modulus, modulus.value);
      if (e.lower == old.first) e.lower = now.first;
      if (e.upper == old.second) e.upper = now.second;
      if (modulus.value < e.lower || modulus.value > e.upper) {
        return problem("the modulus from the slope, " + io::exact(modulus.value) + " Pa, is outside the bounds");
      }
    }
    e.value = modulus.value;
    e.from_slope = modulus;
    if (!entries.slope->as_prior) return;
    if (!(modulus.standard_error > 0.0)) return problem("the slope has no scatter; it cannot serve as a prior");
    e.prior = Prior{modulus.value, modulus.standard_error};
  }

  void check_whole(const Place& root, const Specification& spec) {
    const auto fitted = [](const ParameterSetting& p) { return p.fitted; };
    const bool any = std::any_of(spec.parameters.begin(), spec.parameters.end(), fitted);
    const auto takes_part = [](const DataSet& d) { return d.role == Role::fit; };
    if (!any) reader_.problem(root, "nothing is to be fitted; name parameters in \"fit\", e.g. [\"delta0\"]");
    if (std::none_of(spec.data.begin(), spec.data.end(), takes_part)) {
      reader_.problem(root, "every data set has the role \"predict\"; at least one must be fitted");
    }
  }

  /// Names of fitted parameters, nuisances included; delta0 by default.
  void read_profiles(const Place& root, Specification& spec) {
    std::vector<std::string> fitted;
    for (std::size_t k = 0; k < parameter_info.size(); ++k) {
      if (spec.parameters[k].fitted) fitted.emplace_back(parameter_info[k].name);
    }
    for (const DataSet& set : spec.data) {
      if (set.role != Role::fit) continue;
      for (const FitParameter& n : set.nuisances) fitted.push_back(n.name);
    }
    const JsonValue* options = root.value().find("options");
    const JsonValue* list = options != nullptr ? options->find("profiles") : nullptr;
    if (list == nullptr) {
      if (spec[Parameter::delta0].fitted) spec.profiles.emplace_back("delta0");
      return;
    }
    const Place parent(root, *options);
    const Place at(parent, *list);
    if (!list->is(JsonValue::Kind::array)) {
      reader_.problem(at, "expected an array of parameter names, found " + list->description());
      return;
    }
    const std::vector<std::string_view> names(fitted.begin(), fitted.end());
    for (const JsonValue& item : list->items) {
      const Place place(at, item);
      const auto name = reader_.text(place, longest_name);
      if (!name) continue;
      if (std::find(fitted.begin(), fitted.end(), *name) == fitted.end()) {
        reader_.problem(place, io::in_quotes(*name) + " is not fitted" + io::suggestion(*name, names));
      } else if (std::find(spec.profiles.begin(), spec.profiles.end(), *name) == spec.profiles.end()) {
        spec.profiles.push_back(*name);
      }
    }
  }

  const std::filesystem::path& origin_;
  Problems problems_;
  InputReader reader_;
  std::vector<std::string> warnings_;
  Context context_{reader_, warnings_};
};

}  // namespace
}  // namespace detail

Parameters Specification::start() const {
  Parameters p;
  p.density = density;
  p.choices = choices;
  for (std::size_t k = 0; k < parameter_info.size(); ++k) p.*parameter_info[k].member = parameters[k].value;
  return p;
}

Specification parse_specification(std::string_view text, const std::filesystem::path& origin,
                                  const io::ReadLimits& limits) {
  return detail::SpecificationReader(origin, limits).read(text);
}

Specification read_specification(const std::filesystem::path& file) {
  const io::ReadLimits limits;
  std::string text;
  std::string error;
  if (!io::load_text(file, io::FileKind::any, limits, text, error)) {
    throw io::InputError(file.string() + ": cannot read specification: " + error);
  }
  return parse_specification(text, file, limits);
}

}  // namespace fpz::calibration
