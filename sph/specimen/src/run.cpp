#include "fpz/specimen/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <system_error>

#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/problems.hpp"
#include "fpz/specimen/estimate.hpp"
#include "fpz/specimen/summary.hpp"

namespace fpz::specimen {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double just_after_peak = 0.995;  ///< of the peak load: the frame that shows the peak

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// One run in progress.
class Runner {
 public:
  Runner(const SceneFile& scene, const RunRequest& request)
      : scene_(scene),
        request_(request),
        files_(request.folder),
        specimen_(make_specimen(scene)),
        run_(specimen_.setup),
        schedule_(schedule_of(scene, run_.time_step())) {
    for (const char* name : {"deflection", "load", "support", "cmod"}) order_.emplace_back(name);
    for (const auto& [name, gauge] : specimen_.gauges) {
      if (std::find(order_.begin(), order_.end(), name) == order_.end()) order_.push_back(name);
    }
    for (const double f : scene.output.picture_loads) levels_.push_back(f == 1.0 ? just_after_peak : -f);
  }

  RunResult go() {
    prepare();
    RunResult result;
    while (result.reason.empty()) advance(result);
    finish(result);
    return result;
  }

 private:
  void prepare() {
    io::make_writable_folder(request_.folder);
    if (request_.resume) {
      resume();
    } else {
      io::require_absent({files_.scene, files_.history, files_.summary, files_.checkpoint, files_.frames},
                         request_.force);
      clean();
      begin_history();
    }
    require_space();
    io::make_writable_folder(files_.frames);
    remove_leftovers();
    io::write_text(files_.scene, scene_.text, true);
    if (!request_.resume) {
      add_row();
      add_frame();
    }
    save();  // before the work: a folder that cannot hold a checkpoint is found now
    last_save_ = Clock::now();
  }

  /// What an earlier run left: with --force it is replaced, and its extra frames must not be taken for new ones.
  void clean() const {
    std::error_code ignored;
    for (const fs::path& f : {files_.history, files_.summary, files_.checkpoint, files_.crack}) fs::remove(f, ignored);
    for (const auto& entry : fs::directory_iterator(files_.frames, ignored)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("frame_") && entry.path().extension() == ".vtu") fs::remove(entry.path(), ignored);
    }
  }

