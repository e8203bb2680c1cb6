#include "stage_reader.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "fpz/driver/history.hpp"

namespace fpz::driver::detail {
namespace {

constexpr int most_increments = 1'000'000'000;
constexpr int most_repetitions = 1'000'000;
constexpr std::size_t longest_name = 80;

constexpr std::array<std::string_view, 9> stage_keys = {
    "increments", "automatic", "strain_increment", "strain", "stress", "constraints", "stop", "jump_control", "name"};
constexpr std::array<std::string_view, 3> repetition_keys = {"repeat", "stages", "name"};
constexpr std::array<std::string_view, 2> automatic_keys = {"tolerance", "increments"};
constexpr std::array<std::string_view, 1> jump_keys = {"increment"};
constexpr std::array<std::string_view, 3> constraint_keys = {"strain", "stress", "value"};
constexpr std::array<std::string_view, 3> plane_components = {"xx", "yy", "xy"};

std::span<const std::string_view> components_of(Setting setting) {
  if (setting == Setting::three_d) return component_names;
  return plane_components;
}

int component_index(std::string_view name) {
  const auto at = std::find(component_names.begin(), component_names.end(), name);
  return at == component_names.end() ? -1 : static_cast<int>(at - component_names.begin());
}

/// Which components a stage prescribes, frees or leaves alone.
struct Usage {
  std::array<std::string, 6> controlled_by;  ///< path of the control, empty for none
  std::array<bool, 6> in_constraint{};
};

class StageReader {
 public:
  StageReader(const InputReader& reader, Setting setting) : reader_(reader), setting_(setting) {}

  std::vector<StageEntry> entries(const Place& place) {
    std::vector<StageEntry> list;
    if (!reader_.array(place, "stages")) return list;
    for (const JsonValue& item : place.value().items) list.push_back(entry(Place(place, item)));
    return list;
  }

 private:
  StageEntry entry(const Place& place) {
    StageEntry e;
    if (!reader_.object(place, "the keys of a stage")) return e;
    const bool repeats = place.value().find("repeat") != nullptr || place.value().find("stages") != nullptr;
    if (!repeats) {
      e.stage = stage(place);
      return e;
    }
    reader_.known_keys(place, repetition_keys);
    if (const JsonValue* v = place.value().find("name")) (void)reader_.text(Place(place, *v), longest_name);
    if (const JsonValue* v = reader_.required(place, "repeat")) {
      e.repeat = reader_.integer(Place(place, *v), 1, most_repetitions).value_or(1);
    }
    if (const JsonValue* v = reader_.required(place, "stages")) e.entries = entries(Place(place, *v));
    return e;
  }

  Stage stage(const Place& place) {
    Stage s;
    reader_.known_keys(place, stage_keys);
    if (const JsonValue* v = place.value().find("name")) {
      s.name = reader_.text(Place(place, *v), longest_name).value_or("");
    }
    steps(place, s);
    Usage usage;
    controls(place, s, usage);
    if (const JsonValue* v = place.value().find("constraints")) constraints(Place(place, *v), s, usage);
    if (const JsonValue* v = place.value().find("stop")) stop(Place(place, *v), s);
    if (const JsonValue* v = place.value().find("jump_control")) jump(Place(place, *v), s);
    return s;
  }

  void steps(const Place& place, Stage& s) {
    const JsonValue* fixed = place.value().find("increments");
    const JsonValue* automatic = place.value().find("automatic");
    if (fixed == nullptr && automatic == nullptr) {
      reader_.problem(place, "missing key \"increments\" (or \"automatic\")");
    } else if (fixed != nullptr && automatic != nullptr) {
      reader_.problem(place, "\"increments\" and \"automatic\" exclude each other");
    }
    if (fixed != nullptr) s.increments = reader_.integer(Place(place, *fixed), 1, most_increments).value_or(1);
    if (automatic == nullptr) return;
    s.automatic = true;
    const Place at(place, *automatic);
    if (!reader_.object(at, "\"tolerance\"")) return;
    reader_.known_keys(at, automatic_keys);
    if (const JsonValue* v = reader_.required(at, "tolerance")) {
      s.step_tolerance = reader_.number_between(Place(at, *v), 0.0, 1.0).value_or(s.step_tolerance);
    }
    if (const JsonValue* v = automatic->find("increments")) {
      s.increments = reader_.integer(Place(at, *v), 1, most_increments).value_or(1);
    }
  }

