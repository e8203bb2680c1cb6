// Pictures with several panels by gnuplot: PNG and SVG of the same drawing.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace fpz::io {

struct Series {
  std::string title;  ///< empty: not in the legend
  std::string style;  ///< gnuplot's, after "with"
  std::vector<std::pair<double, double>> points;
};

struct Panel {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::string before;                          ///< gnuplot commands before the plot
  std::pair<double, double> x{0, 0}, y{0, 0};  ///< ranges; equal: automatic
  bool log_x = false, log_y = false;
};

/// Where a panel lies, as fractions of the picture.
struct PanelPlace {
  double left, right, bottom, top;
};

/// Panels in rows from the top, with room for titles and labels.
[[nodiscard]] std::vector<PanelPlace> grid(int rows, int columns, PanelPlace all, double gap_x, double gap_y);

class Picture {
 public:
  Picture(std::string name, int width, int height) : name_(std::move(name)), width_(width), height_(height) {}

  void command(const std::string& text) { body_ += text + "\n"; }
  void panel(const Panel& p, const PanelPlace& at);
  /// The legend of all series with a title, in the middle of a place.
  void legend(const std::vector<Series>& series, const PanelPlace& at, int columns);
  /// Cells of a regular grid, row by row; NaN cells stay `background`; contour lines at the listed values.
  void image(const Panel& p, const PanelPlace& at, int size, double low, double high, const std::vector<double>& cells,
             const std::string& background, const std::string& contours);

  /// The files that write() makes: <folder>/<name>.png and .svg.
  [[nodiscard]] std::vector<std::filesystem::path> files(const std::filesystem::path& folder) const;

  /// Draws them. Throws OutputError when gnuplot does not, or when they exist already and may not be replaced.
  void write(const std::filesystem::path& folder, bool force) const;

 private:
  void place(const PanelPlace& at);
  void axes(const Panel& p);

  std::string name_;
  int width_, height_;
  std::string before_;  ///< commands that must precede the multiplot
  std::string body_;
  int blocks_ = 0;
};

}  // namespace fpz::io
