#include <cmath>
#include <cstdio>
#include <limits>

#include "studies.hpp"

namespace fpz::bench {

std::vector<double> time_interleaved(const std::vector<std::function<void()>>& jobs, double budget) {
  std::vector<double> best(jobs.size(), std::numeric_limits<double>::infinity());
  std::vector<double> spent(jobs.size(), 0.0);
  std::vector<int> batch(jobs.size(), 1);
  for (std::size_t i = 0; i < jobs.size(); ++i) {  // enough calls for the clock
    for (;;) {
      const double t = cpu_seconds();
      for (int k = 0; k < batch[i]; ++k) jobs[i]();
      const double took = cpu_seconds() - t;
      best[i] = took / batch[i];
      if (took > 5e-4) break;
      batch[i] *= 4;
    }
  }
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      if (spent[i] > budget) continue;
      const double t = cpu_seconds();
      for (int k = 0; k < batch[i]; ++k) jobs[i]();
      const double took = cpu_seconds() - t;
      spent[i] += took;
      best[i] = std::min(best[i], took / batch[i]);
      more = true;
    }
  }
  return best;
}

double fitted_order(const std::vector<std::pair<double, double>>& points) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [x, y] : points) {
    const double u = std::log(x);
    const double v = std::log(y);
    n += 1;
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return n < 2 ? std::numeric_limits<double>::quiet_NaN() : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Case<2> four_stage_case() { return {test::four_stage(), "Four stages (section 4.5)", true}; }
Case<2> mixed_case() { return {test::mixed_mode(), "Mixed mode"}; }
Case<2> compressive_case() { return {test::compressive_shear(), "Shear under compression"}; }

namespace {

PathRun verified(const Case<2>& c, Method method, double tolerance, double increment) {
  PathRun run{method, tolerance, increment, {}, 0.0};
  const auto update = library_update<2>(c.material, options_of(method, tolerance));
  if (increment > 0.0) {
    const std::vector<int> counts = c.counts(increment);
    run.error = walk(c, counts, follow_reference(c, counts), update);
  } else {
    run.error = walk_legs(c, update);
  }
  return run;
}

std::function<void()> timed_walk(const Case<2>& c, Method method, double tolerance, double increment) {
  return [&c, counts = c.counts(increment), o = options_of(method, tolerance)] {
    keep(run_path(c, counts, library_update<2>(c.material, o)));
  };
}

}  // namespace

PathStudy study_path(const Case<2>& c, bool quick) {
  PathStudy study{c.path.name, c.title, {}};
  const auto add = [&](Method method, double tolerance, double increment) {
    study.runs.push_back(verified(c, method, tolerance, increment));
  };
  if (quick) {
    for (const double factor : {10.0, 30.0, 100.0, 300.0}) add(Method::implicit, 1e-4, factor * paper_increment);
    return study;
  }
  for (const double tolerance : {1e-4, 1e-7}) {
    for (const double factor : {0.125, 0.25, 0.5, 0.8, 1.0, 3.0, 30.0, 300.0}) {
      add(Method::paper, tolerance, factor * paper_increment);
    }
  }
  for (const double factor : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 10000.0 / 3.0}) {
    add(Method::implicit, 1e-4, factor * paper_increment);
  }
  for (const double increment : {0.0, 9e-5, 3e-7}) {
    for (int digits = 2; digits <= 9; ++digits) add(Method::accurate, std::pow(10.0, -digits), increment);
  }
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    for (const double increment : {1e-6, 3e-6, 1e-5, 3e-5, 3e-4, 1e-3}) add(Method::accurate, tolerance, increment);
  }
  std::vector<std::function<void()>> jobs;
  std::vector<PathRun*> of;
  for (PathRun& run : study.runs) {
    if (!run.error.ok()) continue;
    jobs.push_back(timed_walk(c, run.method, run.tolerance, run.increment));
    of.push_back(&run);
  }
  const std::vector<double> seconds = time_interleaved(jobs, 0.15);
  for (std::size_t i = 0; i < of.size(); ++i) of[i]->seconds = seconds[i];
  return study;
}

WalkError study_coarse_implicit() {
  const Case<2> c(test::four_stage(), "Four stages, largest component");
  return verified(c, Method::implicit, 1e-4, 9e-5).error;
}

