// fpz-driver: element tests from the command line. Exit status: 0 success; 1 a run, check or comparison failed; 2 bad
// usage, bad input, or a file that cannot be written.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <set>

#include "fpz/driver/compare.hpp"
#include "fpz/driver/path_file.hpp"
#include "fpz/driver/plot.hpp"
#include "fpz/driver/replay.hpp"
#include "fpz/driver/run.hpp"
#include "fpz/driver/tangent_check.hpp"
#include "fpz/io/csv_options.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/terminal.hpp"

namespace {

namespace fs = std::filesystem;
namespace io = fpz::io;
using namespace fpz::driver;

void show(io::ProgressLine& line, const std::string& name, const Progress& p) {
  if (!line.due()) return;
  const double elapsed = line.elapsed();
  const double remaining = p.time > 0.0 ? elapsed * (p.stages - p.time) / p.time : 0.0;
  char text[200];
  std::snprintf(text, sizeof text, ": stage %d of %d, D = %.4f, %s elapsed, about %s remaining", p.stage, p.stages,
                p.damage, io::clock_text(elapsed).c_str(), io::clock_text(remaining).c_str());
  line.show(name + text);
}

struct RunArguments {
  std::string file;
  std::string out;
  bool force = false;
  bool plots = true;
};

/// Folder of every test: the output folder itself for a single test, a sub-folder each for several.
std::vector<fs::path> test_folders(const PathFile& paths, const fs::path& out) {
  std::vector<fs::path> folders;
  std::set<std::string> names;
  for (const Test& test : paths.tests) {
    const std::string name = folder_name(test.name);
    if (!names.insert(name).second)
      throw InputError(paths.file.string() + ": two tests would share the folder \"" + name + "\"");
    folders.push_back(paths.tests.size() == 1 ? out : out / name);
  }
  return folders;
}

void plot_test(const io::Table& table, const PlotRequest& request) {
  const PlotOutcome pictures = plot_history(table, request);
  io::print_warnings(pictures.warnings);
  if (!pictures.files.empty())
    std::cout << "  " << pictures.files.size() << " pictures in " << request.folder.string() << "\n";
}

/// Runs one test and writes all its files. Returns whether it came through.
bool run_one(const Test& test, const fs::path& folder, const RunArguments& arguments) {
  io::make_writable_folder(folder);
  io::print_notes(test.conversions);
  io::print_warnings(test.warnings);
  Result result;
  {
    io::ProgressLine line;
    result = run_test(test, [&](const Progress& p) { show(line, test.name, p); });
  }
  write_history(folder / "history.csv", result.history, arguments.force);
  write_summary(folder / "summary.json", test, result, arguments.force);
  std::cout << test.name << ": " << result.status << ", " << result.history.size()
            << " rows, D = " << result.summary.damage << ", energy balance " << result.summary.energy_balance << ", "
            << result.summary.wall_seconds << " s\n  " << (folder / "history.csv").string() << "\n";
  io::print_warnings(result.warnings);
  if (!result.ok()) std::cerr << "error: " << result.message << "\n";
  if (arguments.plots) {
    const fpz::Parameters& p = test.parameters;
    plot_test(io::parse_csv(to_csv(result.history), "history.csv"),
              {test.name, folder, YieldSurface{p.tensile_strength, p.cohesion, p.friction_angle_deg}, arguments.force});
  }
  return result.ok();
}

int run(const RunArguments& arguments) {
  const PathFile paths = read_path_file(arguments.file);
  const auto folders = test_folders(paths, arguments.out);
  for (const fs::path& folder : folders) {  // before the work, not after it
    io::require_absent({folder / "history.csv", folder / "summary.json"}, arguments.force);
    if (arguments.plots) io::require_absent(picture_files(folder, true), arguments.force);
  }
  bool ok = true;
  for (std::size_t k = 0; k < paths.tests.size(); ++k) ok = run_one(paths.tests[k], folders[k], arguments) && ok;
  return ok ? 0 : 1;
}

int plot(const std::string& what, bool force) {
  const fs::path file = fs::is_directory(what) ? fs::path(what) / "history.csv" : fs::path(what);
  const io::Table table = io::read_csv(file);
  PlotRequest request;
  request.folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  request.force = force;
  read_plot_facts(request.folder / "summary.json", request);
  if (request.title.empty()) request.title = file.stem().string();
  if (!request.surface) std::cerr << "note: no summary.json next to the history, so the yield surface is not drawn\n";
  io::make_writable_folder(request.folder);
  plot_test(table, request);
  return 0;
}

int check(const std::string& file, const TangentCheckOptions& options) {
  bool ok = true;
  for (const Test& test : read_path_file(file).tests) {
    const TangentCheck result = check_tangent(test, options);
    std::cout << test.name << ": " << result.report(options);
    ok = ok && result.ok();
  }
  return ok ? 0 : 1;
}

/// A reference file and what a person says of its notation, words or characters; empty: found in the file.
struct Reference {
  std::string file, separator, decimal;

