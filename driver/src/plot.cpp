#include "fpz/driver/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "curves.hpp"
#include "fpz/driver/path_file.hpp"
#include "fpz/io/gnuplot.hpp"
#include "fpz/io/output.hpp"

namespace fpz::driver {
namespace fs = std::filesystem;
namespace {

using io::gnuplot_quoted;

enum class Format { png, svg };

/// Size in units of the SVG; the PNG has twice as many pixels.
struct Size {
  int width = 800;
  int height = 600;
};

class Picture {
 public:
  Picture(std::ostream& gp, Format format, Size size) : gp_(gp) {
    const int f = format == Format::png ? 2 : 1;
    gp_ << "set encoding utf8\n";
    gp_ << "set terminal " << (format == Format::png ? "pngcairo" : "svg dynamic") << " enhanced font 'DejaVu Sans,"
        << 14 << "' " << (format == Format::png ? "fontscale 1.9 linewidth 2 " : "") << "size " << f * size.width << ','
        << f * size.height << " background rgb 'white'\n";
    gp_ << "set border 3 lw 1 lc rgb '#404040'\nset tics nomirror out scale 0.6 textcolor rgb '#202020'\n";
    gp_ << "set grid lc rgb '#E6E6E6' lw 0.7 dt 1\nset key samplen 1.8 spacing 1.15 reverse Left\n";
  }

  void title(const std::string& text) { gp_ << "set title " << gnuplot_quoted(text) << " noenhanced\n"; }
  void letter(const std::string& text) {
    gp_ << "set label 50 " << gnuplot_quoted(text) << " at graph -0.05, graph 1.07 right\n";
  }

  void labels(const Panel& panel) {
    gp_ << "set xlabel " << gnuplot_quoted(panel.x_label) << "\nset ylabel " << gnuplot_quoted(panel.y_label)
        << " offset 0.5,0\n";
    if (panel.legend) {
      gp_ << "set key " << panel.key << "\n";
    } else {
      gp_ << "unset key\n";
    }
  }

  void ranges(const Range& x, const Range& y) {
    gp_ << "set xrange [" << io::gnuplot_number(x.lo) << ':' << io::gnuplot_number(x.hi) << "]\nset yrange ["
        << io::gnuplot_number(y.lo) << ':' << io::gnuplot_number(y.hi) << "]\n";
  }

  /// Draws the panel over ranges that hold all its points.
  void draw(const Panel& panel) {
    Range x, y;
    for (const Curve& c : panel.curves) {
      for (const XY& p : c.points) {
        x.add(p.x);
        y.add(p.y);
      }
    }
    ranges(x.padded(0.03), y.padded(0.06));
    const bool nothing = x.lo == x.hi && y.lo == y.hi;
    if (nothing) gp_ << "set label 99 'zero throughout' at graph 0.5,0.6 center textcolor rgb '#606060'\n";
    draw_curves(panel);
    if (nothing) gp_ << "unset label 99\n";
  }

  void draw_curves(const Panel& panel) {
    labels(panel);
    std::string command;
    for (const Curve& c : panel.curves) {
      if (c.points.empty()) continue;
      const bool coloured = c.style.find("palette") != std::string::npos;
      command += (command.empty() ? "plot " : ", ") + std::string("'-' using 1:2") + (coloured ? ":3" : "") + " with " +
                 c.style + (c.title.empty() ? " notitle" : " title " + gnuplot_quoted(c.title));
    }
    if (command.empty()) {
      gp_ << "set label 99 'no fracture' at graph 0.5,0.6 center textcolor rgb '#606060'\nplot NaN notitle\nunset "
             "label 99\n";
      return;
    }
    gp_ << command << "\n";
    for (const Curve& c : panel.curves) {
      if (!c.points.empty()) send(c.points);
    }
  }

  /// One legend for all panels of a multiplot, under its title: the key of an empty plot, because a key is never wider
  /// than its plot.
  void common_legend(const Panel& panel) {
    gp_ << "set lmargin at screen 0.02\nset rmargin at screen 0.98\nset bmargin at screen 0.905\nset tmargin at screen "
           "0.955\n"
        << "unset border\nunset tics\nunset xlabel\nunset ylabel\nunset label 50\nset key center center horizontal "
           "maxrows 1\n"
        << "set xrange [0:1]\nset yrange [0:1]\n";
    std::string command;
    for (const Curve& c : panel.curves) {
      if (!c.title.empty())
        command += (command.empty() ? "plot NaN with " : ", NaN with ") + c.style + " title " + gnuplot_quoted(c.title);
    }
    if (!command.empty()) gp_ << command << "\n";
  }

