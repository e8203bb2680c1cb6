#include "fpz/specimen/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "convergence.hpp"
#include "fpz/io/csv.hpp"
#include "fpz/io/gnuplot.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"
#include "fpz/specimen/run.hpp"
#include "interface_map.hpp"
#include "picture_parts.hpp"

namespace fpz::specimen {
namespace {

namespace fs = std::filesystem;
using namespace detail;
using io::Panel;
using io::Picture;
using io::Series;

Series curve(const io::Table& t, const char* x, double x_scale, const std::string& y, double y_scale,
             const std::string& title, const std::string& style) {
  Series s{title, style, {}};
  const auto& xs = t.at(x);
  const auto& ys = t.at(y);
  for (std::size_t k = 0; k < xs.size(); ++k) {
    if (std::isfinite(ys[k])) s.points.emplace_back(x_scale * xs[k], y_scale * ys[k]);
  }
  return s;
}

/// The darker the later of so many.
std::string grey_of(std::size_t n, std::size_t count) {
  const int shade = 210 - static_cast<int>(110.0 * static_cast<double>(n) / static_cast<double>(count));
  char colour[16];
  std::snprintf(colour, sizeof colour, "#%02X%02X%02X", shade, shade, shade);
  return line(colour);
}

void drop_empty(std::vector<Series>& series) {
  std::erase_if(series, [](const Series& s) { return s.points.empty(); });
}

Picture load_deflection(const io::Table& t, const std::string& title) {
  Panel p;
  p.title = title;
  p.x_label = "deflection, µm";
  p.y_label = "force, kN";
  p.series.push_back(curve(t, "deflection", 1e6, "support", 1e-3, "supports", line(grey, "dt 2")));
  p.series.push_back(curve(t, "deflection", 1e6, "load", 1e-3, "load", line(blue)));
  drop_empty(p.series);
  return with_legend("load_deflection", p, 2);
}

/// The runs of a solver that repeats them, the last one in full colour.
Picture convergence(const fs::path& folder, const io::Table& runs, const std::string& title) {
  Panel p;
  p.title = title;
  p.x_label = "deflection, µm";
  p.y_label = "load, kN";
  const std::size_t count = runs.at("pace").size();
  for (std::size_t n = 0; n < count; ++n) {
    const io::Table t = io::read_csv(history_of_run(folder, n));
    const std::string name = "pace " + text_of(runs.at("pace")[n]);
    p.series.push_back(
        curve(t, "deflection", 1e6, "load", 1e-3, name, n + 1 == count ? line(blue) : grey_of(n, count)));
  }
  drop_empty(p.series);
  return with_legend("convergence", p, 4);
}

Picture energies(const io::Table& t, const std::string& title) {
  Panel p;
  p.title = title;
  p.x_label = "deflection, µm";
  p.y_label = "energy, mJ";
  const std::pair<const char*, std::string> parts[] = {{"external", line("#202020")}, {"elastic", line(blue)},
                                                       {"fracture", line(red)},       {"kinetic", line(green)},
                                                       {"viscous", line("#8E44AD")},  {"damping", line("#D68910")},
                                                       {"error", line(grey, "dt 2")}};
  for (const auto& [name, style] : parts) {
    p.series.push_back(curve(t, "deflection", 1e6, "energy_" + std::string(name), 1e3, name, style));
    const auto& points = p.series.back().points;
    const bool zero = std::all_of(points.begin(), points.end(), [](const auto& q) { return q.second == 0.0; });
    if (zero) p.series.pop_back();  // viscosity or damping that is off
  }
  return with_legend("energies", p, 7);
}

/// Row at which the load is a given part of its peak: before the peak, or (negative) after it; 0: the last one.
std::size_t row_at(const io::Table& t, double part) {
  const auto& load = t.at("load");
  if (part == 0.0) return load.size() - 1;
  const auto peak = static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin());
  if (part == 1.0) return peak;
  if (part > 0.0) {
    for (std::size_t k = 0; k < peak; ++k) {
      if (load[k] >= part * load[peak]) return k;
    }
    return peak;
  }
  for (std::size_t k = peak; k < load.size(); ++k) {
    if (load[k] <= -part * load[peak]) return k;
  }
  return load.size() - 1;
}

/// Frames nearest to the wanted moments, each once.
std::vector<ParticleMap> damage_maps(const fs::path& folder, const std::vector<Frame>& frames, const io::Table& t,
                                     const std::vector<double>& parts) {
  std::vector<ParticleMap> maps;
  std::vector<std::size_t> used;
  for (const double part : parts) {
    const std::size_t row = row_at(t, part);
    const double time = t.at("time")[row];
    const auto closer = [&](const Frame& a, const Frame& b) {
      return std::abs(a.time - time) < std::abs(b.time - time);
    };
    const auto best = static_cast<std::size_t>(std::min_element(frames.begin(), frames.end(), closer) - frames.begin());
    if (std::find(used.begin(), used.end(), best) != used.end()) continue;
    used.push_back(best);
    const PointCloud cloud = read_vtk(folder / frames[best].file);
    // The row of the frame, not the wanted one: the title says what is drawn.
    const auto& times = t.at("time");
    const auto at =
        std::min(static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), cloud.time) - times.begin()),
                 times.size() - 1);
    maps.push_back(damage_map(cloud, "deflection " + text_of(1e6 * t.at("deflection")[at]) + " µm, load " +
                                         text_of(1e-3 * t.at("load")[at]) + " kN"));
  }
  return maps;
}

