// fpz-sph: fracture tests of specimens from the command line. Exit status: 0 success; 1 the run failed; 2 bad usage,
// bad input, or a file that cannot be written; 3 interrupted, with a checkpoint.
#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <set>

#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/terminal.hpp"
#include "fpz/specimen/estimate.hpp"
#include "fpz/specimen/pictures.hpp"
#include "fpz/specimen/run.hpp"
#include "fpz/specimen/sweep.hpp"

namespace {

namespace fs = std::filesystem;
namespace io = fpz::io;
using namespace fpz::specimen;

volatile std::sig_atomic_t interrupted = 0;
extern "C" void on_signal(int) { interrupted = 1; }

/// Remaining time from what this process has done, as a resumed run begins somewhere on the way.
class RunProgressLine {
 public:
  void show(const Progress& p) {
    if (!line_.due()) return;
    if (!begun_) first_fraction_ = p.fraction, first_seconds_ = p.seconds;
    begun_ = true;
    const double done = p.fraction - first_fraction_;
    const double left = done > 0.0 ? (p.seconds - first_seconds_) * (1.0 - p.fraction) / done : 0.0;
    char text[200];
    std::snprintf(text, sizeof text,
                  "%5.1f %%  load %.4g N, %zu damaged, %.0f steps/s, %s elapsed, at most %s remaining",
                  100.0 * p.fraction, p.load, p.damaged, p.steps_per_second, io::clock_text(p.seconds).c_str(),
                  io::clock_text(left).c_str());
    line_.show(text);
  }

 private:
  io::ProgressLine line_;
  bool begun_ = false;
  double first_fraction_ = 0.0, first_seconds_ = 0.0;
};

void show(io::ProgressLine& line, const SweepProgress& p) {
  if (!line.due()) return;
  char text[200];
  std::snprintf(text, sizeof text, "%zu of %zu runs done, %zu running, %s elapsed, about %s remaining", p.done, p.all,
                p.running, io::clock_text(p.seconds).c_str(),
                std::isnan(p.remaining) ? "?" : io::clock_text(p.remaining).c_str());
  line.show(text);
}

struct Arguments {
  std::string scene, out;
  Overrides set;
  bool force = false, resume = false, pictures = true;
  int threads = 0, jobs = 0;
  long long steps = 0;
};

void report_pictures(const PictureOutcome& pictures, const fs::path& folder) {
  io::print_warnings(pictures.warnings);
  if (!pictures.files.empty()) std::cout << "  " << pictures.files.size() << " pictures in " << folder.string() << "\n";
}

int run(const Arguments& a) {
  const Scene scene = read_scene(a.scene, a.set);
  io::print_notes(scene.conversions);
  io::print_warnings(scene.warnings);
  RunRequest request;
  request.folder = a.out;
  request.force = a.force;
  request.resume = a.resume;
  request.keep_checkpoint = true;
  request.threads = a.threads;
  request.most_steps = a.steps;
  request.interrupt = &interrupted;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  RunResult result;
  {
    RunProgressLine line;
    request.progress = [&](const Progress& p) { line.show(p); };
    request.warn = io::print_warnings;
    result = run_scene(scene, request);
  }
  const History& h = result.history;
  if (result.ending == Ending::interrupted) {
    std::cout << scene.name << ": " << result.reason << "\n  " << RunFiles(a.out).checkpoint.string() << "\n";
    return 3;
  }
  io::print_warnings(result.warnings);
  std::cout << scene.name << ": " << (result.ending == Ending::failed ? "FAILED: " : "") << result.reason << "\n"
            << result.report << "  " << RunFiles(a.out).history.string() << " (" << h.rows() << " rows), "
            << result.frames.size() << " frames in " << RunFiles(a.out).collection.string() << "\n";
  if (a.pictures && scene.output.pictures) report_pictures(draw_run(a.out, true), a.out);
  return result.ending == Ending::failed ? 1 : 0;
}

int check(const Arguments& a) {
  const Scene scene = read_scene(a.scene, a.set);
  io::print_notes(scene.conversions);
  io::print_warnings(scene.warnings);
  const Specimen specimen = make_specimen(scene);
  io::print_warnings(specimen.warnings);
  const Estimate e = estimate(scene, specimen, a.threads);
  const std::string slow = warning_of_time_step(specimen.setup, e.schedule.time_step);
  if (!slow.empty()) io::print_warnings({slow});
  std::cout << scene.name << ": the scene is valid\n" << estimate_text(scene, specimen, e);
  if (!a.pictures) return 0;
  const fs::path folder = a.out.empty() ? fs::path("fpz-check-" + scene.name) : fs::path(a.out);
  io::make_writable_folder(folder);
  report_pictures(draw_scene(scene, specimen, folder, true), folder);
  return 0;
}

/// What is doubtful about the scenes of a sweep, each once.
void print_scene_warnings(const Sweep& sweep) {
  std::set<std::string> shown;
  for (const SweepRun& run : sweep.runs) {
    for (const std::string& w : run.scene.warnings) {
      if (shown.insert(w).second) std::cerr << "warning: " << w << " (" << run.folder.string() << ")\n";
    }
  }
}

int sweep(const Arguments& a) {
  const Sweep sweep = read_sweep(a.scene, a.set);
  print_scene_warnings(sweep);
  SweepRequest request;
  request.folder = a.out;
  request.jobs = a.jobs;
  request.force = a.force;
  request.pictures = a.pictures;
  request.interrupt = &interrupted;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  SweepResult result;
  {
    io::ProgressLine line;
    request.progress = [&](const SweepProgress& p) { show(line, p); };
    result = run_sweep(sweep, request);
  }
  std::size_t kept = 0, with_warnings = 0;
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    const SweepRow& row = result.rows[k];
    kept += row.kept ? 1U : 0U;
    with_warnings += row.figures.back() > 0.0 ? 1U : 0U;
    if (row.reason.empty()) continue;
    std::cerr << (row.status == RunStatus::failed ? "FAILED: " : "warning: ")
              << (fs::path(a.out) / sweep.runs[k].folder).string() << ": " << row.reason << "\n";
  }
  const std::size_t failed = result.count(RunStatus::failed), finished = result.count(RunStatus::finished);
  std::cout << sweep.name << ": " << finished << " of " << sweep.runs.size() << " runs finished (" << kept
            << " were there already), " << failed << " failed\n  " << (fs::path(a.out) / "sweep.csv").string() << "\n";
  if (with_warnings > 0) {
    std::cout << "  " << with_warnings << " runs have warnings: see \"warnings\" in their summary.json\n";
  }
  report_pictures(result.pictures, a.out);
  if (finished + failed < sweep.runs.size()) {
    std::cout << "  interrupted; the same command goes on\n";
    return 3;
  }
  return failed > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Fracture tests of rock specimens by the particle method."};
  app.set_version_flag("--version", FPZ_VERSION);
  app.footer(
      "Examples:\n"
      "  fpz-sph data/scenes/beam_3pb.json -o out/beam\n"
      "  fpz-sph data/scenes/beam_3pb.json -o out/fine --set spacing=0.002 --set material=../materials/bellego.json\n"
      "  fpz-sph data/scenes/scb.json -o out/scb30 --set notches[0].angle_deg=30\n"
      "  fpz-sph data/scenes/beam_3pb.json -o out/beam --resume       after Ctrl-C or a crash\n"
      "  fpz-sph check data/scenes/ring.json --set shape.diameter_ratio=0.5\n"
      "  fpz-sph plot out/beam\n"
      "  fpz-sph sweep data/sweeps/scb_angles.json -o out/angles\n"
      "Scenes and sweeps are described in docs/scenes.md.\n"
      "Exit status: 0 success; 1 the run failed; 2 bad usage or input, or unwritable files; 3 interrupted, resumable.");
  Arguments a;
  const auto common = [&](CLI::App& c) {
    c.add_option("SCENE.json", a.scene, "scene file");
    c.add_option("-o,--out", a.out, "output folder");
    c.add_option("--set", a.set, "path=value: override an entry of the scene (may be repeated)")->take_all();
    c.add_option("--threads", a.threads, "number of threads; results do not depend on it")->check(CLI::PositiveNumber);
    c.add_flag("!--no-pictures", a.pictures, "draw nothing");
  };
  common(app);
  app.add_flag("--force", a.force, "replace the files of an earlier run");
  app.add_flag("--resume", a.resume,
               "go on from the checkpoint in the output folder; after the end, to a later one (stop)");
  app.add_option("--steps", a.steps, "stop after so many steps with a checkpoint (for time limits)")
      ->check(CLI::PositiveNumber);

