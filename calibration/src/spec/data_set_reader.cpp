#include "data_set_reader.hpp"

#include <algorithm>
#include <array>

namespace fpz::calibration::detail {
namespace {

using Kind = JsonValue::Kind;
constexpr std::size_t longest_name = 100;
constexpr std::size_t longest_text = 4000;

constexpr std::array<std::string_view, 2> loss_keys = {"kind", "scale"};

/// One line per kind.
struct KindRow {
  std::string_view name;
  KindReader read;
};
constexpr KindRow kinds[] = {{"fracture_energy", read_fracture_energy},
                             {"strength", read_strength},
                             {"traction_separation", read_traction_separation},
                             {"stress_strain", read_stress_strain},
                             {"notched_beam", read_notched_beam},
                             {"semicircular_bend", read_semicircular_bend},
                             {"compact_tension", read_compact_tension},
                             {"wedge_splitting", read_wedge_splitting},
                             {"double_cantilever", read_double_cantilever},
                             {"peak_load", read_peak_load},
                             {"scene", read_scene}};

void read_loss(const Context& c, const Place& at, DataSet& out) {
  if (!c.reader.object(at, "\"kind\" and \"scale\"")) return;
  c.reader.known_keys(at, loss_keys);
  if (const JsonValue* kind = c.reader.required(at, "kind")) {
    out.loss.kind = read_word<LossKind>(c, Place(at, *kind), "loss").value_or(out.loss.kind);
  }
  if (const JsonValue* scale = at.value().find("scale")) {
    out.loss.scale = c.reader.positive(Place(at, *scale)).value_or(1.0);
  }
}

void read_weight(const Context& c, const Place& at, DataSet& out) {
  const auto x = c.reader.number(at);
  if (!x) return;
  if (*x > 0.0) {
    out.weight = *x;
  } else {
    c.problem(at, io::exact(*x) + ": must be > 0; to leave a data set out of the fit use \"role\": \"predict\"");
  }
}

}  // namespace

void take_curve(const Curve& curve, std::size_t abscissa, std::size_t measured, DataSet& out) {
  out.file = curve.file;
  out.notation = curve.notation;
  out.abscissa = curve.columns[abscissa](curve.used);
  out.measured = curve.columns[measured](curve.used);
  out.deviation = curve.deviation(curve.used);
  out.deviation_known = curve.deviation_known;
  out.deviation_words = curve.deviation_words;
}

Axis readable_axis(const std::string& what, Quantity quantity, double largest) {
  const auto in = [&](std::string_view unit) {
    return Axis{what, std::string(unit), unit_factor(quantity, unit).value_or(1.0)};
  };
  switch (quantity) {
    case Quantity::length:
      return in(largest < 1e-3 ? "um" : "mm");
    case Quantity::force:
      return in(largest < 1e4 ? "N" : "kN");
    case Quantity::stress:
      return in(largest < 1e9 ? "MPa" : "GPa");
    case Quantity::energy_per_area:
      return in("N/m");
    case Quantity::toughness:
      return in("MPa.sqrt(m)");
    default:
      return in(si_unit(quantity));
  }
}

std::optional<DataSet> read_data_set(const SetContext& s, const Place& set) {
  const Context& c = s.c;
  if (!c.reader.object(set, "the keys of a data set")) return std::nullopt;
  const std::size_t before = c.reader.problems().size();
  DataSet out;
  if (const JsonValue* name = c.reader.required(set, "name")) {
    out.name = c.reader.text(Place(set, *name), longest_name).value_or("");
  }
  if (const JsonValue* source = set.value().find("source")) {
    out.source = c.reader.text(Place(set, *source), longest_text).value_or("");
  }
  if (const JsonValue* role = set.value().find("role")) {
    out.role = read_word<Role>(c, Place(set, *role), "role").value_or(out.role);
  }
  if (const JsonValue* weight = set.value().find("weight")) read_weight(c, Place(set, *weight), out);
  if (const JsonValue* loss = set.value().find("loss")) read_loss(c, Place(set, *loss), out);
  if (const JsonValue* kind = c.reader.required(set, "kind")) {
    std::vector<std::string_view> names;
    for (const KindRow& row : kinds) names.push_back(row.name);
    if (const auto k = read_choice(c, Place(set, *kind), "kind", names)) {
      out.kind = kinds[*k].name;
      kinds[*k].read(s, set, out);
    }
  }
  if (c.reader.problems().size() != before) return std::nullopt;
  return out;
}

}  // namespace fpz::calibration::detail
