#include "parameter_reader.hpp"

#include <algorithm>
#include <cmath>

namespace fpz::calibration::detail {
namespace {

using Kind = JsonValue::Kind;
constexpr std::size_t longest_text = 4000;
constexpr double default_factor = 20.0;
constexpr std::array<std::string_view, 8> entry_keys = {
    "value", "start", "unit", "lower", "upper", "prior", "from_initial_slope", "as_prior"};
constexpr std::array<std::string_view, 2> prior_keys = {"mean", "deviation"};

std::vector<std::string_view> all_names() {
  std::vector<std::string_view> names;
  for (const auto& key : io::material_keys) names.push_back(key.name);
  return names;
}

/// A dilation angle or Poisson's ratio of zero is an assumption, not a slip.
bool may_be_zero(std::string_view name) { return name == "dilation_angle_deg" || name == "poisson_ratio"; }

class ParameterReader {
 public:
  ParameterReader(const Context& c, const std::filesystem::path& folder, const Place& root, Specification& spec)
      : c_(c), folder_(folder), root_(root), spec_(spec) {}

  ParameterEntries read() {
    read_base();
    read_quantities();
    read_fit();
    read_own();
    for (std::size_t k = 0; k < io::material_keys.size(); ++k) require_value(io::material_keys[k].name);
    for (const Fitted& f : fitted_) finish_fitted(f);
    return std::move(entries_);
  }

 private:
  struct Fitted {
    std::size_t index;
    const JsonValue* entry;  ///< its object under "parameters", or null
  };

  void read_base() {
    const JsonValue* material = root_.value().find("material");
    if (material == nullptr) return;
    const Place at(root_, *material);
    const std::optional<io::MaterialFile> base = io::material_at(
        c_.reader, at, [this](const Place& name) { return io::load_named_material(c_.reader, name, folder_); });
    has_base_ = true;
    if (!base) return;
    spec_.choices = base->parameters.choices;
    take_material(*base);
    base_ = base;
  }

  void take_material(const io::MaterialFile& material) {
    spec_.conversions = material.conversions;
    c_.warnings.insert(c_.warnings.end(), material.warnings.begin(), material.warnings.end());
    for (std::size_t k = 0; k < io::material_keys.size(); ++k) {
      const std::string_view name = io::material_keys[k].name;
      const double x = material.parameters.*io::material_keys[k].member;
      const io::Location& where = material.locations[k];
      set(name, x, where);
      if (x == 0.0 && may_be_zero(name)) continue;
      const Typical typical = typical_parameter(name);
      const Judgement j = io::judge(name, {x, x, si_unit(typical.quantity)}, typical);
      const std::string text = where.path + ": " + j.text;
      if (j.verdict == Verdict::impossible) c_.reader.problems().add(where.file, where.line, text);
      if (j.verdict == Verdict::doubtful) {
        c_.warnings.push_back(where.file + ':' + std::to_string(where.line) + ": " + text);
      }
    }
  }

  /// Quantities that stand for parameters, such as a compressive strength, under "parameters": what a material file
  /// with the same entries states, fitted parameters by their starts.
  void read_quantities() {
    const JsonValue* own = root_.value().find("parameters");
    if (own == nullptr || !own->is(Kind::object)) return;
    if (std::none_of(own->items.begin(), own->items.end(), [](const JsonValue& m) { return is_alternative(m.key); })) {
      return;
    }
    if (has_base_ && !base_) return;  // complained about already
    const JsonValue stated = plain_values(*own);
    const Place at(root_, stated);
    const auto material = with_quantities(at, c_.reader);
    has_base_ = true;
    if (!material) return;
    refuse_conversions_of_fitted(*own, material->parameters);
    take_material(*material);
  }

  std::optional<io::MaterialFile> with_quantities(const Place& at, const InputReader& reader) const {
    return base_ ? io::read_difference(reader, at, *base_) : io::read_material(reader, at, "parameters");
  }

