// What a choice of the method costs and how wrong it is, on the notched beam.
#include <algorithm>
#include <cmath>
#include <map>

#include "notched_reference.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace fpz::report {
namespace {

struct Point {
  const Run* run = nullptr;
  double particle_steps = 0.0;
  double seconds = 0.0;  ///< on one core, see cost_of()
  BeamErrors errors;
  bool usable =
      false;  ///< finished, energy balance within 1 %, kinetic energy below 2 % of the internal before the peak

  [[nodiscard]] double worst() const { return std::max(std::abs(errors.peak), std::abs(errors.work)); }
  [[nodiscard]] std::string name() const {
    return fixed(1e3 * run->setting("spacing"), 1) + " mm, " +
           (run->sweep == "beam_rate"      ? run->label + " mm/s"
            : run->sweep == "beam_spacing" ? "default"
                                           : run->label);
  }
};

/// The runs of a group cost the same per particle and step.
std::string group_of(const Run& r) {
  return r.choice("method/configuration", "reference") + " " + r.choice("method/kernel", "cubic_spline") + " " +
         r.choice("method/integrator", "implicit");
}

std::vector<Point> collect(const Results& results) {
  std::vector<Point> points;
  for (const SweepRuns* sweep : {&results.beam_methods, &results.beam_methods_fine, &results.beam_rate,
                                 &results.beam_spacing, &results.beam_fine}) {
    for (const Run& run : sweep->runs) {
      const bool spacings = sweep == &results.beam_spacing || sweep == &results.beam_fine;
      const bool comparable = !spacings || run.series == "band narrow";
      if (comparable) points.push_back({&run, run.figure("particles") * run.figure("steps"), 0.0, beam_errors(run)});
    }
  }
  std::map<std::string, double> rate;  // particle-steps per second
  for (const Point& p : points) {
    double& best = rate[group_of(*p.run)];
    best = std::max(best, p.run->figure("particle_steps_per_second"));
  }
  for (Point& p : points) {
    p.seconds = p.particle_steps / rate[group_of(*p.run)];
    p.usable = p.run->finished() && p.run->figure("energy_balance_error") < 0.01 &&
               p.run->figure("kinetic_over_internal/before_peak") < 0.02 && std::isfinite(p.worst());
  }
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.seconds < b.seconds; });
  // The sweeps share some runs.
  const auto same = [](const Point& a, const Point& b) {
    return a.seconds == b.seconds && a.run->figure("peak_load") == b.run->figure("peak_load");
  };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  return points;
}

/// Those whose error is smaller by a tenth at least than that of all cheaper ones. `points` are in the order of their
/// cost.
template <class Error>
std::vector<const Point*> front(const std::vector<Point>& points, Error error) {
  std::vector<const Point*> list;
  for (const Point& p : points) {
    if (p.usable && (list.empty() || error(p) < 0.9 * error(*list.back()))) list.push_back(&p);
  }
  return list;
}

double peak_error(const Point& p) { return std::abs(p.errors.peak); }
double work_error(const Point& p) { return std::abs(p.errors.work); }

io::Panel panel(const std::vector<Point>& points, const char* title, double (*error)(const Point&)) {
  io::Panel p{title, "seconds on one core", "error, %", {}, "", {}, {}, true, true};
  struct Kind {
    const char* title;
    const char* style;
    bool (*is)(const Run&);
  };
  const Kind kinds[] = {
      {"default", "points pt 7 ps 1.1 lc rgb '#1F5FA8'",
       [](const Run& r) { return r.sweep == "beam_spacing" || r.sweep == "beam_fine" || r.label == "default"; }},
      {"loading speed", "points pt 5 ps 1 lc rgb '#2E8B57'",
       [](const Run& r) { return r.label.find("mm/s") != std::string::npos || r.sweep == "beam_rate"; }},
      {"mass scaling", "points pt 9 ps 1.2 lc rgb '#D68910'", [](const Run& r) { return r.label.starts_with("mass"); }},
      {"Courant number", "points pt 11 ps 1.2 lc rgb '#8E44AD'",
       [](const Run& r) { return r.label.starts_with("Courant"); }},
      {"integrator", "points pt 13 ps 1.4 lc rgb '#16A0A0'",
       [](const Run& r) { return r.label == "accurate" || r.label == "paper algorithm"; }},
      {"updated", "points pt 4 ps 1.2 lc rgb '#C0392B'", [](const Run& r) { return r.label == "updated"; }},
      {"other", "points pt 6 ps 1.1 lc rgb '#7F8C8D'", [](const Run&) { return true; }}};
  std::vector<bool> done(points.size(), false);
  for (const Kind& kind : kinds) {
    io::Series s{kind.title, kind.style, {}};
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (done[k] || !kind.is(*points[k].run) || !std::isfinite(points[k].worst())) continue;
      done[k] = true;
      s.points.emplace_back(points[k].seconds, std::max(100.0 * error(points[k]), 0.01));
    }
    if (!s.points.empty()) p.series.push_back(s);
  }
  io::Series best{"not beaten", "lines lw 1.5 dt 2 lc rgb '#202020'", {}};
  for (const Point* q : front(points, error)) best.points.emplace_back(q->seconds, std::max(100.0 * error(*q), 0.01));
  p.series.push_back(best);
  return p;
}

