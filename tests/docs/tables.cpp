#include <cstdio>
#include <vector>

#include "blocks.hpp"
#include "fpz/io/material_file.hpp"
#include "fpz/law/softening.hpp"
#include "fpz/parameters.hpp"
#ifdef FPZ_DOCS_DRIVER
#include "fpz/driver/history.hpp"
#endif
#ifdef FPZ_DOCS_INTERFACES
#include "fpz/point/properties.hpp"
#include "fpz/point/state_layout.hpp"
#endif
#ifdef FPZ_DOCS_SPH
#include "fpz/specimen/history_columns.hpp"
#include "fpz/sph/energy.hpp"
#include "fpz/sph/option_table.hpp"
#endif

namespace fpz::docs {
namespace {

std::string code(std::string_view name) { return std::string("`").append(name).append("`"); }

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line.append(" ").append(cell).append(cell.empty() ? "|" : " |");
  return line + "\n";
}

std::string heading(const std::vector<std::string>& titles) {
  return row(titles) + row(std::vector<std::string>(titles.size(), "---"));
}

/// What a person writes of the parameters of a material and of H.
std::string parameters() {
  std::string table = heading({"key", "symbol", "unit", "bounds"});
  for (const ParameterInfo<double>& p : parameter_table<double>) {
    table += row({code(p.name), std::string(p.symbol), std::string(p.unit), p.bounds.text()});
  }
  const MaterialChoices choices;
  visit_choices(choices, [&table](const char* key, auto choice) {
    table += row({code(key), "", "", all_words<decltype(choice)>() + "; may be left out: " + to_string(choice)});
  });
  return table;
}

/// What may be stated in place of parameters.
std::string material_alternatives() {
  std::string table = heading({"key", "or", "quantity", "unit", "what follows"});
  for (const io::MaterialAlternative& a : io::material_alternatives()) {
    table += row({code(a.key), code(a.symbol), std::string(a.meaning), std::string(si_unit(a.typical.quantity)),
                  std::string(a.formula)});
  }
  return table;
}

std::string parameter_plausibility() {
  std::string table =
      heading({"parameter", "unit", "refused below", "doubtful below", "doubtful above", "refused above"});
  for (const ParameterInfo<double>& p : parameter_table<double>) {
    const Plausible& v = p.plausible;
    table +=
        row({code(p.name), std::string(p.unit), number(v.far_low), number(v.low), number(v.high), number(v.far_high)});
  }
  return table;
}

#ifdef FPZ_DOCS_DRIVER
std::string driver_history() {
  std::string table = heading({"column", "unit", "meaning"});
  for (const driver::Column& c : driver::columns()) {
    table += row({code(c.name), std::string(c.unit), std::string(c.meaning)});
  }
  return table;
}
constexpr auto* driver_history_table = driver_history;
#else
constexpr std::string (*driver_history_table)() = nullptr;
#endif

#ifdef FPZ_DOCS_INTERFACES
std::string interface_properties() {
  std::string table = heading({"place", "name", "unit", "values", "0 or missing"});
  int place = 0;
  for (const point::Property& p : point::properties()) {
    const std::string otherwise = p.name == "rve_length" ? "see the interface" : number(p.default_value);
    table += row({std::to_string(++place), code(p.name), p.unit, p.values, p.required ? "refused" : otherwise});
  }
  return table;
}

/// Runs of names with one beginning share a row.
std::string interface_state() {
  std::string table = heading({"plane settings", "solids", "names"});
  const auto places = [](int dim, const std::string& field) {
    const std::vector<std::string>& names = point::state_names(dim);
    std::size_t first = names.size(), last = 0;
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] != field && !names[k].starts_with(field + "_")) continue;
      first = std::min(first, k + 1);
      last = k + 1;
    }
    return std::to_string(first) + (last > first ? " to " + std::to_string(last) : "");
  };
  const auto list = [](const std::string& field) {
    std::string text;
    for (const std::string& name : point::state_names(3)) {
      if (name == field || name.starts_with(field + "_")) text += (text.empty() ? "" : ", ") + code(name);
    }
    return text;
  };
  State2 s;
  const auto add = [&](const std::string& field) { table += row({places(2, field), places(3, field), list(field)}); };
  visit_point(s, [&](const char* field, const auto&) { add(field); });
  visit_crack(s, [&](const char* field, const auto&) { add(field); });
  add("damage");
  return table;
}
constexpr auto* interface_properties_table = interface_properties;
constexpr auto* interface_state_table = interface_state;
#else
constexpr std::string (*interface_properties_table)() = nullptr;
constexpr std::string (*interface_state_table)() = nullptr;
#endif

#ifdef FPZ_DOCS_SPH
// How a default is written in a scene file.
std::string in_scene(double x) { return number(x); }
std::string in_scene(int x) { return std::to_string(x); }
std::string in_scene(const sph::RveLength& h) {
  return h.rule == sph::RveLength::Rule::number ? number(h.value) : code(to_string(h.rule));
}
std::string in_scene(const Vec<double, 2>& v) {
  return std::string("[").append(number(v[0])).append(", ").append(number(v[1])).append("]");
}
template <Worded E>
std::string in_scene(E word) {
  return code(to_string(word));
}

std::string method_options() {
  std::string table = heading({"key", "unit", "default", "meaning"});
  sph::for_each_option(sph::Options<2>(), [&](const sph::OptionInfo& info, const auto& value) {
    table += row({code(info.name), std::string(info.unit), in_scene(value), std::string(info.text)});
  });
  return table;
}

std::string energy_terms() {
  std::string table = heading({"term", "meaning"});
  for (const sph::EnergyTerm& term : sph::energy_terms) {
    if (term.role != sph::EnergyRole::initial) table += row({code(term.name), std::string(term.text)});
  }
  return table;
}

std::string sph_history() {
  std::string table = heading({"column", "unit", "meaning"});
  for (const specimen::HistoryColumn& c : specimen::history_columns({})) table += row({code(c.name), c.unit, c.text});
  return table;
}
constexpr auto* method_options_table = method_options;
constexpr auto* sph_history_table = sph_history;
constexpr auto* energy_terms_table = energy_terms;
#else
constexpr std::string (*method_options_table)() = nullptr;
constexpr std::string (*energy_terms_table)() = nullptr;
constexpr std::string (*sph_history_table)() = nullptr;
#endif

constexpr NamedTable tables[] = {
    {"parameters", parameters},
    {"material-alternatives", material_alternatives},
    {"parameter-plausibility", parameter_plausibility},
    {"driver-history", driver_history_table},
    {"interface-properties", interface_properties_table},
    {"interface-state", interface_state_table},
    {"method-options", method_options_table},
    {"energy-terms", energy_terms_table},
    {"sph-history", sph_history_table},
};

}  // namespace

std::span<const NamedTable> all_tables() { return tables; }

}  // namespace fpz::docs
