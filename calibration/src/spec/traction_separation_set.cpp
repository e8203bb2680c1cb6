// Data sets of the kind "traction_separation": one cohesive zone under prescribed jumps or normal traction.
#include <algorithm>
#include <array>

#include "data_set_reader.hpp"
#include "fpz/calibration/traction_separation.hpp"
#include "set_keys.hpp"

namespace fpz::calibration::detail {
namespace {

constexpr std::array<Wanted, 4> columns = {Wanted{to_string(ZoneQuantity::normal_jump), Quantity::length},
                                           Wanted{"slip", Quantity::length},
                                           Wanted{to_string(ZoneQuantity::normal_traction), Quantity::stress},
                                           Wanted{to_string(ZoneQuantity::shear_traction), Quantity::stress}};
enum Column : std::size_t { opening, slip, normal_traction, shear_traction };
constexpr std::array<const char*, 4> labels = {"Opening", "Slip", "Normal traction", "Shear traction"};

Column column_of(ZoneQuantity q) {
  switch (q) {
    case ZoneQuantity::normal_traction:
      return normal_traction;
    case ZoneQuantity::shear_traction:
      return shear_traction;
    case ZoneQuantity::normal_jump:
      break;
  }
  return opening;
}

bool has(const Place& set, std::string_view name) {
  for (const std::string_view key : {"columns", "values"}) {
    const JsonValue* object = set.value().find(key);
    if (object != nullptr && object->is(JsonValue::Kind::object) && object->find(name) != nullptr) return true;
  }
  return false;
}

/// The columns that the data set has, the measured one last.
std::vector<Column> present(const Place& set, Column measured) {
  std::vector<Column> list;
  for (const Column c : {slip, opening, normal_traction}) {
    if (c != measured && has(set, columns[c].name)) list.push_back(c);
  }
  list.push_back(measured);
  return list;
}

}  // namespace

void read_traction_separation(const SetContext& s, const Place& set, DataSet& out) {
  const Context& c = s.c;
  c.reader.known_keys(
      set, set_keys({"measured", "constant_normal_traction", "elastic_before_onset", "onset_angle_deg"}, curve_keys));
  const std::size_t before = c.reader.problems().size();
  const JsonValue* named = c.reader.required(set, "measured");
  if (named == nullptr) return;
  const auto which = read_word<ZoneQuantity>(c, Place(set, *named), "quantity");
  if (!which) return;
  const Column measured = column_of(*which);
  const std::vector<Column> list = present(set, measured);
  const auto position = [&](Column column) -> std::optional<std::size_t> {
    const auto at = std::find(list.begin(), list.end(), column);
    if (at == list.end()) return std::nullopt;
    return static_cast<std::size_t>(at - list.begin());
  };
  const auto prescribed = [&](Column column) { return column != measured && position(column); };

  TractionSeparationTest test;
  std::optional<double> constant;
  if (const JsonValue* v = set.value().find("constant_normal_traction")) {
    const auto x = read_written(c, Place(set, *v), Quantity::stress);
    if (x) constant = x->si;
    if (x && x->si != 0.0)
      c.judge(Place(set, *v), "its size", {std::abs(x->si), std::abs(x->number), x->unit}, typical::pressure);
  }
  if (const JsonValue* v = set.value().find("elastic_before_onset")) {
    test.elastic_before_onset = read_boolean(c, Place(set, *v)).value_or(false);
  }
  if (const JsonValue* v = set.value().find("onset_angle_deg")) {
    test.onset_angle_deg = c.reader.number_between(Place(set, *v), 0.0, 179.9, true);
  }
  const int ways = (prescribed(opening) ? 1 : 0) + (prescribed(normal_traction) ? 1 : 0) + (constant ? 1 : 0);
  if (ways != 1) {
    c.problem(set,
              "prescribe the normal direction in one way: a column \"opening\" or \"normal_traction\" that is not "
              "the measured one, or \"constant_normal_traction\"");
  }
  if (measured != normal_traction && !prescribed(slip)) c.problem(set, "needs a column \"slip\"");
  if (c.reader.problems().size() != before) return;

  std::vector<Wanted> wanted;
  for (const Column column : list) wanted.push_back(columns[column]);
  const bool slipping = prescribed(slip) && (measured != normal_traction || !prescribed(opening));
  const Column abscissa = slipping ? slip : opening;
  const auto curve = read_curve(c, s.folder, set, {wanted, list.size() - 1, position(abscissa), 2});
  if (!curve) return;
  take_curve(*curve, *position(abscissa), list.size() - 1, out);
  const double largest_jump = out.abscissa.cwiseAbs().maxCoeff();
  c.judge(set, "the largest " + std::string(columns[abscissa].name), {largest_jump, largest_jump, "m"},
          typical::opening);
  const double largest = out.measured.cwiseAbs().maxCoeff();
  const bool is_length = measured == opening;
  c.judge(set, "the largest " + std::string(columns[measured].name), {largest, largest, is_length ? "m" : "Pa"},
          is_length ? typical::opening : typical::shear_stress);
  for (Eigen::Index k = 0; k < curve->columns.front().size(); ++k) {
    const auto at = [&](Column column) { return curve->columns[*position(column)][k]; };
    ZoneRow row;
    if (prescribed(slip)) row.shear_jump = at(slip);
    if (prescribed(opening)) row.normal_jump = at(opening);
    if (prescribed(normal_traction)) row.normal_traction = at(normal_traction);
    if (constant) row.normal_traction = *constant;
    test.rows.push_back(row);
  }
  for (const Eigen::Index k : curve->used) test.points.push_back({static_cast<int>(k), *which});
  out.abscissa_axis = readable_axis(labels[abscissa], Quantity::length, largest_jump);
  out.value_axis = readable_axis(labels[measured], columns[measured].quantity, largest);
  out.test = std::move(test);
}

}  // namespace fpz::calibration::detail
