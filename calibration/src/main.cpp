// fpz-calibrate: model parameters from laboratory data. Exit status: 0 success; 1 the fit is not usable; 2 bad usage,
// bad input, or a file that cannot be written; 130 interrupted.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>

#include "fpz/calibration/calibration.hpp"
#include "fpz/calibration/quick_specification.hpp"
#include "fpz/calibration/report.hpp"
#include "fpz/calibration/scene_runs.hpp"
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
  const char text[] = "\nfpz-calibrate: interrupted, no result was written; runs of scenes are kept\n";
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
    char numbers[80];
    std::snprintf(numbers, sizeof numbers, "%.0f %%, cost %.6g", 100.0 * p.fraction, p.cost);
    line_.show(p.stage + ", " + (p.detail.empty() ? numbers : p.detail) + ", " + io::clock_text(elapsed) + " elapsed");
  }

 private:
  io::ProgressLine line_;
  std::string stage_;
};

struct Arguments {
  std::string file;
  std::optional<QuickFit> quick;  ///< in place of the file
  std::string out;
  bool force = false;
  bool check = false;
  bool pictures = true;
  int starts = 0;
  std::int64_t seed = -1;
  std::string runs;  ///< folder of the runs of scenes; empty: in the output folder
  int jobs = 0;
};

int check(const Specification& spec, int jobs) {
  const FitProblem problem = make_problem(spec);
  require_valid(problem);
  io::print_notes(spec.conversions);
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
  if (const std::string runs = estimate_of_runs(spec, jobs); !runs.empty()) std::cout << "  " << runs << "\n";
  return 0;
}

/// The specification in the file, or one made of the arguments of a sub-command, which is written where its results go.
Specification specification_of(const Arguments& arguments) {
  if (!arguments.quick) return read_specification(arguments.file);
  const std::filesystem::path folder = arguments.out;
  const std::filesystem::path file = folder / "specification.json";
  const std::string text = quick_specification(*arguments.quick, folder);
  if (arguments.check) return parse_specification(text, file);
  io::make_writable_folder(folder);  // names of data files are relative to it
  io::require_absent({file}, arguments.force);
  Specification spec = parse_specification(text, file);
  io::write_text(file, text, true);
  return spec;
}

/// What the sub-commands for notched specimens have in common.
class SpecimenCommand {
 public:
  using Names = std::initializer_list<std::pair<const char*, const char*>>;  ///< a key and its meaning

  /// Lengths that are needed have a ! before their meaning; the first gauge is meant where none is named.
  SpecimenCommand(CLI::App& app, const char* name, const char* what, const char* kind, Names lengths, Names gauges,
                  const char* example)
      : command_(app.add_subcommand(name, what)) {
    fit_.kind = kind;
    command_->fallthrough();
    command_->add_option("CURVE.csv", data_, "the measured curve, in any of the notations of docs/calibration.md")
        ->required();
    for (const auto& [key, meaning] : lengths) {
      const bool needed = std::string_view(meaning).starts_with("!");
      auto* o = command_->add_option(option_for(key), lengths_[key],
                                     std::string(meaning + (needed ? 1 : 0)) + ", such as 100mm");
      if (needed) o->required();
    }
    for (const auto& [key, meaning] : gauges) gauge(key, meaning);
    if (fit_.kind == "wedge_splitting") {
      command_->add_option("--wedge-half-angle", fit_.wedge_half_angle_deg,
                           "degrees; the load is then the vertical one of the machine, otherwise what splits");
    }
    command_->add_option("--load", fit_.load.column, "name or number of the column with the load; found if unique");
    command_->add_option("--load-unit", fit_.load.unit, "its unit, where the file does not state it");
    command_->add_option("--load-scale", fit_.load.scale, "factor of its numbers: -1 turns the sign");
    command_->add_option("--young-modulus", fit_.young_modulus, "such as 30GPa; fitted when left out");
    command_->add_option("--poisson-ratio", fit_.poisson_ratio, "0.2 when left out");
    command_->add_option("--softening", fit_.softening, "softening law, such as bilinear");
    command_->add_option("--setting", fit_.setting, "plane_strain or plane_stress");
    word("--separator", fit_.table.separator, "of the columns");
    word("--decimal", fit_.table.decimal, "mark of the numbers");
    word("--encoding", fit_.table.encoding, "of the file");
    command_->add_option("--skip-rows", fit_.table.skip_rows, "lines before the one with the column names");
    command_->add_option("--rows", fit_.table.rows, "read at most so many rows");
    command_->footer(std::string("Example:\n  ") + example +
                     "\nE (unless stated), tensile strength and delta0 are fitted; the specification that was used is\n"
                     "written as specification.json, to be changed and run by itself.");
  }