  [[nodiscard]] io::Table read() const {
    io::CsvOptions notation;
    if (!separator.empty()) notation.separator = io::csv_separator(separator);
    if (!decimal.empty()) notation.decimal = io::csv_decimal(decimal);
    return io::read_csv(file, notation);
  }
};

int compare(const std::string& history, const Reference& reference, const CompareOptions& options) {
  const Comparison result = compare_histories(io::read_csv(history), reference.read(), options);
  std::cout << result.report();
  return result.ok() ? 0 : 1;
}

int replay_capture(const std::string& file) {
  const Replay result = replay(file);
  std::cout << result.text;
  return result.ok() ? 0 : 1;
}

std::string column_help() {
  std::string text = "Columns of history.csv (SI units, tension positive, tensor shear strains):\n";
  for (const Column& c : columns()) {
    std::string name(c.name);
    name.resize(20, ' ');
    std::string unit(c.unit);
    unit.resize(7, ' ');
    text.append("  ").append(name).append(unit).append(c.meaning).append("\n");
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Runs element tests of the mixed-mode fracture model along loading paths."};
  app.set_version_flag("--version", FPZ_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  fpz-driver run data/paths/four_stage.json -o out/four_stage\n"
      "  fpz-driver plot out/four_stage --force\n"
      "  fpz-driver check data/paths/four_stage.json --every 20\n"
      "  fpz-driver compare out/four_stage/history.csv data/reference/four_stage.csv --stress-tolerance 1e-7\n"
      "fpz-driver COMMAND --help tells more.\n"
      "Exit status: 0 success; 1 a run, check or comparison failed; 2 bad usage or input, or unwritable files.");

  RunArguments run_arguments;
  CLI::App* run_command =
      app.add_subcommand("run", "Run the tests of a path file; write history.csv, summary.json and pictures");
  run_command->add_option("PATH.json", run_arguments.file, "path file")->required();
  run_command->add_option("-o,--out", run_arguments.out, "output folder; several tests get a sub-folder each")
      ->required();
  run_command->add_flag("--force", run_arguments.force, "replace files that exist");
  run_command->add_flag("!--no-plots", run_arguments.plots, "draw no pictures");
  run_command->footer(column_help() + "Example:\n  fpz-driver run data/paths/four_stage.json -o out/four_stage");

  std::string plot_what;
  bool plot_force = false;
  CLI::App* plot_command = app.add_subcommand("plot", "Draw the pictures of a finished run again");
  plot_command->add_option("OUTDIR|history.csv", plot_what, "folder of a run, or its history.csv")->required();
  plot_command->add_flag("--force", plot_force, "replace pictures that exist");
  plot_command->footer("Example:\n  fpz-driver plot out/four_stage --force");

  std::string check_file;
  TangentCheckOptions check_options;
  CLI::App* check_command =
      app.add_subcommand("check", "Compare the tangent along a path with differences of the update");
  check_command->add_option("PATH.json", check_file, "path file")->required();
  check_command->add_option("--tolerance", check_options.tolerance, "on the relative Frobenius norm")
      ->capture_default_str();
  check_command->add_option("--every", check_options.every, "check every so many increments")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  check_command->footer("Example:\n  fpz-driver check data/paths/four_stage.json --every 20");

  std::string history;
  Reference reference;
  CompareOptions compare_options;
  CLI::App* compare_command = app.add_subcommand("compare", "Compare a history with a reference CSV");
  compare_command->add_option("HISTORY.csv", history, "history to judge")->required();
  compare_command->add_option("REFERENCE.csv", reference.file, "with the columns of a history, or T,sxx,...,us2")
      ->required();
  const auto known = [](auto parse, const std::string& words) {
    return [parse, words](const std::string& text) {
      return parse(text) ? std::string() : "'" + text + "' is not known; it must be " + words + " or the character";
    };
  };
  compare_command->add_option("--separator", reference.separator, "of the reference; found in it without")
      ->check(known(io::csv_separator, fpz::all_words<io::CsvSeparator>()));
  compare_command->add_option("--decimal", reference.decimal, "mark of the reference; found in it without")
      ->check(known(io::csv_decimal, fpz::all_words<io::DecimalMark>()));
  compare_command->add_option("--stress-tolerance", compare_options.stress_tolerance, "relative to the stress scale")
      ->capture_default_str();
  compare_command->add_option("--stress-scale", compare_options.stress_scale, "Pa; 0: largest stress in the reference")
      ->capture_default_str();
  compare_command->add_option("--damage-tolerance", compare_options.damage_tolerance, "absolute")
      ->capture_default_str();
  compare_command
      ->add_option("--jump-tolerance", compare_options.jump_tolerance, "relative to the largest jump in the reference")
      ->capture_default_str();
  compare_command
      ->add_option("--strain-tolerance", compare_options.strain_tolerance,
                   "relative to the largest strain in the reference")
      ->capture_default_str();
  compare_command->footer(
      "Rows are matched by time; where the history has no equal time it is interpolated, and that is said. Every known "
      "column of the\n"
      "reference is compared. A missing column or a NaN is a failure.\n"
      "Example:\n  fpz-driver compare out/four_stage/history.csv data/reference/four_stage.csv --stress-tolerance "
      "1e-7");

  std::string capture;
  CLI::App* replay_command =
      app.add_subcommand("replay", "Repeat one captured update; with the other integrators for comparison");
  replay_command->add_option("CAPTURE.json", capture, "capture written by the library")->required();
  replay_command->footer("Exit status 1 when the update fails again.\nExample:\n  fpz-driver replay failed_point.json");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  if (*run_command) return run(run_arguments);
  if (*plot_command) return plot(plot_what, plot_force);
  if (*check_command) return check(check_file, check_options);
  if (*replay_command) return replay_capture(capture);
  return compare(history, reference, compare_options);
} catch (const std::exception& e) {
  std::cerr << "fpz-driver: " << e.what() << "\n";
  return 2;
}
