// Data sets of the kind "strength": peak stresses and loads of single specimens.
#include <array>
#include <cmath>

#include "data_set_reader.hpp"
#include "fpz/calibration/strength.hpp"
#include "set_keys.hpp"

namespace fpz::calibration::detail {
namespace {

using Kind = JsonValue::Kind;

constexpr double default_relative_deviation = 0.05;
constexpr std::array<std::string_view, 7> point_keys = {"test",      "strength",  "pressure", "diameter",
                                                        "thickness", "deviation", "name"};

bool has_pressure(StrengthKind k) {
  return k == StrengthKind::direct_shear || k == StrengthKind::triaxial_axial || k == StrengthKind::triaxial_deviator;
}

Quantity quantity_of(StrengthKind k) { return k == StrengthKind::brazilian_load ? Quantity::force : Quantity::stress; }

Typical typical_of(const StrengthPoint& point) {
  switch (point.kind) {
    case StrengthKind::uniaxial_tension:
    case StrengthKind::brazilian_stress:
      return typical::tensile_stress;
    case StrengthKind::direct_shear:
      return typical::shear_stress;
    case StrengthKind::brazilian_load:  // by the stress that it means
      return scaled(typical::tensile_stress, Quantity::force, splitting_stress(1.0, point.diameter, point.thickness));
    default:
      return typical::compressive_stress;
  }
}

struct Points {
  StrengthTest test;
  std::vector<double> measured;
  std::vector<double> deviation;  ///< NaN where the point has none
  std::vector<std::string> labels;
};

std::string label_of(const StrengthPoint& p) {
  std::string label(to_string(p.kind));
  if (has_pressure(p.kind)) label += " at " + io::exact(std::round(p.pressure * 1e-3) * 1e-3) + " MPa";
  return label;
}

std::optional<StrengthKind> read_kind(const Context& c, const Place& object) {
  const JsonValue* v = c.reader.required(object, "test");
  if (v == nullptr) return std::nullopt;
  return read_word<StrengthKind>(c, Place(object, *v), "test");
}

void read_sizes(const Context& c, const Place& object, StrengthPoint& point) {
  for (const auto& [key, target] : {std::pair{"diameter", &point.diameter}, std::pair{"thickness", &point.thickness}}) {
    const JsonValue* v = object.value().find(key);
    if (point.kind != StrengthKind::brazilian_load) {
      if (v != nullptr) c.problem(Place(object, *v), "goes with \"test\": \"brazilian_load\"");
      continue;
    }
    v = c.reader.required(object, key);
    if (v != nullptr) *target = read_judged(c, Place(object, *v), typical::specimen_size).value_or(1.0);
  }
  if (point.kind == StrengthKind::brazilian_load && (point.diameter <= 0.0 || point.thickness <= 0.0)) {
    point.diameter = point.thickness = 1.0;  // a problem was recorded
  }
}

void read_pressure(const Context& c, const Place& object, StrengthPoint& point) {
  const JsonValue* v = object.value().find("pressure");
  if (!has_pressure(point.kind)) {
    if (v != nullptr) c.problem(Place(object, *v), "goes with a triaxial or direct shear test");
    return;
  }
  v = c.reader.required(object, "pressure");
  if (v == nullptr) return;
  const Place at(object, *v);
  const auto x = read_written(c, at, Quantity::stress);
  if (!x) return;
  point.pressure = x->si;
  if (x->si > 0.0) c.judge(at, "pressure", *x, typical::pressure);
  if (x->si < 0.0 && point.kind != StrengthKind::direct_shear) {
    c.problem(at, io::exact(x->number) + ": must be >= 0 (compression is positive here)");
  }
}

void read_point(const Context& c, const Place& at, Points& points) {
  if (!c.reader.object(at, "\"test\" and \"strength\"")) return;
  c.reader.known_keys(at, point_keys);
  StrengthPoint point;
  const auto kind = read_kind(c, at);
  const JsonValue* strength = c.reader.required(at, "strength");
  if (!kind) return;
  point.kind = *kind;
  read_sizes(c, at, point);
  read_pressure(c, at, point);
  const auto value = strength != nullptr ? read_judged(c, Place(at, *strength), typical_of(point)) : std::nullopt;
  if (!value) return;
  double deviation = NAN;
  if (at.value().find("deviation") != nullptr) {
    const auto d = read_deviation(c, at, quantity_of(point.kind), Eigen::VectorXd::Constant(1, *value));
    if (d && !d->known) c.problem(at, "the deviation of a single value must be known");
    if (d) deviation = d->values[0];
  }
  std::string label = label_of(point);
  if (const JsonValue* name = at.value().find("name")) label = c.reader.text(Place(at, *name), 100).value_or(label);
  points.test.points.push_back(point);
  points.measured.push_back(*value);
  points.deviation.push_back(deviation);
  points.labels.push_back(std::move(label));
}

/// Several specimens of one kind of test from a file: columns "strength" and "pressure".
std::optional<Curve> read_file(const SetContext& s, const Place& set, Points& points) {
  const Context& c = s.c;
  StrengthPoint point;
  const auto kind = read_kind(c, set);
  if (!kind) return std::nullopt;
  point.kind = *kind;
  read_sizes(c, set, point);
  const std::array<Wanted, 2> wanted = {Wanted{"strength", quantity_of(*kind)}, Wanted{"pressure", Quantity::stress}};
  const std::span<const Wanted> columns = std::span(wanted).first(has_pressure(*kind) ? 2 : 1);
  auto curve = read_curve(c, s.folder, set, {columns, 0, std::nullopt, 1});
  if (!curve) return std::nullopt;
  for (const Eigen::Index k : curve->used) {
    if (has_pressure(*kind)) point.pressure = curve->columns[1][k];
    points.test.points.push_back(point);
    points.measured.push_back(curve->columns[0][k]);
    points.labels.push_back(label_of(point));
  }
  const double largest = curve->columns[0].maxCoeff();
  c.judge(set, "the largest strength", {largest, largest, si_unit(quantity_of(*kind))}, typical_of(point));
  if (curve->columns[0].minCoeff() <= 0.0) c.problem(set, "strengths must be > 0");
  return curve;
}

void take_points(const SetContext& s, const Place& set, const Points& points, DataSet& out) {
  const auto n = static_cast<Eigen::Index>(points.measured.size());
  out.measured = Eigen::Map<const Eigen::VectorXd>(points.measured.data(), n);
  out.deviation = default_relative_deviation * out.measured;
  const bool given = set.value().find("deviation") != nullptr;
  bool all = true;
  for (const double d : points.deviation) all = all && std::isfinite(d);
  if (given) {
    if (auto d = read_deviation(s.c, set, Quantity::stress, out.measured)) {
      out.deviation = std::move(d->values);
      out.deviation_known = d->known;
      out.deviation_words = std::move(d->words);
    }
  } else if (all) {
    out.deviation_words = "given for each point";
  } else {
    out.deviation_known = false;
    out.deviation_words = "in proportion to the values, their common factor estimated from the residuals";
    if (n < 2) {
      s.c.problem(set, "missing key \"deviation\": from a single value no scatter can be estimated");
    }
    for (const double d : points.deviation) {
      if (std::isfinite(d)) {
        s.c.problem(set, "some points have a \"deviation\" and others have none; give one for the whole set, too");
        break;
      }
    }
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    if (std::isfinite(points.deviation[static_cast<std::size_t>(k)])) {
      out.deviation[k] = points.deviation[static_cast<std::size_t>(k)];
    }
  }
}

}  // namespace

void read_strength(const SetContext& s, const Place& set, DataSet& out) {
  const Context& c = s.c;
  Points points;
  const JsonValue* list = set.value().find("points");
  const std::size_t before = c.reader.problems().size();
  if (list != nullptr) {
    c.reader.known_keys(set, set_keys({"points", "deviation"}));
    const Place at(set, *list);
    if (!c.reader.array(at, "points")) return;
    for (const JsonValue& item : list->items) read_point(c, Place(at, item), points);
    if (c.reader.problems().size() != before || points.measured.empty()) return;
    take_points(s, set, points, out);
  } else {
    c.reader.known_keys(set, set_keys({"points", "test", "diameter", "thickness"}, curve_keys));
    auto curve = read_file(s, set, points);
    if (!curve) return;
    take_curve(*curve, 0, 0, out);
  }
  out.abscissa = Eigen::VectorXd::LinSpaced(out.measured.size(), 1.0, static_cast<double>(out.measured.size()));
  out.labels = points.labels;
  out.value_axis = {"Strength", "", 1.0};
  out.test = points.test;
}

}  // namespace fpz::calibration::detail
