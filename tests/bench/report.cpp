#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <ostream>

namespace fpz::bench {
namespace {

template <class... A>
std::string print(const char* format, A... a) {
  char text[256];
  std::snprintf(text, sizeof text, format, a...);
  return text;
}

}  // namespace

std::string sci(double x) {
  if (x == 0.0) return "0";
  if (!std::isfinite(x)) return "-";
  const int e = static_cast<int>(std::floor(std::log10(std::abs(x)) + 1e-12));
  std::string mantissa = print("%.1f", x / std::pow(10.0, e));
  if (mantissa == "10.0") return print("1.0e%d", e + 1);
  return mantissa + print("e%d", e);
}

namespace {

std::string time_of(double seconds) {
  if (!(seconds > 0.0)) return "-";
  if (seconds < 1e-6) return print("%.3g ns", seconds * 1e9);
  if (seconds < 1e-3) return print("%.3g us", seconds * 1e6);
  if (seconds < 1.0) return print("%.3g ms", seconds * 1e3);
  return print("%.3g s", seconds);
}

std::string times(double ratio) { return ratio < 10.0 ? print("%.1f", ratio) : print("%.0f", ratio); }

const char* pass(bool met) { return met ? "PASS" : "FAIL"; }

std::string machine() {
  std::ifstream in("/proc/cpuinfo");
  std::string model = "unknown processor";
  int cores = 0;
  double mhz = 0.0;
  for (std::string line; std::getline(in, line);) {
    const auto value = [&] { return line.substr(std::min(line.find(':') + 2, line.size())); };
    if (line.rfind("model name", 0) == 0) {
      model = value();
      ++cores;
    }
    if (line.rfind("cpu MHz", 0) == 0) mhz = std::atof(value().c_str());
  }
  return model + print(", %.1f GHz, %d cores visible", mhz * 1e-3, cores);
}

const PathStudy& path_named(const Results& r, const std::string& name) {
  for (const PathStudy& p : r.paths) {
    if (p.name == name) return p;
  }
  throw std::runtime_error("no study of " + name);
}

bool same(double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); }

const PathRun* find(const PathStudy& p, Method m, double increment, double tolerance = 0.0) {
  for (const PathRun& r : p.runs) {
    if (r.method == m && (increment == 0.0 ? r.increment == 0.0 : same(r.increment, increment)) &&
        (tolerance == 0.0 || same(r.tolerance, tolerance))) {
      return &r;
    }
  }
  return nullptr;
}

const Timing* find(const Results& r, const std::string& name) {
  for (const Timing& t : r.timings) {
    if (t.name == name) return &t;
  }
  return nullptr;
}
double nanoseconds(const Results& r, const std::string& name) {
  const Timing* t = find(r, name);
  return t ? t->nanoseconds : std::nan("");
}

double order_of(const PathStudy& p, Method m, double low, double high, double tolerance = 0.0) {
  std::vector<std::pair<double, double>> points;
  for (const PathRun& r : p.runs) {
    if (r.method == m && r.error.ok() && r.increment >= low && r.increment <= high &&
        (tolerance == 0.0 || same(r.tolerance, tolerance))) {
      points.emplace_back(r.increment, r.error.worst());
    }
  }
  return fitted_order(points);
}

/// Order of `accurate` in its own steps: error over the number of sub-steps, stages as single updates.
double order_in_substeps(const PathStudy& p) {
  std::vector<std::pair<double, double>> points;
  for (const PathRun& r : p.runs) {
    if (r.method == Method::accurate && r.increment == 0.0 && r.error.ok() && r.tolerance < 2e-3 &&
        r.error.worst() > 1e-11) {
      points.emplace_back(static_cast<double>(r.error.substeps), r.error.worst());
    }
  }
  return -fitted_order(points);
}

std::string outcome(const PathRun& r) {
  return print("%s in stage %d at %.1f %%", to_string(r.error.status), r.error.leg + 1, 100.0 * r.error.fraction);
}

void path_section(std::ostream& out, const Results& r) {
  out << "## Error against increment and time\n\n"
         "![Error against increment](images/speed-increment.png)\n\n"
         "![Error against time](images/speed-time.png)\n\n"
         "Errors are the largest met at 20 points of every stage (all points where a stage has fewer increments): "
         "stress\n"
         "(all components, out of plane included) over `sigma_t0`, and D. Times are of the whole path, onset "
         "included.\n"
         "On the four-stage path an increment is `d eps_xx`, as in the paper, and the shear increment is five times "
         "that;\n"
         "on the other paths it is the largest component.\n\n";
  for (const PathStudy& p : r.paths) {
    out << "### " << p.title
        << "\n\n| integrator | increment | updates | error of stress | error of D | path | per update |\n"
           "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const PathRun& run : p.runs) {
      if (run.method == Method::accurate && run.increment > 0.0 && !same(run.tolerance, 1e-6)) continue;
      std::string name = to_string(run.method);
      if (run.method != Method::implicit) name += print(", %.0e", run.tolerance);
      out << "| " << name << " | " << (run.increment > 0.0 ? sci(run.increment) : "a stage") << " | ";
      if (run.error.ok()) {
        out << run.error.updates << " | " << sci(run.error.stress) << " | " << sci(run.error.damage) << " | "
            << time_of(run.seconds) << " | " << time_of(run.seconds / static_cast<double>(run.error.updates)) << " |\n";
      } else {
        out << "- | " << outcome(run) << " | - | - | - |\n";
      }
    }
    out << "\n";
  }
  out << "### Orders\n\nSlopes of log(error) by least squares; the error is the larger of stress and D.\n\n"
         "| path | `implicit`, increments 3e-7 to 9e-6 | `paper`, tolerance 1e-7, where it converges | `accurate`, in "
         "its own "
         "sub-steps |\n| --- | --- | --- | --- |\n";
  for (const PathStudy& p : r.paths) {
    const double paper = order_of(p, Method::paper, 0.0, 1.0, 1e-7);
    out << "| " << p.title << " | " << print("%.2f", order_of(p, Method::implicit, 0.0, 1e-5)) << " | "
        << (std::isnan(paper) ? "-" : print("%.2f", paper)) << " | " << print("%.2f", order_in_substeps(p)) << " |\n";
  }
  out << "\n";
  for (const PathStudy& p : r.paths) {
    double largest = 0.0;
    double first_failure = 0.0;
    for (const PathRun& run : p.runs) {
      if (run.method != Method::paper || !same(run.tolerance, 1e-4)) continue;
      if (run.error.ok()) {
        largest = std::max(largest, run.increment);
      } else if (first_failure == 0.0) {
        first_failure = run.increment;
      }
    }
    out << "- " << p.title << ": `paper` (tolerance 1e-4) ";
    if (largest > 0.0) {
      out << "gets through with increments up to " << sci(largest);
      if (first_failure > 0.0) out << ", the smallest increment tried that fails is " << sci(first_failure);
    } else {
      out << "fails at every increment tried";
    }
    out << ".\n";
  }
  out << "\n";
}

