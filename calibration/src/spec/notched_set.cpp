// Data sets of notched specimens with a straight crack in mode I: load against a gauge's reading.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "data_set_reader.hpp"
#include "fpz/calibration/notched_specimen.hpp"
#include "fpz/calibration/rise.hpp"
#include "notched_geometry.hpp"
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
    case Gauge::load_line_opening:
      return "Opening on the load line";
  }
  return "";
}

constexpr std::array<std::string_view, 6> nuisance_keys = {"value", "start", "unit", "lower", "upper", "prior"};
constexpr std::array<std::string_view, 2> prior_keys = {"mean", "deviation"};
constexpr std::array<std::string_view, 2> slope_keys = {"from", "to"};
constexpr std::array<std::string_view, 1> work_keys = {"weight"};

/// The gauges that a specimen has, in the order in which columns are looked for.
std::vector<Gauge> gauges_of(SpecimenShape shape) {
  if (is_pulled_open(shape)) return {Gauge::cmod, Gauge::load_line_opening, Gauge::deflection_load_point};
  return {Gauge::cmod, Gauge::deflection_load_point, Gauge::deflection_mid_depth};
}

/// The vertical load of the machine that drives a wedge, in place of what splits the specimen.
constexpr std::string_view vertical_load = "vertical_load";

/// Turns the load of the machine into that of the specimen: P = P_v/(2 tan of the half angle).
void to_splitting_force(const Context& c, const Place& set, const NotchedSpecimen& g, DataSet& out) {
  if (g.wedge_slope == 0.0) {
    return c.problem(set, "\"vertical_load\" needs \"wedge_half_angle_deg\" in the geometry");
  }
  out.measured /= 2.0 * g.wedge_slope;
  out.deviation /= 2.0 * g.wedge_slope;
}

