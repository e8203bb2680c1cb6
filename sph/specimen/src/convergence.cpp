#include "convergence.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fpz/io/csv.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"
#include "servo.hpp"

namespace fpz::specimen::detail {
namespace {

namespace fs = std::filesystem;

/// Begins at a pace at which the whole loading takes only a few swings of the specimen: much too fast, and cheap.
double first_pace(const Scene& scene) {
  constexpr double swings = 4.0, least_halvings = 4.0;  // the latter as a factor
  return std::max(scene.stop.time / (swings * time_constant({}, scene)), least_halvings * scene.solver.slowest);
}

/// What is compared of a run.
struct Curve {
  std::vector<double> deflection, load;

  [[nodiscard]] double peak() const { return *std::max_element(load.begin(), load.end()); }
  [[nodiscard]] double end() const { return *std::max_element(deflection.begin(), deflection.end()); }
  [[nodiscard]] double work_to(double deflection_at_end) const {
    return work_until(deflection_at_end, deflection, load);
  }
};

double relative_change(double from, double to) { return to > 0.0 ? std::abs(to - from) / to : std::nan(""); }

/// One after the other.
class Runs {
 public:
  Runs(const Scene& scene, const RunRequest& request, const RunOnce& run_once)
      : scene_(scene), request_(request), run_once_(run_once), table_(convergence_table(request.folder)) {
    if (request.resume) {
      take_up();
    } else {
      io::make_writable_folder(request.folder);
      io::require_absent({table_}, request.force);
      forget_runs(request.folder);
    }
  }

  RunResult go() {
    for (;;) {
      Scene own = scene_;
      own.solver.pace = runs_.empty() ? first_pace(scene_) : 0.5 * runs_.back().pace;
      RunResult result = run_once_(own, request_of_next(), [&](RunResult& r) { judge(own.solver.pace, r); });
      if (result.ending == Ending::interrupted || ended()) return result;
    }
  }

 private:
  /// A run goes on from its checkpoint where there is one; after another it takes its place.
  [[nodiscard]] RunRequest request_of_next() const {
    RunRequest next = request_;
    next.keep_checkpoint = false;
    next.resume = request_.resume && fs::exists(RunFiles(request_.folder).checkpoint);
    next.force = !next.resume && (request_.force || request_.resume || !runs_.empty());
    return next;
  }

  [[nodiscard]] bool converged() const {
    const double tolerance = scene_.solver.tolerance;
    return !runs_.empty() && runs_.back().change_of_peak <= tolerance && runs_.back().change_of_work <= tolerance;
  }
  [[nodiscard]] bool ended() const {
    return converged() || (!runs_.empty() && 0.5 * runs_.back().pace < scene_.solver.slowest);
  }

  void judge(double pace, RunResult& result) {
    const History& h = result.history;
    Curve curve{h.all("deflection"), h.all("load")};
    ConvergenceRun run;
    run.pace = pace;
    run.steps = static_cast<long long>(h.last("step"));
    run.seconds = result.seconds.all;
    run.failed = result.ending == Ending::failed;
    run.peak_load = curve.peak();
    if (!runs_.empty() && !runs_.back().failed && !run.failed) {
      const double common = std::min(curve.end(), last_.end());
      run.change_of_peak = relative_change(runs_.back().peak_load, run.peak_load);
      run.change_of_work = relative_change(last_.work_to(common), curve.work_to(common));
    }
    runs_.push_back(run);
    last_ = std::move(curve);
    io::write_text(history_of_run(request_.folder, runs_.size() - 1), h.to_csv(), true);
    write_table();
    result.convergence = runs_;
    if (ended()) tell(result);
  }

  /// In the last run.
  void tell(RunResult& result) const {
    const ConvergenceRun& run = runs_.back();
    std::ostringstream s;
    s.precision(3);
    s << "at half the speed (pace " << run.pace << ") the peak load changes by " << 100.0 * run.change_of_peak
      << " % and the work by " << 100.0 * run.change_of_work << " %";
    if (converged()) {
      result.solver_report = s.str();
      return;
    }
    result.reason += (result.reason.empty() ? "" : "; ") + std::string("not converged: ") + s.str() +
                     ", which is more than solver.tolerance; crack paths that differ from run to run do that, and a "
                     "body that breaks faster than any slow test: see convergence.csv";
    result.ending = Ending::failed;
  }

  void write_table() const {
    std::string text = "run,pace,steps,wall_seconds,failed,peak_load,change_of_peak,change_of_work\n";
    for (std::size_t n = 0; n < runs_.size(); ++n) {
      const ConvergenceRun& r = runs_[n];
      text += std::to_string(n + 1) + "," + io::exact(r.pace) + "," + std::to_string(r.steps) + "," +
              io::exact(r.seconds) + "," + (r.failed ? "1" : "0") + "," + io::exact(r.peak_load) + "," +
              io::exact(r.change_of_peak) + "," + io::exact(r.change_of_work) + "\n";
    }
    io::write_text(table_, text, true);
  }

  void take_up() {
    if (!fs::exists(table_)) return;  // the first run was interrupted
    const io::Table t = io::read_csv(table_);
    for (std::size_t n = 0; n < t.at("pace").size(); ++n) {
      runs_.push_back({t.at("pace")[n], std::llround(t.at("steps")[n]), t.at("wall_seconds")[n],
                       t.at("failed")[n] > 0.0, t.at("peak_load")[n], t.at("change_of_peak")[n],
                       t.at("change_of_work")[n]});
    }
    if (ended())
      throw io::InputError(table_.string() + ": these runs have come to their end; there is nothing to resume");
    if (runs_.empty()) return;
    const io::Table h = io::read_csv(history_of_run(request_.folder, runs_.size() - 1));
    last_ = {h.at("deflection"), h.at("load")};
  }

  const Scene& scene_;
  const RunRequest& request_;
  const RunOnce& run_once_;
  fs::path table_;
  std::vector<ConvergenceRun> runs_;
  Curve last_;  ///< of the last run
};

}  // namespace

fs::path convergence_table(const fs::path& folder) { return folder / "convergence.csv"; }

fs::path history_of_run(const fs::path& folder, std::size_t n) {
  return folder / ("history_" + std::to_string(n + 1) + ".csv");
}

void forget_runs(const fs::path& folder) {
  std::error_code ignored;
  fs::remove(convergence_table(folder), ignored);
  for (std::size_t n = 0; fs::remove(history_of_run(folder, n), ignored); ++n) {
  }
}

RunResult run_to_convergence(const Scene& scene, const RunRequest& request, const RunOnce& run_once) {
  return Runs(scene, request, run_once).go();
}

}  // namespace fpz::specimen::detail