void tolerance_section(std::ostream& out, const Results& r) {
  out << "## Requested tolerance against achieved error\n\n"
         "![Requested against achieved](images/speed-tolerance.png)\n\n"
         "`accurate` at several output increments; each cell is the larger of the errors of stress over `sigma_t0` and "
         "of D.\n\n"
         "| path | requested |";
  for (const double h : output_increments(false)) out << " " << sci(h) << " |";
  out << " |\n| --- | --- |";
  for (std::size_t k = 0; k < output_increments(false).size(); ++k) out << " --- |";
  out << " --- |\n";
  double ratio = 0.0;
  for (const ToleranceRow& row : r.tolerance) {
    out << "| " << row.path << " | " << print("%.0e", row.tolerance) << " |";
    for (const WalkError& e : row.at) {
      out << " " << (e.ok() ? sci(e.worst()) : to_string(e.status)) << " |";
      if (e.ok()) ratio = std::max(ratio, e.worst() / row.tolerance);
    }
    out << " " << pass(row.met()) << " |\n";
  }
  out << "\nThe largest error is " << print("%.2g", ratio) << " of what was requested.\n\n";
}

void time_section(std::ostream& out, const Results& r) {
  if (r.time_to_error.empty()) return;
  const Contender& paper = r.time_to_error.front();
  out << "## Time to an error of " << sci(target_error) << " of `sigma_t0`, four-stage path\n\n"
      << "For each integrator the fastest setting that stays within " << sci(target_error)
      << " everywhere on the path: for `paper` over all\nincrements and tolerances (1e-3 to 1e-5) tried, for "
         "`implicit` the "
         "coarsest increment, for `accurate` the loosest\ntolerance. `accurate` needs no small output increment: a "
         "stage can be "
         "one update. The inside of the stages is checked\nall the same, by updates to intermediate points.\n\n"
         "| integrator | setting | updates | error of stress | time | faster than `paper` by |\n"
         "| --- | --- | --- | --- | --- | --- |\n";
  for (const Contender& c : r.time_to_error) {
    out << "| " << c.title << " | " << c.setting << " | " << c.error.updates << " | " << sci(c.error.stress) << " | "
        << time_of(c.seconds) << " | " << (&c == &paper ? "1" : times(paper.seconds / c.seconds)) << " |\n";
  }
  out << "\n";
}