  /// The test that was given, when this was the sub-command.
  [[nodiscard]] std::optional<QuickFit> parsed() const {
    if (!command_->parsed()) return std::nullopt;
    QuickFit fit = fit_;
    fit.data = data_;
    for (const auto& [key, text] : lengths_) {
      if (!text.empty()) fit.lengths.emplace_back(key, text);
    }
    fit.gauge = gauges_.front().first;
    for (const auto& [key, option] : gauges_) {
      if (*option) fit.gauge = key;
    }
    fit.reading = readings_.at(fit.gauge);
    return fit;
  }

 private:
  static std::string option_for(const char* key) {
    std::string option = std::string("--") + key;
    std::replace(option.begin(), option.end(), '_', '-');
    return option;
  }

  void gauge(const char* key, const std::string& what) {
    QuickColumn& c = readings_[key];
    const std::string option = option_for(key);
    gauges_.emplace_back(key, command_->add_option(option, c.column, "name or number of the column with the " + what));
    command_->add_option(option + "-unit", c.unit, "its unit, where the file does not state it");
    command_->add_option(option + "-scale", c.scale, "factor of its numbers");
  }

  template <fpz::Worded E>
  void word(const char* option, std::optional<E>& target, const std::string& what) {
    command_->add_option_function<std::string>(
        option,
        [&target, option](const std::string& text) {
          target = fpz::from_word<E>(text);
          if (!target) throw CLI::ValidationError(option, "must be " + fpz::all_words<E>());
        },
        what + ": " + fpz::all_words<E>());
  }

  CLI::App* command_;
  std::vector<std::pair<std::string, CLI::Option*>> gauges_;
  QuickFit fit_;
  std::string data_;
  std::map<std::string, std::string> lengths_;
  std::map<std::string, QuickColumn> readings_;
};

