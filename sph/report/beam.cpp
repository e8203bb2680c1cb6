// Three-point bending of the notched beam (section 5.1).
#include <algorithm>
#include <cmath>

#include "notched_reference.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace fpz::report {
namespace {

/// Load (kN) over deflection (um) by another finite-element code, load and supports on points.
io::Series reference_file() {
  io::Series s{"FE, points", "lines lw 1.5 dt 3 lc rgb '#7F7F7F'", {}};
  const io::Table t =
      io::read_csv(std::filesystem::path(FPZ_SOURCE_DIR) / "data/reference/beam_3pb_straight_crack.csv");
  for (std::size_t k = 0; k < t.rows(); ++k) {
    s.points.emplace_back(1e3 * t.at("defl_middepth_mm")[k], 1e-3 * t.at("P_N")[k]);
  }
  return s;
}

double peak_of_file() {
  double peak = 0.0;
  for (const auto& [deflection, load] : reference_file().points) peak = std::max(peak, 1e3 * load);
  return peak;
}

/// Spacings of one series from coarse to fine, the finest one from a sweep of its own.
std::vector<const Run*> by_spacing(const Results& r, const std::string& series) {
  std::vector<const Run*> list = r.beam_spacing.of(series);
  for (const Run* fine : r.beam_fine.of(series)) list.push_back(fine);
  return list;
}

struct Series {
  const char* name;
  const char* text;
  bool mode_one;
};
constexpr Series series_list[] = {{"band", "cohesion raised, H = `band`", true},
                                  {"band narrow", "the same, rollers of one column", true},
                                  {"spacing", "cohesion raised, H = `spacing` (the paper's)", true},
                                  {"band as printed", "Table 2 as printed, H = `band`", false},
                                  {"spacing as printed", "Table 2 as printed, H = `spacing` (the paper's)", false},
                                  {"spacing eq 20", "cohesion raised, H = `spacing`, momentum by eq 20", true}};

void spacing_table(std::ostream& out, const Results& r) {
  std::vector<Row> rows;
  for (const Series& s : series_list) {
    for (const Run* run : by_spacing(r, s.name)) {
      const BeamErrors e = beam_errors(*run);
      rows.push_back({s.text, run->label, fixed(run->figure("peak_load"), 0), s.mode_one ? deviation(e.peak) : "-",
                      fixed(1e6 * run->figure("deflection_at_peak"), 1), fixed(1e-6 * run->figure("stiffness"), 1),
                      deviation(e.stiffness), fixed(1e-6 * notch_stiffness(*run), 0), deviation(e.notch_stiffness),
                      fixed(run->figure("fracture_energy_ratio"), 3), percent(run->figure("energy_balance_error"), 2),
                      std::to_string(run->warnings())});
    }
  }
  write_table(out,
              {"parameters", "spacing", "peak, N", "against FE", "at, um", "load / deflection, N/um", "against FE",
               "load / CMOD, N/um", "against FE", "energy / (area G)", "balance error", "warnings"},
              rows);
}

void convergence(std::ostream& out, const Results& r) {
  for (const Series& s : series_list) {
    const std::vector<const Run*> runs = by_spacing(r, s.name);
    if (runs.size() < 3) continue;
    std::string steps;
    bool shrink = true;
    double before = HUGE_VAL;
    for (std::size_t k = 1; k < runs.size(); ++k) {
      const double change = runs[k]->figure("peak_load") - runs[k - 1]->figure("peak_load");
      steps += (k > 1 ? ", " : "") + fixed(change, 0) + " N";
      shrink = shrink && std::abs(change) < before;
      before = std::abs(change);
    }
    out << "- " << s.text << ": changes of the peak from one spacing to the next " << steps
        << ". They shrink: " << verdict(shrink) << ".\n";
  }
  out << "\n";
}

/// The targets at 2 mm with the narrowest rollers of several columns.
void targets(std::ostream& out, const Results& r) {
  const Run* run = r.beam_rollers.find("2 mm", "4 mm");
  if (run == nullptr) {
    out << "\nTargets at a spacing of 2 mm with rollers 4 mm wide: not run.\n";
    return;
  }
  const BeamErrors e = beam_errors(*run);
  const Reference points = beam_reference(*run, 0.0);
  const auto row = [](const char* what, double error, double limit) {
    return Row{what, "within " + percent(limit, 0), deviation(error), verdict(std::abs(error) <= limit)};
  };
  out << "\nTargets at a spacing of 2 mm, H = `band`, cohesion raised, rollers 4 mm wide:\n";
  write_table(
      out, {"quantity", "wanted", "reached", ""},
      {row("load / CMOD against FE", e.notch_stiffness, 0.03),
       row("load / deflection against FE, point loads", run->figure("stiffness") / points.stiffness - 1.0, 0.03),
       row("load / deflection against FE, pressures 4 mm wide", e.stiffness, 0.03),
       row("peak against FE, point loads", run->figure("peak_load") / points.peak - 1.0, 0.03),
       row("peak against FE, pressures 4 mm wide", e.peak, 0.03),
       row("work of the load against FE, pressures 4 mm wide", e.work, 0.05)});
}

void rollers(std::ostream& out, const Results& r) {
  out << "\n### Width of the rollers\n";
  if (!write_state(out, r.beam_rollers, "Rollers")) return;
  std::vector<Row> rows;
  for (const Run& run : r.beam_rollers.runs) {
    const Reference same = beam_reference(run, roller_width(run));
    const BeamErrors e = beam_errors(run);
    rows.push_back({run.label, fixed(1e3 * roller_width(run), 0), fixed(run.figure("peak_load"), 0),
                    fixed(same.peak, 0), deviation(e.peak), fixed(1e-6 * run.figure("stiffness"), 1),
                    fixed(1e-6 * same.stiffness, 1), deviation(e.stiffness),
                    fixed(run.figure("fracture_energy_ratio"), 3)});
  }
  out << "\nSpacing 2 mm. A roller glued to the beam does two things that a point does not: it spreads the force, and "
         "it "
         "hinders the\nrotation, which shortens the span. The finite elements have the first (even pressures) and not "
         "the second. The deflection\nis measured against the rollers, so it contains how far they sink in; that "
         "depends on the width in both, and a point sinks in\nwithout limit as the elements get finer. The opening "
         "of the notch knows none of this.\n";
  write_table(out,
              {"rollers", "in the FE, mm", "peak, N", "FE, N", "", "load / deflection, N/um", "FE, N/um", "",
               "energy / (area G)"},
              rows);
}

void rate(std::ostream& out, const Results& r, const Gallery& gallery) {
  out << "\n### Loading rate\n";
  if (!write_state(out, r.beam_rate, "Loading rate")) return;
  std::vector<const Run*> runs = r.beam_rate.of("4 mm");
  std::sort(runs.begin(), runs.end(), [](const Run* a, const Run* b) { return a->value < b->value; });
  const double slowest = runs.front()->figure("peak_load");
  double matters = runs.front()->value, fastest = runs.front()->value;
  bool within_half = true, within_two = true;
  std::vector<Row> rows;
  io::Panel panel{"Peak load, spacing 4 mm", "loading speed, mm/s", "peak load, kN", {}, "", {}, {}, true, false};
  io::Series points{"peak load", point_style(0), {}};
  for (const Run* run : runs) {
    const double change = run->figure("peak_load") / slowest - 1.0;
    within_half = within_half && std::abs(change) <= 0.005;
    within_two = within_two && std::abs(change) <= 0.02;
    if (within_half) matters = run->value;
    if (within_two) fastest = run->value;
    points.points.emplace_back(run->value, 1e-3 * run->figure("peak_load"));
    rows.push_back({fixed(run->value, 2), fixed(run->figure("peak_load"), 0), deviation(change, 2),
                    fixed(1e-6 * run->figure("stiffness"), 1), fixed(run->figure("fracture_energy_ratio"), 3),
                    percent(run->figure("kinetic_over_internal/before_peak"), 2),
                    percent(run->figure("load_support_imbalance"), 2), fixed(run->figure("steps"), 0)});
  }
  write_table(out,
              {"mm/s", "peak, N", "against the slowest", "stiffness, N/um", "energy / (area G)", "kinetic / internal",
               "load - support", "steps"},
              rows);
  out << "The slowest run that matters: " << fixed(matters, 2) << " mm/s (slower ones change the peak by less than "
      << "0.5 %). The fastest one with a peak within 2 % of the slowest: " << fixed(fastest, 2)
      << " mm/s.\nThe ramp covers the same displacement at every speed, so that the histories differ in nothing but "
         "time.\n";
  panel.series = {points};
  out << gallery.show(panels("rate", {panel}), "rate", "Peak load against the loading speed");
}

io::Series reference_curve(const Reference& reference, const std::string& title) {
  io::Series s{title, reference_style, {}};
  for (std::size_t k = 0; k < reference.curve.load.size(); ++k) {
    s.points.emplace_back(1e6 * reference.curve.deflection_mid_depth[k], 1e-3 * reference.curve.load[k]);
  }
  return s;
}

void curves(std::ostream& out, const Results& r, const Gallery& gallery) {
  io::Panel left{"Cohesion raised, H = band", "mid-depth deflection, um", "load, kN", {}, "", {0, 120}, {0, 3.5}};
  std::size_t k = 0;
  for (const Run* run : by_spacing(r, "band")) left.series.push_back(load_curve(*run, run->label, curve_style(k++)));
  if (!left.series.empty()) {
    const Run& first = *by_spacing(r, "band").front();
    left.series.push_back(reference_curve(beam_reference(first, roller_width(first)), "FE, same width"));
    left.series.push_back(reference_file());
  }
  const std::string finest = r.beam_spacing.runs.back().label;
  io::Panel right{"All series, " + finest, "mid-depth deflection, um", "load, kN", {}, "", {0, 120}, {0, 5}};
  k = 0;
  for (const Series& s : series_list) {
    const Run* run = r.beam_spacing.find(s.name, finest);
    if (run != nullptr) right.series.push_back(load_curve(*run, s.name, curve_style(k++)));
  }
  if (left.series.empty() || right.series.empty()) return;
  out << gallery.show(panels("beam", {left, right}), "beam", "Load over deflection of the notched beam");
}

void maps(std::ostream& out, const Results& r, const Gallery& gallery) {
  const std::vector<const Run*> runs = by_spacing(r, "band");
  if (runs.empty()) return;
  const Run& run = *runs.back();
  const io::Table history = run.history();
  const std::vector<specimen::Frame> frames = run.frames();
  std::vector<CrackMap> list;
  for (const double fraction : {1.0, 0.7, 0.4, 0.1}) {
    const std::size_t row = row_after_peak(history, fraction);
    list.push_back(crack_map(run, frame_at(frames, history.at("time")[row]),
                             "load " + fixed(1e-3 * history.at("load")[row], 2) + " kN, deflection " +
                                 fixed(1e6 * history.at("deflection")[row], 0) + " um"));
  }
  out << gallery.show(crack_picture("beam-damage", list, 2), "beam-damage",
                      "Cracked particles at the peak and after it, H = band, spacing " + run.label);
}

}  // namespace

