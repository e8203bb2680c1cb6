#include "particle_map.hpp"

#include <algorithm>
#include <cmath>

namespace fpz::specimen::detail {
namespace {

constexpr double mm = 1e3;
constexpr double pixels_per_pointsize = 6.0;  // a square of gnuplot's cairo terminals at pointsize 1
constexpr double side = 70.0, top = 36.0, bottom = 30.0, foot = 70.0;

struct Box {
  Point low = Point::Constant(1e300), high = Point::Constant(-1e300);
};

Box box_of(const std::vector<ParticleMap>& maps, double margin) {
  Box box;
  for (const ParticleMap& m : maps) {
    for (const Point& p : m.at) {
      box.low = box.low.cwiseMin(p).eval();
      box.high = box.high.cwiseMax(p).eval();
    }
  }
  box.low -= Point::Constant(margin);
  box.high += Point::Constant(margin);
  return box;
}

}  // namespace

io::Picture map_picture(const std::string& name, const std::vector<ParticleMap>& maps,
                        const std::vector<ColourClass>& classes, double size, int legend_columns) {
  const Box box = box_of(maps, 1.5 * size);
  const Point extent = box.high - box.low;
  const bool wide = extent[0] > 2.0 * extent[1] || maps.size() == 1;
  const bool many = maps.size() > 6;
  const int columns = wide ? (many ? 2 : 1) : (many ? 4 : 2);
  const double width = columns > 2 ? 1600.0 : 1000.0;  // of the picture, pixels
  const int rows = (static_cast<int>(maps.size()) + columns - 1) / columns;
  const double scale = ((width - side * columns - 20.0) / columns) / extent[0];  // pixels per metre
  const double panel_width = extent[0] * scale, panel_height = extent[1] * scale;
  const double height = foot + rows * (panel_height + top + bottom);
  io::Picture picture(name, static_cast<int>(width), static_cast<int>(std::lround(height)));
  std::vector<io::Series> key;
  for (const ColourClass& c : classes) key.push_back({c.title, "points pt 5 ps 1.6 lc rgb '" + c.colour + "'", {}});
  picture.legend(key, {0.0, 1.0, 0.0, 0.5 * foot / height}, legend_columns);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const ParticleMap& m = maps[k];
    io::Panel panel;
    panel.title = m.title;
    if (k + static_cast<std::size_t>(columns) >= maps.size()) panel.x_label = "x, mm";
    panel.y_label = "y, mm";
    panel.x = {mm * box.low[0], mm * box.high[0]};
    panel.y = {mm * box.low[1], mm * box.high[1]};
    panel.before = "unset grid";
    const std::string point_size = std::to_string(1.04 * size * scale / pixels_per_pointsize);
    for (std::size_t c = 0; c < classes.size(); ++c) {
      panel.series.push_back({"", "points pt 5 ps " + point_size + " lc rgb '" + classes[c].colour + "'", {}});
    }
    for (std::size_t i = 0; i < m.at.size(); ++i) {
      panel.series[m.colour[i]].points.emplace_back(mm * m.at[i][0], mm * m.at[i][1]);
    }
    panel.series.insert(panel.series.end(), m.lines.begin(), m.lines.end());
    const auto row = static_cast<double>(k / static_cast<std::size_t>(columns));
    const auto column = static_cast<double>(k % static_cast<std::size_t>(columns));
    const double left = side + column * (panel_width + side);
    const double low = height - (row + 1.0) * (panel_height + top + bottom) + bottom;
    picture.panel(panel, {left / width, (left + panel_width) / width, low / height, (low + panel_height) / height});
  }
  return picture;
}

}  // namespace fpz::specimen::detail
