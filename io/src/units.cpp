#include "fpz/io/units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace fpz::io {

namespace {

struct UnitsOf {
  Quantity quantity;
  std::vector<Unit> units;
};

const std::vector<UnitsOf>& table() {
  static const double root_milli = std::sqrt(1e-3);
  static const std::vector<UnitsOf> list = {
      {Quantity::length, {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}}},
      {Quantity::force, {{"N", 1.0}, {"kN", 1e3}, {"MN", 1e6}}},
      {Quantity::stress, {{"Pa", 1.0}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}, {"N/mm2", 1e6}}},
      {Quantity::energy_per_area, {{"J/m2", 1.0}, {"N/m", 1.0}, {"N/mm", 1e3}, {"kJ/m2", 1e3}, {"mJ/mm2", 1e3}}},
      {Quantity::toughness,
       {{"Pa.sqrt(m)", 1.0}, {"kPa.sqrt(m)", 1e3}, {"MPa.sqrt(m)", 1e6}, {"MPa.sqrt(mm)", 1e6 * root_milli}}},
      {Quantity::stiffness,
       {{"Pa/m", 1.0}, {"MPa/m", 1e6}, {"GPa/m", 1e9}, {"MPa/mm", 1e9}, {"GPa/mm", 1e12}, {"N/mm3", 1e9}}},
      {Quantity::density, {{"kg/m3", 1.0}, {"g/cm3", 1e3}, {"t/m3", 1e3}}},
      {Quantity::angle, {{"deg", 1.0}, {"rad", 180.0 / std::numbers::pi}}},
      {Quantity::number, {{"", 1.0}, {"%", 1e-2}, {"1e-3", 1e-3}, {"1e-6", 1e-6}}}};
  return list;
}

/// Understood, but not offered: a number that would be usual in psi is rarely one in psi.
const std::vector<UnitsOf>& further_table() {
  static constexpr double inch = 0.0254, pound_force = 4.4482216152605, psi = pound_force / (inch * inch);
  static const double root_inch = std::sqrt(inch), root_milli = std::sqrt(1e-3);
  static const std::vector<UnitsOf> list = {
      {Quantity::length, {{"in", inch}, {"inch", inch}, {"micron", 1e-6}}},
      {Quantity::force, {{"lbf", pound_force}, {"kip", 1e3 * pound_force}, {"kgf", 9.80665}}},
      {Quantity::stress,
       {{"N/m2", 1.0}, {"MN/m2", 1e6}, {"kN/mm2", 1e9}, {"bar", 1e5}, {"psi", psi}, {"ksi", 1e3 * psi}}},
      {Quantity::energy_per_area, {{"Nm/m2", 1.0}, {"N.m/m2", 1.0}, {"kN/m", 1e3}, {"J/mm2", 1e6}}},
      {Quantity::toughness,
       {{"N/m1.5", 1.0},
        {"kN/m1.5", 1e3},
        {"MN/m1.5", 1e6},
        {"N/mm1.5", 1e6 * root_milli},
        {"psi.sqrt(in)", psi * root_inch},
        {"ksi.sqrt(in)", 1e3 * psi * root_inch}}},
      {Quantity::stiffness, {{"N/m3", 1.0}, {"MN/m3", 1e6}}},
      {Quantity::density, {{"g/cc", 1e3}, {"kg/dm3", 1e3}, {"kg/l", 1e3}}},
      {Quantity::angle, {{"degree", 1.0}, {"degrees", 1.0}, {"°", 1.0}}},
      {Quantity::number, {{"-", 1.0}, {"mm/m", 1e-3}, {"um/m", 1e-6}, {"ue", 1e-6}}}};
  return list;
}

struct Spelling {
  std::string_view written, meant;
};

/// Replaced one after the other.
constexpr Spelling spellings[] = {{"µ", "u"},     {"μ", "u"},       {"ε", "e"},       {"²", "2"},
                                  {"³", "3"},     {"·", "."},       {"⋅", "."},       {"*", "."},
                                  {"√", "sqrt"},  {"^", ""},        {"½", "0.5"},     {"3/2", "1.5"},
                                  {"1/2", "0.5"}, {"(1.5)", "1.5"}, {"(0.5)", "0.5"}, {"(-1.5)", "-1.5"}};

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

/// The end of the text, when it is that; with the points before it, which set it off.
bool replace_end(std::string& text, std::string_view end, std::string_view with) {
  if (!text.ends_with(end)) return false;
  text.resize(text.size() - end.size());
  while (text.ends_with('.')) text.pop_back();
  text += with;
  return true;
}

/// Roots of lengths: m0.5 and sqrtm are sqrt(m), m-1.5 is /m1.5.
void tidy_root(std::string& text) {
  for (const std::string length : {"mm", "in", "m"}) {
    const std::string root = ".sqrt(" + length + ')';
    for (const std::string& other : {root.substr(1), length + "0.5", "sqrt" + length}) {
      if (replace_end(text, other, root)) return;
    }
    if (replace_end(text, length + "-1.5", '/' + length + "1.5")) return;
  }
}

/// One spelling for all that mean the same.
std::string usual_spelling(std::string_view name) {
  std::string text(name);
  std::erase(text, ' ');
  for (const Spelling& s : spellings) replace_all(text, s.written, s.meant);
  tidy_root(text);
  return text;
}

const Unit* find_in(const std::vector<UnitsOf>& list, Quantity q, std::string_view name) {
  for (const UnitsOf& of : list) {
    if (of.quantity != q) continue;
    for (const Unit& unit : of.units) {
      if (unit.name == name) return &unit;
    }
  }
  return nullptr;
}

}  // namespace

const std::vector<Unit>& units(Quantity q) {
  const std::vector<UnitsOf>& all = table();
  return std::find_if(all.begin(), all.end(), [q](const UnitsOf& u) { return u.quantity == q; })->units;
}

std::string_view si_unit(Quantity q) { return units(q).front().name; }

Quantity quantity_of(std::string_view si_unit) {
  for (const UnitsOf& u : table()) {
    if (u.units.front().name == si_unit) return u.quantity;
  }
  throw std::invalid_argument("no quantity has the SI unit \"" + std::string(si_unit) + '"');
}

std::optional<Unit> find_unit(Quantity q, std::string_view name) {
  const std::string usual = usual_spelling(name);
  for (const std::vector<UnitsOf>* list : {&table(), &further_table()}) {
    for (const std::string_view spelling : {name, std::string_view(usual)}) {
      if (const Unit* unit = find_in(*list, q, spelling)) return *unit;
    }
  }
  return std::nullopt;
}

std::optional<double> unit_factor(Quantity q, std::string_view name) {
  const std::optional<Unit> unit = find_unit(q, name);
  if (!unit) return std::nullopt;
  return unit->factor;
}

bool is_si_unit(std::string_view name) {
  const std::vector<UnitsOf>& all = table();
  return name == "s" ||
         std::any_of(all.begin(), all.end(), [name](const UnitsOf& u) { return unit_factor(u.quantity, name) == 1.0; });
}

bool is_unit(std::string_view name) {
  const std::vector<UnitsOf>& all = table();
  return !name.empty() && std::any_of(all.begin(), all.end(),
                                      [name](const UnitsOf& u) { return find_unit(u.quantity, name).has_value(); });
}

}  // namespace fpz::io