void recommend(std::ostream& out, const std::vector<Point>& points) {
  std::vector<Row> rows;
  for (const double limit : {0.05, 0.02, 0.01}) {
    const auto at =
        std::find_if(points.begin(), points.end(), [&](const Point& p) { return p.usable && p.worst() <= limit; });
    if (at == points.end()) {
      rows.push_back({percent(limit, 0), "none of these runs", "-", "-", "-"});
    } else {
      rows.push_back({percent(limit, 0), at->name(), fixed(at->seconds, 1), deviation(at->errors.peak),
                      deviation(at->errors.work)});
    }
  }
  out << "Cheapest run with both errors within a limit:\n";
  write_table(out, {"limit", "setting", "s", "peak", "work"}, rows);
}

void integrators(std::ostream& out, const Results& r) {
  const Run* base = r.beam_methods.find("4 mm", "default");
  if (base == nullptr) return;
  std::vector<Row> rows;
  for (const char* label : {"default", "accurate", "paper algorithm"}) {
    const Run* run = r.beam_methods.find("4 mm", label);
    if (run == nullptr) continue;
    rows.push_back({std::string(label) == "default" ? "`implicit`" : label,
                    run->finished() ? "yes" : "**NO**: " + run->reason(), fixed(run->figure("peak_load"), 2),
                    deviation(run->figure("peak_load") / base->figure("peak_load") - 1.0, 3),
                    fixed(1e3 * run->figure("energies/fracture"), 3),
                    deviation(run->figure("energies/fracture") / base->figure("energies/fracture") - 1.0, 3),
                    fixed(1e9 / run->figure("particle_steps_per_second"), 0)});
  }
  out << "### Integrator of cracked particles, the same run at 4 mm\n";
  write_table(out, {"integrator", "finished", "peak, N", "", "fracture energy, mJ", "", "ns per particle-step"}, rows);
}

}  // namespace

void write_cost(std::ostream& out, const Results& r, const Gallery& gallery) {
  out << "## 5. Speed against error\n";
  (void)write_state(out, r.beam_methods, "Methods");
  (void)write_state(out, r.beam_methods_fine, "Methods at 2 mm");
  const std::vector<Point> points = collect(r);
  if (points.empty()) return;
  out << "\nThe notched beam with the cohesion raised and H = `band`, rollers of one column. Errors of the peak and of "
         "the work of\nthe load, to the deflection that both reach: against finite elements with pressures of the same "
         "width. Seconds are\nparticle-steps divided by the best rate of all runs that share configuration, kernel and "
         "integrator, because other programs\nran on the machine. Runs that failed, whose energy balance drifts by "
         "more than 1 % of the\nwork, or whose kinetic energy exceeds 2 % of the internal one before the peak are in "
         "the table and the picture but are\nneither recommended nor on the line.\n";
  std::vector<Row> rows;
  const auto by_peak = front(points, peak_error), by_work = front(points, work_error);
  const auto on = [](const std::vector<const Point*>& list, const Point& p) {
    return std::find(list.begin(), list.end(), &p) != list.end();
  };
  for (const Point& p : points) {
    rows.push_back({p.name(), fixed(1e-6 * p.particle_steps, 1), fixed(p.seconds, 2), deviation(p.errors.peak),
                    deviation(p.errors.stiffness), deviation(p.errors.work),
                    std::string(on(by_peak, p) ? "peak " : "") + (on(by_work, p) ? "work" : ""),
                    p.run->finished() ? std::to_string(p.run->warnings()) : "failed"});
  }
  write_table(out, {"run", "million particle-steps", "s", "peak", "stiffness", "work", "not beaten in", "warnings"},
              rows);
  recommend(out, points);
  out << gallery.show(
      panels("cost", {panel(points, "Peak load", peak_error), panel(points, "Work of the load", work_error)}), "cost",
      "Time against error");
  integrators(out, r);
}

}  // namespace fpz::report
