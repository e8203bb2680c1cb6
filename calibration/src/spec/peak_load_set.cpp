// Data sets of the kind "peak_load": the largest loads of single bending specimens.
#include <array>
#include <cmath>

#include "fpz/calibration/geometry_function.hpp"
#include "fpz/calibration/peak_load.hpp"
#include "notched_geometry.hpp"
#include "set_keys.hpp"

namespace fpz::calibration::detail {
namespace {

constexpr double default_relative_deviation = 0.05;
constexpr std::array<std::string_view, 5> point_keys = {"shape", "geometry", "load", "toughness", "name"};

/// The largest load (N) of a specimen of which only the toughness is handed down that a published formula made of it.
std::optional<double> load_of_toughness(const Context& c, const Place& object, const NotchedSpecimen& specimen) {
  const Place at(object, *object.value().find("toughness"));
  const auto toughness = read_judged(c, at, typical::toughness);
  if (!toughness) return std::nullopt;
  const auto f = published_geometry_function(specimen);
  if (!f) {
    c.problem(at, "for this geometry the program knows no published formula of the toughness; give the \"load\"");
    return std::nullopt;
  }
  return *toughness / stress_intensity(specimen, *f, 1.0);
}

void read_point(const SetContext& s, const Place& at, PeakLoadTest& test, std::vector<double>& loads, DataSet& out) {
  const Context& c = s.c;
  if (!c.reader.object(at, "\"geometry\" and \"load\" or \"toughness\"")) return;
  c.reader.known_keys(at, point_keys);
  SpecimenShape shape = SpecimenShape::beam;
  if (const JsonValue* v = at.value().find("shape")) {
    shape = read_word<SpecimenShape>(c, Place(at, *v), "shape").value_or(shape);
  }
  const std::size_t before = c.reader.problems().size();
  PeakLoadSpecimen point;
  point.specimen = read_geometry(s, at, shape);
  const bool by_toughness = at.value().find("toughness") != nullptr;
  const JsonValue* load = by_toughness ? at.value().find("load") : c.reader.required(at, "load");
  if (by_toughness && load != nullptr) c.problem(at, "has \"load\" and \"toughness\"; give one of them");
  if (c.reader.problems().size() != before) return;
  const auto value = by_toughness ? load_of_toughness(c, at, point.specimen)
                                  : read_judged(c, Place(at, *load), typical_load(point.specimen));
  if (!value) return;
  std::string label = "specimen " + std::to_string(test.specimens.size() + 1);
  if (const JsonValue* name = at.value().find("name")) label = c.reader.text(Place(at, *name), 100).value_or(label);
  test.specimens.push_back(std::move(point));
  loads.push_back(*value);
  out.labels.push_back(std::move(label));
}

}  // namespace

void read_peak_load(const SetContext& s, const Place& set, DataSet& out) {
  const Context& c = s.c;
  c.reader.known_keys(set, set_keys({"points", "deviation"}));
  const JsonValue* list = c.reader.required(set, "points");
  if (list == nullptr) return;
  const Place at(set, *list);
  if (!c.reader.array(at, "points")) return;
  PeakLoadTest test;
  std::vector<double> loads;
  for (const JsonValue& item : list->items) read_point(s, Place(at, item), test, loads, out);
  if (loads.empty()) return;
  const auto n = static_cast<Eigen::Index>(loads.size());
  out.measured = Eigen::Map<const Eigen::VectorXd>(loads.data(), n);
  out.deviation = default_relative_deviation * out.measured;
  out.deviation_known = false;
  out.deviation_words = "in proportion to the values, their common factor estimated from the residuals";
  if (set.value().find("deviation") != nullptr) {
    if (auto d = read_deviation(c, set, Quantity::force, out.measured)) {
      out.deviation = std::move(d->values);
      out.deviation_known = d->known;
      out.deviation_words = std::move(d->words);
    }
  } else if (n < 2) {
    c.problem(set, "missing key \"deviation\": from a single value no scatter can be estimated");
  }
  out.abscissa = Eigen::VectorXd::LinSpaced(n, 1.0, static_cast<double>(n));
  out.value_axis = readable_axis("Peak load", Quantity::force, out.measured.maxCoeff());
  out.test = std::move(test);
}

}  // namespace fpz::calibration::detail