  /// What follows from a quantity is worked out once. Where a fitted parameter enters, that would be wrong at every
  /// other value of it.
  void refuse_conversions_of_fitted(const JsonValue& own, const Parameters& at_start) {
    constexpr double nudge = 1.001;
    io::Problems unused(1000);
    const InputReader quiet(c_.reader.file(), c_.reader.limits(), unused);
    for (const auto& fitted : io::material_keys) {
      if (!is_fitted(fitted.name)) continue;
      JsonValue moved = plain_values(own);
      std::erase_if(moved.items, [&fitted](const JsonValue& m) { return m.key == fitted.name; });
      JsonValue& value = moved.items.emplace_back();
      value.kind = Kind::number;
      value.key = fitted.name;
      value.number = nudge * (at_start.*fitted.member);
      value.text = io::exact(value.number);
      const auto material = with_quantities(Place(root_, moved), quiet);
      if (!material) continue;
      for (const auto& key : io::material_keys) {
        if (key.name == fitted.name || material->parameters.*key.member == at_start.*key.member) continue;
        c_.problem(Place(root_, own), std::string(fitted.name) + " is fitted, and " + std::string(key.name) +
                                          " follows from it by a quantity that is stated; state " +
                                          std::string(key.name) + " itself, or give the quantity as a data set");
      }
    }
  }

  static bool is_alternative(std::string_view key) {
    const auto all = io::material_alternatives();
    return std::any_of(all.begin(), all.end(), [key](const auto& a) { return key == a.key || key == a.symbol; });
  }

  /// By its name in "fit" or by a start under "parameters".
  [[nodiscard]] bool is_fitted(std::string_view name) const {
    const JsonValue* own = root_.value().find("parameters");
    const JsonValue* entry = own != nullptr ? own->find(name) : nullptr;
    if (entry != nullptr && entry->is(Kind::object) && entry->find("start") != nullptr) return true;
    const JsonValue* list = root_.value().find("fit");
    if (list == nullptr || !list->is(Kind::array)) return false;
    return std::any_of(list->items.begin(), list->items.end(),
                       [name](const JsonValue& item) { return item.is(Kind::string) && item.text == name; });
  }

  /// An entry of "parameters" as it would stand in a material file.
  static JsonValue plain_value(const JsonValue& entry) {
    JsonValue out = entry;
    if (!entry.is(Kind::object)) return out;
    std::erase_if(out.items, [](const JsonValue& m) {
      return m.key == "lower" || m.key == "upper" || m.key == "prior" || m.key == "from_initial_slope" ||
             m.key == "as_prior";
    });
    for (JsonValue& m : out.items) {
      if (m.key == "start") m.key = "value";
    }
    return out;
  }

  static JsonValue plain_values(const JsonValue& own) {
    JsonValue out = own;
    for (JsonValue& m : out.items) m = plain_value(m);
    // What an initial slope gives has no value yet.
    std::erase_if(out.items, [](const JsonValue& m) { return m.is(Kind::object) && m.find("value") == nullptr; });
    return out;
  }

  void set(std::string_view name, double x, const io::Location& where) {
    const auto index = parameter_index(name);
    if (!index) {
      spec_.density = x;
      has_density_ = true;
      return;
    }
    spec_.parameters[*index].value = x;
    has_value_[*index] = true;
    entries_.locations[*index] = where;
    const std::string file = std::filesystem::path(where.file).filename().string();
    spec_.parameters[*index].origin = '"' + where.path + "\" in " + file;
  }

  void read_fit() {
    const JsonValue* list = root_.value().find("fit");
    if (list == nullptr) return;
    const Place at(root_, *list);
    if (!c_.reader.array(at, "parameter names")) return;
    for (const JsonValue& item : list->items) {
      const Place place(at, item);
      const auto name = c_.reader.text(place, longest_text);
      if (!name) continue;
      if (*name == "density") {
        c_.problem(place, "no test that is evaluated here depends on the density; it stays as it is given");
      } else if (const auto index = parameter_index(*name)) {
        add_fitted(*index, place);
      } else {
        c_.problem(place, "unknown parameter " + io::in_quotes(*name) + io::suggestion(*name, all_names()));
      }
    }
  }

  void add_fitted(std::size_t index, const Place& at) {
    const auto same = [index](const Fitted& f) { return f.index == index; };
    if (std::any_of(fitted_.begin(), fitted_.end(), same)) {
      c_.problem(at, "is named twice");
      return;
    }
    spec_.parameters[index].fitted = true;
    fitted_.push_back({index, nullptr});
  }

  void read_own() {
    const JsonValue* own = root_.value().find("parameters");
    if (own == nullptr) return;
    const Place at(root_, *own);
    if (!c_.reader.object(at, "the parameters of a material")) return;
    auto known = all_names();
    const auto choices = io::choice_keys();
    known.insert(known.end(), choices.begin(), choices.end());
    for (const io::MaterialAlternative& a : io::material_alternatives()) known.insert(known.end(), {a.key, a.symbol});
    c_.reader.known_keys(at, known);
    io::read_choices(c_.reader, at, spec_.choices);
    for (const JsonValue& member : own->items) {
      const auto names = all_names();
      if (std::find(names.begin(), names.end(), member.key) != names.end()) read_entry(Place(at, member));
    }
  }

