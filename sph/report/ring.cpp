// Disc and rings under diametral compression (section 5.3).
#include <algorithm>
#include <cmath>
#include <optional>

#include "sections.hpp"
#include "text.hpp"

namespace fpz::report {
namespace {

/// Elastic hoop stress at the hole on the load line in units of P/(pi R t), exact series for d/D = 0.1 ... 0.5.
constexpr std::pair<double, double> hoop_factors[] = {
    {0.1, 6.385}, {0.2, 7.598}, {0.3, 9.856}, {0.4, 13.68}, {0.5, 20.31}};

/// Load at which the elastic stress at the hole reaches the tensile strength; NaN for other diameters and the disc.
double hoop_load(const Run& run) {
  for (const auto& [ratio, factor] : hoop_factors) {
    if (std::abs(ratio - run.value) < 1e-9) {
      return run.setting("material/tensile_strength") * M_PI * run.setting("shape/radius") * run.setting("thickness") /
             factor;
    }
  }
  return NAN;
}

/// Fewer particles are no crack: two columns, five particles long.
constexpr std::size_t smallest_crack = 10;

/// Particles with D > 0.5 within 30 degrees of the line across the load, when they appear and how many at the end.
struct Secondary {
  double time = NAN;
  std::size_t particles = 0;
  double innermost = NAN;  ///< radius that they reach, m
};

Secondary secondary_of(const Run& run) {
  Secondary s;
  for (const specimen::Frame& f : run.frames()) {
    const specimen::PointCloud cloud = run.cloud(f);
    const specimen::PointData* damage = cloud.find("damage");
    if (damage == nullptr) continue;
    s.particles = 0;
    s.innermost = NAN;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double x = cloud.points[3 * i], y = cloud.points[3 * i + 1];
      if (damage->values[i] <= 0.5 || std::abs(y) > std::tan(M_PI / 6.0) * std::abs(x)) continue;
      if (std::hypot(x, y) < 4.0 * run.setting("spacing")) continue;  // the crack along the load line passes there
      ++s.particles;
      s.innermost = std::fmin(s.innermost, std::hypot(x, y));
    }
    if (s.particles >= smallest_crack && std::isnan(s.time)) s.time = f.time;
  }
  return s;
}

/// Share of the variance of y that a straight line in x explains.
double linearity(const std::vector<std::pair<double, double>>& points) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (const auto& [a, b] : points) n += 1.0, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
  const double c = n * xy - x * y;
  return c * c / ((n * xx - x * x) * (n * yy - y * y));
}

struct Reading {
  bool falls = true, on_line = true, at_hole = true;
  std::string secondary;  ///< diameters with secondary cracks
};

Reading ring_table(std::ostream& out, const std::vector<const Run*>& runs) {
  Reading reading;
  std::vector<Row> rows;
  double before = HUGE_VAL;
  for (const Run* run : runs) {
    const double spacing = run->setting("spacing"), peak = run->figure("peak_load");
    const double hole = run->value * run->setting("shape/radius");
    const std::optional<Onset> onset = first_crack(*run);
    const Secondary second = secondary_of(*run);
    reading.falls = reading.falls && peak < before;
    before = peak;
    if (onset) {
      reading.on_line = reading.on_line && std::abs(onset->at[0]) <= 2.0 * spacing;
      if (hole > 0.0) reading.at_hole = reading.at_hole && onset->at.norm() - hole <= 3.0 * spacing;
    }
    const io::Table t = run->history();
    const auto& load = t.at("load");
    const double peak_time =
        t.at("time")[static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin())];
    if (second.particles >= smallest_crack)
      reading.secondary += (reading.secondary.empty() ? "" : ", ") + fixed(run->value, 1);
    rows.push_back(
        {fixed(run->value, 1), fixed(1e-3 * peak, 2), fixed(1e6 * run->figure("deflection_at_peak"), 1),
         onset ? fixed(1e-3 * onset->load, 2) : "none", fixed(1e-3 * hoop_load(*run), 2),
         onset ? fixed(1e3 * onset->at[0], 1) + ", " + fixed(1e3 * onset->at[1], 1) : "-",
         std::to_string(second.particles),
         second.particles >= smallest_crack ? (second.time > peak_time ? "after the peak" : "before the peak") : "-",
         fixed(1e3 * second.innermost, 1), fixed(run->figure("fracture_energy_ratio"), 2),
         percent(run->figure("kinetic_over_internal/before_peak"), 1), run->finished() ? "" : "failed"});
  }
  write_table(out,
              {"d/D", "peak, kN", "at, um", "first crack, kN", "hoop stress = strength, kN", "first crack at x, y, mm",
               "secondary: particles", "seen", "down to radius, mm", "energy / (area G)", "kinetic / internal", ""},
              rows);
  return reading;
}

