#include "material_statements.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "fpz/io/material_conversion.hpp"
#include "fpz/io/quantity_reader.hpp"

namespace fpz::io {
namespace {

// Of stiffnesses: as for Young's modulus.
constexpr Typical modulus{Quantity::stress, {2e7, 1e8, 1.5e11, 1e12}};

constexpr std::array<MaterialAlternative, 7> alternatives = {{
    {"bulk_modulus", "K", "bulk modulus", "E = 9 K G/(3 K + G), nu = (3 K - 2 G)/(6 K + 2 G) (Landau and Lifshitz)",
     modulus},
    {"shear_modulus", "G", "shear modulus", "the same", modulus},
    {"brazilian_strength", "sigma_bz", "splitting stress 2 P/(pi D t) of a disc",
     "sigma_t0 = 2 P/(pi D t) (ISRM 1978; the centre cracks normal to the tension)", typical::tensile_stress},
    {"bending_strength", "f_r", "6 M/(t d^2) of an unnotched beam of the depth d",
     "sigma_t0 = f_r a/(1 + a), a = 0.06 (d/mm)^0.7 (fib Model Code 2010, eq 5.1-8, for concrete)",
     typical::tensile_stress},
    {"compressive_strength", "UCS", "peak stress of uniaxial compression",
     "c0 with which sqrt(q^2/4 + A^2) = c0 cos(phi) + q/2 sin(phi), A = c0 - sigma_t0 tan(phi): the Mohr circle of "
     "uniaxial compression touches the yield surface",
     typical::compressive_stress},
    {"fracture_energy", "G_I", "fracture energy in mode I", "delta0 = G_I/sigma_t0", typical::fracture_energy},
    {"toughness", "K_Ic", "fracture toughness in mode I",
     "G_I = K_Ic^2/E' (Irwin 1957), E' = E/(1 - nu^2) in plane strain, E in plane stress; delta0 = G_I/sigma_t0",
     typical::toughness},
}};

}  // namespace

std::span<const MaterialAlternative> material_alternatives() { return alternatives; }

namespace detail {
namespace {

using Keys = std::vector<std::string_view>;
using Statement = MaterialStatement;

/// Quantities that determine the same parameters: `needed` of them.
struct Group {
  std::array<std::string_view, 4> keys;
  std::size_t needed = 1;

