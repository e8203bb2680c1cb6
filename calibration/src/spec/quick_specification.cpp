#include "fpz/calibration/quick_specification.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fpz/io/input_reader.hpp"
#include "fpz/io/quantity_reader.hpp"

namespace fpz::calibration {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using io::InputError;
using Words = std::vector<std::string_view>;

/// Words by which a column is known, in lower case; single letters must be the whole name.
Words words_for(const std::string& what) {
  if (what == "load") return {"load", "force", "kraft", "last", "p", "f"};
  if (what != "deflection") return {"cmod", "cod", "mouth", "clip", "opening", "ffnung"};
  return {"deflection", "displacement", "durchbiegung", "stroke", "weg"};
}

/// The argument that says it.
std::string option_for(const std::string& key) {
  std::string option = "--" + key;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

bool is_known_by(const std::string& name, const Words& words) {
  const std::string lower = io::lower_case(name);
  const auto bare = lower.substr(0, lower.find_first_of("([ "));
  return std::any_of(words.begin(), words.end(), [&](std::string_view w) {
    return w.size() == 1 ? bare == w : lower.find(w) != std::string::npos;
  });
}

std::string list_of(const io::Table& table) {
  std::string text;
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    text += (k > 0 ? ", " : "") + std::to_string(k + 1) + ' ' + io::in_quotes(table.names[k]);
  }
  return text;
}

/// The column that is stated, or the only one whose name says what it is.
std::size_t find_column(const io::Table& table, const std::string& what, const QuickColumn& given) {
  const std::string& name = given.column;
  if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos && !table.index(name)) {
    const auto number = static_cast<std::size_t>(std::stoul(name.substr(0, 6)));
    if (number >= 1 && number <= table.columns.size()) return number - 1;
    throw InputError(option_for(what) + " " + name + ": " + table.origin + " has " +
                     std::to_string(table.columns.size()) + " columns");
  }
  if (!name.empty()) {
    const auto index = table.index(name);
    if (!index) throw InputError(option_for(what) + " " + name + ": " + table.no_column(name));
    return *index;
  }
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    if (what == "load" && is_known_by(table.names[k], words_for("cmod"))) continue;  // "load line opening"
    if (is_known_by(table.names[k], words_for(what))) found.push_back(k);
  }
  if (found.size() == 1) return found.front();
  throw InputError(table.origin + ": " + (found.empty() ? "no column is" : "several columns may be") + " the " + what +
                   "; say " + option_for(what) + " with the name or the number of one of " + list_of(table));
}

/// The column as a specification names it. What it is in must be known from the file or from the arguments.
Json column_json(const io::Table& table, const std::string& what, const QuickColumn& given) {
  const std::size_t k = find_column(table, what, given);
  if (given.unit.empty() && table.units[k].empty()) {
    throw InputError(table.origin + " does not say what column " + io::in_quotes(table.names[k]) + " is in; say " +
                     option_for(what) + "-unit, such as " + option_for(what) + "-unit " +
                     (what == "load" ? "kN" : "mm"));
  }
  const auto& values = table.columns[k];
  const double largest = *std::max_element(values.begin(), values.end(), [](double a, double b) { return a < b; });
  if (what == "load" && !(largest * given.scale > 0.0) && given.scale > 0.0) {
    throw InputError(table.origin + ": no load in column " + io::in_quotes(table.names[k]) +
                     " is positive; if the machine counts them negative, say --load-scale=-1");
  }
  Json j;
  const auto same = std::count(table.names.begin(), table.names.end(), table.names[k]);
  if (same == 1 && !table.names[k].empty()) {
    j["column"] = table.names[k];
  } else {
    j["column"] = k + 1;
  }
  j["unit"] = given.unit.empty() ? table.units[k] : given.unit;
  if (given.scale != 1.0) j["scale"] = given.scale;
  return j;
}

/// In the unit in which all lengths are given, else in metres.
Json geometry_json(const QuickFit& fit) {
  std::vector<io::Written> values;
  for (const auto& [key, text] : fit.lengths) {
    values.push_back(io::written_in(text, io::Quantity::length, option_for(key)));
  }
  const bool one_unit =
      std::all_of(values.begin(), values.end(), [&](const io::Written& v) { return v.unit == values.front().unit; });
  Json j = {{"unit", one_unit && !values.empty() ? std::string(values.front().unit) : "m"}};
  for (std::size_t k = 0; k < values.size(); ++k) j[fit.lengths[k].first] = one_unit ? values[k].number : values[k].si;
  if (fit.wedge_half_angle_deg) j["wedge_half_angle_deg"] = *fit.wedge_half_angle_deg;
  return j;
}

Json parameters_json(const QuickFit& fit) {
  Json j;
  if (fit.young_modulus.empty()) {
    j["young_modulus"] = {{"start", 30}, {"unit", "GPa"}, {"lower", 1}, {"upper", 150}};
  } else {
    const io::Written e = io::written_in(fit.young_modulus, io::Quantity::stress, "--young-modulus");
    j["young_modulus"] = {{"value", e.number}, {"unit", std::string(e.unit)}};
  }
  j["poisson_ratio"] = fit.poisson_ratio;
  j["density"] = 2400;
  j["tensile_strength"] = {{"start", 3}, {"unit", "MPa"}, {"lower", 0.3}, {"upper", 30}};
  j["cohesion"] = {{"value", 60}, {"unit", "MPa"}};
  j["friction_angle_deg"] = 35;
  j["dilation_angle_deg"] = 5;
  j["delta0"] = {{"start", 30}, {"unit", "um"}, {"lower", 1}, {"upper", 600}};
  j["normal_stiffness"] = 1e14;
  j["shear_stiffness"] = 1e14;
  if (!fit.softening.empty()) j["softening"] = fit.softening;
  return j;
}

void put_table_options(Json& j, const io::CsvOptions& o) {
  if (o.separator) j["separator"] = to_string(*o.separator);
  if (o.decimal) j["decimal"] = to_string(*o.decimal);
  if (o.skip_rows) j["skip_rows"] = *o.skip_rows;
  if (o.rows) j["rows"] = *o.rows;
  if (o.encoding) j["encoding"] = to_string(*o.encoding);
}

}  // namespace

std::string quick_specification(const QuickFit& fit, const fs::path& folder) {
  const Json geometry = geometry_json(fit);
  const io::Table table = io::read_csv(fit.data, fit.table);
  const fs::path here = fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal();
  const std::string stem = fit.data.stem().string();
  Json set = {{"name", stem.substr(0, 100)}, {"kind", fit.kind}, {"geometry", geometry}};
  set["file"] = fs::absolute(fit.data).lexically_normal().lexically_relative(here).generic_string();
  put_table_options(set, fit.table);
  set["columns"] = {{fit.gauge, column_json(table, fit.gauge, fit.reading)},
                    {fit.wedge_half_angle_deg ? "vertical_load" : "load", column_json(table, "load", fit.load)}};
  Json j = {{"name", stem.substr(0, 100)}, {"setting", fit.setting}, {"parameters", parameters_json(fit)}};
  j["notes"] =
      "Made by fpz-calibrate from the arguments of a command. Assumed: density, cohesion, friction and dilation angle "
      "and both stiffnesses, on which a crack in pure mode I hardly depends; replace them by what is known.";
  j["options"] = {{"profiles", Json::array()}};
  j["data"] = Json::array({set});
  return j.dump(2) + "\n";
}

}  // namespace fpz::calibration