void judge_load(const SetContext& s, const Place& set, std::string_view name, const NotchedSpecimen& g,
                double largest) {
  Typical t = typical_load(g);
  if (name == vertical_load) t = scaled(t, Quantity::force, 0.5 / g.wedge_slope);
  const JsonValue* given = set.value().find("columns");
  if (given == nullptr) given = set.value().find("values");
  const Place columns(set, *given);
  const Place at(columns, *given->find(name));
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

/// A nuisance parameter as it is without any statement: start and bounds from the readings at the peak (m, N).
FitParameter usual_nuisance(const NuisanceInfo& which, const std::string& set, double reading, double load) {
  FitParameter p;
  p.name = set + '.' + std::string(which.name);
  p.symbol = which.symbol;
  p.unit = which.unit;
  const double scale = which.unit == "m" ? reading : which.unit == "N" ? load : reading / load;
  p.lower = which.any_sign ? -scale : 0.0;
  p.upper = scale;
  if (which.name == "toe") p.start = 0.05 * reading;
  if (which.name == "toe_load") {
    p.start = 0.1 * load;
    p.lower = 1e-3 * load;
  }
  return p;
}

/// Fills in what is stated of one nuisance parameter. Returns the value at which it is held, or nothing when it is
/// fitted.
std::optional<double> read_nuisance(const Context& c, const Place& at, const NuisanceInfo& which, FitParameter& p) {
  if (!c.reader.object(at, "\"value\", or \"start\", \"lower\", \"upper\" or \"prior\"")) return std::nullopt;
  c.reader.known_keys(at, nuisance_keys);
  Unit unit{which.unit, 1.0};
  if (which.unit == "m" || which.unit == "N") {
    unit = read_unit(c, at, which.unit == "m" ? Quantity::length : Quantity::force).value_or(unit);
  } else if (const JsonValue* v = at.value().find("unit"); v != nullptr && v->text != which.unit) {
    c.problem(Place(at, *v), "only \"" + std::string(which.unit) + "\" is known here");
  }
  const auto number = [&](std::string_view key, double& target) {
    const JsonValue* v = at.value().find(key);
    if (v == nullptr) return false;
    if (const auto x = c.reader.number(Place(at, *v))) target = *x * unit.factor;
    return true;
  };
  if (double held = 0.0; number("value", held)) {
    for (const std::string_view other : {"start", "lower", "upper", "prior"}) {
      if (at.value().find(other) == nullptr) continue;
      c.problem(at, "has \"value\", which holds it, and \"" + std::string(other) + "\", which is for a fitted one");
    }
    if (held < 0.0 && !which.any_sign) c.problem(at, "must be >= 0");
    return held;
  }
  number("start", p.start);
  number("lower", p.lower);
  number("upper", p.upper);
  if (!(p.lower < p.upper) || p.start < p.lower || p.start > p.upper) {
    c.problem(at, "needs lower <= start <= upper and lower < upper; they are " + io::exact(p.lower) + ", " +
                      io::exact(p.start) + ", " + io::exact(p.upper) + ' ' + p.unit);
  }
  if (const JsonValue* v = at.value().find("prior")) {
    const Place prior(at, *v);
    if (!c.reader.object(prior, "\"mean\" and \"deviation\"")) return std::nullopt;
    c.reader.known_keys(prior, prior_keys);
    const JsonValue* mean = c.reader.required(prior, "mean");
    const JsonValue* deviation = c.reader.required(prior, "deviation");
    if (mean == nullptr || deviation == nullptr) return std::nullopt;
    const auto m = c.reader.number(Place(prior, *mean));
    const auto d = c.reader.positive(Place(prior, *deviation));
    if (m && d) p.prior = Prior{*m * unit.factor, *d * unit.factor};
  }
  return std::nullopt;
}

/// Reads "nuisance": which of the model's list are fitted, and the values of those that are held.
void read_nuisances(const SetContext& s, const Place& set, NotchedData& data, DataSet& out) {
  const std::span<const NuisanceInfo> known = nuisances(data.test.gauge);
  data.held = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(known.size()));
  const JsonValue* given = set.value().find("nuisance");
  if (given == nullptr) return;
  const Place at(set, *given);
  if (!s.c.reader.object(at, "nuisance parameters by name")) return;
  std::vector<std::string_view> names;
  for (const NuisanceInfo& n : known) names.push_back(n.name);
  s.c.reader.known_keys(at, names);
  if ((given->find("toe") == nullptr) != (given->find("toe_load") == nullptr)) {
    s.c.problem(at, "\"toe\" and \"toe_load\" go together: what settles, and the load that it takes");
  }
  Eigen::Index peak = 0;
  const double load = out.measured.maxCoeff(&peak);
  const double reading = std::abs(out.abscissa[peak]);
  for (std::size_t k = 0; k < known.size(); ++k) {
    const JsonValue* v = given->find(known[k].name);
    if (v == nullptr) continue;
    const auto place = static_cast<Eigen::Index>(k);
    FitParameter p = usual_nuisance(known[k], out.name, reading, load);
    if (const auto held = read_nuisance(s.c, Place(at, *v), known[k], p)) {
      data.held[place] = *held;
    } else {
      data.fitted.push_back(place);
      out.nuisances.push_back(std::move(p));
    }
  }
}

std::string micrometres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g um", 1e6 * metres);
  return text;
}