  [[nodiscard]] bool has(std::string_view key) const {
    return !key.empty() && std::find(keys.begin(), keys.end(), key) != keys.end();
  }
};
constexpr std::array<Group, 4> groups = {{
    {{"young_modulus", "poisson_ratio", "bulk_modulus", "shear_modulus"}, 2},
    {{"tensile_strength", "brazilian_strength", "bending_strength"}},
    {{"cohesion", "compressive_strength"}},
    {{"delta0", "fracture_energy", "toughness"}},
}};

const Group* group_of(std::string_view key) {
  const auto found = std::find_if(groups.begin(), groups.end(), [key](const Group& g) { return g.has(key); });
  return found == groups.end() ? nullptr : &*found;
}

const MaterialAlternative* alternative(std::string_view key) {
  const auto found = std::find_if(alternatives.begin(), alternatives.end(),
                                  [key](const MaterialAlternative& a) { return a.key == key || a.symbol == key; });
  return found == alternatives.end() ? nullptr : &*found;
}

/// The key under which a quantity is kept; empty for other keys.
std::string_view usual_key(std::string_view key) {
  for (const ParameterInfo<double>& p : material_keys) {
    if (p.name == key) return p.name;
  }
  const MaterialAlternative* a = alternative(key);
  return a != nullptr ? a->key : std::string_view();
}

std::string digits(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.5g", x);
  return text.data();
}

std::string shown_statement(const Statement& s) {
  std::string text = std::string(s.key) + " = " + exact(s.value.number);
  if (!s.value.unit.empty()) text.append(" ").append(s.value.unit);
  return text;
}

/// Reads what belongs to a quantity besides its value.
void read_circumstances(const InputReader& reader, const Place& at, Statement& s) {
  const JsonValue& v = at.value();
  if (s.key == "toughness" && v.is(JsonValue::Kind::object)) {
    const JsonValue* setting = v.find("setting");
    const auto word = setting != nullptr ? reader.text(Place(at, *setting), 40) : std::nullopt;
    if (!word) return;
    const auto known = from_word<Setting>(*word);
    if (known && *known != Setting::three_d) {
      s.setting = *known;
    } else {
      reader.problem(Place(at, *setting), in_quotes(*word) + " is not known; it must be plane_strain or plane_stress");
    }
  }
  if (s.key == "bending_strength") {
    const JsonValue* depth = v.is(JsonValue::Kind::object) ? v.find("depth") : nullptr;
    if (depth == nullptr) {
      reader.problem(
          at, "needs the depth of the beam, which the strength depends on: {\"value\": " + exact(s.value.number) +
                  ", \"unit\": \"" + std::string(s.value.unit) + "\", \"depth\": {\"value\": 100, \"unit\": \"mm\"}}");
      return;
    }
    const Place place(at, *depth);
    const auto x = read_written(reader, place, Quantity::length);
    if (!x) return;
    const Judgement j = judge("depth", *x, typical::specimen_size);
    if (!(x->si > 0.0) || j.verdict == Verdict::impossible) {
      reader.problem(place, x->si > 0.0 ? j.text : exact(x->number) + ": must be > 0");
    }
    s.depth = x->si;
  }
}

Keys circumstance_keys(std::string_view key) {
  if (key == "toughness") return {"setting"};
  if (key == "bending_strength") return {"depth"};
  return {};
}

/// Impossible values of a quantity that is no parameter are problems, doubtful ones warnings. Parameters are judged by
/// check_material().
void judge_statement(const InputReader& reader, const Place& at, const Statement& s, MaterialFile& material) {
  const MaterialAlternative* a = alternative(s.key);
  if (a == nullptr) return;
  if (!(s.value.si > 0.0)) return reader.problem(at, exact(s.value.number) + ": must be > 0");
  const Judgement j = judge(s.key, s.value, a->typical);
  if (j.verdict == Verdict::impossible) reader.problem(at, j.text);
  if (j.verdict == Verdict::doubtful) material.warnings.push_back(reader.where(at) + ": " + j.text);
}

Quantity quantity_of_key(std::string_view key) {
  if (const MaterialAlternative* a = alternative(key)) return a->typical.quantity;
  return typical_parameter(key).quantity;
}

class Resolver {
 public:
  Resolver(MaterialFile& material, Problems& problems) : m_(material), problems_(problems) {}

  void resolve() {
    m_.conversions.clear();
    const std::size_t before = problems_.size();
    refuse_doubles();
    if (problems_.size() != before) return;
    for (const ParameterInfo<double>& p : material_keys) {
      if (const Statement* s = find(p.name)) put(p.name, s->value.si, *s, false);
    }
    elastic();
    tension();
    if (problems_.size() != before) return;
    cohesion();
    energy();
    if (const Statement* s = find("brazilian_strength")) check_disc(*s);
  }

 private:
  [[nodiscard]] const Statement* find(std::string_view key) const {
    const auto found =
        std::find_if(m_.statements.begin(), m_.statements.end(), [key](const Statement& s) { return s.key == key; });
    return found == m_.statements.end() ? nullptr : &*found;
  }
  [[nodiscard]] std::optional<double> value(std::string_view key) const {
    const Statement* s = find(key);
    if (s == nullptr) return std::nullopt;
    return s->value.si;
  }
  void problem(const Statement& s, const std::string& text) {
    problems_.add(s.at.file, s.at.line, s.at.path + ": " + text);
  }

  void refuse_doubles() {
    for (const Group& g : groups) {
      std::vector<const Statement*> stated;
      for (const Statement& s : m_.statements) {
        if (g.has(s.key)) stated.push_back(&s);
      }
      if (stated.size() <= g.needed) continue;
      std::string others;
      for (std::size_t k = 0; k + 1 < stated.size(); ++k) {
        others +=
            (k > 0 ? " and " : "") + shown_statement(*stated[k]) + " (line " + std::to_string(stated[k]->at.line) + ')';
      }
      problem(*stated.back(), shown_statement(*stated.back()) + " beside " + others + ": " +
                                  (g.needed == 2 ? "two elastic constants determine the others"
                                                 : "one of them determines " + std::string(g.keys[0])) +
                                  "; leave out what was not measured");
    }
  }

  /// A parameter that `s` gives, itself or by conversion.
  void put(std::string_view name, double x, const Statement& s, bool converted) {
    for (std::size_t k = 0; k < material_keys.size(); ++k) {
      if (material_keys[k].name != name) continue;
      m_.parameters.*material_keys[k].member = x;
      m_.locations[k] = s.at;
      if (converted) m_.locations[k].path += " (" + std::string(name) + ')';
    }
  }