  /// The component that a member is named after.
  std::optional<int> component(const Place& member) {
    const std::string& name = member.value().key;
    const std::span<const std::string_view> valid = components_of(setting_);
    if (std::find(valid.begin(), valid.end(), name) != valid.end()) return component_index(name);
    if (component_index(name) < 0) {
      reader_.problem(member, "unknown component " + io::in_quotes(name) + io::suggestion(name, valid));
    } else {
      const bool stress = setting_ == Setting::plane_stress;
      reader_.problem(member, "component \"" + name + "\" cannot be controlled in " + to_string(setting_) + ", where " +
                                  (stress ? "sig_zz = sig_xz = sig_yz = 0" : "eps_zz = eps_xz = eps_yz = 0") +
                                  " (valid: xx, yy, xy)");
    }
    return std::nullopt;
  }

  void controls(const Place& place, Stage& s, Usage& usage) {
    bool any = place.value().find("constraints") != nullptr;
    for (const auto& [prescribed, key] : Words<Prescribed>::list) {
      const JsonValue* v = place.value().find(key);
      if (v == nullptr) continue;
      any = true;
      const Place at(place, *v);
      if (!reader_.object(at, "a value per component")) continue;
      for (const JsonValue& member : v->items) add_control(Place(at, member), prescribed, s, usage);
    }
    if (any) return;
    reader_.problem(place,
                    "nothing is controlled; give \"strain_increment\", \"strain\", \"stress\" or \"constraints\"");
  }

  void add_control(const Place& member, Prescribed prescribed, Stage& s, Usage& usage) {
    const std::optional<int> c = component(member);
    const std::optional<double> value = reader_.number(member);
    if (!c) return;
    std::string& earlier = usage.controlled_by[static_cast<std::size_t>(*c)];
    if (!earlier.empty()) {
      reader_.problem(member, "component \"" + member.value().key + "\" is already controlled by \"" + earlier + '"');
      return;
    }
    earlier = to_string(prescribed);
    if (value) s.controls.push_back({*c, prescribed, *value});
  }

  void constraints(const Place& place, Stage& s, Usage& usage) {
    if (!reader_.array(place, "constraints")) return;
    const std::size_t before = reader_.problems().size();
    for (const JsonValue& item : place.value().items) {
      const LinearConstraint c = constraint(Place(place, item), usage);
      if (s.constraints.size() < component_names.size()) s.constraints.push_back(c);
    }
    if (reader_.problems().size() == before) check_count(place, usage);
  }

  LinearConstraint constraint(const Place& place, Usage& usage) {
    LinearConstraint c;
    if (!reader_.object(place, "\"strain\" or \"stress\" coefficients and \"value\"")) return c;
    reader_.known_keys(place, constraint_keys);
    if (const JsonValue* v = reader_.required(place, "value")) c.value = reader_.number(Place(place, *v)).value_or(0.0);
    const JsonValue* strain = place.value().find("strain");
    const JsonValue* stress = place.value().find("stress");
    if (strain == nullptr && stress == nullptr) {
      reader_.problem(place, "missing key \"strain\" or \"stress\" with coefficients");
      return c;
    }
    if (strain != nullptr) coefficients(Place(place, *strain), c.strain, usage);
    if (stress != nullptr) coefficients(Place(place, *stress), c.stress, usage);
    const auto zero = [](double x) { return x == 0.0; };
    if (std::all_of(c.strain.begin(), c.strain.end(), zero) && std::all_of(c.stress.begin(), c.stress.end(), zero)) {
      reader_.problem(place, "all coefficients are zero");
    }
    return c;
  }

  void coefficients(const Place& place, std::array<double, 6>& values, Usage& usage) {
    if (!reader_.object(place, "a coefficient per component")) return;
    for (const JsonValue& member : place.value().items) {
      const Place at(place, member);
      const std::optional<int> c = component(at);
      const std::optional<double> x = reader_.number(at);
      if (!c || !x) continue;
      values[static_cast<std::size_t>(*c)] = *x;
      // A zero coefficient frees nothing.
      if (*x != 0.0) usage.in_constraint[static_cast<std::size_t>(*c)] = true;
    }
  }

