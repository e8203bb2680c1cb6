#include "fpz/specimen/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <system_error>

#include "checkpointer.hpp"
#include "convergence.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/problems.hpp"
#include "fpz/specimen/bifurcation.hpp"
#include "fpz/specimen/closure.hpp"
#include "fpz/specimen/summary.hpp"
#include "frame_writer.hpp"
#include "pace_keeper.hpp"
#include "recorder.hpp"
#include "run_folder.hpp"
#include "stage_keeper.hpp"

namespace fpz::specimen {
namespace {

using namespace detail;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void write_crack(const fs::path& file, const std::vector<CrackPath>& paths) {
  std::string text = "crack,point,x,y,damage\n";
  for (std::size_t c = 0; c < paths.size(); ++c) {
    for (std::size_t k = 0; k < paths[c].points.size(); ++k) {
      const Point& x = paths[c].points[k];
      text += std::to_string(c) + "," + std::to_string(k) + "," + io::exact(x[0]) + "," + io::exact(x[1]) + "," +
              io::exact(paths[c].damage[k]) + "\n";
    }
  }
  io::write_text(file, text, true);
}

/// One run in progress.
class Runner {
 public:
  Runner(const Scene& scene, const RunRequest& request)
      : scene_(scene),
        request_(request),
        files_(request.folder),
        specimen_(make_specimen(scene)),
        run_(specimen_.setup),
        schedule_(schedule_of(scene, run_.time_step())),
        recorder_(scene, specimen_),
        frames_(scene, specimen_, files_, schedule_.frame_every),
        stages_(scene, specimen_, run_.time_step()),
        pace_(scene, run_.time_step()),
        checkpointer_(scene, files_) {
    const std::string slow = warning_of_time_step(specimen_.setup, run_.time_step());
    if (!slow.empty()) specimen_.warnings.push_back(slow);
  }

  /// `judge` may say more about the result, before it is summed up.
  RunResult go(const std::function<void(RunResult&)>& judge = {}) {
    if (request_.warn) request_.warn(specimen_.warnings);
    prepare();
    RunResult result;
    while (result.reason.empty()) advance(result);
    if (result.ending == Ending::interrupted) {
      save();
    } else {
      if (may_go_on(result)) save();
      write_end(result);
    }
    result.history = recorder_.history();
    result.frames = frames_.frames();
    result.stages = stages_.ended();
    result.seconds = seconds();
    if (result.ending != Ending::interrupted) {
      if (judge) judge(result);
      sum_up(result);
    }
    return result;
  }

 private:
  void prepare() {
    io::make_writable_folder(request_.folder);
    if (request_.resume) {
      checkpointer_.resume(run_, recorder_, frames_, stages_, pace_, schedule_, earlier_);
    } else {
      io::require_absent({files_.scene, files_.history, files_.summary, files_.checkpoint, files_.frames},
                         request_.force);
      clear_earlier_run(files_);
      if (scene_.solver.kind != Solver::Kind::converged) forget_runs(request_.folder);
    }
    require_space(request_.folder, expected_bytes());
    io::make_writable_folder(files_.frames);
    remove_leftovers(request_.folder, files_);
    io::write_text(files_.scene, scene_.text, true);
    if (!request_.resume) {
      recorder_.add_row(run_);
      frames_.write_first(run_);
    }
    last_row_ = run_.loading_steps() / schedule_.row_every;
    save();  // before the work: a folder that cannot hold a checkpoint is found now
  }

  /// Rows are at even distances of the loading.
  [[nodiscard]] bool row_is_due() {
    const long long row = run_.loading_steps() / schedule_.row_every;
    if (row == last_row_) return false;
    last_row_ = row;
    return true;
  }

  /// One step and what follows it. Gives `result` a reason when the run ends.
  void advance(RunResult& result) {
    const auto before = Clock::now();
    stages_.steer(run_);
    const sph::Outcome outcome = run_.step();
    stepping_seconds_ += seconds_since(before);
    ++steps_here_;
    if (!outcome.ok()) {
      result.ending = Ending::failed;
      result.reason = outcome.message();
      return;
    }
    const StepUse use = pace_.after_step(run_);
    if (use.in_row) recorder_.accumulate(run_);
    if (use.equilibrium || (!pace_.makes_rows() && row_is_due())) {
      recorder_.add_row(run_);
      frames_.after_row(run_, recorder_);
      bool changed = false;
      result.reason = stages_.after_row(run_, recorder_, changed);
      if (changed) frames_.write_last(run_);
      show_progress();
      if (!result.reason.empty()) return;
    }
    if (wanted_to_stop()) {
      result.ending = Ending::interrupted;
      result.reason = "interrupted; go on with --resume";
    } else if (checkpointer_.due()) {
      save();
    }
  }

  /// The last row and frame of a run that has finished or failed.
  void write_end(const RunResult& result) {
    if (recorder_.has_steps()) recorder_.add_row(run_);
    frames_.write_last(run_);
    stages_.finish(run_, result.reason);
    io::write_text(files_.history, recorder_.history().to_csv(), true);
  }

  /// Whether the run has come to its end, and could go on to a later one.
  [[nodiscard]] bool may_go_on(const RunResult& result) const {
    return request_.keep_checkpoint && result.ending == Ending::finished;
  }

