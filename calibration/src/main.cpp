// fpz-calibrate: model parameters from laboratory data. Exit status: 0 success; 1 the fit is not usable; 2 bad usage,
// bad input, or a file that cannot be written; 130 interrupted.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>

#include "fpz/calibration/calibration.hpp"
#include "fpz/calibration/report.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/terminal.hpp"

namespace {

namespace io = fpz::io;
using namespace fpz::calibration;
using fpz::to_string;

constexpr int interrupted_status = 130;

volatile std::sig_atomic_t writing = 0;
volatile std::sig_atomic_t interrupted = 0;

/// While nothing is being written there is nothing to clean up; otherwise the file at hand is finished or dropped.
void on_interrupt(int /*signal*/) {
  interrupted = 1;
  if (writing != 0) return;
  const char text[] = "\nfpz-calibrate: interrupted, nothing was written\n";
  const auto ignored = ::write(STDERR_FILENO, text, sizeof text - 1);
  (void)ignored;
  ::_exit(interrupted_status);
}

struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void stop_if_interrupted() {
  if (interrupted != 0) throw Interrupted("interrupted while writing; the results are not complete");
}

/// On a terminal one line that is written over again and again; elsewhere one line per stage of the fit.
class FitProgressLine {
 public:
  void show(const FitProgress& p) {
    const double elapsed = line_.elapsed();
    if (!line_.on_terminal()) {
      if (p.stage == stage_ || elapsed < 1.0) return;  // nothing for fits that are done at once
      stage_ = p.stage;
      std::fprintf(stderr, "%s, %.0f s elapsed\n", p.stage.c_str(), elapsed);
      return;
    }
    if (!line_.due()) return;
    char text[80];
    std::snprintf(text, sizeof text, ", %.0f %%, cost %.6g, %s elapsed", 100.0 * p.fraction, p.cost,
                  io::clock_text(elapsed).c_str());
    line_.show(p.stage + text);
  }

 private:
  io::ProgressLine line_;
  std::string stage_;
};

struct Arguments {
  std::string file;
  std::string out;
  bool force = false;
  bool check = false;
  bool pictures = true;
  int starts = 0;
  std::int64_t seed = -1;
};

int check(const Specification& spec) {
  const FitProblem problem = make_problem(spec);
  require_valid(problem);
  io::print_warnings(spec.warnings);
  std::cout << spec.name << ": ok\n";
  for (const FitParameter& p : problem.parameters) {
    std::cout << "  " << p.name << ": start " << p.start << ' ' << p.unit << ", from " << p.lower << " to " << p.upper
              << "\n";
  }
  for (const DataSet& d : spec.data) {
    std::cout << "  " << d.name << ": " << d.kind << ", " << d.measured.size() << " points, "
              << (d.role == Role::fit ? "fitted" : "predicted") << "\n";
    if (!d.file.empty()) std::cout << "    " << d.file << ": " << d.notation << "\n";
  }
  return 0;
}

int run(const Arguments& arguments) {
  Specification spec = read_specification(arguments.file);
  if (arguments.starts > 0) spec.options.starts = arguments.starts;
  if (arguments.seed >= 0) spec.options.seed = static_cast<std::uint64_t>(arguments.seed);
  if (arguments.check) return check(spec);
  io::make_writable_folder(arguments.out);  // before the work, not after it
  io::require_absent(report_files(spec, arguments.out, arguments.pictures), arguments.force);
  Calibration result;
  {
    FitProgressLine line;
    result = calibrate(spec, [&](const FitProgress& p) { line.show(p); });
  }
  io::print_warnings(result.warnings);
  writing = 1;
  const ReportFiles written =
      write_report(result, {arguments.out, arguments.force, arguments.pictures, stop_if_interrupted});
  stop_if_interrupted();
  io::print_warnings(written.warnings);
  std::cout << short_table(result) << "  " << written.files.size() << " files in " << arguments.out << "\n";
  if (result.result.usable()) return 0;
  std::cerr << "error: the fit is not usable (" << to_string(result.result.status) << ")\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Fits the parameters of the process zone model to laboratory data.", "fpz-calibrate"};
  app.set_version_flag("--version", "fpz-calibrate " FPZ_VERSION);
  Arguments arguments;
  app.add_option("SPEC.json", arguments.file, "specification: parameters, data sets, options")->required();
  auto* out = app.add_option("-o,--out", arguments.out,
                             "folder for material.json, report.json, report.md, curves and pictures");
  app.add_flag("--check", arguments.check, "only read and check the specification and its data")->excludes(out);
  app.add_flag("--force", arguments.force, "replace files that exist");
  app.add_flag("!--no-plots", arguments.pictures, "draw no pictures");
  app.add_option("--starts", arguments.starts, "number of starts, in place of the specification's")
      ->check(CLI::Range(1, 1000));
  app.add_option("--seed", arguments.seed, "seed of the starts, in place of the specification's")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{2'000'000'000}));
  app.footer(
      "Examples:\n"
      "  fpz-calibrate data/calibration/table1.json -o out/table1\n"
      "  fpz-calibrate data/calibration/gregoire_d50_modulus.json -o out/d50\n"
      "  fpz-calibrate my_rock.json --check\n"
      "  fpz-driver run PATH.json takes the resulting material.json as its \"material\".\n"
      "The specification is described in docs/calibration.md.\n"
      "Exit status: 0 success; 1 the fit is not usable (material_unusable.json is written in place of material.json);\n"
      "2 bad usage or input, or unwritable files; 130 interrupted.");
  try {
    app.parse(argc, argv);
    if (!arguments.check && arguments.out.empty()) throw CLI::RequiredError("--out");
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  return run(arguments);
} catch (const Interrupted& e) {
  std::cerr << "fpz-calibrate: " << e.what() << "\n";
  return interrupted_status;
} catch (const std::exception& e) {
  std::cerr << "fpz-calibrate: " << e.what() << "\n";
  return 2;
}
