#include "pictures.hpp"

#include <algorithm>
#include <cmath>

#include "fpz/io/gnuplot.hpp"
#include "fpz/io/picture.hpp"

namespace fpz::bench {
namespace {

io::Panel log_log() {
  io::Panel p;
  p.log_x = p.log_y = true;
  return p;
}

using Points = std::vector<std::pair<double, double>>;

constexpr const char* vermilion = "#D55E00";
constexpr const char* blue = "#0072B2";
constexpr const char* green = "#009E73";
constexpr const char* purple = "#CC79A7";
constexpr const char* orange = "#E69F00";
constexpr const char* black = "#202020";

std::string marks(const char* colour, int point, double size = 0.9, double width = 1.8, int dash = 1) {
  return "linespoints lw " + io::gnuplot_number(width) + " dt " + std::to_string(dash) + " pt " +
         std::to_string(point) + " ps " + io::gnuplot_number(size) + " lc rgb '" + colour + "'";
}
std::string line(const char* colour, double width, int dash) {
  return "lines lw " + io::gnuplot_number(width) + " dt " + std::to_string(dash) + " lc rgb '" + colour + "'";
}

constexpr double floor_of_plots = 1e-14;

template <class Keep, class X, class Y>
Points pick(const std::vector<PathRun>& runs, const Keep& keep, const X& x, const Y& y, bool sorted) {
  Points p;
  for (const PathRun& r : runs) {
    if (r.error.ok() && keep(r)) p.emplace_back(x(r), std::max(y(r), floor_of_plots));
  }
  if (sorted) std::sort(p.begin(), p.end());
  return p;
}

}  // namespace

void draw_increment(const std::vector<PathStudy>& studies, const std::filesystem::path& folder) {
  io::Picture picture("speed-increment", 1200, 760);
  const auto places = io::grid(2, static_cast<int>(studies.size()), {0.075, 0.985, 0.175, 0.94}, 0.035, 0.085);
  std::vector<io::Series> legend;
  for (int row = 0; row < 2; ++row) {
    for (std::size_t i = 0; i < studies.size(); ++i) {
      const auto& runs = studies[i].runs;
      const auto error = [row](const PathRun& r) { return row == 0 ? r.error.stress : r.error.damage; };
      const auto size = [](const PathRun& r) { return r.increment; };
      io::Panel p = log_log();
      p.title = row == 0 ? studies[i].title : "";
      if (row == 1) p.x_label = "Strain increment";
      if (i == 0) p.y_label = row == 0 ? "Largest stress error / {/Symbol s}_{t0}" : "Largest error of D";
      p.x = {2e-8, 2e-3};
      p.y = {1e-14, 1e0};
      const auto of = [&](Method m, double tolerance) {
        return pick(
            runs,
            [=](const PathRun& r) {
              return r.method == m && r.increment > 0.0 && std::abs(r.tolerance / tolerance - 1.0) < 1e-6;
            },
            size, error, true);
      };
      p.series = {{"paper, tolerance 1e-4", marks(vermilion, 7), of(Method::paper, 1e-4)},
                  {"paper, tolerance 1e-7", marks(orange, 6, 1.2), of(Method::paper, 1e-7)},
                  {"implicit", marks(blue, 5), of(Method::implicit, 1e-4)},
                  {"accurate, tolerance 1e-4", marks(green, 9, 1.0), of(Method::accurate, 1e-4)},
                  {"accurate, tolerance 1e-6", marks(purple, 11, 1.0), of(Method::accurate, 1e-6)},
                  {"accurate, tolerance 1e-8", marks(black, 13, 1.0), of(Method::accurate, 1e-8)}};
      io::Series failed{"paper: no convergence", "points pt 2 ps 1.1 lw 2 lc rgb '#D55E00'", {}};
      for (const PathRun& r : runs) {
        if (r.method == Method::paper && !r.error.ok() && r.tolerance > 5e-5)
          failed.points.emplace_back(r.increment, 2e-1);
      }
      p.series.push_back(failed);
      p.before = "set arrow from 3e-7, graph 0 to 3e-7, graph 1 nohead dt 3 lw 1.2 lc rgb '#808080'";
      if (i == 0) p.before += "\nset label \"the paper's increment\" at 3.6e-7, 2e-6 font ',11' tc rgb '#606060'";
      if (i != 0) p.before += "\nset format y ''";
      picture.panel(p, places[static_cast<std::size_t>(row) * studies.size() + i]);
      if (legend.empty()) legend = p.series;
    }
  }
  picture.legend(legend, {0.02, 0.98, 0.0, 0.095}, 4);
  picture.write(folder, true);
}

void draw_time(const std::vector<PathStudy>& studies, const std::filesystem::path& folder) {
  io::Picture picture("speed-time", 1240, 860);
  const auto places = io::grid(2, static_cast<int>(studies.size()), {0.075, 0.985, 0.165, 0.945}, 0.035, 0.12);
  std::vector<io::Series> legend;
  for (int row = 0; row < 2; ++row) {
    for (std::size_t i = 0; i < studies.size(); ++i) {
      const auto& runs = studies[i].runs;
      const auto time = [row](const PathRun& r) {
        return row == 0 ? r.seconds : 1e9 * r.seconds / static_cast<double>(r.error.updates);
      };
      const auto error = [](const PathRun& r) { return r.error.worst(); };
      io::Panel p = log_log();
      p.title = row == 0 ? studies[i].title : "";
      p.x_label = row == 0 ? "CPU time of the whole path (s)" : "Mean CPU time per update (ns)";
      if (i == 0) p.y_label = "Largest error (stress/{/Symbol s}_{t0}, D)";
      p.x = row == 0 ? std::pair{1e-6, 3.0} : std::pair{1e1, 1e6};
      p.y = {1e-14, 1e0};
      const auto of = [&](Method m, double low, double high) {
        return pick(
            runs, [=](const PathRun& r) { return r.method == m && r.increment >= low && r.increment <= high; }, time,
            error, false);
      };
      const auto paper = [&](double tolerance) {
        return pick(
            runs,
            [=](const PathRun& r) {
              return r.method == Method::paper && std::abs(r.tolerance / tolerance - 1.0) < 1e-6;
            },
            time, error, false);
      };
      p.series = {{"paper, tolerance 1e-4", marks(vermilion, 7), paper(1e-4)},
                  {"paper, tolerance 1e-7", marks(orange, 6, 1.2), paper(1e-7)},
                  {"implicit, increments 3e-7 to 1e-3", marks(blue, 5), of(Method::implicit, 0, 1)},
                  {"accurate, output every 3e-7", marks(purple, 11, 1.0), of(Method::accurate, 2.9e-7, 3.1e-7)},
                  {"accurate, output every 9e-5", marks(black, 13, 1.0), of(Method::accurate, 8.9e-5, 9.1e-5)},
                  {"accurate, one update per stage", marks(green, 9, 1.0), of(Method::accurate, -1, 0)}};
      if (i != 0) p.before += "set format y ''";
      picture.panel(p, places[static_cast<std::size_t>(row) * studies.size() + i]);
      if (legend.empty()) legend = p.series;
    }
  }
  picture.legend(legend, {0.02, 0.98, 0.0, 0.085}, 3);
  picture.write(folder, true);
}

void draw_tolerance(const std::vector<ToleranceRow>& rows, const std::filesystem::path& folder) {
  io::Picture picture("speed-tolerance", 980, 480);
  io::Panel p = log_log();
  p.x_label = "Requested tolerance";
  p.y_label = "Achieved error (stress/{/Symbol s}_{t0}, D)";
  p.x = {2e-9, 1e-3};
  p.y = {1e-14, 1e-2};
  p.series.push_back({"achieved = requested", line("#808080", 1.5, 2), {{2e-9, 2e-9}, {1e-3, 1e-3}}});
  const char* colours[] = {vermilion, blue, green, purple, orange, black};
  const int points[] = {7, 5, 9, 11, 13, 6};
  std::vector<std::string> paths;
  for (const ToleranceRow& r : rows) {
    if (std::find(paths.begin(), paths.end(), r.path) == paths.end()) paths.push_back(r.path);
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    io::Series s{
        paths[i], "points pt " + std::to_string(points[i % 6]) + " ps 1.0 lw 1.5 lc rgb '" + colours[i % 6] + "'", {}};
    for (const ToleranceRow& r : rows) {
      if (r.path != paths[i]) continue;
      for (const WalkError& e : r.at) {
        if (e.ok())
          s.points.emplace_back(r.tolerance * std::pow(1.22, static_cast<double>(i) - 2.5),
                                std::max(e.worst(), floor_of_plots));
      }
    }
    p.series.push_back(s);
  }
  picture.panel(p, {0.1, 0.63, 0.15, 0.96});
  picture.legend(p.series, {0.65, 0.99, 0.15, 0.96}, 1);
  picture.write(folder, true);
}

void draw_onset(const OnsetStudy& study, const std::filesystem::path& folder) {
  io::Picture picture("speed-onset", 1100, 520);
  const auto places = io::grid(1, 2, {0.085, 0.98, 0.25, 0.93}, 0.095, 0.0);
  std::vector<io::Series> legend;
  for (int k = 0; k < 2; ++k) {
    io::Panel p = log_log();
    p.title = k == 0 ? "Orientation of the crack" : "Stress at onset";
    p.x_label = "CPU time per search (ns)";
    p.y_label = k == 0 ? "Largest error of the angle (degrees)" : "Largest relative error";
    p.x = {10, 1e7};
    p.y = k == 0 ? std::pair{1e-14, 1e2} : std::pair{1e-17, 1e0};
    const auto of = [&](int dim, bool closed) {
      Points points;
      for (const OnsetRow& r : study.rows) {
        if (r.dim == dim && closed == (r.degrees == 0.0)) {
          points.emplace_back(r.nanoseconds,
                              std::max(k == 0 ? r.angle_error_deg : r.stress_error, k == 0 ? 1e-14 : 1e-16));
        }
      }
      return points;
    };
    p.series = {{"scan, 2-D", marks(vermilion, 7), of(2, false)},
                {"scan, 3-D", marks(orange, 5), of(3, false)},
                {"closed form, 2-D", "points pt 13 ps 1.8 lc rgb '#0072B2'", of(2, true)},
                {"closed form, 3-D", "points pt 9 ps 1.8 lc rgb '#009E73'", of(3, true)}};
    for (const OnsetRow& r : study.rows) {
      if (r.degrees == 0.0 || (r.degrees != 0.1 && r.degrees != 1.0 && r.degrees != 10.0)) continue;
      p.before += "set label '" + io::gnuplot_number(r.degrees) + "°' at " + io::gnuplot_number(r.nanoseconds) + "," +
                  io::gnuplot_number(k == 0 ? r.angle_error_deg : r.stress_error) +
                  " offset 0.7,0.6 font ',11' tc rgb '#404040'\n";
    }
    picture.panel(p, places[static_cast<std::size_t>(k)]);
    if (legend.empty()) legend = p.series;
  }
  picture.legend(legend, {0.02, 0.98, 0.0, 0.09}, 4);
  picture.write(folder, true);
}

void draw_maps(const MapStudy& study, const std::filesystem::path& folder) {
  io::Picture picture("speed-isoerror", 1240, 820);
  const auto places = io::grid(2, 3, {0.08, 0.88, 0.09, 0.945}, 0.03, 0.07);
  picture.command(
      "set palette defined (0 '#0B2C5C', 1 '#2166AC', 2 '#67A9CF', 3 '#D1E5F0', 4 '#FDDBC7', 5 '#EF8A62', 6 "
      "'#B2182B')\n"
      "set cbrange [-8:0]\nunset colorbox");
  for (std::size_t i = 0; i < study.maps.size(); ++i) {
    const ErrorMap& m = study.maps[i];
    io::Panel p = log_log();
    p.log_x = p.log_y = false;
    p.x = p.y = {study.low, study.high};
    p.title = std::string(to_string(m.method)) + ", D = " + io::gnuplot_number(std::round(m.damage * 1e6) * 1e-6);
    if (i >= 3) p.x_label = "{/Symbol D}u_n / {/Symbol d}_0";
    if (i % 3 == 0) p.y_label = "{/Symbol D}u_s / {/Symbol d}_0";
    p.before = "set format x " + std::string(i >= 3 ? "'10^{%g}'" : "''") + "\nset format y " +
               (i % 3 == 0 ? "'10^{%g}'" : "''") + "\nset xtics -6,2,-2\nset ytics 2";
    p.series = {{"",
                 "points pt 3 ps 1.4 lw 2 lc rgb 'black'",
                 {{std::log10(study.paper_step[0]), std::log10(study.paper_step[1])}}}};
    if (i + 1 == study.maps.size()) {
      p.before +=
          "\nset colorbox user origin 0.905,0.2 size 0.018,0.65\nset cblabel 'Error of the traction / {/Symbol "
          "s}_{t0}' offset 0.3,0\n"
          "set format cb '10^{%g}'\nset cbtics 1";
    }
    picture.image(p, places[i], study.size, study.low, study.high, m.log10_error, "#9A9A9A", "-6,-4,-2");
  }
  picture.write(folder, true);
}

void draw_newton(const NewtonStudy& study, const std::filesystem::path& folder) {
  io::Picture picture("speed-newton", 1100, 500);
  const auto places = io::grid(1, 2, {0.085, 0.98, 0.145, 0.92}, 0.09, 0.0);
  const char* colours[] = {green, blue, purple, orange, black, vermilion};
  const int points[] = {7, 5, 9, 11, 13, 6};
  for (int k = 0; k < 2; ++k) {
    io::Panel p = log_log();
    p.log_x = false;
    p.title = k == 0 ? "implicit: Newton in (z, a)" : "paper: traction continuity, eq 57-61";
    p.x_label = "Iteration";
    p.y_label = k == 0 ? "Residual / {/Symbol d}_0" : "Residual / |t_{onset}|";
    p.x = k == 0 ? std::pair{-0.3, 12.0} : std::pair{-5.0, 400.0};
    p.y = k == 0 ? std::pair{1e-18, 1e2} : std::pair{1e-13, 1e5};
    const auto& histories = k == 0 ? study.implicit : study.paper;
    std::string key;
    for (std::size_t i = 0; i < histories.size(); ++i) {
      io::Series s{"", k == 0 ? marks(colours[i % 6], points[i % 6], 1.1) : line(colours[i % 6], 2.2, 1), {}};
      for (std::size_t j = 0; j < histories[i].residuals.size(); ++j) {
        s.points.emplace_back(static_cast<double>(j), std::clamp(histories[i].residuals[j], 1e-18, 1e9));
      }
      p.series.push_back(s);
      // Name each curve in a column at the right, in its colour.
      key += "set label '" + histories[i].title +
             (histories[i].converged ? "" : (k == 0 ? " (*)" : ": no convergence")) + "' at graph 0.97, graph " +
             io::gnuplot_number((k == 0 ? 0.68 : 0.95) - 0.058 * static_cast<double>(i)) + " right tc rgb '" +
             colours[i % 6] + "'\n";
    }
    if (k == 1) {
      p.series.push_back({"", line("#808080", 1.2, 2), {{-5, 1e-4}, {400, 1e-4}}});
      key += "set label \"the paper's tolerance\" at graph 0.55, first 3e-5 font ',11' tc rgb '#606060'\n";
    }
    p.before = key;
    picture.panel(p, places[static_cast<std::size_t>(k)]);
  }
  picture.write(folder, true);
}

void draw_alternatives(const AlternativeStudy& study, const std::filesystem::path& folder) {
  io::Picture picture("speed-alternatives", 1240, 480);
  const auto places = io::grid(1, 3, {0.075, 0.985, 0.235, 0.92}, 0.03, 0.0);
  std::vector<io::Series> legend;
  for (int k = 0; k < 3; ++k) {
    io::Panel p = log_log();
    p.title = k == 0   ? "Four stages"
              : k == 1 ? "K_n, K_s 10^6 times larger"
                       : "K_n, K_s 10^6 times larger, to separation";
    p.x_label = "CPU time of the whole path (s)";
    if (k == 0) p.y_label = "Largest error at the stage ends";
    p.x = {2e-6, 0.5};
    if (k > 0) p.before = "set format y ''\n";
    p.y = {1e-14, 1e0};
    const auto of = [&](const char* method) {
      Points points;
      for (const AlternativeRun& r : k == 0 ? study.ordinary : k == 1 ? study.stiff : study.separated) {
        if (r.method == method && r.error.ok())
          points.emplace_back(r.seconds, std::max(r.error.worst(), floor_of_plots));
      }
      return points;
    };
    p.series = {{"RODAS 4(3) (accurate)", marks(green, 9, 1.0), of("RODAS 4(3)")},
                {"Dormand-Prince 5(4)", marks(vermilion, 7), of("Dormand-Prince 5(4)")},
                {"extrapolated backward Euler", marks(blue, 5), of("extrapolated Euler")}};
    if (p.series[1].points.empty()) {
      p.before +=
          "set label 'Dormand-Prince: over 300 000 steps' at graph 0.97, graph 0.93 right font ',11' tc rgb "
          "'#D55E00'";
    }
    picture.panel(p, places[static_cast<std::size_t>(k)]);
    if (legend.empty()) legend = p.series;
  }
  picture.legend(legend, {0.02, 0.98, 0.0, 0.1}, 3);
  picture.write(folder, true);
}

}  // namespace fpz::bench
