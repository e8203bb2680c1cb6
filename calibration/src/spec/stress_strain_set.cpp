// Data sets of the kind "stress_strain": an RVE along a loading path of the driver.
#include <algorithm>
#include <array>
#include <cmath>

#include "data_set_reader.hpp"
#include "fpz/calibration/stress_strain.hpp"
#include "set_keys.hpp"

namespace fpz::calibration::detail {
namespace {

constexpr std::size_t longest_text = 4000;
constexpr std::array<std::string_view, 12> component_columns = {"eps_xx", "eps_yy", "eps_zz", "eps_xy",
                                                                "eps_xz", "eps_yz", "sig_xx", "sig_yy",
                                                                "sig_zz", "sig_xy", "sig_xz", "sig_yz"};

Quantity quantity_of(std::size_t column) { return column < 6 ? Quantity::number : Quantity::stress; }

std::optional<driver::Test> read_path(const SetContext& s, const Place& set) {
  const Context& c = s.c;
  const JsonValue* path = c.reader.required(set, "path");
  if (path == nullptr) return std::nullopt;
  const Place at(set, *path);
  const auto name = c.reader.text(at, longest_text);
  if (!name || name->find('\0') != std::string::npos) return std::nullopt;
  driver::PathFile file;
  try {
    file = driver::read_path_file((s.folder / *name).lexically_normal());
  } catch (const io::InputError& e) {
    c.problem(at, "the path file has problems:\n" + std::string(e.what()));
    return std::nullopt;
  }
  std::vector<std::string_view> names;
  for (const driver::Test& test : file.tests) names.push_back(test.name);
  const JsonValue* which = set.value().find("test");
  if (which == nullptr) {
    if (file.tests.size() == 1) return file.tests.front();
    c.problem(set, "missing key \"test\": the path file has several");
    return std::nullopt;
  }
  const auto k = read_choice(c, Place(set, *which), "test", names);
  if (!k) return std::nullopt;
  return file.tests[*k];
}

/// The column beside the measured one: "time" or a strain.
std::optional<std::size_t> abscissa_column(const Context& c, const Place& set, std::size_t measured) {
  std::vector<Wanted> candidates = {{"time", Quantity::number}};
  for (std::size_t k = 0; k < 6; ++k) candidates.push_back({component_columns[k], Quantity::number});
  std::erase_if(candidates, [&](const Wanted& w) { return w.name == component_columns[measured]; });
  const auto which = which_column(c, set, candidates);
  if (!which) return std::nullopt;
  const auto all = std::find(component_columns.begin(), component_columns.end(), candidates[*which].name);
  return static_cast<std::size_t>(all - component_columns.begin());  // past the end: time
}

void read_window(const Context& c, const Place& at, StressStrainTest& test) {
  if (!c.reader.array(at, "two path times")) return;
  const std::vector<JsonValue>& items = at.value().items;
  if (items.size() != 2) return c.problem(at, "needs two path times, has " + std::to_string(items.size()));
  const auto a = c.reader.number(Place(at, items[0]));
  const auto b = c.reader.number(Place(at, items[1]));
  if (!a || !b) return;
  if (!(*a < *b)) return c.problem(at, "the first path time must be below the second");
  test.window = {*a, *b};
}

}  // namespace

void read_stress_strain(const SetContext& s, const Place& set, DataSet& out) {
  const Context& c = s.c;
  c.reader.known_keys(set, set_keys({"path", "test", "measured", "window"}, curve_keys));
  const std::size_t before = c.reader.problems().size();
  StressStrainTest test;
  if (auto path = read_path(s, set)) test.path = std::move(*path);
  const JsonValue* named = c.reader.required(set, "measured");
  if (named == nullptr) return;
  const auto measured = read_choice(c, Place(set, *named), "component", component_columns);
  if (!measured) return;
  if (const JsonValue* v = set.value().find("window")) read_window(c, Place(set, *v), test);
  const auto abscissa = abscissa_column(c, set, *measured);
  if (!abscissa || c.reader.problems().size() != before) return;
  const bool over_time = *abscissa >= component_columns.size();
  const std::string_view abscissa_name = over_time ? "time" : component_columns[*abscissa];
  const std::array<Wanted, 2> wanted = {Wanted{abscissa_name, Quantity::number},
                                        Wanted{component_columns[*measured], quantity_of(*measured)}};
  const auto curve = read_curve(c, s.folder, set, {wanted, 1, 0, 2});
  if (!curve) return;
  take_curve(*curve, 0, 1, out);
  const double largest = out.measured.cwiseAbs().maxCoeff();
  if (*measured >= 6) {
    Typical stress = typical::compressive_stress;
    stress.range.low = typical::tensile_stress.range.low;
    stress.range.far_low = typical::tensile_stress.range.far_low;
    c.judge(set, "the largest " + std::string(component_columns[*measured]), {largest, largest, "Pa"}, stress);
  }
  test.ordinate = {*measured < 6 ? TensorKind::strain : TensorKind::stress, static_cast<int>(*measured % 6)};
  if (!over_time) test.abscissa_strain = static_cast<int>(*abscissa);
  test.points.assign(out.abscissa.begin(), out.abscissa.end());
  out.abscissa_axis = {over_time ? "Path time (stages)" : "Strain " + std::string(abscissa_name), "", 1.0};
  out.value_axis = readable_axis((*measured < 6 ? "Strain " : "Stress ") + std::string(component_columns[*measured]),
                                 quantity_of(*measured), largest);
  out.test = std::move(test);
}

}  // namespace fpz::calibration::detail