  CLI::App* check_command = app.add_subcommand("check", "Validate a scene, draw it, estimate steps, memory and time");
  common(*check_command);
  check_command->footer("Example:\n  fpz-sph check data/scenes/scb.json -o out/check --set notches[0].angle_deg=45");

  CLI::App* sweep_command = app.add_subcommand("sweep", "Run a scene many times with entries changed");
  sweep_command->add_option("SWEEP.json", a.scene, "sweep file");
  sweep_command->add_option("-o,--out", a.out, "output folder");
  sweep_command->add_option("--set", a.set, "path=value: override an entry of every scene (may be repeated)")
      ->take_all();
  sweep_command->add_option("--jobs", a.jobs, "runs at the same time, one thread each; default: one per core")
      ->check(CLI::PositiveNumber);
  sweep_command->add_flag("--force", a.force, "replace runs of other scenes and repeat failed ones");
  sweep_command->add_flag("!--no-pictures", a.pictures, "draw nothing");
  sweep_command->footer(
      "Every run has a folder OUTDIR/<series>/<value>; sweep.csv has one row per run. The same command again goes on\n"
      "where an interrupted sweep was, and repeats nothing that is done.\n"
      "Examples:\n"
      "  fpz-sph sweep data/sweeps/scb_angles.json -o out/angles\n"
      "  fpz-sph sweep data/sweeps/ring_diameters.json -o out/coarse --set spacing=0.001 --jobs 4\n"
      "Exit status: 0 all runs finished; 1 some failed; 2 bad usage or input, or unwritable files; 3 interrupted.");

  std::string folder;
  CLI::App* plot_command = app.add_subcommand("plot", "Draw the pictures of a run again");
  plot_command->add_option("OUTDIR", folder, "folder of a run")->required();
  plot_command->footer("Example:\n  fpz-sph plot out/beam");

  try {
    app.parse(argc, argv);
    if (*plot_command) {
      const PictureOutcome pictures = draw_run(folder, true);
      report_pictures(pictures, folder);
      return 0;
    }
    if (a.scene.empty()) throw CLI::RequiredError(*sweep_command ? "SWEEP.json" : "SCENE.json");
    if (!*check_command && a.out.empty()) throw CLI::RequiredError("--out");
    if (a.force && a.resume) throw CLI::ValidationError("--force and --resume exclude each other");
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  if (*sweep_command) return sweep(a);
  return *check_command ? check(a) : run(a);
} catch (const std::exception& e) {
  std::cerr << "fpz-sph: " << e.what() << "\n";
  return 2;
}