  void read_entry(const Place& at) {
    const std::string& name = at.value().key;
    const Typical typical = typical_parameter(name);
    const io::Location where{c_.reader.file(), at.line(), at.path()};
    given_.push_back(name);
    if (!at.value().is(Kind::object)) {
      if (const auto x = c_.reader.number(at)) take(at, {*x, *x, si_unit(typical.quantity)}, typical, where);
      return;
    }
    if (!c_.reader.object(at, "\"value\" or \"start\"")) return;
    c_.reader.known_keys(at, entry_keys);
    const auto index = parameter_index(name);
    const JsonValue* value = at.value().find("value");
    const JsonValue* start = at.value().find("start");
    const JsonValue* slope = at.value().find("from_initial_slope");
    if ((value != nullptr) + (start != nullptr) + (slope != nullptr) > 1) {
      c_.problem(at, "give one of \"value\", \"start\", \"from_initial_slope\"");
      return;
    }
    if (start != nullptr && index && !spec_.parameters[*index].fitted) add_fitted(*index, at);
    if (start != nullptr && !index) c_.problem(at, "the density cannot be fitted; give a \"value\"");
    if (index) {
      for (Fitted& f : fitted_) {
        if (f.index == *index) f.entry = &at.value();
      }
      refuse_bounds_of_fixed(at, *index);
    }
    if (slope != nullptr) return read_slope(at, *slope, where);
    const JsonValue* number = value != nullptr ? value : start;
    if (number == nullptr) {
      if (!index || !has_value_[*index]) c_.problem(at, "missing key \"value\" or \"start\"");
      return;
    }
    const auto unit = read_unit(c_, at, typical.quantity);
    const auto x = c_.reader.number(Place(at, *number));
    if (unit && x) take(at, {*x * unit->factor, *x, unit->name}, typical, where);
  }

  void refuse_bounds_of_fixed(const Place& at, std::size_t index) {
    if (spec_.parameters[index].fitted) return;
    for (const std::string_view key : {"lower", "upper", "prior", "as_prior"}) {
      const JsonValue* v = at.value().find(key);
      if (v == nullptr) continue;
      c_.problem(Place(at, *v),
                 "has no effect on a fixed parameter; to fit it, give \"start\" in place of \"value\" or "
                 "name it in \"fit\"");
    }
  }

  void take(const Place& at, const Written& x, const Typical& typical, const io::Location& where) {
    const std::string& name = at.value().key;
    if (!(x.si == 0.0 && may_be_zero(name))) c_.judge(at, name, x, typical);
    set(name, x.si, where);
  }

  void read_slope(const Place& at, const JsonValue& slope, const io::Location& where) {
    if (at.value().key != "young_modulus") {
      c_.problem(Place(at, slope), "only young_modulus follows from an initial slope");
      return;
    }
    const auto name = c_.reader.text(Place(at, slope), longest_text);
    if (!name) return;
    SlopeRequest request;
    request.at = where;
    if (const JsonValue* v = at.value().find("as_prior"))
      request.as_prior = read_boolean(c_, Place(at, *v)).value_or(false);
    if (const JsonValue* v = at.value().find("prior"); v != nullptr && request.as_prior) {
      c_.problem(Place(at, *v), "the prior comes from the slope already (\"as_prior\")");
    }
    constexpr double until_known = 3e10;  // replaced when the data are there; no constraint depends on it
    const auto index = static_cast<std::size_t>(Parameter::young_modulus);
    if (!has_value_[index]) set("young_modulus", until_known, where);
    spec_.parameters[index].slope_of = *name;
    entries_.locations[index] = where;
    entries_.slope = request;
  }

  void require_value(std::string_view name) {
    const auto index = parameter_index(name);
    const bool there = index ? has_value_[*index] : has_density_;
    if (there || has_base_) return;
    if (std::find(given_.begin(), given_.end(), name) != given_.end()) return;  // complained about already
    const JsonValue* own = root_.value().find("parameters");
    const std::string text = "missing parameter " + io::in_quotes(name) + ", and no \"material\" to take it from";
    c_.problem(own != nullptr ? Place(root_, *own) : root_, text);
  }