void onset_section(std::ostream& out, const Results& r) {
  const OnsetStudy& s = r.onset;
  out << "## Onset: plane scan against closed form\n\n![Onset](images/speed-onset.png)\n\n"
      << "Largest errors over " << s.samples_2d << " (2-D) and " << s.samples_3d
      << " (3-D) random stress states at failure, Table 1. Exact values come from the reference\nsearch (bisection, "
         "Newton on "
         "the sphere). \"Stress\" is the relative error of the load factor at which the search first\nsees a failing "
         "plane.\n\n"
         "| search | angle (degrees) | stress | per search |\n| --- | --- | --- | --- |\n";
  std::vector<std::pair<double, double>> angle, stress;
  double closed[2] = {0, 0};
  double one_degree[2] = {0, 0};
  for (const OnsetRow& row : s.rows) {
    out << "| "
        << (row.degrees > 0.0 ? print("scan, %g degree%s", row.degrees, row.degrees == 1.0 ? "" : "s")
                              : std::string("closed form"))
        << ", " << row.dim << "-D | " << sci(row.angle_error_deg) << " | " << sci(row.stress_error) << " | "
        << time_of(row.nanoseconds * 1e-9) << " |\n";
    if (row.degrees == 0.0) closed[row.dim - 2] = row.nanoseconds;
    if (row.degrees == 1.0) one_degree[row.dim - 2] = row.nanoseconds;
    if (row.dim == 2 && row.degrees > 0.0) {
      angle.emplace_back(row.degrees, row.angle_error_deg);
      stress.emplace_back(row.degrees, row.stress_error);
    }
  }
  out << "\nThe scan's error of the angle falls with order " << print("%.2f", fitted_order(angle))
      << " of the resolution and that of the stress with order " << print("%.2f", fitted_order(stress))
      << ",\nbecause F is stationary on the critical plane. A scan at 1 degree costs "
      << times(one_degree[0] / closed[0]) << " (2-D) and " << times(one_degree[1] / closed[1])
      << " (3-D) times the closed form.\n\n";
}

void map_section(std::ostream& out, const Results& r) {
  out << "## One step of Algorithm 1: iso-error maps\n\n![Iso-error maps](images/speed-isoerror.png)\n\n"
         "One jump increment from a state on the yield surface (cracked at `t_s` = 0.4 MPa, then opened and sheared "
         "alike to the\n"
         "given D); the error is that of the traction against `accurate` at 1e-11, without traction continuity. Grey: "
         "no result.\n"
         "Lines: 1e-6, 1e-4, 1e-2. Star: the paper's increment ("
      << print("%.1e, %.1e", r.maps.paper_step[0], r.maps.paper_step[1])
      << " of `delta0`, were the jump to take\nall of the strain).\n\n"
         "| integrator | D | error at the star | part of the map within 1 % | no result |\n| --- | --- | --- | --- | "
         "--- |\n";
  for (const ErrorMap& m : r.maps.maps) {
    out << "| " << to_string(m.method) << " | " << print("%.1f", m.damage) << " | " << sci(m.at_paper_step) << " | "
        << print("%.0f %%", 100.0 * m.within_1_percent) << " | " << print("%.0f %%", 100.0 * m.failed_share) << " |\n";
  }
  out << "\n";
}

double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

