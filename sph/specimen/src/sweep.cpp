#include "fpz/specimen/sweep.hpp"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <thread>

#include "fpz/io/input_error.hpp"
#include "fpz/io/json_locator.hpp"
#include "fpz/io/output.hpp"
#include "fpz/specimen/run.hpp"

namespace fpz::specimen {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// ---- What a run has left in its folder

std::optional<io::JsonValue> load_json(const fs::path& file) {
  const io::ReadLimits limits;
  io::Problems problems(limits.problems);
  std::string text, error;
  io::JsonValue root;
  if (!io::load_text(file, io::FileKind::regular, limits, text, error)) return std::nullopt;
  if (!io::parse_json(text, file.string(), limits, problems, root)) return std::nullopt;
  return root;
}

/// A number of the summary by its path, or the number of entries of a list; NaN when it is null or not there.
double number_at(const io::JsonValue& root, const std::vector<const char*>& path) {
  const io::JsonValue* at = &root;
  for (const char* name : path) {
    at = at->find(name);
    if (at == nullptr) return nan;
  }
  if (at->is(io::JsonValue::Kind::array)) return static_cast<double>(at->items.size());
  return at->is(io::JsonValue::Kind::number) ? at->number : nan;
}

/// A column of sweep.csv and where the summary of a run has it.
struct Figure {
  const char* name;
  std::vector<const char*> path;
};

const std::vector<Figure>& figures() {
  static const std::vector<Figure> list = {{"peak_load", {"peak_load"}},
                                           {"deflection_at_peak", {"deflection_at_peak"}},
                                           {"stiffness", {"stiffness"}},
                                           {"fracture_energy_ratio", {"fracture_energy_ratio"}},
                                           {"crack_area", {"crack_area"}},
                                           {"energy_balance_error", {"energy_balance_error"}},
                                           {"kinetic_over_internal", {"kinetic_over_internal", "before_peak"}},
                                           {"load_support_imbalance", {"load_support_imbalance"}},
                                           {"energy_external", {"energies", "external"}},
                                           {"energy_fracture", {"energies", "fracture"}},
                                           {"K_I", {"toughness_K_I"}},
                                           {"K_II", {"toughness_K_II"}},
                                           {"particles", {"particles"}},
                                           {"steps", {"steps"}},
                                           {"wall_seconds", {"wall_seconds"}},
                                           {"warnings", {"warnings"}}};
  return list;
}

std::vector<double> no_figures(double value) {
  std::vector<double> row(figure_names().size(), nan);
  row[0] = value;
  return row;
}

std::vector<double> figures_of(const fs::path& folder, double value) {
  std::vector<double> row = no_figures(value);
  const auto summary = load_json(RunFiles(folder).summary);
  if (!summary) return row;
  for (std::size_t k = 0; k < figures().size(); ++k) row[k + 1] = number_at(*summary, figures()[k].path);
  return row;
}

std::string word_at(const io::JsonValue& root, const char* name) {
  const io::JsonValue* at = root.find(name);
  return at != nullptr ? at->text : std::string();
}

/// What an earlier sweep has left of a run.
enum class Found : unsigned char { nothing, part, finished, failed, other };

Found look(const fs::path& folder, const Scene& scene, std::string& reason) {
  const RunFiles files(folder);
  std::string text, error;
  if (!io::load_text(files.scene, io::FileKind::regular, io::ReadLimits(), text, error)) return Found::nothing;
  if (text != scene.text) return Found::other;
  std::error_code ignored;
  if (fs::exists(files.checkpoint, ignored)) return Found::part;
  const auto summary = load_json(files.summary);
  if (!summary) return Found::nothing;
  reason = word_at(*summary, "reason");
  return word_at(*summary, "status") == "finished" ? Found::finished : Found::failed;
}

// ---- One run in a process of its own

/// What the process of a run tells the sweep, in memory that both see.
struct Slot {
  std::atomic<double> fraction{0.0};
  char reason[1000] = {};
};
static_assert(std::atomic<double>::is_always_lock_free);

/// One slot per run, shared with the processes that are forked later.
class Slots {
 public:
  explicit Slots(std::size_t count) : count_(count) {
    void* memory = ::mmap(nullptr, count * sizeof(Slot), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    slots_ = static_cast<Slot*>(memory);
    for (std::size_t k = 0; k < count; ++k) new (slots_ + k) Slot();
  }
  ~Slots() { ::munmap(slots_, count_ * sizeof(Slot)); }
  Slots(const Slots&) = delete;
  Slots& operator=(const Slots&) = delete;
  Slot& operator[](std::size_t k) { return slots_[k]; }

 private:
  std::size_t count_;
  Slot* slots_ = nullptr;
};

volatile std::sig_atomic_t told_to_stop = 0;
extern "C" void on_stop(int) { told_to_stop = 1; }

/// The order of the exit statuses is that of fpz-sph: 0 finished, 1 failed, 2 files, 3 interrupted.
int run_one(const Scene& scene, RunRequest request, bool pictures, Slot& slot) {
  const auto say = [&](const std::string& text) { std::snprintf(slot.reason, sizeof slot.reason, "%s", text.c_str()); };
  try {
    request.threads = 1;
    request.interrupt = &told_to_stop;
    request.progress = [&](const Progress& p) { slot.fraction = p.fraction; };
    const RunResult result = run_scene(scene, request);
    if (result.ending == Ending::interrupted) return 3;
    if (result.ending == Ending::failed) say(result.reason);
    if (pictures && scene.output.pictures) {
      const PictureOutcome drawn = draw_run(request.folder, true);
      if (result.ending == Ending::finished && !drawn.warnings.empty()) say(drawn.warnings.front());
    }
    return result.ending == Ending::failed ? 1 : 0;
  } catch (const std::exception& e) {
    say(e.what());
    return 2;
  }
}

/// While it lives, SIGINT and SIGTERM wait: a new process must first have its own handlers.
class HoldSignals {
 public:
  HoldSignals() {
    sigset_t both;
    sigemptyset(&both);
    sigaddset(&both, SIGINT);
    sigaddset(&both, SIGTERM);
    ::sigprocmask(SIG_BLOCK, &both, &previous_);
  }
  ~HoldSignals() { release(); }
  HoldSignals(const HoldSignals&) = delete;
  HoldSignals& operator=(const HoldSignals&) = delete;
  void release() { ::sigprocmask(SIG_SETMASK, &previous_, nullptr); }

