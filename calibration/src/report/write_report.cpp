#include <sstream>

#include "fpz/calibration/report.hpp"
#include "fpz/driver/run.hpp"
#include "fpz/io/gnuplot.hpp"
#include "fpz/io/html.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/problems.hpp"
#include "pictures.hpp"

namespace fpz::calibration {
namespace fs = std::filesystem;
namespace {

std::string curve_name(const DataSet& set) { return "curve_" + driver::folder_name(set.name) + ".csv"; }

}  // namespace

std::string curve_csv(const Calibration& all, const Comparison& c) {
  const DataSet& set = all.specification.data[c.data_set];
  std::ostringstream out;
  out << "abscissa,measured,deviation,fitted,band_low,band_high,residual\n";
  for (Eigen::Index k = 0; k < set.measured.size(); ++k) {
    out << io::exact(set.abscissa[k]) << ',' << io::exact(set.measured[k]);
    if (c.ok()) {
      for (const double x :
           {c.deviation[k], c.predicted[k], c.predicted[k] - c.band[k], c.predicted[k] + c.band[k], c.residuals[k]}) {
        out << ',' << io::exact(x);
      }
    } else {
      out << ',' << io::exact(set.deviation[k]) << ",,,,";
    }
    out << '\n';
  }
  return std::move(out).str();
}

std::vector<fs::path> report_files(const Specification& spec, const fs::path& folder, bool pictures) {
  std::vector<fs::path> files;
  for (const char* name : {"material.json", "material_unusable.json", "report.json", "report.md", "report.html"}) {
    files.push_back(folder / name);
  }
  for (const DataSet& set : spec.data) files.push_back(folder / curve_name(set));
  if (!pictures) return files;
  for (const std::string& name : detail::picture_names(spec)) {
    for (const char* ending : {".png", ".svg"}) files.push_back(folder / (name + ending));
  }
  return files;
}

ReportFiles write_report(const Calibration& all, const ReportOptions& options) {
  io::make_writable_folder(options.folder);
  io::require_absent(report_files(all.specification, options.folder, options.pictures), options.force);
  ReportFiles written;
  const auto text = [&](const std::string& name, const std::string& content) {
    if (options.between) options.between();
    io::write_text(options.folder / name, content, options.force);
    written.files.push_back(options.folder / name);
  };
  // What an earlier fit left here would be taken for the result of this one.
  std::error_code ignored;
  for (const fs::path& file : report_files(all.specification, options.folder, options.force)) {
    if (options.force) fs::remove(file, ignored);
  }

  const bool drawn = options.pictures && io::gnuplot_is_installed();
  text(all.result.usable() ? "material.json" : "material_unusable.json", material_json(all));
  text("report.json", report_json(all));
  text("report.md", report_markdown(all, drawn));
  for (const Comparison& c : all.comparisons) {
    text(curve_name(all.specification.data[c.data_set]), curve_csv(all, c));
  }
  if (options.pictures && !drawn) {
    written.warnings.emplace_back("no pictures: gnuplot is not installed (apt-get install gnuplot-nox)");
  }
  for (const io::Picture& picture : drawn ? detail::draw_pictures(all) : std::vector<io::Picture>()) {
    if (options.between) options.between();
    try {
      picture.write(options.folder, options.force);
      for (const fs::path& file : picture.files(options.folder)) written.files.push_back(file);
    } catch (const io::OutputError& e) {
      written.warnings.emplace_back(e.what());
    }
  }
  text("report.html", io::html_page(all.specification.name, report_markdown(all, drawn), options.folder));
  return written;
}

}  // namespace fpz::calibration
