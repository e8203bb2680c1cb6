// fpz-sph-report RESULTS -o DOCS: writes DOCS/validation.md, DOCS/validation.csv and DOCS/images/validation-*.png from
// the folders of the validation sweeps (scripts/run_validation.sh). Exit status: 0 success, 2 bad usage or files.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>

#include "fpz/io/markdown.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/problems.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace {

namespace fs = std::filesystem;
using namespace fpz::report;

std::string report(const Results& results, const Gallery& gallery) {
  std::ostringstream out;
  out << "# Validation of the particle method\n\nWritten by `scripts/run_validation.sh` from the runs of the sweeps in "
         "`data/sweeps`; every number and every verdict below is\ncomputed from their output "
         "([validation.csv](validation.csv) has the main figures of all of them). Forces are for the whole thickness. "
         "Warnings are those\nthat the runs give themselves ([scenes.md](scenes.md)).\n\n";
  write_beam(out, results, gallery);
  out << "\n";
  write_semicircular(out, results, gallery);
  out << "\n";
  write_ring(out, results, gallery);
  out << "\n";
  write_method(out, results, gallery);
  out << "\n";
  write_cost(out, results, gallery);
  out << "\n";
  write_solvers(out, results, gallery);
  return out.str();
}

/// The main figures of all runs, SI.
std::string table(const Results& results) {
  constexpr const char* figures[] = {"peak_load",
                                     "deflection_at_peak",
                                     "stiffness",
                                     "fracture_energy_ratio",
                                     "crack_area",
                                     "energies/external",
                                     "energies/fracture",
                                     "energy_balance_error",
                                     "kinetic_over_internal/before_peak",
                                     "load_support_imbalance",
                                     "toughness_K_I",
                                     "toughness_K_II",
                                     "particles",
                                     "steps",
                                     "stepping_seconds",
                                     "particle_steps_per_second"};
  std::string text = "sweep,series,run,finished";
  for (const std::string name : figures) text += "," + name;
  text += ",warnings\n";
  for (const SweepRuns* sweep : results.all()) {
    for (const Run& run : sweep->runs) {
      text += run.sweep + "," + run.series + "," + run.label + "," + (run.finished() ? "1" : "0");
      for (const char* name : figures) {
        const double x = run.figure(name);
        char cell[32] = "nan";
        if (std::isfinite(x)) std::snprintf(cell, sizeof cell, "%.6g", x);
        text += std::string(",") + cell;
      }
      text += "," + std::to_string(run.warnings()) + "\n";
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"The validation report of the particle method from the folders of its runs."};
  std::string folder, docs;
  app.add_option("RESULTS", folder, "folder with one folder per sweep")->required();
  app.add_option("-o,--out", docs, "where validation.md, validation.csv and images/ go")->required();
  app.footer("Example:\n  fpz-sph-report build/validation -o docs");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  const Results results = load_results(folder);
  const Gallery gallery{fs::path(folder) / "pictures", fs::path(docs) / "images"};
  fpz::io::make_writable_folder(gallery.work);
  fpz::io::make_writable_folder(gallery.images);
  fpz::io::write_text(fs::path(docs) / "validation.md", fpz::io::wrap_prose(report(results, gallery)), true);
  fpz::io::write_text(fs::path(docs) / "validation.csv", table(results), true);
  std::cout << (fs::path(docs) / "validation.md").string() << "\n";
  return 0;
} catch (const std::exception& e) {
  std::cerr << "fpz-sph-report: " << e.what() << "\n";
  return 2;
}
