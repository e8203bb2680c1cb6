// Semicircular bending (section 5.2).
#include <algorithm>
#include <cmath>

#include "fpz/specimen/run.hpp"
#include "notched_reference.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace fpz::report {
namespace {

namespace fs = std::filesystem;
constexpr double toughness_unit = 1e-6 * 31.6227766016838;  // Pa sqrt(m) to MPa sqrt(mm)
const fs::path lefm_file = fs::path(FPZ_SOURCE_DIR) / "data/reference/scb_lefm.csv";

/// Peak load (N) and toughness (MPa sqrt(mm)) that linear fracture mechanics with K_Ic expects, over the angle; empty
/// without the file.
struct Lefm {
  std::vector<std::pair<double, double>> load, toughness;
};

Lefm lefm() {
  Lefm theory;
  if (!fs::exists(lefm_file)) return theory;
  const io::Table t = io::read_csv(lefm_file);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    theory.load.emplace_back(t.at("angle_deg")[k], t.at("peak_load")[k]);
    theory.toughness.emplace_back(toughness_unit * t.at("K_I")[k], toughness_unit * t.at("K_II")[k]);
  }
  return theory;
}

double lefm_at(const std::vector<std::pair<double, double>>& curve, double angle) {
  const auto at =
      std::find_if(curve.begin(), curve.end(), [&](const auto& p) { return std::abs(p.first - angle) < 1e-9; });
  return at == curve.end() ? NAN : at->second;
}

/// Where the cracks of a run come from and go to.
struct Crack {
  double from_tip = NAN;   ///< least distance of a crack from the notch tip, m
  double from_load = NAN;  ///< least distance of a crack from the load, m
  double way = 0.0;        ///< from the notch tip to the load, m
};

Crack crack_of(const Run& run) {
  Crack c;
  const io::Table t = io::read_csv(specimen::RunFiles(run.folder).crack);
  const specimen::Notch notch = run.parsed_scene().body.notches.front();
  const specimen::Point load(run.setting("boundaries/0/at/0"), run.setting("boundaries/0/at/1"));
  c.way = (load - notch.tip).norm();
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const specimen::Point p(t.at("x")[k], t.at("y")[k]);
    c.from_tip = std::fmin(c.from_tip, (p - notch.tip).norm());
    c.from_load = std::fmin(c.from_load, (p - load).norm());
  }
  return c;
}

std::vector<const Run*> by_angle(const SweepRuns& sweep, const std::string& series) {
  std::vector<const Run*> runs = sweep.of(series);
  std::sort(runs.begin(), runs.end(), [](const Run* a, const Run* b) { return a->value < b->value; });
  return runs;
}

void angle_table(std::ostream& out, const std::vector<const Run*>& runs) {
  const Lefm theory = lefm();
  std::vector<Row> rows;
  for (const Run* run : runs) {
    const Crack c = crack_of(*run);
    const double peak = run->figure("peak_load"), expected = lefm_at(theory.load, run->value);
    rows.push_back({fixed(run->value, 0), fixed(peak, 1), fixed(expected, 1), fixed(peak / expected, 2),
                    fixed(toughness_unit * run->figure("toughness_K_I"), 2),
                    fixed(toughness_unit * run->figure("toughness_K_II"), 2), fixed(1e3 * c.from_tip, 1),
                    fixed(1e3 * c.from_load, 1), fixed(run->figure("fracture_energy_ratio"), 2),
                    percent(run->figure("kinetic_over_internal/before_peak"), 1),
                    percent(run->figure("energy_balance_error"), 2), run->finished() ? "" : "failed"});
  }
  write_table(out,
              {"angle", "peak, N", "LEFM, N", "peak / LEFM", "K_I", "K_II", "crack to notch tip, mm",
               "crack to load, mm", "energy / (area G)", "kinetic / internal", "balance error", ""},
              rows);
}

void readings(std::ostream& out, const std::vector<const Run*>& runs) {
  bool rising = true, tip = true, load = true;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Crack c = crack_of(*runs[k]);
    const double spacing = runs[k]->setting("spacing");
    tip = tip && c.from_tip <= 3.0 * spacing;
    load = load && c.from_load <= 0.25 * c.way;
    if (k > 0) rising = rising && runs[k]->figure("peak_load") > runs[k - 1]->figure("peak_load");
  }
  out << "What the paper says of its runs, here:\n\n- the peak load rises with the angle: " << verdict(rising)
      << "\n- every crack starts at the notch tip (within three spacings): " << verdict(tip)
      << "\n- every crack runs to the load (at least three quarters of the way from the tip): " << verdict(load)
      << "\n";
  if (runs.front()->value != 0.0) return;
  const Run& upright = *runs.front();
  const double width = upright.setting("boundaries/0/width");
  const Reference fe = semicircular_reference(upright, width), points = semicircular_reference(upright, 0.0);
  out << "\nAt 0 degrees finite elements with the same cohesive law on a straight crack (pressures over "
      << fixed(1e3 * width, 1) << " mm) reach " << fixed(fe.peak, 1) << " N (" << fixed(points.peak, 1)
      << " N with point loads); the run is " << deviation(upright.figure("peak_load") / fe.peak - 1.0) << " off.\n";
  const double expected = lefm_at(lefm().load, 0.0);
  if (std::isnan(expected)) return;
  out << "K_Ic alone gives " << fixed(expected, 0) << " N: the process zone is not small against the ligament of "
      << fixed(1e3 * (upright.setting("shape/radius") - upright.setting("notches/0/length")), 0)
      << " mm, so that linear fracture\nmechanics does not apply to this specimen, and agreement with it would be no "
         "sign of a correct run.\n";
}