 private:
  sigset_t previous_{};
};

[[noreturn]] void be_a_run(pid_t parent, HoldSignals& held, const Scene& scene, const RunRequest& request,
                           bool pictures, Slot& slot) {
  std::signal(SIGINT, on_stop);
  std::signal(SIGTERM, on_stop);
  held.release();
#ifdef _OPENMP
  omp_set_num_threads(1);  // also because the threads of the caller's teams do not exist in this process
#endif
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // a killed sweep leaves no runs behind, but their checkpoints
  if (::getppid() != parent) told_to_stop = 1;
  ::_exit(run_one(scene, request, pictures, slot));
}

// ---- The sweep

/// One sweep in progress.
class Sweeper {
 public:
  Sweeper(const Sweep& sweep, const SweepRequest& request)
      : sweep_(sweep), request_(request), slots_(sweep.runs.size()) {
    jobs_ = request.jobs > 0 ? static_cast<std::size_t>(request.jobs)
                             : std::max<std::size_t>(1, std::thread::hardware_concurrency());
    result_.rows.resize(sweep.runs.size());
  }
  ~Sweeper() { end_all(); }  // only an exception leaves runs behind
  Sweeper(const Sweeper&) = delete;
  Sweeper& operator=(const Sweeper&) = delete;

  SweepResult go() {
    io::make_writable_folder(request_.folder);
    sort_out();
    write_table();
    while (!stopped() && (!waiting_.empty() || !running_.empty())) {
      while (running_.size() < jobs_ && !waiting_.empty()) start();
      if (collect()) write_table();
      show_progress();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    end_all();
    write_table();
    if (request_.pictures && !stopped()) result_.pictures = draw_sweep(sweep_, result_.rows, request_.folder);
    return std::move(result_);
  }

 private:
  struct Process {
    pid_t pid;
    std::size_t run;
  };

  [[nodiscard]] bool stopped() const { return request_.interrupt != nullptr && *request_.interrupt != 0; }
  [[nodiscard]] fs::path folder(std::size_t k) const { return request_.folder / sweep_.runs[k].folder; }

  /// What has to be run, in the order of the sweep.
  void sort_out() {
    std::string others;
    for (std::size_t k = 0; k < sweep_.runs.size(); ++k) {
      SweepRow& row = result_.rows[k];
      const Found found = look(folder(k), sweep_.runs[k].scene, row.reason);
      if (found == Found::other && !request_.force) others += "\n  " + folder(k).string();
      const bool done = found == Found::finished || (found == Found::failed && !request_.force);
      if (done) {
        row.kept = true;
        row.status = found == Found::finished ? RunStatus::finished : RunStatus::failed;
        if (found == Found::finished) row.reason.clear();
      } else {
        row.reason.clear();
        waiting_.push_back(k);
        resume_.push_back(found == Found::part);
      }
      row.figures = done ? figures_of(folder(k), sweep_.runs[k].value) : no_figures(sweep_.runs[k].value);
    }
    if (!others.empty()) {
      throw io::OutputError("these folders hold runs of other scenes (use --force to replace them):" + others);
    }
    kept_ = sweep_.runs.size() - waiting_.size();
  }

  void start() {
    const std::size_t k = waiting_.front();
    RunRequest request;
    request.folder = folder(k);
    request.resume = resume_.front();
    request.force = !request.resume;  // what is there is of no use: sort_out() has looked
    waiting_.erase(waiting_.begin());
    resume_.erase(resume_.begin());
    const pid_t parent = ::getpid();
    std::fflush(nullptr);  // else the child would write it again
    HoldSignals held;
    const pid_t pid = ::fork();
    if (pid == 0) be_a_run(parent, held, sweep_.runs[k].scene, request, request_.pictures, slots_[k]);
    if (pid < 0) throw io::OutputError(std::string("no process can be started: ") + std::strerror(errno));
    running_.push_back({pid, k});
    result_.rows[k].status = RunStatus::running;
  }

  /// Takes note of runs that have ended; true when there are any.
  bool collect() {
    const std::size_t before = running_.size();
    std::erase_if(running_, [&](const Process& p) {
      int status = 0;
      if (::waitpid(p.pid, &status, WNOHANG) != p.pid) return false;
      SweepRow& row = result_.rows[p.run];
      row.reason = slots_[p.run].reason;
      const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      row.status = code == 0 ? RunStatus::finished : code == 3 ? RunStatus::interrupted : RunStatus::failed;
      if (code == -1) row.reason = "its process was ended by signal " + std::to_string(WTERMSIG(status));
      if (code == 0 || code == 1) row.figures = figures_of(folder(p.run), sweep_.runs[p.run].value);
      return true;
    });
    return running_.size() < before;
  }

  /// Lets all runs write a checkpoint and end.
  void end_all() {
    for (const Process& p : running_) ::kill(p.pid, SIGTERM);
    while (!running_.empty()) {
      (void)collect();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  void show_progress() {
    if (!request_.progress) return;
    SweepProgress p;
    p.all = sweep_.runs.size();
    p.running = running_.size();
    p.done = p.all - p.running - waiting_.size();
    p.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    double work = static_cast<double>(p.done - kept_);  // in runs
    for (const Process& q : running_) work += slots_[q.run].fraction;
    const double all = static_cast<double>(p.all - kept_);
    p.remaining = work > 0.0 ? p.seconds * (all - work) / work : nan;
    request_.progress(p);
  }

  void write_table() const {
    std::string text = "series,value,label,status";
    for (std::size_t c = 1; c < figure_names().size(); ++c) text.append(",").append(figure_names()[c]);
    text += ",folder\n";
    for (std::size_t k = 0; k < sweep_.runs.size(); ++k) {
      const SweepRun& run = sweep_.runs[k];
      const auto number = [](double x) { return std::isnan(x) ? std::string("nan") : io::exact(x); };
      const SweepRow& row = result_.rows[k];
      text += sweep_.series[run.series] + "," + number(run.value) + "," + run.label + "," + fpz::to_string(row.status);
      for (std::size_t c = 1; c < row.figures.size(); ++c) text.append(",").append(number(row.figures[c]));
      text.append(",").append(run.folder.string()).append("\n");
    }
    io::write_text(request_.folder / "sweep.csv", text, true);
  }

  const Sweep& sweep_;
  const SweepRequest& request_;
  Slots slots_;
  std::size_t jobs_ = 1, kept_ = 0;
  std::vector<std::size_t> waiting_;
  std::vector<bool> resume_;  ///< of the waiting ones
  std::vector<Process> running_;
  SweepResult result_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list = {"value"};
    for (const Figure& f : figures()) list.emplace_back(f.name);
    return list;
  }();
  return names;
}

std::size_t SweepResult::count(RunStatus status) const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const SweepRow& row) { return row.status == status; }));
}

SweepResult run_sweep(const Sweep& sweep, const SweepRequest& request) { return Sweeper(sweep, request).go(); }

}  // namespace fpz::specimen
