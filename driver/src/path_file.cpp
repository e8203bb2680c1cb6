#include "fpz/driver/path_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "fpz/io/input_reader.hpp"
#include "fpz/io/material_file.hpp"
#include "stage_reader.hpp"

namespace fpz::driver {
namespace detail {
namespace {

using Kind = JsonValue::Kind;
using io::check_material;
using io::exact;
using io::in_quotes;
using io::Location;
using io::MaterialFile;
using io::Problems;
using io::shown;
using io::suggestion;

constexpr std::size_t longest_name = 200;
constexpr std::size_t longest_description = 4000;
constexpr double finest_scan_deg = 0.01;  // finer ones cost a minute per onset in 3-D and find nothing new
constexpr double coarsest_scan_deg = 10.0;

constexpr std::array<std::string_view, 7> test_keys = {"name",    "description", "material", "rve_length",
                                                       "setting", "integrator",  "stages"};
constexpr std::array<std::string_view, 8> file_keys = {"name",    "description", "material", "rve_length",
                                                       "setting", "integrator",  "stages",   "tests"};
constexpr std::array<std::string_view, 6> integrator_keys = {"name",         "tolerance", "max_iterations",
                                                             "max_substeps", "onset",     "preferred_normal"};
constexpr std::array<std::string_view, 1> onset_names = {"closed_form"};
constexpr std::array<std::string_view, 1> onset_keys = {"scan_degrees"};
constexpr int most_iterations = 1'000'000'000;

/// The keys of one test: its own, or those of the file where it has none.
class Scope {
 public:
  explicit Scope(const Place& file) : test_(file), file_(file) {}
  Scope(const Place& test, const Place& file) : test_(test), file_(file) {}

  [[nodiscard]] const Place& test() const { return test_; }

  [[nodiscard]] std::optional<Place> find(std::string_view key) const {
    if (const JsonValue* own = test_.value().find(key)) return Place(test_, *own);
    if (const JsonValue* common = file_.value().find(key)) return Place(file_, *common);
    return std::nullopt;
  }

 private:
  const Place& test_;
  const Place& file_;
};

bool is_short_text(const JsonValue* v) { return v != nullptr && v->is(Kind::string) && v->text.size() <= longest_name; }

class FileReader {
 public:
  FileReader(const std::filesystem::path& origin, const Limits& limits)
      : origin_(origin), limits_(limits), problems_(limits.problems), reader_(origin.string(), limits, problems_) {}

  std::vector<Test> read(std::string_view text) {
    JsonValue root;
    std::vector<Test> tests;
    if (parse_json(text, reader_.file(), reader_.limits(), problems_, root)) {
      const Place place(root);
      if (reader_.object(place, "the keys of a path file")) tests = read_root(place);
    }
    problems_.throw_if_any();
    return tests;
  }

 private:
  std::vector<Test> read_root(const Place& root) {
    reader_.known_keys(root, file_keys);
    std::vector<Test> tests;
    const JsonValue* list = root.value().find("tests");
    if (list == nullptr) {
      tests.push_back(read_test(Scope(root), origin_.stem().string()));
    } else {
      read_tests(root, Place(root, *list), tests);
    }
    if (problems_.empty()) expand(tests);
    return tests;
  }

  void read_tests(const Place& root, const Place& list, std::vector<Test>& tests) {
    if (!reader_.array(list, "tests")) return;
    if (list.value().items.size() > limits_.tests) {
      reader_.problem(list, "more than " + std::to_string(limits_.tests) + " tests");
      return;
    }
    refuse_unused(root, list);
    std::string base = origin_.stem().string();
    if (const JsonValue* name = root.value().find("name"); is_short_text(name)) base = name->text;
    std::map<std::string, std::size_t> names;
    for (const JsonValue& item : list.value().items) {
      const Place place(list, item);
      if (!item.is(Kind::object)) {  // an empty one inherits everything
        reader_.problem(place, "expected an object with the keys of a test, found " + item.description());
        continue;
      }
      reader_.known_keys(place, test_keys);
      tests.push_back(
          read_test(Scope(place, root), base + '_' + std::to_string(&item - list.value().items.data() + 1)));
      // Results of tests with one name would overwrite each other, on some file systems whatever the letter case.
      const auto [other, is_new] = names.emplace(io::lower_case(tests.back().name), names.size());
      if (!is_new) reader_.problem(place, "two tests with the name " + in_quotes(tests.back().name));
    }
  }

  /// A value that no test inherits is never looked at; a person who changes it would wait for an effect.
  void refuse_unused(const Place& root, const Place& list) {
    for (const std::string_view key : test_keys) {
      const JsonValue* value = root.value().find(key);
      if (value == nullptr || key == "name" || key == "description") continue;
      const bool used = std::any_of(list.value().items.begin(), list.value().items.end(),
                                    [key](const JsonValue& test) { return test.find(key) == nullptr; });
      if (!used) reader_.problem(Place(root, *value), "is not used: every test has its own");
    }
  }