void peaks(std::ostream& out, const Results& r, const Gallery& gallery) {
  io::Panel load{"Peak load", "notch angle, degrees", "peak load, N", {}, "", {-2, 62}, {}};
  io::Panel envelope{"Toughness from the peak load, MPa mm^{1/2}", "K_I", "K_{II}", {}, "", {}, {}};
  std::size_t k = 0;
  const auto add = [&](const std::vector<const Run*>& runs, const std::string& title) {
    if (runs.empty()) return;
    io::Series peak{title, point_style(k), {}}, toughness{title, point_style(k), {}};
    ++k;
    for (const Run* run : runs) {
      peak.points.emplace_back(run->value, run->figure("peak_load"));
      if (std::isfinite(run->figure("toughness_K_I"))) {
        toughness.points.emplace_back(toughness_unit * run->figure("toughness_K_I"),
                                      toughness_unit * run->figure("toughness_K_II"));
      }
    }
    load.series.push_back(peak);
    if (!toughness.points.empty()) envelope.series.push_back(toughness);
  };
  add(by_angle(r.scb_angles, "reference"), "reference");
  for (const char* series : {"updated", "updated without artificial stress"})
    add(by_angle(r.scb_updated, series), series);
  const Lefm theory = lefm();
  if (!theory.load.empty()) {
    load.series.push_back({"LEFM with K_{Ic}", reference_style, theory.load});
    if (!envelope.series.empty()) envelope.series.push_back({"LEFM with K_{Ic}", reference_style, theory.toughness});
  }
  std::vector<io::Panel> list = {load};
  if (!envelope.series.empty()) list.push_back(envelope);
  out << gallery.show(panels("scb", list), "scb", "Peak load and toughness against the notch angle");
}

void paths(std::ostream& out, const std::vector<const Run*>& runs, const Gallery& gallery) {
  std::vector<CrackMap> list;
  for (const Run* run : runs) list.push_back(crack_map(*run, run->frames().back(), fixed(run->value, 0) + " degrees"));
  out << gallery.show(crack_picture("scb-cracks", list, 4), "scb-cracks", "Cracked particles at the end of every run");
}

void artificial_stress(std::ostream& out, const Results& r, const Gallery& gallery) {
  out << "\n### Updated configuration, with and without artificial stress\n";
  if (!write_state(out, r.scb_updated, "Updated")) return;
  std::vector<Row> rows;
  std::vector<CrackMap> maps;
  for (const char* series : {"updated", "updated without artificial stress"}) {
    for (const Run* run : by_angle(r.scb_updated, series)) {
      const Run* same = r.scb_angles.find("reference", run->label);
      rows.push_back({series, fixed(run->value, 0), fixed(run->figure("peak_load"), 1),
                      same != nullptr ? deviation(run->figure("peak_load") / same->figure("peak_load") - 1.0) : "-",
                      fixed(run->figure("damaged_particles"), 0), fixed(run->figure("fracture_energy_ratio"), 2),
                      percent(run->figure("energy_balance_error"), 2),
                      percent(run->figure("energies/viscous") / run->figure("energies/external"), 1),
                      run->finished() ? "" : "failed: " + run->reason()});
      if (run->value == 30.0) maps.push_back(crack_map(*run, run->frames().back(), series));
    }
  }
  write_table(out,
              {"series", "angle", "peak, N", "against reference", "cracked particles", "energy / (area G)",
               "balance error", "viscous / work", ""},
              rows);
  if (maps.size() == 2) {
    const auto count = [](const CrackMap& m) {
      const specimen::PointData* d = m.cloud.find("damage");
      return d == nullptr ? 0 : std::count_if(d->values.begin(), d->values.end(), [](double x) { return x > 0.5; });
    };
    const auto with = count(maps[0]), without = count(maps[1]);
    out << "At 30 degrees " << with << " particles have D > 0.5 at the end with artificial stress and " << without
        << " without it. The paper finds spurious\ncracks and clusters without it; more than half as many particles "
           "again would show them: "
        << (2 * without > 3 * with ? "they appear" : "they do not appear here") << ".\n";
    out << gallery.show(crack_picture("scb-artificial", maps, 2), "scb-artificial",
                        "30 degrees, updated configuration, with and without artificial stress");
  }
}

}  // namespace

void write_semicircular(std::ostream& out, const Results& r, const Gallery& gallery) {
  out << "## 2. Semicircular bending (section 5.2)\n";
  if (write_state(out, r.scb_angles, "Angles")) {
    const auto runs = by_angle(r.scb_angles, "reference");
    out << "\nSpacing " << fixed(1e3 * runs.front()->setting("spacing"), 2) << " mm, `reference`, H = `"
        << runs.front()->choice("method/rve_length", "band")
        << "`. K_I and K_II in MPa sqrt(mm), by eqs 68-69 from the peak load.\n";
    angle_table(out, runs);
    readings(out, runs);
    peaks(out, r, gallery);
    paths(out, runs, gallery);
  }
  artificial_stress(out, r, gallery);
}

}  // namespace fpz::report