  /// Temporary files of a process that was killed while it wrote one.
  void remove_leftovers() const {
    std::error_code ignored;
    for (const fs::path& folder : {request_.folder, files_.frames}) {
      for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        for (const char* stem : {".scene.", ".history.", ".summary.", ".checkpoint.", ".crack.", ".frame"}) {
          if (name.starts_with(stem)) fs::remove(entry.path(), ignored);
        }
      }
    }
  }

  void begin_history() {
    History& h = record_.history;
    h.columns = {"step", "time", "deflection", "load", "support", "cmod"};
    for (const char* name :
         {"external", "elastic", "kinetic", "fracture", "viscous", "damping", "artificial", "error"}) {
      h.columns.push_back(std::string("energy_") + name);
    }
    for (const char* name : {"damaged_particles", "largest_damage", "released_bonds"}) h.columns.emplace_back(name);
    for (std::size_t k = 4; k < order_.size(); ++k) h.columns.push_back(order_[k]);
    record_.window.assign(order_.size(), 0.0);
    record_.levels_done.assign(levels_.size() + scene_.output.frames_at.size(), 0);
  }

  void resume() {
    Checkpoint c = read_checkpoint(files_.checkpoint);
    if (c.scene_text != scene_.text) {
      throw io::InputError(files_.checkpoint.string() + ": belongs to another scene (" + files_.scene.string() +
                           " is the one it belongs to; resume with that file)");
    }
    record_ = std::move(c.record);
    try {
      run_.restore(c.state);
    } catch (const std::exception& e) {
      throw io::InputError(files_.checkpoint.string() + ": the checkpoint cannot be used: " + e.what());
    }
  }

  void require_space() const {
    std::error_code error;
    const double frames = scene_.output.frames + static_cast<double>(record_.levels_done.size()) + 2.0;
    const double history =
        20.0 * static_cast<double>(record_.history.columns.size()) * (scene_.output.history_rows + 2.0);
    const double needed = frame_bytes(run_.particles().count) * frames + 3.0 * history +
                          2.0 * static_cast<double>(run_.snapshot().size()) + 2e7;
    const auto space = fs::space(request_.folder, error);
    if (!error && static_cast<double>(space.available) < needed) {
      throw io::OutputError(request_.folder.string() + ": the disk has " + std::to_string(space.available >> 20U) +
                            " MiB left, this run needs about " +
                            std::to_string(static_cast<long long>(needed / 1048576.0)) +
                            " MiB (output.frames sets most of it)");
    }
  }

  void advance(RunResult& result) {
    const auto before = Clock::now();
    const sph::Outcome outcome = run_.step();
    record_.stepping_seconds += seconds_since(before);
    ++steps_here_;
    accumulate();
    if (!outcome.ok()) {
      result.ending = Ending::failed;
      result.reason = outcome.message();
      return;
    }
    if (run_.steps() % schedule_.row_every == 0) {
      add_row();
      add_frames();
      result.reason = stop_reason();
      show_progress();
    }
    if (!result.reason.empty()) return;
    if (wanted_to_stop()) {
      result.ending = Ending::interrupted;
      result.reason = "interrupted; go on with --resume";
    } else if (scene_.output.checkpoint_seconds > 0.0 && seconds_since(last_save_) > scene_.output.checkpoint_seconds) {
      save();
      last_save_ = Clock::now();
    }
  }

  [[nodiscard]] bool wanted_to_stop() const {
    return (request_.interrupt != nullptr && *request_.interrupt != 0) ||
           (request_.most_steps > 0 && steps_here_ >= request_.most_steps);
  }

  void accumulate() {
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const auto at = specimen_.gauges.find(order_[k]);
      if (at != specimen_.gauges.end()) record_.window[k] += measure(at->second, run_, scene_.thickness);
    }
    ++record_.window_steps;
  }

  /// Gauges as means over the steps since the last row, the rest as it is now.
  void add_row() {
    const sph::Energies e = run_.energies();
    const double b = scene_.thickness;
    std::vector<double> row = {static_cast<double>(run_.steps()), run_.time()};
    const auto gauge = [&](std::size_t k) {
      if (!specimen_.gauges.contains(order_[k])) return std::numeric_limits<double>::quiet_NaN();
      return record_.window_steps > 0 ? record_.window[k] / static_cast<double>(record_.window_steps) : 0.0;
    };
    for (std::size_t k = 0; k < 4; ++k) row.push_back(gauge(k));
    for (const double x :
         {e.external, e.elastic, e.kinetic, e.fracture, e.viscous, e.damping, e.artificial, e.error()}) {
      row.push_back(b * x);
    }
    row.push_back(static_cast<double>(run_.cracked()));
    row.push_back(largest_damage());
    row.push_back(static_cast<double>(run_.released_bonds()));
    for (std::size_t k = 4; k < order_.size(); ++k) row.push_back(gauge(k));
    record_.history.values.insert(record_.history.values.end(), row.begin(), row.end());
    record_.window.assign(order_.size(), 0.0);
    record_.window_steps = 0;
  }

  [[nodiscard]] double largest_damage() const {
    const sph::Particles<2>& p = run_.particles();
    double largest = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      if (p.kind[i] == sph::kind::cracked) largest = std::max(largest, 1.0 - p.point[i].crack.integrity);
    }
    return largest;
  }

  /// Frames at equal intervals, at deflections asked for, and where the load has fallen to given parts of its peak.
  void add_frames() {
    const History& h = record_.history;
    const double load = h.last("load");
    bool wanted = schedule_.frame_every > 0 && run_.steps() % schedule_.frame_every == 0;
    if (load > record_.peak_load) {
      record_.peak_load = load;
      std::fill_n(record_.levels_done.begin(), levels_.size(), static_cast<unsigned char>(0));
    }
    const auto check = [&](std::size_t k, bool reached) {
      if (record_.levels_done[k] != 0 || !reached) return;
      record_.levels_done[k] = 1;
      wanted = true;
    };
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      check(k, levels_[k] > 0.0 && run_.cracked() > 0 && load < levels_[k] * record_.peak_load);
    }
    for (std::size_t k = 0; k < scene_.output.frames_at.size(); ++k) {
      check(levels_.size() + k, h.last("deflection") >= scene_.output.frames_at[k]);
    }
    if (wanted) add_frame();
  }

  void add_frame() {
    char name[40];
    std::snprintf(name, sizeof name, "frame_%05zu.vtu", record_.frames.size());
    write_vtu(files_.frames / name, frame_of(run_, specimen_));
    record_.frames.push_back({run_.time(), files_.frames.filename().string() + "/" + name});
    write_pvd(request_.folder / "frames.pvd", record_.frames);
  }

  [[nodiscard]] std::string stop_reason() const {
    const History& h = record_.history;
    if (run_.steps() >= schedule_.steps) return "the time is over (stop.time)";
    if (scene_.stop.deflection && h.last("deflection") >= *scene_.stop.deflection)
      return "deflection reached (stop.deflection)";
    if (scene_.stop.load_below && run_.cracked() > 0 && h.rows() > 4) {
      bool below = true;
      for (std::size_t k = 1; k <= 3; ++k) {
        below = below && h.at(h.rows() - k, "load") < *scene_.stop.load_below * record_.peak_load;
      }
      if (below) return "the load has dropped (stop.load_below)";
    }
    if (scene_.stop.separation && h.rows() % 10 == 0 && h.last("largest_damage") > 0.99 && separated()) {
      return "the specimen is in pieces (stop.separation)";
    }
    return {};
  }

  [[nodiscard]] bool separated() const {
    const auto areas = piece_areas(spots(run_, specimen_), scene_.body.notches, scene_.spacing);
    return areas.size() > 1 && areas[1] > 0.02 * specimen_.area;
  }

  void show_progress() const {
    if (!request_.progress) return;
    const History& h = record_.history;
    Progress p;
    p.fraction = static_cast<double>(run_.steps()) / static_cast<double>(schedule_.steps);
    if (scene_.stop.deflection) p.fraction = std::max(p.fraction, h.last("deflection") / *scene_.stop.deflection);
    p.seconds = seconds_since(start_);
    p.time = run_.time();
    p.load = h.last("load");
    p.damaged = run_.cracked();
    p.steps_per_second = static_cast<double>(steps_here_) / p.seconds;
    request_.progress(p);
  }

  /// History and checkpoint are written whole under temporary names: at any moment both are complete.
  void save() {
    io::write_text(files_.history, record_.history.to_csv(), true);
    Checkpoint c{scene_.text, record_, run_.snapshot()};
    c.record.wall_seconds += seconds_since(start_);
    write_checkpoint(files_.checkpoint, c);
  }

  void finish(RunResult& result) {
    if (result.ending == Ending::interrupted) {
      save();
      result.record = record_;
      return;
    }
    if (record_.window_steps > 0) add_row();
    if (record_.frames.empty() || record_.frames.back().time != run_.time()) add_frame();
    record_.wall_seconds += seconds_since(start_);
    io::write_text(files_.history, record_.history.to_csv(), true);
    const std::vector<Spot> all = spots(run_, specimen_);
    const std::vector<CrackPath> paths = crack_paths(all, scene_.spacing);
    const std::vector<double> pieces = piece_areas(all, scene_.body.notches, scene_.spacing);
    write_crack(paths);
    const Findings f = findings(scene_, record_.history, opened_length(all, scene_.spacing));
    result.warnings = warnings_of(scene_, record_.history, f);
    result.report = report_of(f);
    result.record = record_;
    io::write_text(files_.summary, summary_text({scene_, specimen_, run_, result, f, paths, pieces}), true);
    std::error_code ignored;
    fs::remove(files_.checkpoint, ignored);
  }

  void write_crack(const std::vector<CrackPath>& paths) const {
    std::string text = "crack,point,x,y,damage\n";
    for (std::size_t c = 0; c < paths.size(); ++c) {
      for (std::size_t k = 0; k < paths[c].points.size(); ++k) {
        const Point& x = paths[c].points[k];
        text += std::to_string(c) + "," + std::to_string(k) + "," + io::exact(x[0]) + "," + io::exact(x[1]) + "," +
                io::exact(paths[c].damage[k]) + "\n";
      }
    }
    io::write_text(files_.crack, text, true);
  }

  const SceneFile& scene_;
  const RunRequest& request_;
  RunFiles files_;
  Specimen specimen_;
  sph::Simulation<2> run_;
  Schedule schedule_;
  std::vector<std::string> order_;  ///< gauges in the order of the columns
  std::vector<double> levels_;      ///< parts of the peak load at which a frame is written; <= 0: none
  RunRecord record_;
  long long steps_here_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_save_ = start_;
};

}  // namespace

RunFiles::RunFiles(const fs::path& folder)
    : scene(folder / "scene.json"),
      history(folder / "history.csv"),
      summary(folder / "summary.json"),
      checkpoint(folder / "checkpoint.bin"),
      frames(folder / "frames"),
      crack(folder / "crack.csv") {}

Schedule schedule_of(const SceneFile& scene, double time_step) {
  Schedule s;
  s.time_step = time_step;
  s.steps = std::max(1LL, std::llround(std::ceil(scene.stop.time / time_step)));
  s.row_every = std::max(1LL, s.steps / scene.output.history_rows);
  if (scene.output.frames > 0) {
    s.frame_every = s.row_every * std::max(1LL, s.steps / s.row_every / scene.output.frames);
  }
  return s;
}

RunResult run_scene(const SceneFile& scene, const RunRequest& request) {
  if (request.threads == 0) return Runner(scene, request).go();
  SceneFile own = scene;
  own.options.threads = request.threads;  // not in its text: results do not depend on it
  return Runner(own, request).go();
}

}  // namespace fpz::specimen