  /// Cracks, findings, summary.
  void sum_up(RunResult& result) const {
    const std::vector<Spot> all = spots(run_, specimen_);
    const std::vector<CrackPath> paths = crack_paths(all, scene_.spacing);
    const std::vector<double> pieces = piece_areas(all, scene_.body.notches, scene_.spacing);
    write_crack(files_.crack, paths);
    const double alternation = run_.alternation() / largest_opening(run_);
    const Findings f = findings(scene_, result.history, opened_length(all, scene_.spacing), alternation,
                                mean_fracture_energy(run_, specimen_));
    result.warnings = warnings_of(scene_, result.history, f);
    result.warnings.insert(result.warnings.end(), stages_.warnings().begin(), stages_.warnings().end());
    const double overlap = run_.overlap();
    const std::string closed = std::isnan(overlap) ? warning_of_closure(overlaps(), scene_.spacing)
                                                   : warning_of_overlap(overlap, scene_.spacing);
    for (const std::string& w : {closed, warning_of_bifurcation(paths, scene_.spacing), pace_.warning()}) {
      if (!w.empty()) result.warnings.push_back(w);
    }
    const std::string error = error_of_the_model(scene_, f);
    if (!error.empty()) {
      result.ending = Ending::failed;
      result.reason += (result.reason.empty() ? "" : "; ") + error;
    }
    result.report = report_of(f);
    if (!result.solver_report.empty()) result.report += "  " + result.solver_report + "\n";
    io::write_text(files_.summary, summary_text({scene_, specimen_, run_, result, f, paths, pieces}), true);
    if (may_go_on(result)) return;
    std::error_code ignored;
    fs::remove(files_.checkpoint, ignored);
  }

  /// Of the faces of each notch, m.
  [[nodiscard]] std::vector<double> overlaps() const {
    const sph::Particles<2>& p = run_.motions_now();
    std::vector<Point> start, displacement;
    for (std::size_t i = 0; i < p.count; ++i) {
      start.emplace_back(p.start[0][i], p.start[1][i]);
      displacement.emplace_back(p.position[0][i] - p.start[0][i], p.position[1][i] - p.start[1][i]);
    }
    std::vector<double> all;
    for (const Notch& n : scene_.body.notches) {
      all.push_back(face_overlap(n, start, displacement, scene_.spacing));
    }
    return all;
  }

  void save() { checkpointer_.save(run_, recorder_, frames_, stages_, pace_, schedule_, seconds()); }

  [[nodiscard]] bool wanted_to_stop() const {
    return (request_.interrupt != nullptr && *request_.interrupt != 0) ||
           (request_.most_steps > 0 && steps_here_ >= request_.most_steps);
  }

  [[nodiscard]] WallTimes seconds() const {
    return {earlier_.stepping + stepping_seconds_, earlier_.all + seconds_since(start_)};
  }

  [[nodiscard]] double expected_bytes() const {
    const double rows = scene_.output.history_rows + 2.0;
    const double history = 20.0 * static_cast<double>(recorder_.history().columns.size()) * rows;
    return frame_bytes(run_.count()) * frames_.expected() + 3.0 * history +
           2.0 * static_cast<double>(run_.snapshot().size()) + 2e7;
  }

  void show_progress() const {
    if (!request_.progress) return;
    const History& h = recorder_.history();
    Progress p;
    p.fraction = static_cast<double>(run_.loading_steps()) / static_cast<double>(schedule_.steps);
    if (scene_.stop.deflection) p.fraction = std::max(p.fraction, h.last("deflection") / *scene_.stop.deflection);
    p.seconds = seconds_since(start_);
    p.time = run_.loading_time();
    p.load = h.last("load");
    p.damaged = run_.cracked();
    p.steps_per_second = static_cast<double>(steps_here_) / p.seconds;
    request_.progress(p);
  }

  const Scene& scene_;
  const RunRequest& request_;
  RunFiles files_;
  Specimen specimen_;
  sph::Simulation<2> run_;
  Schedule schedule_;
  Recorder recorder_;
  FrameWriter frames_;
  StageKeeper stages_;
  PaceKeeper pace_;
  Checkpointer checkpointer_;
  WallTimes earlier_;  ///< of the processes before this one
  double stepping_seconds_ = 0.0;
  long long steps_here_ = 0;
  long long last_row_ = 0;  ///< see row_is_due()
  Clock::time_point start_ = Clock::now();
};

}  // namespace

Schedule schedule_of(const Scene& scene, double time_step) {
  Schedule s;
  s.time_step = time_step;
  for (const Stage& stage : scene.stages) s.steps += steps_within(stage.stop.time, time_step);
  s.row_every = std::max(1LL, s.steps / scene.output.history_rows);
  if (scene.output.frames > 0) {
    s.frame_every = s.row_every * std::max(1LL, s.steps / s.row_every / scene.output.frames);
  }
  return s;
}

std::string warning_of_time_step(const sph::RunSetup<2>& setup, double time_step) {
  constexpr double far_below = 4.0;
  const double at_most_one = std::min(1.0, 1.0 / setup.options.courant);
  const double ratio = at_most_one * sph::courant_step(setup) / time_step;
  if (ratio < far_below) return {};
  std::ostringstream s;
  s.precision(2);
  s << "the time step is " << ratio
    << " times shorter than \"courant\" asks for, and the run as much longer: something vibrates far faster than the "
       "body. Gradients of few bonds do (\"smoothing_ratio\" below 1.1), particles that almost touch, a "
       "\"machine_stiffness\" far above the body's";
  return s.str();
}

long long steps_within(double time, double time_step) {
  return std::max(1LL, std::llround(std::ceil(time / time_step)));
}

RunResult run_scene(const Scene& scene, const RunRequest& request) {
  Scene own = scene;
  if (request.threads > 0) own.options.threads = request.threads;  // not in its text: results do not depend on it
  if (scene.solver.kind != Solver::Kind::converged) return Runner(own, request).go();
  return run_to_convergence(
      own, request, [](const Scene& s, const RunRequest& r, const auto& judge) { return Runner(s, r).go(judge); });
}

}  // namespace fpz::specimen