void newton_section(std::ostream& out, const Results& r) {
  out << "## Newton's residuals\n\n![Residual histories](images/speed-newton.png)\n\n"
         "Single updates of the four-stage path at multiples of the paper's increment: in the middle of softening on "
         "stage 2, and\n"
         "(last two rows) the first update after onset on stage 1. `r2/r1` and the order `log(r3/r2)/log(r2/r1)` are "
         "taken from\n"
         "consecutive residuals above rounding: the last ones for `implicit`, medians for `paper`.\n\n"
         "| integrator | increment | residuals | r2/r1 | order | |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const bool implicit : {true, false}) {
    for (const History& h : implicit ? r.newton.implicit : r.newton.paper) {
      out << "| " << (implicit ? "implicit" : "paper") << " | " << h.title << " | ";
      for (std::size_t k = 0; k < h.residuals.size() && k < 8; ++k) out << (k ? ", " : "") << sci(h.residuals[k]);
      if (h.residuals.size() > 8) out << ", ... " << sci(h.residuals.back()) << " (" << h.residuals.size() << ")";
      const bool regular = h.converged && !h.orders.empty();
      const double ratio = h.ratios.empty() ? std::nan("") : implicit ? h.ratios.back() : median(h.ratios);
      out << " | "
          << (std::isnan(ratio) || (implicit && !regular) ? "-"
              : implicit                                  ? sci(ratio)
                                                          : print("%.3f", ratio))
          << " | " << (regular ? print("%.2f", implicit ? h.orders.back() : median(h.orders)) : std::string("-"))
          << " | "
          << (h.converged ? ""
              : implicit  ? "(*) leaves the domain"
                          : "no convergence")
          << " |\n";
    }
  }
  out << "\nNewton on the backward Euler system is quadratic; from far outside it can leave the domain, and the "
         "library then\nsolves by "
         "bracketing. The paper's loop uses the continuum tangent of eq 67 and contracts by a nearly constant "
         "factor:\nlinear "
         "convergence, until the state drops inside the yield surface, where the secant stiffness is exact.\n\n";
}

void timing_section(std::ostream& out, const Results& r) {
  out << "## Times of single updates\n\nGoogle Benchmark, 30 interleaved repetitions, the fastest counts; CPU time "
         "(batches: wall "
         "clock per point).\n`1x` is the paper's increment on stage 2 (3e-7, shear 15e-7); `iterations` are those of "
         "the report of an "
         "update.\nRows of `paper` use half its increment, where it converges.\n\n"
         "| benchmark | time | iterations |\n| --- | --- | --- |\n";
  for (const Timing& t : r.timings) {
    out << "| " << t.name << " | " << time_of(t.nanoseconds * 1e-9) << " | "
        << (t.iterations > 0.0 ? print("%.1f", t.iterations) : std::string("-")) << " |\n";
  }
  for (const char* kind : {"elastic", "10 % yielding"}) {
    const double one = nanoseconds(r, std::string("batch of 1e5/2d/") + kind + "/1 thread");
    const double two = nanoseconds(r, std::string("batch of 1e5/2d/") + kind + "/2 threads");
    out << "\nBatch, " << kind << ": " << print("%.1f", 1e3 / one) << " million points per second on one thread, "
        << print("%.1f", 1e3 / two) << " on two.";
  }
  out << "\n\n";
}

void alternative_section(std::ostream& out, const Results& r) {
  const AlternativeStudy& s = r.alternatives;
  out << "## Alternatives that were tried\n\n![Alternatives](images/speed-alternatives.png)\n\n"
         "The same rate equations, events and error norm with three one-step methods, every stage as one update, "
         "errors at the\n"
         "stage ends. \"Stiff\" has `Kn` and `Ks` 1e6 times larger; \"separated\" adds a fifth stage to it that opens "
         "and shears the\n"
         "crack to the end. Their reference is `accurate` at 1e-11, which differs from 1e-10 by "
      << sci(s.stiff_reference_check)
      << ". Runs of more than\n300 000 steps in an update are given up.\n\n"
         "| method | path | time at error 1e-4 | 1e-6 | 1e-8 | steps at tolerance 1e-6 | failed runs |\n"
         "| --- | --- | --- | --- | --- | --- | --- |\n";
  const std::pair<const char*, const std::vector<AlternativeRun>*> cases[] = {
      {"four stages", &s.ordinary}, {"stiff", &s.stiff}, {"separated", &s.separated}};
  for (const auto& [name, runs] : cases) {
    for (const char* method : {"RODAS 4(3)", "Dormand-Prince 5(4)", "extrapolated Euler"}) {
      out << "| " << method << " | " << name << " |";
      for (const double error : {1e-4, 1e-6, 1e-8})
        out << " " << time_of(seconds_at_error(*runs, method, error)) << " |";
      long failed = 0;
      std::string why;
      std::string steps = "-";
      for (const AlternativeRun& a : *runs) {
        if (a.method != method) continue;
        if (!a.error.ok()) {
          ++failed;
          why = to_string(a.error.status);
        }
        if (a.error.ok() && same(a.tolerance, 1e-6)) steps = std::to_string(a.error.substeps);
      }
      out << " " << steps << " | " << failed << (failed > 0 ? " (" + why + ")" : "") << " |\n";
    }
  }
  out << "\nTime over that of RODAS at an error of 1e-6:\n\n";
  for (const auto& [name, runs] : cases) {
    out << "- " << name << ":";
    for (const char* method : {"Dormand-Prince 5(4)", "extrapolated Euler"}) {
      const double x = seconds_at_error(*runs, method, 1e-6) / seconds_at_error(*runs, "RODAS 4(3)", 1e-6);
      out << " " << method << " " << (std::isnan(x) ? std::string("not reached") : print("%.2g", x))
          << (method[0] == 'D' ? "," : "\n");
    }
  }
  out << "\nThe backward Euler return in the unknowns (S, a) takes " << print("%.2f", s.sa_over_za)
      << " times as long as in (z, a), which the library uses,\nwhen calls follow one another freely, and "
      << print("%.2f", s.sa_over_za_waiting) << " times when each waits for the one before ("
      << print("%.1f", s.sa_iterations) << " and " << print("%.1f", s.za_iterations)
      << "\niterations on average, paper-size increments).\n\n";
}