  void say(const Statement& s, const std::string& text) {
    m_.conversions.push_back(s.at.file + ':' + std::to_string(s.at.line) + ": " + text);
  }

  /// May the parameters that a conversion needs be used in it?
  bool usable(const Statement& s, std::initializer_list<std::string_view> names) {
    bool good = true;
    for (const ParameterInfo<double>& p : material_keys) {
      const double x = m_.parameters.*p.member;
      if (std::find(names.begin(), names.end(), p.name) == names.end() || p.bounds.hold(x)) continue;
      problem(s, shown_statement(s) + ": cannot be converted: " + std::string(p.name) + " = " + exact(x) + " must be " +
                     p.bounds.text());
      good = false;
    }
    return good;
  }

  void elastic() {
    const Statement* e = find("young_modulus");
    const Statement* nu = find("poisson_ratio");
    const Statement* k = find("bulk_modulus");
    const Statement* g = find("shear_modulus");
    if (k == nullptr && g == nullptr) return;
    const ElasticConstants c = elastic_constants(value("young_modulus"), value("poisson_ratio"), value("bulk_modulus"),
                                                 value("shear_modulus"));
    const Statement& by = k != nullptr ? *k : *g;
    std::string from, formula;
    for (const Statement* s : {e, nu, k, g}) {
      if (s != nullptr) from += (from.empty() ? "" : " and ") + shown_statement(*s);
    }
    if (e != nullptr) {
      formula = k != nullptr ? "nu = (3 K - E)/(6 K)" : "nu = E/(2 G) - 1";
    } else if (nu != nullptr) {
      formula = k != nullptr ? "E = 3 K (1 - 2 nu)" : "E = 2 G (1 + nu)";
    } else {
      formula = "E = 9 K G/(3 K + G), nu = (3 K - 2 G)/(6 K + 2 G)";
    }
    if (e == nullptr) put("young_modulus", c.young_modulus, by, true);
    if (nu == nullptr) put("poisson_ratio", c.poisson_ratio, by, true);
    const std::string result = (e == nullptr ? "young_modulus = " + digits(c.young_modulus) + " Pa" : "") +
                               (e == nullptr && nu == nullptr ? ", " : "") +
                               (nu == nullptr ? "poisson_ratio = " + digits(c.poisson_ratio) : "");
    say(by, result + " from " + from + ": " + formula);
  }

  void tension() {
    if (const Statement* s = find("brazilian_strength")) {
      put("tensile_strength", s->value.si, *s, true);
      say(*s, "tensile_strength = " + digits(s->value.si) + " Pa from " + shown_statement(*s) +
                  ": the splitting stress 2 P/(pi D t) at the centre of the disc (ISRM 1978)");
    }
    if (const Statement* s = find("bending_strength")) {
      const double x = tensile_from_bending(s->value.si, s->depth);
      put("tensile_strength", x, *s, true);
      say(*s, "tensile_strength = " + digits(x) + " Pa from " + shown_statement(*s) + ", depth " + digits(s->depth) +
                  " m: f_r a/(1 + a), a = 0.06 (depth/mm)^0.7 (fib Model Code 2010, eq 5.1-8, for concrete)");
    }
  }

  void cohesion() {
    const Statement* s = find("compressive_strength");
    if (s == nullptr) return;
    if (!usable(*s, {"friction_angle_deg", "tensile_strength"})) return;
    const double phi = m_.parameters.friction_angle_deg;
    const auto c = cohesion_from_compression(s->value.si, phi, m_.parameters.tensile_strength);
    if (!c) {
      problem(*s, shown_statement(*s) + ": is too low for a tensile strength of " +
                      digits(m_.parameters.tensile_strength) + " Pa and a friction angle of " + digits(phi) +
                      " degrees: no cohesion above tensile_strength tan(phi) has it");
      return;
    }
    put("cohesion", *c, *s, true);
    say(*s,
        "cohesion = " + digits(*c) + " Pa from " + shown_statement(*s) + " and friction_angle_deg = " + digits(phi) +
            ": the Mohr circle of uniaxial compression touches the yield surface (Mohr-Coulomb's UCS (1 - sin phi)/(2 "
            "cos phi) is " +
            digits(mohr_coulomb_cohesion(s->value.si, phi)) + " Pa)");
  }

