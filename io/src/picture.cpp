#include "fpz/io/picture.hpp"

#include <cmath>
#include <fstream>

#include "fpz/io/gnuplot.hpp"

namespace fpz::io {
namespace {

constexpr const char* plain_axes =
    "set border 31 lw 1 lc rgb '#404040'\n"
    "set tics nomirror out scale 0.6,0.3 textcolor rgb '#202020'\n"
    "set grid lc rgb '#DDDDDD' lw 0.7 dt 1\nunset mxtics\nunset mytics\n";

/// gnuplot writes hundreds of groups with nothing in them.
void drop_empty_groups(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string text, held;
  for (std::string line; std::getline(in, line);) {
    if (line == "</g>" && !held.empty()) {
      held.clear();
      continue;
    }
    text += held;
    held.clear();
    if (line.rfind("<g fill=", 0) == 0 && line.back() == '>') {
      held = line + "\n";
    } else if (!line.empty()) {
      text += line + "\n";
    }
  }
  in.close();
  std::ofstream(file) << text << held;
}

}  // namespace

std::vector<PanelPlace> grid(int rows, int columns, PanelPlace all, double gap_x, double gap_y) {
  std::vector<PanelPlace> places;
  const double width = (all.right - all.left - gap_x * (columns - 1)) / columns;
  const double height = (all.top - all.bottom - gap_y * (rows - 1)) / rows;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double left = all.left + c * (width + gap_x);
      const double top = all.top - r * (height + gap_y);
      places.push_back({left, left + width, top - height, top});
    }
  }
  return places;
}

void Picture::place(const PanelPlace& at) {
  command("set lmargin at screen " + gnuplot_number(at.left) + "; set rmargin at screen " + gnuplot_number(at.right) +
          "; set bmargin at screen " + gnuplot_number(at.bottom) + "; set tmargin at screen " + gnuplot_number(at.top));
}

void Picture::axes(const Panel& p) {
  const auto axis = [&](const char* name, bool log, std::pair<double, double> range) {
    command(std::string(log ? "set" : "unset") + " logscale " + name);
    command(std::string("set format ") + name + (log ? " '10^{%L}'" : " '%g'"));
    command(std::string("set ") + name + "range [" +
            (range.first < range.second ? gnuplot_number(range.first) + ":" + gnuplot_number(range.second) : "*:*") +
            "]");
  };
  axis("x", p.log_x, p.x);
  axis("y", p.log_y, p.y);
  command("set title " + gnuplot_quoted(p.title) + " offset 0,-0.4");
  command("set xlabel " + gnuplot_quoted(p.x_label) + " offset 0,0.2");
  command("set ylabel " + gnuplot_quoted(p.y_label) + " offset 0.6,0");
}

void Picture::panel(const Panel& p, const PanelPlace& at) {
  place(at);
  command(plain_axes);
  axes(p);
  command("unset key\nunset label\nunset arrow");
  if (!p.before.empty()) command(p.before);
  std::string plot;
  for (const Series& s : p.series) {
    if (s.points.empty()) continue;
    const std::string block = "$block" + std::to_string(blocks_++);
    command(block + " << END");
    for (const auto& [x, y] : s.points) command(gnuplot_number(x) + " " + gnuplot_number(y));
    command("END");
    plot += (plot.empty() ? "plot " : ", ") + block + " using 1:2 with " + s.style + " notitle";
  }
  if (!plot.empty()) command(plot);
}

void Picture::legend(const std::vector<Series>& series, const PanelPlace& at, int columns) {
  place(at);
  command("unset logscale\nunset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\nunset title\nunset label");
  command("unset arrow\nset xrange [0:1]\nset yrange [0:1]\nset key at screen " +
          gnuplot_number(0.5 * (at.left + at.right)) + "," + gnuplot_number(0.5 * (at.bottom + at.top)) +
          " center center horizontal maxcols " + std::to_string(columns) +
          " samplen 2.0 spacing 1.2 Left reverse font ',12'");
  std::string plot;
  for (const Series& s : series) {
    if (!s.title.empty())
      plot += (plot.empty() ? "plot NaN with " : ", NaN with ") + s.style + " title " + gnuplot_quoted(s.title);
  }
  command(plot);
}

void Picture::image(const Panel& p, const PanelPlace& at, int size, double low, double high,
                    const std::vector<double>& cells, const std::string& background, const std::string& contours) {
  place(at);
  command(plain_axes);
  axes(p);
  command("unset key\nunset label\nunset arrow\nunset grid");
  command("set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '" + background +
          "' fillstyle solid noborder");
  if (!p.before.empty()) command(p.before);
  const std::string block = "$block" + std::to_string(blocks_++);
  const std::string lines = "$block" + std::to_string(blocks_++);
  const auto at_cell = [&](int k) { return gnuplot_number(low + (high - low) * k / (size - 1)); };
  before_ += block + " << END\n";
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const double v =
          cells[static_cast<std::size_t>(j) * static_cast<std::size_t>(size) + static_cast<std::size_t>(i)];
      before_ += at_cell(i) + " " + at_cell(j) + " " +
                 (std::isnan(v) ? "9" : gnuplot_number(std::round(v * 1e4) * 1e-4)) + "\n";
    }
    before_ += "\n";
  }
  before_ += "END\nset contour base\nset cntrparam levels discrete " + contours + "\nunset surface\nset table " +
             lines + "\nsplot " + block + " using 1:2:3\nunset table\nunset contour\nset surface\n";
  std::string plot = "plot " + block + " using 1:2:($3 > 8 ? NaN : $3) with image notitle, " + lines +
                     " using 1:2 with lines lw 1.2 lc rgb '#202020' notitle";
  for (const Series& s : p.series) {
    const std::string data = "$block" + std::to_string(blocks_++);
    command(data + " << END");
    for (const auto& [x, y] : s.points) command(gnuplot_number(x) + " " + gnuplot_number(y));
    command("END");
    plot += ", " + data + " using 1:2 with " + s.style + " notitle";
  }
  command(plot);
  command("unset object 1");
}

std::vector<std::filesystem::path> Picture::files(const std::filesystem::path& folder) const {
  return {folder / (name_ + ".png"), folder / (name_ + ".svg")};
}

void Picture::write(const std::filesystem::path& folder, bool force) const {
  for (const std::filesystem::path& file : files(folder)) {
    const bool png = file.extension() == ".png";
    draw_with_gnuplot(file, force, [&](std::ostream& gp) {
      const double scale = png ? 1.2 : 1.0;
      gp << "set encoding utf8\nset terminal " << (png ? "pngcairo" : "svg dynamic")
         << " enhanced font 'DejaVu Sans,13' " << (png ? "fontscale 1.2 linewidth 1.2 pointscale 1.2 " : "") << "size "
         << std::lround(scale * width_) << ',' << std::lround(scale * height_) << " background rgb 'white'\n"
         << before_ << "set multiplot\n"
         << body_ << "unset multiplot\n";
    });
    if (!png) drop_empty_groups(file);
  }
}

}  // namespace fpz::io
