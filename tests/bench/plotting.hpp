// Pictures with several panels by gnuplot: PNG and SVG of the same drawing.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace fpz::bench {

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
  bool log_x = true, log_y = true;
};

/// Where a panel lies, as fractions of the picture.
struct Place {
  double left, right, bottom, top;
};

/// Panels in rows from the top, with room for titles and labels.
[[nodiscard]] std::vector<Place> grid(int rows, int columns, Place all, double gap_x, double gap_y);

class Picture {
 public:
  Picture(std::string name, int width, int height) : name_(std::move(name)), width_(width), height_(height) {}

  void command(const std::string& text) { body_ += text + "\n"; }
  void panel(const Panel& p, const Place& at);
  /// The legend of all series with a title, in the middle of a place.
  void legend(const std::vector<Series>& series, const Place& at, int columns);
  /// Cells of a regular grid, row by row; NaN cells stay `background`; contour lines at the listed values.
  void image(const Panel& p, const Place& at, int size, double low, double high, const std::vector<double>& cells,
             const std::string& background, const std::string& contours);

  /// Writes <folder>/<name>.png and .svg; throws std::runtime_error when gnuplot does not draw them.
  void write(const std::filesystem::path& folder) const;

 private:
  void place(const Place& at);
  void axes(const Panel& p);

  std::string name_;
  int width_, height_;
  std::string before_;  ///< commands that must precede the multiplot
  std::string body_;
  int blocks_ = 0;
};

[[nodiscard]] std::string number(double x);

}  // namespace fpz::bench
