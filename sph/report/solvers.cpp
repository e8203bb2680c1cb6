// How fast a slow test may be run: every solver of a scene against a run that is slow enough.
#include <algorithm>
#include <cmath>

#include "fpz/specimen/history.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace fpz::report {
namespace {

struct SolverRun {
  const Run* run = nullptr;
  double steps = 0.0;             ///< of all its runs, where it repeats them
  double peak = 0.0, work = 0.0;  ///< errors against the slowest run, relative

  [[nodiscard]] double worst() const { return std::max(std::abs(peak), std::abs(work)); }
  [[nodiscard]] std::string solver() const { return run->label.substr(0, run->label.find(' ')); }
};

double all_steps(const Run& run) {
  double sum = 0.0;
  for (int k = 0;; ++k) {
    const double steps = run.figure("solver/runs/" + std::to_string(k) + "/steps");
    if (!std::isfinite(steps)) return k == 0 ? run.figure("steps") : sum;
    sum += steps;
  }
}

double largest(const io::Table& t, const char* column) {
  return *std::max_element(t.at(column).begin(), t.at(column).end());
}

double work_to_common_end(const io::Table& of, const io::Table& with) {
  const double end = std::min(largest(of, "deflection"), largest(with, "deflection"));
  return specimen::work_until(end, of.at("deflection"), of.at("load"));
}

/// The first run of the sweep is the slow one.
std::vector<SolverRun> compare(const SweepRuns& sweep) {
  std::vector<SolverRun> list;
  const io::Table slow = sweep.runs.front().history();
  for (const Run& run : sweep.runs) {
    const io::Table t = run.history();
    list.push_back({&run, all_steps(run), largest(t, "load") / largest(slow, "load") - 1.0,
                    work_to_common_end(t, slow) / work_to_common_end(slow, t) - 1.0});
  }
  return list;
}

io::Panel panel(const std::vector<SolverRun>& runs, const std::string& title) {
  io::Panel p{title, "steps, all runs together", "larger error of peak and work, %", {}, "", {}, {}, true, true};
  for (const SolverRun& r : runs) {
    if (&r == &runs.front()) continue;
    if (p.series.empty() || p.series.back().title != r.solver()) {
      p.series.push_back({r.solver(), point_style(p.series.size()), {}});
    }
    p.series.back().points.emplace_back(r.steps, std::max(100.0 * r.worst(), 0.01));
  }
  return p;
}

void recommend(std::ostream& out, const std::vector<SolverRun>& runs) {
  for (const double limit : {0.05, 0.02, 0.01}) {
    const SolverRun* best = nullptr;
    for (const SolverRun& r : runs) {
      if (&r != &runs.front() && r.worst() <= limit && (best == nullptr || r.steps < best->steps)) best = &r;
    }
    out << "- within " << percent(limit, 0) << ": "
        << (best == nullptr ? "none of these" : "`" + best->run->label + "`, " + fixed(best->steps, 0) + " steps")
        << "\n";
  }
}

void specimen_of(std::ostream& out, const SweepRuns& sweep, const std::string& name, std::vector<io::Panel>& panels) {
  out << "\n### " << name << "\n";
  if (!write_state(out, sweep, name) || sweep.runs.front().label != "dynamic 0.25") return;
  const std::vector<SolverRun> runs = compare(sweep);
  std::vector<Row> rows;
  for (const SolverRun& r : runs) {
    rows.push_back({r.run->label, fixed(r.steps, 0), fixed(r.run->figure("peak_load"), 1), deviation(r.peak, 2),
                    deviation(r.work, 2), percent(r.run->figure("kinetic_over_internal/before_peak"), 2)});
  }
  write_table(out, {"solver", "steps", "peak, N", "peak against the slow run", "work", "kinetic / internal"}, rows);
  out << "Fewest steps:\n\n";
  recommend(out, runs);
  panels.push_back(panel(runs, name));
}

}  // namespace

void write_solvers(std::ostream& out, const Results& r, const Gallery& gallery) {
  out << "## 6. Solvers\n\nThe same test by every `\"solver\"` ([solvers.md](solvers.md)); the number after its name "
         "is "
         "the pace, the part of kinetic energy, the number of equilibria, or the tolerance. Errors are those against "
         "the run at a quarter of the scene's speed, the work to the deflection that both reach. Steps are those of "
         "all runs where a solver repeats them.\n";
  std::vector<io::Panel> list;
  specimen_of(out, r.solver_beam, "Notched beam, 4 mm", list);
  specimen_of(out, r.solver_scb, "Semicircular specimen, 1.9 mm", list);
  if (!list.empty())
    out << "\n" << gallery.show(panels("solvers", list), "solvers", "Steps against error, all solvers");
}

}  // namespace fpz::report