  std::ostream& raw() { return gp_; }

 private:
  void send(const Points& points) {
    for (const XY& p : points)
      gp_ << io::gnuplot_number(p.x) << ' ' << io::gnuplot_number(p.y) << ' ' << io::gnuplot_number(p.c) << '\n';
    gp_ << "e\n";
  }

  std::ostream& gp_;
};

/// Drawn only where they are not zero throughout.
constexpr std::array<const char*, 4> other_components = {"yy", "zz", "xz", "yz"};

struct Job {
  std::string name;  ///< file name without its ending
  Size size;
  std::function<void(Picture&)> draw;
};

void mark_stages(Picture& picture, int stages) {
  if (stages > 12) return;
  for (int k = 1; k <= stages; ++k) {
    picture.raw() << "set label " << k << " 'Stage " << k << "' at " << k - 0.5
                  << ", graph 1.03 center font ',12' textcolor rgb '#606060'\n";
    if (k < stages)
      picture.raw() << "set arrow " << k << " from " << k << ", graph 0 to " << k
                    << ", graph 1 nohead lc rgb '#A0A0A0' lw 0.8 dt 2\n";
  }
}

Job single(const std::string& name, const Panel& panel, const std::string& title) {
  return {name, {}, [panel, title](Picture& p) {
            p.title(title);
            p.draw(panel);
          }};
}

Job four_panels(const HistoryCurves& curves, const std::string& title) {
  return {"four_panels", {1120, 860}, [&curves, title](Picture& p) {
            std::array<Panel, 4> panels = {curves.stress_strain("xx"), curves.stress_strain("xy"),
                                           curves.normal_traction(), curves.shear_traction()};
            const std::array<const char*, 4> letters = {"(A)", "(B)", "(C)", "(D)"};
            p.raw() << "set multiplot layout 2,2 title " << gnuplot_quoted(title)
                    << " noenhanced font ',17' margins 0.095,0.98,0.09,0.865 "
                    << "spacing 0.115,0.135\n";
            for (std::size_t k = 0; k < 4; ++k) {
              panels[k].legend = false;
              p.letter(letters[k]);
              p.draw(panels[k]);
            }
            p.common_legend(panels[0]);
            p.raw() << "unset multiplot\n";
          }};
}

Job loading_path(const HistoryCurves& curves, const std::string& title) {
  return {"loading_path", {}, [&curves, title](Picture& p) {
            p.raw() << "set title " << gnuplot_quoted(title) << " noenhanced offset 0,0.9\n";
            mark_stages(p, curves.stages());
            p.draw(curves.loading_path());
          }};
}

Job damage_energy(const HistoryCurves& curves, const std::string& title) {
  return {"damage_energy", {800, 820}, [&curves, title](Picture& p) {
            p.raw() << "set multiplot layout 2,1 title " << gnuplot_quoted(title)
                    << " noenhanced font ',17' margins 0.15,0.97,0.13,0.9 "
                    << "spacing 0.1,0.11\n";
            mark_stages(p, curves.stages());
            const Panel damage = curves.damage();
            p.ranges(Range{0.0, static_cast<double>(curves.stages()), false}.padded(0.03), {0.0, 1.0, false});
            p.draw_curves(damage);
            p.draw(curves.energies());
            p.raw() << "unset multiplot\n";
          }};
}

Job yield_surface(const HistoryCurves& curves, const YieldSurface& s, const std::string& title) {
  return {"yield_surface", {860, 680}, [&curves, s, title](Picture& p) {
            const Points path = curves.traction_path();
            const double strength = s.tensile_strength * 1e-6;
            Range x, y;
            x.add(-0.35 * strength);
            x.add(1.08 * strength);
            for (const XY& q : path) {
              x.add(q.x);
              y.add(q.y);
            }
            const Range xr = x.padded(0.02);
            Panel panel;
            panel.x_label = "Normal traction t_n (MPa)";
            panel.y_label = curves.shear_is_magnitude() ? "Shear traction |t_s| (MPa)" : "Shear traction t_s (MPa)";
            const std::array<std::pair<double, const char*>, 5> levels = {
                {{0.0, "#000000"}, {0.25, "#505050"}, {0.5, "#7C7C7C"}, {0.75, "#A0A0A0"}, {0.9, "#BEBEBE"}}};
            for (const auto& [damage, colour] : levels) {
              const Points surface = yield_curve(s.tensile_strength, s.cohesion, s.friction_angle_deg, damage, xr.lo);
              if (damage == 0.0) {
                for (const XY& q : surface) y.add(q.y);
              }
              std::ostringstream label;
              label << (damage == 0.0 ? "initial yield surface" : "at D = ");
              if (damage > 0.0) label << damage;
              panel.curves.push_back({surface,
                                      std::string("lines lw ") + (damage == 0.0 ? "2.2" : "1.4") + " dt " +
                                          (damage == 0.0 ? "1" : "2") + " lc rgb '" + colour + "'",
                                      label.str()});
            }
            panel.curves.push_back({path, "lines lw 3.5 lc palette", path.empty() ? "" : "traction path"});
            p.title(title);
            p.raw() << "set palette defined (0 '#440154', 0.25 '#3B528B', 0.5 '#21918C', 0.75 '#5EC962', 1 '#FDE725')\n"
                    << "set cbrange [0:1]\nset cblabel 'Damage D'\nset zeroaxis lc rgb '#909090' lw 0.8 dt 1\n";
            p.ranges(xr, y.padded(0.04));
            p.draw_curves(panel);
          }};
}

std::vector<Job> jobs(const HistoryCurves& curves, const PlotRequest& request) {
  const std::string& t = request.title;
  std::vector<Job> all = {loading_path(curves, t),
                          four_panels(curves, t),
                          single("stress_strain_xx", curves.stress_strain("xx"), t),
                          single("stress_strain_xy", curves.stress_strain("xy"), t),
                          single("traction_normal", curves.normal_traction(), t),
                          single("traction_shear", curves.shear_traction(), t),
                          damage_energy(curves, t)};
  for (const char* component : other_components) {
    if (curves.is_active(component)) {
      all.push_back(single(std::string("stress_strain_") + component, curves.stress_strain(component), t));
    }
  }
  if (request.surface) all.push_back(yield_surface(curves, *request.surface, t));
  return all;
}

void draw_one(const Job& job, Format format, const fs::path& file, bool force) {
  io::draw_with_gnuplot(file, force, [&](std::ostream& gp) {
    Picture picture(gp, format, job.size);
    job.draw(picture);
  });
}

}  // namespace

std::vector<fs::path> picture_files(const fs::path& folder, bool with_surface) {
  std::vector<fs::path> files;
  for (const char* name : {"loading_path", "four_panels", "stress_strain_xx", "stress_strain_xy", "traction_normal",
                           "traction_shear", "damage_energy", "stress_strain_yy", "stress_strain_zz",
                           "stress_strain_xz", "stress_strain_yz", "yield_surface"}) {
    if (!with_surface && std::string_view(name) == "yield_surface") continue;
    for (const char* ending : {".png", ".svg"}) files.push_back(folder / (std::string(name) + ending));
  }
  return files;
}

PlotOutcome plot_history(const io::Table& history, const PlotRequest& request) {
  io::require_absent(picture_files(request.folder, request.surface.has_value()), request.force);
  PlotOutcome outcome;
  if (!io::gnuplot_is_installed()) {
    outcome.warnings.emplace_back("no pictures: gnuplot is not installed (apt-get install gnuplot-nox)");
    return outcome;
  }
  const HistoryCurves curves(history);
  for (const Job& job : jobs(curves, request)) {
    for (const Format format : {Format::png, Format::svg}) {
      const fs::path file = request.folder / (job.name + (format == Format::png ? ".png" : ".svg"));
      try {
        draw_one(job, format, file, request.force);
        outcome.files.push_back(file);
      } catch (const io::OutputError& e) {
        outcome.warnings.emplace_back(e.what());
      }
    }
  }
  return outcome;
}

void read_plot_facts(const fs::path& summary, PlotRequest& request) {
  std::ifstream in(summary);
  if (!in) return;
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) return;
  if (request.title.empty()) request.title = json.value("test", "");
  const auto m = json.find("material");
  if (m == json.end() || !m->is_object()) return;
  const auto get = [&](const char* key) {
    return m->contains(key) && (*m)[key].is_number() ? (*m)[key].get<double>() : 0.0;
  };
  const YieldSurface s = {get("tensile_strength"), get("cohesion"), get("friction_angle_deg")};
  if (s.tensile_strength > 0.0 && s.cohesion > 0.0 && s.friction_angle_deg > 0.0) request.surface = s;
}

}  // namespace fpz::driver