  Test read_test(const Scope& scope, std::string default_name) {
    Test test;
    test.name = read_name(scope, std::move(default_name));
    if (const auto at = scope.find("description")) {
      test.description = reader_.text(*at, longest_description).value_or("");
    }
    const std::optional<Setting> setting = read_setting(scope);
    test.setting = setting.value_or(Setting::plane_strain);
    read_parameters(scope, test);
    if (const auto at = required(scope, "integrator")) {
      test.options = read_integrator(*at, setting);
      const std::string why = why_unfit(test.options.method, test.parameters.choices);
      if (!why.empty()) reader_.problem(*at, why);
    }
    // With an unknown setting all components pass, so that its correction does not bring up false complaints.
    if (const auto at = required(scope, "stages")) stages_of(*at, setting.value_or(Setting::three_d));
    return test;
  }

  std::optional<Place> required(const Scope& scope, std::string_view key) {
    std::optional<Place> at = scope.find(key);
    if (!at) reader_.problem(scope.test(), "missing key " + in_quotes(key));
    return at;
  }

  std::string read_name(const Scope& scope, std::string default_name) {
    if (default_name.empty()) default_name = "test";
    const std::optional<Place> at = scope.find("name");
    if (!at) return default_name;
    const std::optional<std::string> name = reader_.text(*at, longest_name);
    const bool own = scope.test().value().find("name") != nullptr;
    return name && own ? *name : default_name;
  }

  std::optional<Setting> read_setting(const Scope& scope) {
    const std::optional<Place> at = required(scope, "setting");
    if (!at) return std::nullopt;
    const std::optional<std::string> name = reader_.text(*at, longest_name);
    if (!name) return std::nullopt;
    const std::optional<Setting> setting = from_word<Setting>(*name);
    if (!setting) reader_.problem(*at, "unknown setting " + in_quotes(*name) + suggestion(*name, word_list<Setting>));
    return setting;
  }

  void read_parameters(const Scope& scope, Test& test) {
    std::optional<Location> length_at;
    double length = 0.0;
    if (const auto at = required(scope, "rve_length")) {
      if (const auto x = reader_.positive(*at)) {
        length = *x;
        length_at = Location{reader_.file(), at->line(), at->path()};
      }
    }
    const std::optional<Place> at = required(scope, "material");
    if (!at) return;
    const std::optional<MaterialFile>& material = material_of(*at);
    if (!material) return;
    test.parameters = material->parameters;
    test.parameters.rve_length = length;
    test.material_name = material->name;
    test.conversions = material->conversions;
    test.warnings = check_material(*material, test.parameters, test.setting, length_at, problems_);
  }

  /// Each material is read once, however many tests use it.
  const std::optional<MaterialFile>& material_of(const Place& place) {
    const JsonValue* key = &place.value();
    const auto known = materials_.find(key);
    if (known != materials_.end()) return known->second;
    std::optional<MaterialFile> material =
        io::material_at(reader_, place, [this](const Place& name) { return material_from_file(name); });
    return materials_.emplace(key, std::move(material)).first->second;
  }

  std::optional<MaterialFile> material_from_file(const Place& place) {
    const std::string key = place.value().text;
    const auto known = files_.find(key);
    if (known != files_.end()) return known->second;
    return files_.emplace(key, io::load_named_material(reader_, place, origin_.parent_path())).first->second;
  }

  Options read_integrator(const Place& place, std::optional<Setting> setting) {
    Options o;
    if (!reader_.object(place, "\"name\" and \"tolerance\"")) return o;
    reader_.known_keys(place, integrator_keys);
    const std::optional<Method> method = read_method(place);
    o.method = method.value_or(o.method);
    const JsonValue* tolerance = place.value().find("tolerance");
    if (tolerance != nullptr) {
      o.tolerance = reader_.number_between(Place(place, *tolerance), 0.0, 1.0).value_or(o.tolerance);
    } else if (method && *method != Method::implicit) {
      reader_.problem(place, "missing key \"tolerance\"");
    }
    if (const JsonValue* v = place.value().find("max_iterations")) {
      o.max_iterations = reader_.integer(Place(place, *v), 1, most_iterations).value_or(1);
    }
    if (const JsonValue* v = place.value().find("max_substeps")) {
      o.max_substeps = reader_.integer(Place(place, *v), 1, most_iterations).value_or(1);
    }
    if (const JsonValue* v = place.value().find("onset")) read_onset(Place(place, *v), o);
    if (const JsonValue* v = place.value().find("preferred_normal")) read_normal(Place(place, *v), setting, o);
    return o;
  }

  std::optional<Method> read_method(const Place& integrator) {
    const JsonValue* v = reader_.required(integrator, "name");
    if (v == nullptr) return std::nullopt;
    const Place place(integrator, *v);
    const std::optional<std::string> name = reader_.text(place, longest_name);
    if (!name) return std::nullopt;
    const std::optional<Method> method = from_word<Method>(*name);
    if (!method)
      reader_.problem(place, "unknown integrator " + in_quotes(*name) + suggestion(*name, word_list<Method>));
    return method;
  }