void pictures(std::ostream& out, const std::vector<const Run*>& runs, const Gallery& gallery) {
  io::Panel peak{"Peak load and first crack", "d/D", "load, kN", {}, "", {-0.02, 0.52}, {}};
  io::Panel curves{"Load over closing of the platens", "um", "load, kN", {}, "", {}, {}};
  io::Series top{"peak", point_style(0), {}}, first{"first crack", point_style(1), {}};
  io::Series elastic{"hoop stress = strength", "points pt 2 ps 1.3 lc rgb '#202020'", {}};
  std::vector<CrackMap> maps;
  std::size_t k = 0;
  for (const Run* run : runs) {
    top.points.emplace_back(run->value, 1e-3 * run->figure("peak_load"));
    if (const auto onset = first_crack(*run)) first.points.emplace_back(run->value, 1e-3 * onset->load);
    if (std::isfinite(hoop_load(*run))) elastic.points.emplace_back(run->value, 1e-3 * hoop_load(*run));
    curves.series.push_back(load_curve(*run, "d/D " + run->label, curve_style(k++)));
    maps.push_back(crack_map(*run, run->frames().back(), "d/D " + run->label));
  }
  peak.series = {top, first, elastic};
  out << gallery.show(panels("ring", {peak, curves}), "ring", "Loads of disc and rings");
  out << gallery.show(crack_picture("ring-cracks", maps, 3), "ring-cracks",
                      "Cracked particles at the end of every run");
}

}  // namespace

void write_ring(std::ostream& out, const Results& r, const Gallery& gallery) {
  out << "## 3. Disc and rings (section 5.3)\n";
  if (!write_state(out, r.ring_diameters, "Diameters")) return;
  std::vector<const Run*> runs = r.ring_diameters.of("reference");
  std::sort(runs.begin(), runs.end(), [](const Run* a, const Run* b) { return a->value < b->value; });
  const Run& any = *runs.front();
  out << "\nSpacing " << fixed(1e3 * any.setting("spacing"), 2) << " mm on concentric rings, `reference`, platens "
      << fixed(1e3 * any.setting("boundaries/0/width"), 1)
      << " mm wide and bonded. The first crack is the first cracked particle of the history;\nits place is the most "
         "damaged particle of the first frame that shows one. \"Hoop stress = strength\": the load at which the\n"
         "elastic stress at the hole (exact series) reaches the tensile strength. Secondary: particles with D > 0.5 "
         "within 30 degrees of\nthe horizontal, off the centre; fewer than ten are not called a crack.\n";
  const Reading reading = ring_table(out, runs);
  std::vector<std::pair<double, double>> peaks;
  for (const Run* run : runs) peaks.emplace_back(run->value, run->figure("peak_load"));
  out << "What the paper says of its runs, here:\n\n- the peak falls with d/D: " << verdict(reading.falls);
  if (peaks.size() > 2) out << "; a straight line explains " << percent(linearity(peaks), 1) << " of its variance";
  out << "\n- the first crack lies on the load line (within two spacings): " << verdict(reading.on_line)
      << "; of rings at the hole: " << verdict(reading.at_hole)
      << "\n- secondary cracks at d/D = " << (reading.secondary.empty() ? "none" : reading.secondary)
      << "; the paper: from 0.3 on\n";
  pictures(out, runs, gallery);
}

}  // namespace fpz::report
