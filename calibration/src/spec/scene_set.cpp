// Data sets of the kind "scene": gauges of a specimen that the particle program runs.
#include <algorithm>
#include <array>
#include <cmath>

#include "data_set_reader.hpp"
#include "fpz/calibration/scene_data.hpp"
#include "scene_program.hpp"
#include "set_keys.hpp"

namespace fpz::calibration::detail {
namespace {

constexpr std::size_t longest_text = 4000;
constexpr double default_relative_deviation = 0.05;
constexpr std::array<std::string_view, 4> point_keys = {"name", "set", "gauge", "largest"};

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// A value as it stands in a --set of the particle program.
std::string json_text(const JsonValue& v) {
  using Kind = JsonValue::Kind;
  const auto joined = [&](char open, char close) {
    std::string text(1, open);
    for (const JsonValue& item : v.items) {
      if (text.size() > 1) text += ", ";
      if (v.is(Kind::object)) text += quoted(item.key) + ": ";
      text += json_text(item);
    }
    return text + close;
  };
  switch (v.kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return v.boolean ? "true" : "false";
    case Kind::number:
      return v.text;
    case Kind::string:
      return quoted(v.text);
    case Kind::array:
      return joined('[', ']');
    case Kind::object:
      break;
  }
  return joined('{', '}');
}

/// Adds what the member "set" of `object` changes. The material is the calibration's.
void read_changes(const Context& c, const Place& object, SceneSource& source) {
  const JsonValue* set = object.value().find("set");
  if (set == nullptr) return;
  const Place at(object, *set);
  if (!c.reader.object(at, "entries of the scene, such as \"notches[0].angle_deg\": 30")) return;
  for (const JsonValue& member : set->items) {
    if (member.key == "material" || member.key.starts_with("material.")) {
      c.problem(Place(at, member),
                "the material of the scene is the one that is fitted: state it in the specification");
      continue;
    }
    source.changes.push_back(member.key + "=" + json_text(member));
  }
}

std::optional<SceneFacts> read_facts(const SetContext& s, const Place& at, const SceneSource& source) {
  try {
    SceneFacts facts = facts_of(source);
    if (facts.setting != s.setting) {
      s.c.problem(at, std::string("the scene is in ") + to_string(facts.setting) + ", the specification in " +
                          to_string(s.setting) + ": state the same \"setting\"");
    }
    for (const std::string& w : facts.warnings) {
      if (std::find(s.c.warnings.begin(), s.c.warnings.end(), w) == s.c.warnings.end()) s.c.warnings.push_back(w);
    }
    return facts;
  } catch (const io::InputError& e) {
    s.c.problem(at, "the scene has problems:\n" + std::string(e.what()));
    return std::nullopt;
  }
}

std::vector<std::string_view> names_of(const SceneFacts& facts) {
  std::vector<std::string_view> names;
  for (const SceneColumn& column : facts.columns) names.push_back(column.name);
  return names;
}

Axis axis_of(const SceneColumn& column, double largest) {
  if (column.name == "time") return {"Time (s)", "", 1.0};
  std::string label = column.name;
  label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return readable_axis(label, column.quantity, largest);
}

/// A curve: a gauge over another one, or over time.
void read_scene_curve(const SetContext& s, const Place& set, const SceneFacts& facts, SceneData data, DataSet& out) {
  const Context& c = s.c;
  const JsonValue* named = c.reader.required(set, "measured");
  if (named == nullptr) return;
  const auto measured = read_choice(c, Place(set, *named), "gauge", names_of(facts));
  if (!measured) return;
  std::vector<Wanted> candidates;
  for (const SceneColumn& column : facts.columns) {
    if (column.name != facts.columns[*measured].name) candidates.push_back({column.name, column.quantity});
  }
  const auto which = which_column(c, set, candidates);
  if (!which) return;
  const std::array<Wanted, 2> wanted = {candidates[*which],
                                        Wanted{facts.columns[*measured].name, facts.columns[*measured].quantity}};
  const auto curve = read_curve(c, s.folder, set, {wanted, 1, 0, 2});
  if (!curve) return;
  take_curve(*curve, 0, 1, out);
  if (!std::is_sorted(out.abscissa.begin(), out.abscissa.end())) {
    return c.problem(set, "a scene cannot follow a curve that goes back; leave out \"cyclic\" and use one branch");
  }
  const auto abscissa = std::find_if(facts.columns.begin(), facts.columns.end(),
                                     [&](const SceneColumn& column) { return column.name == wanted[0].name; });
  for (const double x : out.abscissa) {
    data.values.push_back(
        {0, facts.columns[*measured].name, abscissa->name, x, si_unit(facts.columns[*measured].quantity)});
  }
  out.abscissa_axis = axis_of(*abscissa, out.abscissa.cwiseAbs().maxCoeff());
  out.value_axis = axis_of(facts.columns[*measured], out.measured.cwiseAbs().maxCoeff());
  out.test = std::move(data);
}

/// The largest reading of a gauge in a run of its own, or in one that another point has, too.
void read_point(const SetContext& s, const Place& at, const SceneSource& base, SceneData& data,
                std::vector<double>& largest, DataSet& out) {
  const Context& c = s.c;
  if (!c.reader.object(at, "\"largest\", \"gauge\", \"set\" and \"name\"")) return;
  c.reader.known_keys(at, point_keys);
  SceneSource source = base;
  const std::size_t before = c.reader.problems().size();
  read_changes(c, at, source);
  const JsonValue* value = c.reader.required(at, "largest");
  if (value == nullptr || c.reader.problems().size() != before) return;
  const auto facts = read_facts(s, at, source);
  if (!facts) return;
  std::optional<std::size_t> gauge;
  const std::vector<std::string_view> names = names_of(*facts);
  if (const JsonValue* v = at.value().find("gauge")) {
    gauge = read_choice(c, Place(at, *v), "gauge", names);
  } else {
    gauge = static_cast<std::size_t>(std::find(names.begin(), names.end(), "load") - names.begin());
  }
  if (!gauge) return;
  const SceneColumn& column = facts->columns[*gauge];
  const auto x = read_written(c, Place(at, *value), column.quantity);
  if (!x) return;
  if (!(x->si > 0.0)) return c.problem(Place(at, *value), "a largest reading must be > 0");
  std::string label = "value " + std::to_string(largest.size() + 1);
  if (const JsonValue* name = at.value().find("name")) label = c.reader.text(Place(at, *name), 100).value_or(label);
  auto known = std::find(data.scenes.begin(), data.scenes.end(), source);
  if (known == data.scenes.end()) known = data.scenes.insert(known, std::move(source));
  data.values.push_back(
      {static_cast<std::size_t>(known - data.scenes.begin()), column.name, "", 0.0, si_unit(column.quantity)});
  largest.push_back(x->si);
  out.labels.push_back(std::move(label));
  out.value_axis = {"Largest " + column.name, "", 1.0};
}

void read_points(const SetContext& s, const Place& set, const SceneSource& base, DataSet& out) {
  const Context& c = s.c;
  const Place at(set, *set.value().find("points"));
  if (!c.reader.array(at, "points")) return;
  SceneData data;
  std::vector<double> largest;
  for (const JsonValue& item : at.value().items) read_point(s, Place(at, item), base, data, largest, out);
  if (largest.empty()) return;
  const auto n = static_cast<Eigen::Index>(largest.size());
  out.measured = Eigen::Map<const Eigen::VectorXd>(largest.data(), n);
  out.abscissa = Eigen::VectorXd::LinSpaced(n, 1.0, static_cast<double>(n));
  out.deviation = default_relative_deviation * out.measured;
  out.deviation_known = false;
  out.deviation_words = "in proportion to the values, their common factor estimated from the residuals";
  const bool alike = std::all_of(data.values.begin(), data.values.end(),
                                 [&](const SceneValue& v) { return v.gauge == data.values.front().gauge; });
  if (set.value().find("deviation") != nullptr) {
    const Quantity quantity = alike ? io::quantity_of(data.values.front().si_unit) : Quantity::number;
    if (auto d = read_deviation(c, set, quantity, out.measured)) {
      out.deviation = std::move(d->values);
      out.deviation_known = d->known;
      out.deviation_words = std::move(d->words);
    }
  } else if (n < 2) {
    c.problem(set, "missing key \"deviation\": from a single value no scatter can be estimated");
  }
  if (alike) {
    out.value_axis =
        readable_axis(out.value_axis.label, io::quantity_of(data.values.front().si_unit), out.measured.maxCoeff());
  }
  out.test = std::move(data);
}

}  // namespace

void read_scene(const SetContext& s, const Place& set, DataSet& out) {
  const Context& c = s.c;
  const bool points = set.value().find("points") != nullptr;
  if (points) {
    c.reader.known_keys(set, set_keys({"scene", "set", "points", "deviation"}));
  } else {
    c.reader.known_keys(set, set_keys({"scene", "set", "measured", "points"}, curve_keys));
  }
  const JsonValue* scene = c.reader.required(set, "scene");
  if (scene == nullptr) return;
  const Place at(set, *scene);
  const auto name = c.reader.text(at, longest_text);
  if (!name || name->find('\0') != std::string::npos) return;
  SceneSource source{(s.folder / *name).lexically_normal(), {}};
  const std::size_t before = c.reader.problems().size();
  read_changes(c, set, source);
  if (c.reader.problems().size() != before) return;
  if (points) return read_points(s, set, source, out);
  if (const auto facts = read_facts(s, at, source); facts && c.reader.problems().size() == before) {
    SceneData data;
    data.scenes = {source};
    read_scene_curve(s, set, *facts, std::move(data), out);
  }
}

}  // namespace fpz::calibration::detail