  void read_onset(const Place& place, Options& o) {
    if (place.value().is(Kind::string)) {
      const std::string& name = place.value().text;
      if (name == "closed_form") return;
      reader_.problem(place, "unknown onset " + in_quotes(name) + suggestion(name, onset_names) +
                                 "; for a scan give {\"scan_degrees\": 1.0}");
      return;
    }
    if (!place.value().is(Kind::object)) {
      reader_.problem(place,
                      "expected \"closed_form\" or {\"scan_degrees\": 1.0}, found " + place.value().description());
      return;
    }
    reader_.known_keys(place, onset_keys);
    const JsonValue* v = reader_.required(place, "scan_degrees");
    if (v == nullptr) return;
    o.scan_resolution_deg =
        reader_.number_between(Place(place, *v), finest_scan_deg, coarsest_scan_deg, true).value_or(0.0);
  }

  void read_normal(const Place& place, std::optional<Setting> setting, Options& o) {
    if (!reader_.array(place, "numbers")) return;
    const std::vector<JsonValue>& items = place.value().items;
    const std::size_t wanted = setting == Setting::three_d ? 3 : 2;
    const bool fits = setting ? items.size() == wanted : items.size() == 2 || items.size() == 3;
    if (!fits) {
      reader_.problem(place, "has " + std::to_string(items.size()) + " components; needs " +
                                 (setting ? std::to_string(wanted) + " in " + to_string(*setting) : "2 or 3"));
      return;
    }
    const std::size_t before = problems_.size();
    for (std::size_t k = 0; k < items.size(); ++k) {
      o.preferred_normal[static_cast<Eigen::Index>(k)] = reader_.number(Place(place, items[k])).value_or(0.0);
    }
    if (problems_.size() != before) return;
    const double largest = o.preferred_normal.lpNorm<Eigen::Infinity>();
    if (largest == 0.0) {
      reader_.problem(place, "is zero; a direction is needed");
    } else {
      // Only the direction counts; products of very large or small numbers must not spoil it.
      o.preferred_normal = (o.preferred_normal / largest).normalized().eval();
    }
  }

  using StageKey = std::pair<const JsonValue*, Setting>;

  /// Inherited stages are read once per setting.
  void stages_of(const Place& place, Setting setting) {
    const StageKey key{&place.value(), setting};
    auto known = stages_.find(key);
    if (known == stages_.end()) known = stages_.emplace(key, read_stages(reader_, place, setting)).first;
    used_stages_.emplace_back(place.line(), place.path(), &known->second);
  }

  struct UsedStages {
    UsedStages(std::size_t l, std::string p, const std::optional<std::vector<StageEntry>>* e)
        : line(l), path(std::move(p)), entries(e) {}
    std::size_t line;
    std::string path;
    const std::optional<std::vector<StageEntry>>* entries;
  };

  /// Expands the repetitions of all tests, whose number is bounded first: a few nested ones ask for any amount of
  /// memory.
  void expand(std::vector<Test>& tests) {
    StageCount total;
    for (const UsedStages& used : used_stages_) {
      const StageCount count = count_stages(**used.entries);
      total.stages += count.stages;
      total.increments += count.increments;
      if (total.stages > limits_.stages) return refuse_excess(used, "stages", limits_.stages);
      if (total.increments > limits_.increments) {
        return refuse_excess(used, "increments", limits_.increments);
      }
    }
    for (std::size_t k = 0; k < tests.size(); ++k) expand_stages(**used_stages_[k].entries, tests[k].stages);
  }

  void refuse_excess(const UsedStages& used, const std::string& what, double most) {
    problems_.add(reader_.file(), used.line,
                  used.path + ": with repetitions the file has more than " + exact(most) + ' ' + what);
  }

  const std::filesystem::path& origin_;
  const Limits& limits_;
  Problems problems_;
  InputReader reader_;
  std::map<const JsonValue*, std::optional<MaterialFile>> materials_;
  std::map<std::string, std::optional<MaterialFile>> files_;
  std::map<StageKey, std::optional<std::vector<StageEntry>>> stages_;
  std::vector<UsedStages> used_stages_;  ///< of each test, in order, when there is no problem
};

}  // namespace
}  // namespace detail

PathFile parse_path_file(std::string_view text, const std::filesystem::path& origin, const Limits& limits) {
  return {origin, detail::FileReader(origin, limits).read(text)};
}

PathFile read_path_file(const std::filesystem::path& file) {
  const Limits limits;
  std::string text;
  std::string error;
  if (!io::load_text(file, io::FileKind::any, limits, text, error)) {
    throw InputError(file.string() + ": cannot read path file: " + error);
  }
  return parse_path_file(text, file, limits);
}

}  // namespace fpz::driver