Picture velocity_map(const PointCloud& cloud, double size) {
  const auto& v = field(cloud, "velocity").values;
  double largest = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) largest = std::max(largest, std::abs(v[3 * i]));
  // The bulk of the specimen sets the scale, not one fragment.
  std::vector<double> sizes;
  for (std::size_t i = 0; i < cloud.size(); ++i) sizes.push_back(std::abs(v[3 * i]));
  std::sort(sizes.begin(), sizes.end());
  const double scale = std::max(sizes[sizes.size() * 98 / 100], 1e-300);
  const char* colours[] = {"#08306B", "#2B6CB0", "#7FB2DD", "#CFE3F2", "#E8E8E4",
                           "#F6D5C3", "#EE9A78", "#D1495B", "#7A0F22"};
  std::vector<ColourClass> classes;
  for (int k = -4; k <= 4; ++k) {
    classes.push_back({text_of(1e3 * scale * k / 4.0) + (k == 4 ? " mm/s" : ""), colours[k + 4]});
  }
  ParticleMap map{"horizontal velocity, largest " + text_of(1e3 * largest) + " mm/s", positions(cloud), {}, {}};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    map.colour.push_back(static_cast<std::size_t>(std::lround(std::clamp(v[3 * i] / scale, -1.0, 1.0) * 4.0) + 4));
  }
  return map_picture("velocity", {map}, classes, size, 9);
}

void require_free(const std::vector<Picture>& pictures, const fs::path& folder, bool force) {
  std::vector<fs::path> files;
  for (const Picture& p : pictures) {
    for (const fs::path& f : p.files(folder)) files.push_back(f);
  }
  io::require_absent(files, force);
}

Series outline(const std::vector<Point>& points, const std::string& style) {
  Series s{"", style, {}};
  for (const Point& p : points) s.points.emplace_back(1e3 * p[0], 1e3 * p[1]);
  return s;
}

}  // namespace

PictureOutcome draw_run(const fs::path& folder, bool force) {
  PictureOutcome outcome;
  const RunFiles files(folder);
  const io::Table t = io::read_csv(files.history);
  const Scene scene = read_scene(files.scene);
  const std::vector<Frame> frames = read_pvd(files.collection);
  if (gnuplot_missing(outcome)) return outcome;
  std::vector<Picture> pictures = {load_deflection(t, io::gnuplot_plain(scene.name)),
                                   energies(t, io::gnuplot_plain(scene.name))};
  const fs::path runs = convergence_table(folder);
  if (fs::exists(runs)) {
    pictures.push_back(convergence(folder, io::read_csv(runs), io::gnuplot_plain(scene.name)));
  }
  if (!frames.empty()) {
    const auto maps = damage_maps(folder, frames, t, scene.output.picture_loads);
    if (!maps.empty()) pictures.push_back(map_picture("damage", maps, damage_classes(), scene.spacing, 7));
    pictures.push_back(velocity_map(read_vtk(folder / frames.back().file), scene.spacing));
  }
  require_free(pictures, folder, force);
  write_pictures(pictures, folder, force, outcome);
  return outcome;
}

PictureOutcome draw_scene(const Scene& scene, const Specimen& specimen, const fs::path& folder, bool force) {
  PictureOutcome outcome;
  if (gnuplot_missing(outcome)) return outcome;
  const char* colours[] = {"#C0392B", "#1F5FA8", "#2E8B57", "#D68910", "#8E44AD", "#16A0A0"};
  const char* pale[] = {"#E8D3A8", "#B9CCE0", "#C4DDBF", "#DDC3DA", "#F0C4B8", "#B8DAD6"};
  std::vector<ColourClass> classes = {{"specimen", "#D8D8D2"}};
  for (std::size_t k = 0; k < scene.regions.size(); ++k) {
    classes.push_back({io::gnuplot_plain(scene.regions[k].name), pale[k % 6]});
  }
  for (std::size_t b = 0; b < scene.boundaries.size(); ++b)
    classes.push_back({io::gnuplot_plain(scene.boundaries[b].name), colours[b % 6]});
  classes.push_back({"gauges", "#202020"});
  const sph::Arrangement<2>& a = specimen.setup.arrangement;
  ParticleMap map{io::gnuplot_plain(scene.name) + ": " + std::to_string(a.size()) + " particles", a.position, {}, {}};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool in_body = a.group[i] == sph::Arrangement<2>::specimen;
    map.colour.push_back(in_body ? specimen.setup.materials.of(i)
                                 : scene.regions.size() + 1 + static_cast<std::size_t>(a.group[i]));
  }
  for (const auto& points : outlines(scene.body)) map.lines.push_back(outline(points, "lines lw 1.5 lc rgb '#202020'"));
  for (const Interface& f : scene.interfaces) {
    for (const auto& points : lines_in_body(f, scene.body, 0.5 * scene.spacing)) {
      map.lines.push_back(outline(points, "lines lw 2 lc rgb '#8E44AD'"));
    }
  }
  std::vector<Point> gauges;
  for (const auto& [name, g] : specimen.gauges) {
    for (const auto& ids : g.sites) {
      for (const std::size_t id : ids) gauges.push_back(a.position[id]);
    }
  }
  map.lines.push_back(outline(gauges, "points pt 7 ps 0.5 lc rgb '#202020'"));
  const std::vector<Picture> pictures = {map_picture("scene", {map}, classes, 0.8 * scene.spacing, 8)};
  require_free(pictures, folder, force);
  write_pictures(pictures, folder, force, outcome);
  return outcome;
}

}  // namespace fpz::specimen
