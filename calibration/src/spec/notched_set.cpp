// Data sets of the kinds "notched_beam" and "semicircular_bend": load against a gauge's reading.
#include <algorithm>
#include <array>
#include <cmath>

#include "data_set_reader.hpp"
#include "fpz/calibration/notched_specimen.hpp"
#include "set_keys.hpp"

namespace fpz::calibration::detail {
namespace {

const char* label_of(Gauge gauge) {
  switch (gauge) {
    case Gauge::cmod:
      return "CMOD";
    case Gauge::deflection_load_point:
      return "Deflection";
    case Gauge::deflection_mid_depth:
      return "Deflection at mid-depth";
  }
  return "";
}

constexpr std::array<std::string_view, 8> beam_keys = {"unit",  "depth",  "thickness",    "span",
                                                       "notch", "length", "roller_width", "clip_gauge_distance"};
constexpr std::array<std::string_view, 7> disc_keys = {"unit",  "radius",       "thickness",          "span",
                                                       "notch", "roller_width", "clip_gauge_distance"};
constexpr std::array<std::string_view, 5> nuisance_keys = {"start", "unit", "lower", "upper", "prior"};
constexpr std::array<std::string_view, 2> prior_keys = {"mean", "deviation"};
constexpr std::array<std::string_view, 2> slope_keys = {"from", "to"};

NotchedSpecimen read_geometry(const SetContext& s, const Place& set, SpecimenShape shape) {
  const Context& c = s.c;
  NotchedSpecimen g;
  g.shape = shape;
  g.setting = s.setting;
  const JsonValue* geometry = c.reader.required(set, "geometry");
  if (geometry == nullptr) return g;
  const Place at(set, *geometry);
  if (!c.reader.object(at, "the lengths of the specimen")) return g;
  const std::size_t before = c.reader.problems().size();
  const bool beam = shape == SpecimenShape::beam;
  c.reader.known_keys(at, beam ? std::span<const std::string_view>(beam_keys) : disc_keys);
  const auto unit = read_unit(c, at, Quantity::length);
  if (!unit) return g;
  const auto needed = [&](std::string_view key, const Typical& t) {
    return read_member(c, at, key, *unit, t, true).value_or(0.0);
  };
  g.thickness = needed("thickness", typical::small_size);
  g.span = needed("span", typical::specimen_size);
  g.notch = needed("notch", typical::small_size);
  if (beam) {
    g.depth = needed("depth", typical::specimen_size);
    const auto length = read_member(c, at, "length", *unit, typical::specimen_size, false);
    g.length = length.value_or(g.span + g.depth);  // what overhangs carries nothing
  } else {
    g.radius = needed("radius", typical::specimen_size);
  }
  g.roller_width = read_member(c, at, "roller_width", *unit, typical::small_size, false, true).value_or(0.0);
  g.clip_gauge_distance =
      read_member(c, at, "clip_gauge_distance", *unit, typical::small_size, false, true).value_or(0.0);
  if (c.reader.problems().size() != before) return g;
  const Validation found = validate(g);
  for (const Violation& v : found.errors) c.problem(at, v.field + " = " + io::exact(v.value) + " m: " + v.constraint);
  for (const Violation& v : found.warnings) c.warn(at, v.field + " = " + io::exact(v.value) + " m: " + v.constraint);
  return g;
}

/// By the nominal bending stress 1.5 P span/(thickness ligament^2) that the largest load means.
void judge_load(const SetContext& s, const Place& set, const NotchedSpecimen& g, double largest) {
  const double per_load = 1.5 * g.span / (g.thickness * g.ligament() * g.ligament());
  const Typical t = scaled(typical::bending_stress, Quantity::force, per_load);
  const JsonValue* given = set.value().find("columns");
  if (given == nullptr) given = set.value().find("values");
  const Place columns(set, *given);
  const Place at(columns, *given->find("load"));
  const Unit unit = read_unit(s.c, at, Quantity::force).value_or(units(Quantity::force).front());
  s.c.judge(at, "the largest load, for a specimen of this size,", {largest, largest / unit.factor, unit.name}, t);
}

void judge_reading(const SetContext& s, const Place& set, std::string_view gauge, double largest) {
  const JsonValue* given = set.value().find("columns");
  if (given == nullptr) given = set.value().find("values");
  const Place columns(set, *given);
  const Place at(columns, *given->find(gauge));
  const Unit unit = read_unit(s.c, at, Quantity::length).value_or(units(Quantity::length).front());
  s.c.judge(at, "the largest " + std::string(gauge), {largest, largest / unit.factor, unit.name}, typical::opening);
}

/// One nuisance parameter; `scale` is a typical size of it, for default bounds.
void read_nuisance(const Context& c, const Place& at, const NuisanceInfo& which, double scale, DataSet& out) {
  if (!c.reader.object(at, "\"start\", \"lower\", \"upper\" or \"prior\"")) return;
  c.reader.known_keys(at, nuisance_keys);
  FitParameter p;
  p.name = out.name + '.' + std::string(which.name);
  p.symbol = which.symbol;
  p.unit = which.unit;
  Unit unit{which.unit, 1.0};
  if (which.unit == "m") {
    unit = read_unit(c, at, Quantity::length).value_or(unit);
  } else if (const JsonValue* v = at.value().find("unit"); v != nullptr && v->text != which.unit) {
    c.problem(Place(at, *v), "only \"" + std::string(which.unit) + "\" is known here");
  }
  const bool offset = which.unit == "m";
  p.lower = offset ? -scale : 0.0;
  p.upper = scale;
  const auto number = [&](std::string_view key, double& target) {
    const JsonValue* v = at.value().find(key);
    if (v == nullptr) return;
    if (const auto x = c.reader.number(Place(at, *v))) target = *x * unit.factor;
  };
  number("start", p.start);
  number("lower", p.lower);
  number("upper", p.upper);
  if (!(p.lower < p.upper) || p.start < p.lower || p.start > p.upper) {
    c.problem(at, "needs lower <= start <= upper and lower < upper; they are " + io::exact(p.lower) + ", " +
                      io::exact(p.start) + ", " + io::exact(p.upper) + ' ' + p.unit);
  }
  if (const JsonValue* v = at.value().find("prior")) {
    const Place prior(at, *v);
    if (!c.reader.object(prior, "\"mean\" and \"deviation\"")) return;
    c.reader.known_keys(prior, prior_keys);
    const JsonValue* mean = c.reader.required(prior, "mean");
    const JsonValue* deviation = c.reader.required(prior, "deviation");
    if (mean == nullptr || deviation == nullptr) return;
    const auto m = c.reader.number(Place(prior, *mean));
    const auto d = c.reader.positive(Place(prior, *deviation));
    if (m && d) p.prior = Prior{*m * unit.factor, *d * unit.factor};
  }
  out.nuisances.push_back(std::move(p));
}

/// Reads "nuisance"; returns for each fitted one its place in the model's list.
std::vector<Eigen::Index> read_nuisances(const SetContext& s, const Place& set, Gauge gauge, DataSet& out) {
  const JsonValue* given = set.value().find("nuisance");
  if (given == nullptr) return {};
  const Place at(set, *given);
  if (!s.c.reader.object(at, "nuisance parameters by name")) return {};
  const std::span<const NuisanceInfo> known = nuisances(gauge);
  std::vector<std::string_view> names;
  for (const NuisanceInfo& n : known) names.push_back(n.name);
  s.c.reader.known_keys(at, names);
  Eigen::Index peak = 0;
  const double largest_load = out.measured.maxCoeff(&peak);
  std::vector<Eigen::Index> places;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const JsonValue* v = given->find(known[k].name);
    if (v == nullptr) continue;
    // At most the reading at the peak is offset, or all of it taken up by the machine.
    const double reading = std::abs(out.abscissa[peak]);
    read_nuisance(s.c, Place(at, *v), known[k], known[k].unit == "m" ? reading : reading / largest_load, out);
    places.push_back(static_cast<Eigen::Index>(k));
  }
  return places;
}

void read_slope_part(const SetContext& s, const Place& set, NotchedData& data) {
  const JsonValue* given = set.value().find("initial_slope");
  if (given == nullptr) return;
  const Place at(set, *given);
  if (!s.c.reader.object(at, "\"from\" and \"to\", over the peak load")) return;
  s.c.reader.known_keys(at, slope_keys);
  if (const JsonValue* v = given->find("from")) {
    data.slope_from = s.c.reader.number_between(Place(at, *v), 0.0, 1.0, true).value_or(data.slope_from);
  }
  if (const JsonValue* v = given->find("to")) {
    data.slope_to = s.c.reader.number_between(Place(at, *v), 0.0, 1.0, true).value_or(data.slope_to);
  }
  if (!(data.slope_from < data.slope_to)) s.c.problem(at, "\"from\" must be below \"to\"");
}

void read_notched(const SetContext& s, const Place& set, SpecimenShape shape, DataSet& out) {
  const Context& c = s.c;
  c.reader.known_keys(set, set_keys({"geometry", "nuisance", "initial_slope"}, curve_keys));
  const std::size_t before = c.reader.problems().size();
  NotchedData data;
  NotchedSpecimenTest& test = data.test;
  test.specimen = read_geometry(s, set, shape);
  read_slope_part(s, set, data);
  std::vector<Wanted> gauges;
  for (const Word<Gauge>& word : Words<Gauge>::list) gauges.push_back({word.text, Quantity::length});
  const auto which = which_column(c, set, gauges);
  if (!which) return;
  test.gauge = Words<Gauge>::list[*which].value;
  const std::array<Wanted, 2> wanted = {gauges[*which], Wanted{"load", Quantity::force}};
  auto curve = read_curve(c, s.folder, set, {wanted, 1, 0, 4});
  if (!curve || c.reader.problems().size() != before) return;
  take_curve(*curve, 0, 1, out);
  const double largest = out.measured.maxCoeff();
  if (!(largest > 0.0)) {
    return c.problem(set,
                     "no load is positive; loads that bend the specimen are positive: if the machine counts them "
                     "negative, give the column \"scale\": -1");
  }
  judge_load(s, set, test.specimen, largest);
  judge_reading(s, set, wanted[0].name, out.abscissa.cwiseAbs().maxCoeff());
  test.readings = out.abscissa;
  const Validation found = validate(test);
  for (const Violation& v : found.errors) c.problem(set, v.field + " = " + io::exact(v.value) + ": " + v.constraint);
  data.fitted = read_nuisances(s, set, test.gauge, out);
  out.abscissa_axis = readable_axis(label_of(test.gauge), Quantity::length, out.abscissa.maxCoeff());
  out.value_axis = readable_axis("Load", Quantity::force, largest);
  out.test = std::move(data);
}

}  // namespace