int run(const Arguments& arguments) {
  Specification spec = specification_of(arguments);
  if (arguments.starts > 0) spec.options.starts = arguments.starts;
  if (arguments.seed >= 0) spec.options.seed = static_cast<std::uint64_t>(arguments.seed);
  if (arguments.check) return check(spec, arguments.jobs);
  io::make_writable_folder(arguments.out);  // before the work, not after it
  io::require_absent(report_files(spec, arguments.out, arguments.pictures), arguments.force);
  io::print_notes(spec.conversions);
  Calibration result;
  {
    FitProgressLine line;
    const std::filesystem::path runs =
        arguments.runs.empty() ? std::filesystem::path(arguments.out) / "runs" : std::filesystem::path(arguments.runs);
    result = calibrate(
        spec, [&](const FitProgress& p) { line.show(p); }, scene_runner({runs, arguments.jobs}));
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
  app.add_option("SPEC.json", arguments.file, "specification: parameters, data sets, options");
  auto* out = app.add_option("-o,--out", arguments.out,
                             "folder for material.json, report.html, report.md, report.json, curves and pictures");
  app.add_flag("--check", arguments.check, "only read and check the specification and its data")->excludes(out);
  app.add_flag("--force", arguments.force, "replace files that exist");
  app.add_flag("!--no-plots", arguments.pictures, "draw no pictures");
  app.add_option("--starts", arguments.starts, "number of starts, in place of the specification's")
      ->check(CLI::Range(1, 1000));
  app.add_option("--seed", arguments.seed, "seed of the starts, in place of the specification's")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{2'000'000'000}));
  app.add_option("--runs", arguments.runs,
                 "folder that keeps the runs of scenes, so that a fit goes on or is repeated quickly; default: runs in "
                 "the output folder");
  app.add_option("--jobs", arguments.jobs, "runs of scenes at the same time, one core each; default: one per core")
      ->check(CLI::Range(1, 10000));
  constexpr std::pair<const char*, const char*> cmod{"cmod", "crack mouth opening"};
  constexpr std::pair<const char*, const char*> clip{"clip_gauge_distance",
                                                     "distance of the clip gauge from the mouth"};
  const SpecimenCommand::Names bending_gauges = {
      cmod, {"deflection", "deflection of the load point, which needs --roller-width"}};
  const SpecimenCommand::Names pulled_gauges = {cmod,
                                                {"load_line_opening", "opening of the notch on the line of the forces"},
                                                {"deflection", "displacement of the two points of the forces apart"}};
  const SpecimenCommand beam(
      app, "beam", "Fit a notched beam from its curve and lengths, without a specification", "notched_beam",
      {{"depth", "!depth of the beam"},
       {"span", "!distance of the supports"},
       {"notch", "!length of the notch"},
       {"thickness", "!thickness"},
       {"length", "length of the beam"},
       {"roller_width", "width of the loaded line"},
       clip},
      bending_gauges,
      "fpz-calibrate beam --depth 100mm --span 300mm --notch 50mm --thickness 100mm curve.csv -o out/beam");
  const SpecimenCommand semicircular(
      app, "semicircular", "Fit a semicircular specimen in bending the same way", "semicircular_bend",
      {{"radius", "!radius of the half disc"},
       {"span", "!distance of the supports"},
       {"notch", "!length of the notch"},
       {"thickness", "!thickness"},
       {"roller_width", "width of the loaded line"},
       clip},
      bending_gauges,
      "fpz-calibrate semicircular --radius 50mm --span 60mm --notch 20mm --thickness 30mm curve.csv -o out/scb");
  const SpecimenCommand compact(
      app, "compact", "Fit a compact tension specimen the same way", "compact_tension",
      {{"width", "!from the line of the pins to the back"},
       {"notch", "!from the line of the pins to the tip"},
       {"thickness", "!thickness"},
       {"hole", "diameter of the holes; 0.25 width when left out"},
       clip},
      pulled_gauges, "fpz-calibrate compact --width 100mm --notch 40mm --thickness 50mm curve.csv -o out/compact");
  const SpecimenCommand wedge(
      app, "wedge", "Fit a wedge splitting test the same way", "wedge_splitting",
      {{"length", "!of the specimen across the notch"},
       {"depth", "!from the face with the notch to the bottom"},
       {"ligament", "!from the tip of the notch to the bottom"},
       {"thickness", "!thickness"},
       {"span", "!distance of the two bearings"},
       {"load_depth", "!of the bearings below the face"},
       {"groove_width", "of a groove in the face"},
       {"groove_depth", "of a groove in the face"},
       {"roller_width", "height over which the forces are spread"},
       clip},
      pulled_gauges,
      "fpz-calibrate wedge --length 200mm --depth 200mm --ligament 100mm --thickness 100mm --span 80mm\n"
      "    --load-depth 20mm --wedge-half-angle 15 curve.csv -o out/wedge");
  const SpecimenCommand cantilever(
      app, "cantilever", "Fit a double cantilever beam the same way", "double_cantilever",
      {{"height", "!of both arms"},
       {"length", "!from end to end"},
       {"notch", "!from the line of the forces to the tip"},
       {"thickness", "!thickness"},
       {"span", "distance of the two forces; half the height when left out"},
       {"load_depth", "of the line of the forces from the end"},
       {"roller_width", "length over which the forces are spread"},
       clip},
      pulled_gauges,
      "fpz-calibrate cantilever --height 60mm --length 300mm --notch 80mm --thickness 30mm curve.csv -o out/dcb");
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n"
      "  fpz-calibrate beam --depth 100mm --span 300mm --notch 50mm --thickness 100mm curve.csv -o out/beam\n"
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
    for (const SpecimenCommand* command : {&beam, &semicircular, &compact, &wedge, &cantilever}) {
      if (auto fit = command->parsed()) arguments.quick = std::move(fit);
    }
    if (arguments.quick.has_value() != arguments.file.empty()) throw CLI::RequiredError("SPEC.json (or a sub-command)");
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