/// Says so when the rise does not start at the origin and nothing in the specification takes care of that.
void judge_rise(const SetContext& s, const Place& set, const NotchedData& data, const DataSet& out) {
  const bool opening = is_opening(data.test.gauge);
  if (const JsonValue* given = set.value().find("nuisance")) {
    for (const std::string_view shift : {"cmod_offset", "deflection_offset", "toe"}) {
      if (given->find(shift) != nullptr) return;
    }
  }
  const std::optional<RiseIntercept> rise = rise_intercept(out.abscissa, out.measured);
  if (!rise) {
    s.c.warn(
        set,
        "there are too few points on the rise (four are needed between 0.2 and 0.7 of the peak load) to see whether "
        "it starts at the origin; slack or a toe would be taken for compliance, and young_modulus come out too low");
    return;
  }
  if (!rise->beyond_zero) return;
  s.c.warn(set,
           "the straight part of the rise (" + io::exact(rise->from) + " to " + io::exact(rise->to) +
               " of the peak load) meets zero load at " + micrometres(rise->reading) + ", not at zero: " +
               (opening ? "the gauge was not zeroed. Fit \"nuisance\": {\"cmod_offset\": {\"unit\": \"um\"}}"
                        : "slack, or a toe of settling rollers. Fit \"nuisance\": {\"deflection_offset\": {\"unit\": "
                          "\"um\"}}, or "
                          "for a curved beginning {\"toe\": {\"unit\": \"um\"}, \"toe_load\": {\"unit\": \"N\"}}") +
               ", or subtract it; as it is, the fit takes it for compliance, and young_modulus comes out too low");
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

/// "work_of_fracture": {"weight": ...}: G_F from the area under the curve, too.
void read_work(const SetContext& s, const Place& set, NotchedData& data, const DataSet& out) {
  const JsonValue* given = set.value().find("work_of_fracture");
  if (given == nullptr) return;
  const Place at(set, *given);
  if (!s.c.reader.object(at, "\"weight\", 0 where it is balanced")) return;
  s.c.reader.known_keys(at, work_keys);
  const JsonValue* weight = s.c.reader.required(at, "weight");
  if (weight == nullptr) return;
  const auto written = read_written(s.c, Place(at, *weight), Quantity::force);
  if (!written) return;
  data.weight = written->si;
  if (data.test.gauge == Gauge::cmod) {
    return s.c.problem(at, "needs deflections: the load does no work on the CMOD");
  }
  if (data.test.gauge == Gauge::deflection_mid_depth) {
    s.c.warn(at,
             "the load does its work on the deflection of the load point; with that at mid-depth G_F comes out a few "
             "per cent too large");
  }
  const std::optional<WorkOfFracture> work = measured_work(data, out.measured);
  if (!work->failure.empty()) s.c.problem(at, work->failure);
}

/// "self_weight": of the whole beam. By the bending moment at mid-span: w span^2/8, less w c^2/2 of what overhangs by
/// c.
void read_self_weight(const SetContext& s, const Place& set, NotchedData& data, const DataSet& out) {
  const JsonValue* given = set.value().find("self_weight");
  if (given == nullptr) return;
  const Place at(set, *given);
  const auto weight = read_written(s.c, at, Quantity::force);
  if (!weight) return;
  const NotchedSpecimen& g = data.test.specimen;
  if (g.shape != SpecimenShape::beam) return s.c.problem(at, "is known for beams only");
  if (!(weight->si >= 0.0)) return s.c.problem(at, "must be >= 0");
  if (const JsonValue* n = set.value().find("nuisance"); n != nullptr && n->find("toe") != nullptr) {
    return s.c.problem(at,
                       "does not go together with a toe: how far the rollers have settled under the weight is open");
  }
  const double overhang = 0.5 * (g.length - g.span);
  const double moment = weight->si / g.length * (0.125 * g.span * g.span - 0.5 * overhang * overhang);
  data.dead_load = 4.0 * moment / g.arms();
  const double peak = out.measured.maxCoeff();
  if (std::abs(data.dead_load) > 0.3 * peak) {
    s.c.problem(at, io::exact(weight->si) + " N bends the ligament as a load of " + io::exact(data.dead_load) +
                        " N does, more than 0.3 of the largest load, " + io::exact(peak) + " N");
  }
}

void read_notched(const SetContext& s, const Place& set, SpecimenShape shape, DataSet& out) {
  const Context& c = s.c;
  c.reader.known_keys(
      set, set_keys({"geometry", "nuisance", "initial_slope", "work_of_fracture", "self_weight"}, curve_keys));
  const std::size_t before = c.reader.problems().size();
  NotchedData data;
  NotchedSpecimenTest& test = data.test;
  test.specimen = read_geometry(s, set, shape);
  read_slope_part(s, set, data);
  std::vector<Wanted> gauges;
  const std::vector<Gauge> known = gauges_of(shape);
  for (const Gauge gauge : known) gauges.push_back({to_string(gauge), Quantity::length});
  std::vector<Wanted> loads = {{"load", Quantity::force}};
  if (shape == SpecimenShape::wedge_splitting) loads.push_back({vertical_load, Quantity::force});
  const auto which = which_column(c, set, gauges);
  const auto which_load = which ? which_column(c, set, loads) : std::nullopt;
  if (!which_load) return;
  test.gauge = known[*which];
  const std::array<Wanted, 2> wanted = {gauges[*which], loads[*which_load]};
  auto curve = read_curve(c, s.folder, set, {wanted, 1, 0, 4});
  if (!curve || c.reader.problems().size() != before) return;
  take_curve(*curve, 0, 1, out);
  const double machine = out.measured.maxCoeff();
  if (wanted[1].name == vertical_load) to_splitting_force(c, set, test.specimen, out);
  if (c.reader.problems().size() != before) return;
  const double largest = out.measured.maxCoeff();
  if (!(largest > 0.0)) {
    return c.problem(set,
                     "no load is positive; loads that open the crack are positive: if the machine counts them "
                     "negative, give the column \"scale\": -1");
  }
  judge_load(s, set, wanted[1].name, test.specimen, machine);
  judge_reading(s, set, wanted[0].name, out.abscissa.cwiseAbs().maxCoeff());
  test.readings = out.abscissa;
  const Validation found = validate(test);
  for (const Violation& v : found.errors) c.problem(set, v.field + " = " + io::exact(v.value) + ": " + v.constraint);
  read_nuisances(s, set, data, out);
  judge_rise(s, set, data, out);
  read_work(s, set, data, out);
  read_self_weight(s, set, data, out);
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

void read_compact_tension(const SetContext& s, const Place& set, DataSet& out) {
  read_notched(s, set, SpecimenShape::compact_tension, out);
}

void read_wedge_splitting(const SetContext& s, const Place& set, DataSet& out) {
  read_notched(s, set, SpecimenShape::wedge_splitting, out);
}

void read_double_cantilever(const SetContext& s, const Place& set, DataSet& out) {
  read_notched(s, set, SpecimenShape::double_cantilever, out);
}

}  // namespace fpz::calibration::detail

namespace fpz::calibration {

namespace {

/// A test under a dead load is one whose zeros lie on the elastic line at that load: the gauge's offset moves by the
/// reading there, and the loads by the dead one. `all` are the nuisance parameters, all of them.
Prediction predict_from_dead_load(const NotchedData& data, const Parameters& p, Eigen::VectorXd all, bool derivatives) {
  const NotchedSpecimenTest& test = data.test;
  const auto body = test.cache->get(test.specimen, p.poisson_ratio, derivatives);
  const int gauge = static_cast<int>(test.gauge);
  const bool opening = is_opening(test.gauge);
  const Eigen::Index offset = opening ? 0 : 1;
  const double machine = opening ? 0.0 : all[0];
  const double compliance = body->body.gauge_load[gauge] / p.young_modulus;
  all[offset] -= (compliance + machine) * data.dead_load;
  Prediction x = predict(test, p, all, derivatives);
  if (!x.ok()) return x;
  x.values.array() -= data.dead_load;
  if (!derivatives) return x;
  const Eigen::VectorXd by_offset = x.jacobian.col(parameter_count + offset);
  const auto add = [&](int column, double offset_rate) { x.jacobian.col(column) += offset_rate * by_offset; };
  add(static_cast<int>(Parameter::young_modulus), compliance / p.young_modulus * data.dead_load);
  add(static_cast<int>(Parameter::poisson_ratio), -body->d_nu->gauge_load[gauge] / p.young_modulus * data.dead_load);
  if (!opening) add(parameter_count, -data.dead_load);
  return x;
}

}  // namespace

Prediction predict(const NotchedData& data, const Parameters& p, const Eigen::VectorXd& nuisance, bool derivatives) {
  Eigen::VectorXd all = data.held.size() > 0
                            ? data.held
                            : Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nuisances(data.test.gauge).size()));
  all(data.fitted) = nuisance;
  Prediction x = data.dead_load != 0.0 ? predict_from_dead_load(data, p, all, derivatives)
                                       : predict(data.test, p, all, derivatives);
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

std::optional<WorkOfFracture> measured_work(const NotchedData& data, const Eigen::VectorXd& loads) {
  if (!data.weight) return std::nullopt;
  const NotchedSpecimen& s = data.test.specimen;
  return work_of_fracture(data.test.readings, loads, s.thickness * s.ligament(), *data.weight);
}

std::string model_warning(const NotchedData& /*data*/, const Parameters& p) { return mode_one_warning(p); }

}  // namespace fpz::calibration
