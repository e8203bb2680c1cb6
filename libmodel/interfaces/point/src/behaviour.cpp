#include "fpz/point/behaviour.hpp"

#include <array>
#include <cstring>
#include <stdexcept>

#include "fpz/point/notice.hpp"

namespace fpz::point {

namespace {

/// "property 5, cohesion" for the field of a violation; options come without their prefix.
std::string place_of(const std::string& field) {
  const std::vector<Property>& list = properties();
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string& name = list[k].name;
    if (name == field || name == "integrator_" + field || name == "integrator_" + field + "_x") {
      return "property " + std::to_string(k + 1) + ", " + name;
    }
  }
  return field;
}

std::string text_of(const std::vector<Violation>& list) {
  std::string text;
  for (const Violation& v : list) {
    const std::string report = Validation{{v}, {}}.report();  // "error: <field> = ..."
    text += place_of(v.field) + report.substr(std::strlen("error: ") + v.field.size());
  }
  return text;
}

/// What a missing property looks like: a number that may not be 0 is 0.
std::string missing_text(std::span<const double> list) {
  std::string names;
  for (std::size_t k = list.size(); k < properties().size(); ++k) {
    if (properties()[k].required) names += (names.empty() ? "" : ", ") + properties()[k].name;
  }
  if (names.empty()) return {};
  return std::to_string(list.size()) + " properties are given; missing: " + names + '\n';
}

/// One behaviour that a thread keeps, with the list it was made from.
struct Kept {
  std::vector<double> list;
  Behaviour behaviour;
  bool own_length = false;  ///< H comes from the list
  bool long_noticed = false;
  bool used = false;

  [[nodiscard]] bool is(Setting setting, std::span<const double> other) const {
    return used && behaviour.setting == setting && list.size() == other.size() &&
           std::memcmp(list.data(), other.data(), other.size_bytes()) == 0;
  }
};

constexpr std::size_t kept_count = 16;

struct Shelf {
  std::array<Kept, kept_count> kept;
  std::size_t last = 0;  ///< met last
  std::size_t next = 0;  ///< to be replaced next
};

void notice_snap_back(Kept& kept) {
  const Behaviour& b = kept.behaviour;
  if (kept.long_noticed || b.parameters.rve_length < b.snap_back_length) return;
  kept.long_noticed = true;
  for (const Violation& v : validate(b.parameters, b.setting).warnings) {
    if (v.field == "rve_length") notice(text_of({v}));
  }
}

/// The length of the place where it differs from the one that the behaviour has.
const Behaviour& with_length(Kept& kept, double rve_length) {
  Behaviour& b = kept.behaviour;
  if (kept.own_length || rve_length == b.parameters.rve_length) return b;
  if (!(rve_length > 0.0) || !std::isfinite(rve_length)) return b = make_behaviour(b.setting, kept.list, rve_length);
  b.parameters.rve_length = rve_length;
  set_rve_length(b.material, rve_length);
  notice_snap_back(kept);
  return b;
}

}  // namespace

Behaviour make_behaviour(Setting setting, const Statement& statement) {
  Validation found = validate(statement.parameters, setting);
  const Validation options = validate(statement.options);
  found.errors.insert(found.errors.end(), options.errors.begin(), options.errors.end());
  std::string faults = text_of(found.errors);
  const std::string unfit = why_unfit(statement.options.method, statement.parameters.choices);
  if (!unfit.empty()) faults += unfit + '\n';
  if (!faults.empty()) throw std::invalid_argument(faults);
  Behaviour b;
  b.setting = setting;
  b.parameters = statement.parameters;
  b.options = statement.options;
  b.material = make_material(statement.parameters, setting);
  b.snap_back_length = snap_back_length(statement.parameters, setting);
  b.warnings = text_of(found.warnings);
  return b;
}

Behaviour make_behaviour(Setting setting, std::span<const double> list, double rve_length) {
  const std::string missing = missing_text(list);
  if (!missing.empty()) throw std::invalid_argument(missing);
  return make_behaviour(setting, read_properties(list, rve_length));
}

const Behaviour& behaviour_of(Setting setting, std::span<const double> list, double rve_length) {
  thread_local Shelf shelf;
  if (shelf.kept[shelf.last].is(setting, list)) return with_length(shelf.kept[shelf.last], rve_length);
  for (std::size_t k = 0; k < kept_count; ++k) {
    if (!shelf.kept[k].is(setting, list)) continue;
    shelf.last = k;
    return with_length(shelf.kept[k], rve_length);
  }
  Kept fresh;
  fresh.list.assign(list.begin(), list.end());
  fresh.behaviour = make_behaviour(setting, list, rve_length);
  constexpr std::size_t place = material_parameter_count;
  fresh.own_length = list.size() > place && list[place] != 0.0;
  fresh.long_noticed = fresh.behaviour.parameters.rve_length >= fresh.behaviour.snap_back_length;
  fresh.used = true;
  if (!fresh.behaviour.warnings.empty()) notice(fresh.behaviour.warnings);
  shelf.last = shelf.next;
  shelf.next = (shelf.next + 1) % kept_count;
  shelf.kept[shelf.last] = std::move(fresh);
  return shelf.kept[shelf.last].behaviour;
}

}  // namespace fpz::point
