// Pictures of a sweep.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fpz/io/csv.hpp"
#include "fpz/io/gnuplot.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/specimen/run.hpp"
#include "fpz/specimen/sweep.hpp"
#include "picture_parts.hpp"

namespace fpz::specimen {
namespace {

namespace fs = std::filesystem;
using namespace detail;
using io::Panel;
using io::Picture;
using io::Series;

constexpr const char* colours[] = {"#1F5FA8", "#C0392B", "#2E8B57", "#D68910", "#8E44AD", "#16A0A0"};
constexpr int marks[] = {7, 5, 9, 13, 11, 15};

/// How a column of sweep.csv is drawn.
struct Axis {
  const char* column;
  const char* title;
  double scale;
};
constexpr Axis axes[] = {{"peak_load", "peak load, N", 1.0},
                         {"deflection_at_peak", "deflection at the peak, µm", 1e6},
                         {"stiffness", "stiffness, N/µm", 1e-6},
                         {"fracture_energy_ratio", "dissipated energy over crack area times G", 1.0},
                         {"crack_area", "crack area, mm²", 1e6},
                         {"energy_balance_error", "error of the energy balance over external work", 1.0},
                         {"kinetic_over_internal", "kinetic over internal energy before the peak", 1.0},
                         {"load_support_imbalance", "difference of load and supports over the peak", 1.0},
                         {"energy_external", "external work, mJ", 1e3},
                         {"energy_fracture", "energy dissipated by fracture, mJ", 1e3},
                         {"K_I", "K_I, MPa √m", 1e-6},
                         {"K_II", "K_{II}, MPa √m", 1e-6}};

Axis axis_of(const std::string& column) {
  for (const Axis& a : axes) {
    if (column == a.column) return a;
  }
  return {column.c_str(), column.c_str(), 1.0};
}

std::string parameter_title(const Sweep& sweep) {
  return io::gnuplot_plain(sweep.parameter) + (sweep.unit.empty() ? "" : ", " + io::gnuplot_plain(sweep.unit));
}

std::size_t figure_index(const std::string& column) {
  const auto& names = figure_names();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
}

bool has_result(const SweepRow& row) { return row.status == RunStatus::finished; }

/// Number of values of the parameter.
std::size_t values_of(const Sweep& sweep) { return sweep.runs.size() / sweep.series.size(); }

/// Values that are no numbers are drawn at 1, 2, ... with their labels.
bool has_numbers(const Sweep& sweep) {
  return std::none_of(sweep.runs.begin(), sweep.runs.end(), [](const SweepRun& r) { return std::isnan(r.value); });
}

std::string label_tics(const Sweep& sweep) {
  std::string tics;
  for (std::size_t k = 0; k < values_of(sweep); ++k) {
    tics +=
        (k > 0 ? ", " : "") + io::gnuplot_quoted(io::gnuplot_plain(sweep.runs[k].label)) + " " + std::to_string(k + 1);
  }
  return "set xtics (" + tics + ")";
}

Picture column_picture(const Sweep& sweep, const std::vector<SweepRow>& rows, const SweepPicture& what) {
  const bool over_parameter = what.x == "value";
  const bool numbers = has_numbers(sweep);
  const Axis x = axis_of(what.x), y = axis_of(what.y);
  const std::size_t kx = figure_index(what.x), ky = figure_index(what.y);
  Panel panel;
  panel.title = io::gnuplot_plain(sweep.name);
  panel.x_label = over_parameter ? parameter_title(sweep) : x.title;
  panel.y_label = y.title;
  for (std::size_t s = 0; s < sweep.series.size(); ++s) {
    const std::string style =
        std::string("linespoints lw 2 ps 0.9 pt ") + std::to_string(marks[s % 6]) + " lc rgb '" + colours[s % 6] + "'";
    panel.series.push_back({io::gnuplot_plain(sweep.series[s]), style, {}});
  }
  for (std::size_t k = 0; k < sweep.runs.size(); ++k) {
    if (!has_result(rows[k])) continue;
    const bool position = over_parameter && !numbers;
    const double px = position ? static_cast<double>(k % values_of(sweep) + 1) : x.scale * rows[k].figures[kx];
    const double py = y.scale * rows[k].figures[ky];
    if (std::isfinite(px) && std::isfinite(py)) panel.series[sweep.runs[k].series].points.emplace_back(px, py);
  }
  for (std::size_t r = 0; r < sweep.references.size(); ++r) {
    const SweepReference& reference = sweep.references[r];
    if (reference.x != what.x || reference.y != what.y) continue;
    const std::string colour = " lc rgb '#202020'";
    Series s{io::gnuplot_plain(reference.name),
             reference.points ? "points pt " + std::to_string(4 + 2 * r) + " ps 1.1" + colour
                              : "lines lw 1.5 dt " + std::to_string(r + 2) + colour,
             {}};
    for (const auto& [px, py] : reference.values) s.points.emplace_back(x.scale * px, y.scale * py);
    panel.series.push_back(std::move(s));
  }
  if (over_parameter && !numbers) {
    panel.before = label_tics(sweep);
    panel.x = {0.5, static_cast<double>(values_of(sweep)) + 0.5};
  }
  return with_legend(over_parameter ? what.y : what.y + "_over_" + what.x, panel, 1);
}

/// Load over deflection of all runs of a series, coloured from the first to the last value.
Picture curve_picture(const Sweep& sweep, const std::vector<SweepRow>& rows, const fs::path& folder, std::size_t s) {
  Panel panel;
  panel.title = io::gnuplot_plain(sweep.name + ", " + sweep.series[s]);
  panel.x_label = "deflection, µm";
  panel.y_label = "load, N";
  const std::size_t n = values_of(sweep);
  for (std::size_t k = s * n; k < (s + 1) * n; ++k) {
    if (!has_result(rows[k])) continue;
    const io::Table t = io::read_csv(RunFiles(folder / sweep.runs[k].folder).history);
    const double hue = n > 1 ? 0.68 * (1.0 - static_cast<double>(k - s * n) / static_cast<double>(n - 1)) : 0.6;
    char colour[80];
    std::snprintf(colour, sizeof colour, "lines lw 1.6 lc rgb hsv2rgb(%.3f,0.85,0.8)", hue);
    Series curve{io::gnuplot_plain(sweep.runs[k].label + (sweep.unit.empty() ? "" : " " + sweep.unit)), colour, {}};
    const auto &u = t.at("deflection"), &load = t.at("load");
    for (std::size_t r = 0; r < t.rows(); ++r) curve.points.emplace_back(1e6 * u[r], load[r]);
    panel.series.push_back(std::move(curve));
  }
  return with_legend("load_deflection_" + sweep.runs[s * n].folder.parent_path().string(), panel, 5);
}

/// Damage at the end of every run of a series.
Picture map_montage(const Sweep& sweep, const std::vector<SweepRow>& rows, const fs::path& folder, std::size_t s) {
  std::vector<ParticleMap> maps;
  const std::size_t n = values_of(sweep);
  double size = 0.0;
  for (std::size_t k = s * n; k < (s + 1) * n; ++k) {
    if (!has_result(rows[k])) continue;
    const SweepRun& run = sweep.runs[k];
    const std::vector<Frame> frames = read_pvd(folder / run.folder / "frames.pvd");
    if (frames.empty()) continue;
    maps.push_back(damage_map(read_vtk(folder / run.folder / frames.back().file),
                              io::gnuplot_plain(run.label + (sweep.unit.empty() ? "" : " " + sweep.unit))));
    size = std::max(size, run.scene.spacing);
  }
  return map_picture("damage_" + sweep.runs[s * n].folder.parent_path().string(), maps, damage_classes(), size, 7);
}

bool any_result(const Sweep& sweep, const std::vector<SweepRow>& rows, std::size_t s) {
  const std::size_t n = values_of(sweep);
  return std::any_of(rows.begin() + static_cast<std::ptrdiff_t>(s * n),
                     rows.begin() + static_cast<std::ptrdiff_t>((s + 1) * n), has_result);
}

}  // namespace

PictureOutcome draw_sweep(const Sweep& sweep, const std::vector<SweepRow>& rows, const fs::path& folder) {
  PictureOutcome outcome;
  if (gnuplot_missing(outcome)) return outcome;
  std::vector<Picture> pictures;
  for (const SweepPicture& p : sweep.pictures) {
    if (p.kind == SweepPicture::Kind::columns) {
      pictures.push_back(column_picture(sweep, rows, p));
      continue;
    }
    for (std::size_t s = 0; s < sweep.series.size(); ++s) {
      if (!any_result(sweep, rows, s)) continue;
      const bool curves = p.kind == SweepPicture::Kind::curves;
      pictures.push_back(curves ? curve_picture(sweep, rows, folder, s) : map_montage(sweep, rows, folder, s));
    }
  }
  write_pictures(pictures, folder, true, outcome);
  return outcome;
}

}  // namespace fpz::specimen