void write_beam(std::ostream& out, const Results& r, const Gallery& gallery) {
  out << "## 1. Three-point bending (section 5.1)\n";
  const bool any = write_state(out, r.beam_spacing, "Spacing");
  (void)write_state(out, r.beam_fine, "Finest spacing");
  if (any) {
    const Run& first = r.beam_spacing.runs.front();
    const Reference wide = beam_reference(first, roller_width(first)), points = beam_reference(first, 0.0);
    out << "\nReference: finite elements with the same exponential law on a straight crack in mode I "
           "(`calibration/`), with pressures over\nthe width of the rollers: "
        << fixed(1e3 * roller_width(first), 0) << " mm (" << fixed(wide.peak, 0) << " N, "
        << fixed(1e-6 * wide.stiffness, 1) << " N/um), or points where a roller is one column of particles ("
        << fixed(points.peak, 0) << " N, " << fixed(1e-6 * points.stiffness, 1)
        << " N/um; another\nfinite-element code, with G as printed in Table 2: " << fixed(peak_of_file(), 1)
        << " N). Table 2 as printed does not crack in mode I, so its peak has no reference.\n";
    spacing_table(out, r);
    convergence(out, r);
    targets(out, r);
    curves(out, r, gallery);
    maps(out, r, gallery);
  }
  rollers(out, r);
  rate(out, r, gallery);
}

}  // namespace fpz::report