/// What the tables below say, in sentences.
void findings(std::ostream& out, const Results& r) {
  out << "## Findings\n\n";
  double ratio = 0.0;
  for (const ToleranceRow& row : r.tolerance) {
    for (const WalkError& e : row.at) ratio = std::max(ratio, e.worst() / row.tolerance);
  }
  out << "- The error of `accurate` is at most " << print("%.2g", ratio)
      << " times the requested tolerance, on all six paths and at all output\n  increments. It needs no small "
         "increments: a "
         "whole stage can be one update. It errs on the safe side, so loose\n  tolerances cost more than they need.\n";
  double low = 1e9;
  double high = 0.0;
  for (const PathStudy& p : r.paths) {
    low = std::min(low, order_of(p, Method::implicit, 0.0, 1e-5));
    high = std::max(high, order_of(p, Method::implicit, 0.0, 1e-5));
  }
  out << "- `implicit` is of first order (" << print("%.2f to %.2f", low, high)
      << ") and finishes every path at every increment up to 1e-3.\n";
  const PathRun* coarse = find(path_named(r, "four_stage"), Method::implicit, 9e-5);
  if (coarse && coarse->error.ok()) {
    out << "  At 300 times the paper's increments its largest error on the four-stage path is "
        << sci(coarse->error.stress)
        << " of `sigma_t0`: large damage increments are\n  taken in parts, which bounds the error and ends the first "
           "order.\n";
  }
  out << "- `paper` converges only for small increments, which depend on the path (below), and not at 3e-7 on its own "
         "four "
         "stages.\n  Its error stays near the tolerance of eq 62 and is of no clean order in the increment.\n";
  if (r.time_to_error.size() > 4) {
    const auto& t = r.time_to_error;
    out << "- To " << sci(target_error) << " of `sigma_t0` on the four-stage path `implicit` needs "
        << times(t[0].seconds / t[1].seconds) << " times less time than `paper`,\n  `accurate` "
        << times(t[0].seconds / t[3].seconds) << " times less with\n  one update per stage ("
        << times(t[0].seconds / t[2].seconds) << " at tolerance 1e-4) and " << times(t[0].seconds / t[4].seconds)
        << " times less with an output every 9e-5. With an output at each of the paper's increments the\n  number of "
           "updates decides, "
           "and the factor is "
        << times(t[0].seconds / t.back().seconds) << ".\n";
  }
  const auto& s = r.alternatives;
  const auto over = [](const std::vector<AlternativeRun>& runs) {
    const double x = seconds_at_error(runs, "Dormand-Prince 5(4)", 1e-6) / seconds_at_error(runs, "RODAS 4(3)", 1e-6);
    return std::isnan(x) ? std::string("not reached") : print("%.2g", x);
  };
  out << "- Dormand-Prince against RODAS at an error of 1e-6, time ratio: four stages " << over(s.ordinary)
      << "; `Kn`, `Ks` 1e6 times larger " << over(s.stiff) << "; the same\n  to separation " << over(s.separated)
      << ". Eliminating the jump takes `Kn` and `Ks` out of the time scales while the bulk is soft in series;\n  they "
         "come back as D "
         "approaches 1, where an explicit method's steps are bounded by stability.\n\n";
}

}  // namespace