  void finish_fitted(const Fitted& f) {
    ParameterSetting& p = spec_.parameters[f.index];
    const auto which = static_cast<Parameter>(f.index);
    std::tie(p.lower, p.upper) = default_bounds(which, p.value);
    if (f.entry == nullptr) return;
    const JsonValue* own = root_.value().find("parameters");
    const Place all(root_, *own);
    const Place at(all, *f.entry);
    const Typical typical = typical_parameter(info(which).name);
    const auto unit = read_unit(c_, at, typical.quantity);
    if (!unit) return;
    const auto limit = [&](std::string_view key, double& target) {
      const JsonValue* v = at.value().find(key);
      if (v == nullptr) return;
      if (const auto x = c_.reader.number(Place(at, *v))) target = *x * unit->factor;
    };
    limit("lower", p.lower);
    limit("upper", p.upper);
    if (const JsonValue* prior = at.value().find("prior")) read_prior(Place(at, *prior), *unit, typical, p);
    if (!(p.lower < p.upper)) {
      c_.problem(at, "\"lower\" must be below \"upper\"");
    } else if (!p.slope_of && (p.value < p.lower || p.value > p.upper)) {
      c_.problem(at, "the start " + io::exact(p.value) + " must lie between \"lower\" = " + io::exact(p.lower) +
                         " and \"upper\" = " + io::exact(p.upper));
    }
    if (p.lower < 0.0 || (p.lower == 0.0 && !may_be_zero(info(which).name))) {
      c_.problem(at, "\"lower\" must be > 0");
    }
  }

  void read_prior(const Place& at, const Unit& unit, const Typical& typical, ParameterSetting& p) {
    if (!c_.reader.object(at, "\"mean\" and \"deviation\"")) return;
    c_.reader.known_keys(at, prior_keys);
    const JsonValue* mean = c_.reader.required(at, "mean");
    const JsonValue* deviation = c_.reader.required(at, "deviation");
    if (mean == nullptr || deviation == nullptr) return;
    const auto m = c_.reader.number(Place(at, *mean));
    const auto d = c_.reader.positive(Place(at, *deviation));
    if (!m || !d) return;
    c_.judge(Place(at, *mean), "the mean of the prior", {*m * unit.factor, *m, unit.name}, typical);
    p.prior = Prior{*m * unit.factor, *d * unit.factor};
  }

  const Context& c_;
  const std::filesystem::path& folder_;
  const Place& root_;
  Specification& spec_;
  ParameterEntries entries_;
  std::optional<io::MaterialFile> base_;
  bool has_base_ = false;
  bool has_density_ = false;
  std::array<bool, parameter_count> has_value_{};
  std::vector<std::string> given_;
  std::vector<Fitted> fitted_;
};

}  // namespace

std::pair<double, double> default_bounds(Parameter which, double start) {
  switch (which) {
    case Parameter::poisson_ratio:
      return {std::min(0.01, start), std::max(0.48, start)};
    case Parameter::friction_angle_deg:
      return {std::min(5.0, start), std::max(75.0, start)};
    case Parameter::dilation_angle_deg:
      return {std::min(0.1, start), std::max(60.0, start)};
    default:
      return {start / default_factor, start * default_factor};
  }
}

ParameterEntries read_parameters(const Context& c, const std::filesystem::path& folder, const Place& root,
                                 Specification& spec) {
  return ParameterReader(c, folder, root, spec).read();
}

void check_start(const Context& c, const Specification& spec, const ParameterEntries& entries) {
  Parameters p = spec.start();
  p.rve_length = 1e-12;  // belongs to the tests; none of the constraints that are checked here depends on it
  const Validation found = validate(p, spec.setting);
  const auto location = [&](const std::string& field) -> io::Location {
    const auto index = parameter_index(field);
    return index ? entries.locations[*index] : io::Location{c.reader.file(), 0, field};
  };
  const auto line = [](const io::Location& at, const Violation& v) {
    return at.path + " = " + io::exact(v.value) + ": " + v.constraint;
  };
  for (const Violation& v : found.errors) {
    const io::Location at = location(v.field);
    c.reader.problems().add(at.file, at.line, line(at, v));
  }
  for (const Violation& v : found.warnings) {
    const io::Location at = location(v.field);
    c.warnings.push_back(at.file + ':' + std::to_string(at.line) + ": " + line(at, v));
  }
}

}  // namespace fpz::calibration::detail