bool ToleranceRow::met() const {
  for (const WalkError& e : at) {
    if (!e.ok() || !(e.worst() <= tolerance)) return false;
  }
  return !at.empty();
}

std::vector<double> output_increments(bool quick) {
  if (quick) return {3e-6, 9e-5, 1e-3};
  return {3e-7, 3e-6, 3e-5, 9e-5, 3e-4, 1e-3};
}

namespace {

template <int Dim>
void add_tolerance_rows(const Case<Dim>& c, bool quick, std::vector<ToleranceRow>& rows) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    ToleranceRow row{c.title, tolerance, {}};
    for (const double increment : output_increments(quick)) {
      const std::vector<int> counts = c.counts(increment);
      row.at.push_back(walk(c, counts, follow_reference(c, counts),
                            library_update<Dim>(c.material, options_of(Method::accurate, tolerance))));
    }
    rows.push_back(row);
  }
}

}  // namespace

std::vector<ToleranceRow> study_tolerance(bool quick) {
  std::vector<ToleranceRow> rows;
  add_tolerance_rows(four_stage_case(), quick, rows);
  add_tolerance_rows(mixed_case(), quick, rows);
  add_tolerance_rows(compressive_case(), quick, rows);
  add_tolerance_rows(Case<2>(test::closing(), "Opening, closing, sliding, reopening"), quick, rows);
  add_tolerance_rows(Case<2>(test::plane_stress_cycle(), "Plane stress cycle (Table 2)"), quick, rows);
  add_tolerance_rows(Case<3>(test::rotating_shear(), "Rotating shear (3-D)"), quick, rows);
  return rows;
}

std::vector<Contender> study_time_to_error(const Case<2>& c, double target) {
  const auto meets = [&](const PathRun& r) { return r.error.ok() && r.error.stress <= target; };
  const auto number = [](const char* format, double x) {
    char text[80];
    std::snprintf(text, sizeof text, format, x);
    return std::string(text);
  };
  std::vector<Contender> out;
  std::vector<std::function<void()>> jobs;
  const auto enter = [&](const std::string& title, const std::string& setting, const PathRun& r) {
    out.push_back({title, setting, r.error, 0.0});
    jobs.push_back(timed_walk(c, r.method, r.tolerance, r.increment));
  };

  // paper: the fastest of all increments and tolerances that get there.
  PathRun best;
  double best_seconds = std::numeric_limits<double>::infinity();
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    for (double factor = 0.125; factor < 1.3; factor *= std::pow(2.0, 0.25)) {
      const PathRun r = verified(c, Method::paper, tolerance, factor * paper_increment);
      if (!meets(r)) continue;
      const double seconds = time_interleaved({timed_walk(c, r.method, r.tolerance, r.increment)}, 0.1)[0];
      if (seconds < best_seconds) {
        best_seconds = seconds;
        best = r;
      }
    }
  }
  enter("`paper`", number("increment %.3g", best.increment) + number(", tolerance %.0e", best.tolerance), best);

  // implicit: the coarsest increment below which all are good enough.
  best = verified(c, Method::implicit, 1e-4, paper_increment);
  for (double factor = 1.1; factor < 1000.0; factor *= 1.1) {
    const PathRun r = verified(c, Method::implicit, 1e-4, factor * paper_increment);
    if (!meets(r)) break;
    best = r;
  }
  enter("`implicit`", number("increment %.3g", best.increment), best);

  enter("`accurate`, one update per stage", "tolerance 1e-4", verified(c, Method::accurate, 1e-4, 0.0));

  // accurate: the loosest tolerance below which all are good enough.
  for (const double increment : {0.0, 9e-5, 3e-6, paper_increment}) {
    best = PathRun{};
    for (int k = 24; k >= 4; --k) {
      const PathRun r = verified(c, Method::accurate, std::pow(10.0, -0.25 * k), increment);
      if (!meets(r)) break;
      best = r;
    }
    enter(increment > 0.0 ? number("`accurate`, output every %.0e", increment) : "`accurate`, one update per stage",
          number("tolerance %.1e", best.tolerance), best);
  }
  const std::vector<double> seconds = time_interleaved(jobs, 0.6);
  for (std::size_t i = 0; i < out.size(); ++i) out[i].seconds = seconds[i];
  return out;
}

}  // namespace fpz::bench