  void energy() {
    const double strength = m_.parameters.tensile_strength;
    if (const Statement* s = find("fracture_energy"); s != nullptr && usable(*s, {"tensile_strength"})) {
      put("delta0", s->value.si / strength, *s, true);
      say(*s,
          "delta0 = " + digits(s->value.si / strength) + " m from " + shown_statement(*s) + ": G_I/tensile_strength");
    }
    const Statement* s = find("toughness");
    const double e = m_.parameters.young_modulus, nu = m_.parameters.poisson_ratio;
    if (s == nullptr || !usable(*s, {"tensile_strength", "young_modulus", "poisson_ratio"})) return;
    const double g = energy_from_toughness(s->value.si, e, nu, s->setting);
    put("delta0", g / strength, *s, true);
    const bool strain = s->setting == Setting::plane_strain;
    say(*s, "delta0 = " + digits(g / strength) + " m from " + shown_statement(*s) +
                ": G_I = " + (strain ? "K_Ic^2 (1 - nu^2)/E" : "K_Ic^2/E") + " = " + digits(g) + " J/m2 (" +
                (strain ? "plane strain" : "plane stress") + ", Irwin 1957), delta0 = G_I/tensile_strength");
  }

  /// A disc whose centre cracks on an inclined plane does so before it reaches the tensile strength.
  void check_disc(const Statement& s) {
    const Parameters& p = m_.parameters;
    if (!usable(s, {"friction_angle_deg", "cohesion"})) return;
    const double disc = splitting_strength(p.tensile_strength, p.cohesion, p.friction_angle_deg);
    if (disc >= p.tensile_strength) return;
    problem(s, shown_statement(s) + ": with this cohesion and friction angle a disc cracks on an inclined plane at " +
                   digits(disc) +
                   " Pa, before its centre has the tensile strength; state \"tensile_strength\" itself, "
                   "or a higher cohesion");
  }

  MaterialFile& m_;
  Problems& problems_;
};

}  // namespace

bool is_statement(std::string_view key) { return !usual_key(key).empty(); }

bool read_statements(const InputReader& reader, const Place& place, MaterialFile& material) {
  const std::size_t before = reader.problems().size();
  for (const JsonValue& member : place.value().items) {
    Statement s;
    s.key = usual_key(member.key);
    if (s.key.empty()) continue;
    const Place at(place, member);
    const auto x = read_written(reader, at, quantity_of_key(s.key), circumstance_keys(s.key));
    if (!x) continue;
    s.value = *x;
    s.at = {reader.file(), at.line(), at.path()};
    read_circumstances(reader, at, s);
    judge_statement(reader, at, s, material);
    material.statements.push_back(std::move(s));
  }
  return reader.problems().size() == before;
}

bool require_statements(const InputReader& reader, const Place& place) {
  const auto stated = [&](std::string_view key) {
    return std::any_of(place.value().items.begin(), place.value().items.end(),
                       [key](const JsonValue& m) { return usual_key(m.key) == key; });
  };
  const std::size_t before = reader.problems().size();
  for (const ParameterInfo<double>& p : material_keys) {
    if (stated(p.name)) continue;
    const Group* g = group_of(p.name);
    std::string otherwise;
    if (g != nullptr) {
      const auto count = std::count_if(g->keys.begin(), g->keys.end(),
                                       [&](std::string_view key) { return !key.empty() && stated(key); });
      if (static_cast<std::size_t>(count) >= g->needed) continue;
      for (const std::string_view key : g->keys) {
        if (alternative(key) != nullptr) otherwise += (otherwise.empty() ? " (or " : " or ") + in_quotes(key);
      }
      otherwise += ')';
    }
    reader.problem(place, "missing key " + in_quotes(p.name) + otherwise);
  }
  return reader.problems().size() == before;
}

void replace_statements(const MaterialFile& given, MaterialFile& whole) {
  std::vector<Statement>& old = whole.statements;
  for (const Group& g : groups) {
    const auto of_group = [&](const Statement& x) { return g.has(x.key); };
    const auto count = std::count_if(given.statements.begin(), given.statements.end(), of_group);
    if (static_cast<std::size_t>(count) >= g.needed) std::erase_if(old, of_group);
  }
  for (const Statement& s : given.statements) {
    std::erase_if(old, [&](const Statement& o) { return o.key == s.key; });
    old.push_back(s);
  }
  whole.warnings.insert(whole.warnings.end(), given.warnings.begin(), given.warnings.end());
}

void resolve(MaterialFile& material, Problems& problems) { Resolver(material, problems).resolve(); }

}  // namespace detail
}  // namespace fpz::io