  /// One equation per unknown: each constraint needs a component that it names and no control prescribes.
  void check_count(const Place& place, const Usage& usage) {
    std::string free_names;
    std::size_t free = 0;
    for (std::size_t k = 0; k < component_names.size(); ++k) {
      if (!usage.in_constraint[k] || !usage.controlled_by[k].empty()) continue;
      free_names += (free > 0 ? ", " : "") + std::string(component_names[k]);
      ++free;
    }
    const std::size_t given = place.value().items.size();
    if (given == free) return;
    reader_.problem(place, std::to_string(given) + (given == 1 ? " constraint for " : " constraints for ") +
                               std::to_string(free) + (free == 1 ? " free component" : " free components") +
                               (free > 0 ? " (" + free_names + ")" : "") +
                               "; give as many constraints as there are components that they name and nothing else "
                               "controls");
  }

  void stop(const Place& place, Stage& s) {
    if (!reader_.object(place, "a value per quantity")) return;
    for (const JsonValue& member : place.value().items) {
      const Place at(place, member);
      const Column* column = find_column(member.key);
      const bool known = column != nullptr && column->get != nullptr;
      if (!known) {
        reader_.problem(
            at, "unknown quantity " + io::in_quotes(member.key) + io::suggestion(member.key, numeric_column_names()));
      }
      const bool damage = member.key == "D";
      const std::optional<double> value = damage ? reader_.number_between(at, 0.0, 1.0) : reader_.number(at);
      if (known && value) s.stop.push_back({member.key, *value});
    }
  }

  void jump(const Place& place, Stage& s) {
    if (!reader_.object(place, "\"increment\"")) return;
    reader_.known_keys(place, jump_keys);
    if (const JsonValue* v = reader_.required(place, "increment")) {
      if (const auto x = reader_.positive(Place(place, *v))) s.jump = JumpControl{*x};
    }
    if (s.automatic) reader_.problem(place, "jump control prescribes the step; give \"increments\", not \"automatic\"");
    const auto is_stress = [](const ComponentControl& c) { return c.prescribed == Prescribed::stress; };
    if (!s.constraints.empty() || std::any_of(s.controls.begin(), s.controls.end(), is_stress)) {
      reader_.problem(place, "jump control scales a strain increment; it excludes \"stress\" and \"constraints\"");
    }
    // Whether a target strain is away from the strain at the begin of the stage is known only in the run.
    const auto gives_direction = [](const ComponentControl& c) {
      return c.prescribed == Prescribed::strain || (c.prescribed == Prescribed::strain_increment && c.value != 0.0);
    };
    if (!std::any_of(s.controls.begin(), s.controls.end(), gives_direction)) {
      reader_.problem(place, "needs a direction: a \"strain_increment\" that is not zero, or a \"strain\"");
    }
  }

  const InputReader& reader_;
  Setting setting_;
};

}  // namespace

std::optional<std::vector<StageEntry>> read_stages(const InputReader& reader, const Place& place, Setting setting) {
  const std::size_t before = reader.problems().size();
  std::vector<StageEntry> entries = StageReader(reader, setting).entries(place);
  if (reader.problems().size() != before) return std::nullopt;
  return entries;
}

StageCount count_stages(const std::vector<StageEntry>& entries) {
  StageCount total;
  for (const StageEntry& e : entries) {
    const StageCount one =
        e.entries.empty() ? StageCount{1.0, static_cast<double>(e.stage.increments)} : count_stages(e.entries);
    total.stages += e.repeat * one.stages;
    total.increments += e.repeat * one.increments;
  }
  return total;
}

void expand_stages(const std::vector<StageEntry>& entries, std::vector<Stage>& stages) {
  for (const StageEntry& e : entries) {
    for (int k = 0; k < e.repeat; ++k) {
      if (e.entries.empty()) {
        stages.push_back(e.stage);
      } else {
        expand_stages(e.entries, stages);
      }
    }
  }
}

}  // namespace fpz::driver::detail