std::vector<Target> accuracy_targets(const Results& r) {
  std::vector<Target> targets;
  double worst = 0.0;
  bool met = !r.tolerance.empty();
  for (const ToleranceRow& row : r.tolerance) {
    met = met && row.met();
    for (const WalkError& e : row.at) worst = std::max(worst, e.ok() ? e.worst() / row.tolerance : HUGE_VAL);
  }
  targets.push_back({"`accurate` meets tolerances of 1e-4, 1e-6, 1e-8 on all paths, output increments 3e-7 to 1e-3",
                     "error / tolerance <= 1", print("%.2g", worst), met});
  int failures = 0;
  int runs = 0;
  for (const PathStudy& p : r.paths) {
    for (const PathRun& run : p.runs) {
      if (run.method != Method::implicit) continue;
      ++runs;
      failures += run.error.ok() ? 0 : 1;
    }
  }
  targets.push_back({"`implicit` never fails on a path with a solution", "0 failures",
                     print("%d of %d runs", failures, runs), failures == 0 && runs > 0});
  const auto coarse = [&](const std::string& what, const WalkError& e) {
    const double error = e.ok() ? e.stress : HUGE_VAL;
    targets.push_back({"`implicit`, four stages, " + what, "error <= 1e-2 of `sigma_t0`", sci(error), error <= 1e-2});
  };
  coarse("largest component of the increments 9e-5", r.coarse_implicit);
  const PathRun* run = find(path_named(r, "four_stage"), Method::implicit, 9e-5);
  coarse("`d eps_xx` = 9e-5 and `d eps_xy` = 45e-5, 300 times the paper's increments", run ? run->error : WalkError{});
  return targets;
}

std::vector<Target> speed_targets(const Results& r) {
  std::vector<Target> targets;
  const Contender& paper = r.time_to_error.front();
  double best = 0.0;
  for (const Contender& c : r.time_to_error) best = std::max(best, paper.seconds / c.seconds);
  targets.push_back({"time to " + sci(target_error) + " of `sigma_t0` on the four-stage path against `paper`",
                     "100 times less (aim: 300)", times(best) + " times less", best >= 100.0});
  const auto below = [&](const std::string& what, const std::string& name, double limit) {
    const double t = nanoseconds(r, name);
    targets.push_back({what, print("< %.0f ns", limit), print("%.1f ns", t), t < limit});
  };
  below("elastic update with onset check, 2-D", "elastic/2d", 15.0);
  below("cracked, yielding update (`implicit`, paper-size increment), 2-D, one after the other along stage 2",
        "yielding/2d/implicit/stage 2", 250.0);
  below("the same, 16 points in turn", "yielding/2d/implicit/1x", 250.0);
  return targets;
}

void write_report(std::ostream& out, const Results& r) {
  out << "# Speed against error\n\n"
         "Written by `fpz-speed-report -o docs` (tests/bench); all numbers are that program's.\n\n"
      << "Machine: " << machine() << ". Compiler: g++ " << __VERSION__ << ", `" << FPZ_BUILD_FLAGS
      << "`. One core unless\nsaid otherwise. Times are the smallest over many repetitions that take turns, CPU time "
         "of the thread; the "
         "machine may be\nshared, so ratios are firmer than times.\n\n"
         "Reference: the independent integration of the rate equations in tests/support (Dormand-Prince at 1e-12, "
         "located\n"
         "events). Paths: tests/support/paths.hpp, Table 1 of the paper; four stages with H = 4 mm, the others with H "
         "= 1 mm.\n\n"
         "## Targets\n\n| target | wanted | reached | |\n| --- | --- | --- | --- |\n";
  auto targets = accuracy_targets(r);
  for (const Target& t : speed_targets(r)) targets.push_back(t);
  for (const Target& t : targets) {
    out << "| " << t.what << " | " << t.wanted << " | " << t.reached << " | " << pass(t.met) << " |\n";
  }
  out << "| no heap allocation in an update | none | checked by the test `property_no_allocation` | |\n\n";
  findings(out, r);
  path_section(out, r);
  tolerance_section(out, r);
  time_section(out, r);
  onset_section(out, r);
  map_section(out, r);
  newton_section(out, r);
  timing_section(out, r);
  alternative_section(out, r);
}

}  // namespace fpz::bench