void read_notched_beam(const SetContext& s, const Place& set, DataSet& out) {
  read_notched(s, set, SpecimenShape::beam, out);
}

void read_semicircular_bend(const SetContext& s, const Place& set, DataSet& out) {
  read_notched(s, set, SpecimenShape::semicircular, out);
}

}  // namespace fpz::calibration::detail

namespace fpz::calibration {

Prediction predict(const NotchedData& data, const Parameters& p, const Eigen::VectorXd& nuisance, bool derivatives) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nuisances(data.test.gauge).size()));
  all(data.fitted) = nuisance;
  Prediction x = predict(data.test, p, all, derivatives);
  if (!x.ok() || !derivatives) return x;
  Eigen::MatrixXd jacobian(x.values.size(), parameter_count + nuisance.size());
  jacobian.leftCols(parameter_count) = x.jacobian.leftCols(parameter_count);
  for (std::size_t k = 0; k < data.fitted.size(); ++k) {
    jacobian.col(parameter_count + static_cast<Eigen::Index>(k)) = x.jacobian.col(parameter_count + data.fitted[k]);
  }
  x.jacobian = std::move(jacobian);
  return x;
}

std::optional<NotchedData> at_abscissa(const NotchedData& data, const Eigen::VectorXd& readings) {
  NotchedData other = data;
  other.test.readings = readings;
  return other;
}

std::optional<ModulusEstimate> modulus_from_slope(const NotchedData& data, const Eigen::VectorXd& loads,
                                                  const Parameters& p) {
  const NotchedSpecimenTest& test = data.test;
  ModulusEstimate e;
  try {
    const InitialModulus m = initial_modulus(test.specimen, p.poisson_ratio, test.readings, loads, data.slope_from,
                                             data.slope_to, test.gauge);
    e.value = m.value;
    e.standard_error = m.standard_error;
    e.words = "straight line through " + std::to_string(m.points) + " points between " + io::exact(data.slope_from) +
              " and " + io::exact(data.slope_to) +
              " of the peak load; a process zone that forms before flattens it, so the modulus is a lower bound";
  } catch (const std::invalid_argument& why) {
    e.failure = why.what();
  }
  return e;
}

std::string model_warning(const NotchedData& /*data*/, const Parameters& p) { return mode_one_warning(p); }

}  // namespace fpz::calibration
