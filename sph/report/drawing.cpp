#include "drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fpz/io/gnuplot.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"

namespace fpz::report {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 8> colours = {"#1F5FA8", "#C0392B", "#2E8B57", "#D68910",
                                                "#8E44AD", "#16A0A0", "#7F8C8D", "#A04000"};
constexpr double mm = 1e3;
constexpr double pixels_per_pointsize = 6.0;  // a square of gnuplot's cairo terminals at pointsize 1

struct DamageClass {
  const char* title;
  const char* colour;
  double above;
};
constexpr std::array<DamageClass, 3> damage_classes = {
    {{"0 < D <= 0.5", "#F2B861", 0.0}, {"0.5 < D <= 0.9", "#D9512C", 0.5}, {"D > 0.9", "#5C0A12", 0.9}}};

const specimen::PointData& field(const CrackMap& map, const char* name) {
  const specimen::PointData* data = map.cloud.find(name);
  if (data == nullptr) throw io::InputError(map.title + ": a frame has no field \"" + name + "\"");
  return *data;
}

std::vector<io::Series> cracked(const CrackMap& map, double pixels_per_metre) {
  std::vector<io::Series> list;
  const std::string size = std::to_string(pixels_per_metre * map.scene.spacing / pixels_per_pointsize);
  for (const DamageClass& c : damage_classes) {
    list.push_back({"", "points pt 5 ps " + size + " lc rgb '" + c.colour + "'", {}});
  }
  const std::vector<double>& damage = field(map, "damage").values;
  for (std::size_t i = 0; i < map.cloud.size(); ++i) {
    std::size_t k = damage_classes.size();
    while (k > 0 && damage[i] <= damage_classes[k - 1].above) --k;
    if (k > 0) list[k - 1].points.emplace_back(mm * map.cloud.points[3 * i], mm * map.cloud.points[3 * i + 1]);
  }
  return list;
}

std::vector<io::Series> outline(const CrackMap& map) {
  std::vector<io::Series> list;
  for (const auto& points : outlines(map.scene.body)) {
    io::Series s{"", "lines lw 1 lc rgb '#404040'", {}};
    for (const specimen::Point& p : points) s.points.emplace_back(mm * p[0], mm * p[1]);
    list.push_back(s);
  }
  for (const specimen::Notch& n : map.scene.body.notches) {
    list.push_back(
        {"", "lines lw 1 lc rgb '#404040'", {{mm * n.mouth[0], mm * n.mouth[1]}, {mm * n.tip[0], mm * n.tip[1]}}});
  }
  return list;
}

/// gnuplot sets long titles below each other anyway.
int legend_columns(const io::Panel& panel) {
  const bool longer =
      std::any_of(panel.series.begin(), panel.series.end(), [](const io::Series& s) { return s.title.size() > 16; });
  return longer ? 1 : 2;
}

int legend_lines(const io::Panel& panel) {
  const int columns = legend_columns(panel);
  return (static_cast<int>(panel.series.size()) + columns - 1) / columns;
}

}  // namespace

std::string curve_style(std::size_t k) {
  return "lines lw 1.5 lc rgb '" + std::string(colours[k % colours.size()]) + "'";
}

std::string point_style(std::size_t k) {
  constexpr std::array<int, 5> shapes = {7, 5, 9, 11, 13};
  return "linespoints lw 1.5 pt " + std::to_string(shapes[k % shapes.size()]) + " ps 0.9 lc rgb '" +
         colours[k % colours.size()] + "'";
}

io::Series load_curve(const Run& run, const std::string& title, const std::string& style) {
  io::Series s{title, style, {}};
  const io::Table t = run.history();
  const auto &u = t.at("deflection"), &p = t.at("load");
  for (std::size_t k = 0; k < t.rows(); ++k) s.points.emplace_back(1e6 * u[k], 1e-3 * p[k]);
  return s;
}

CrackMap crack_map(const Run& run, const specimen::Frame& frame, const std::string& title) {
  return {title, run.cloud(frame), run.parsed_scene()};
}

io::Picture crack_picture(const std::string& name, const std::vector<CrackMap>& maps, int columns) {
  specimen::Point low = specimen::Point::Constant(HUGE_VAL), high = specimen::Point::Constant(-HUGE_VAL);
  for (const CrackMap& m : maps) {
    const auto [l, h] = extent(m.scene.body.shape);
    low = low.cwiseMin(l).eval();
    high = high.cwiseMax(h).eval();
  }
  const specimen::Point margin = 0.02 * (high - low);
  low -= margin;
  high += margin;
  const int rows = (static_cast<int>(maps.size()) + columns - 1) / columns;
  const double width = 1000.0, gap = 10.0, title = 34.0, foot = 44.0;
  const double scale = ((width - gap) / columns - gap) / (high[0] - low[0]);  // pixels per metre
  const double panel_width = scale * (high[0] - low[0]), panel_height = scale * (high[1] - low[1]);
  const double height = foot + rows * (panel_height + title);
  io::Picture picture(name, static_cast<int>(width), static_cast<int>(std::lround(height)));
  std::vector<io::Series> key;
  for (const DamageClass& c : damage_classes) {
    key.push_back({c.title, "points pt 5 ps 1.4 lc rgb '" + std::string(c.colour) + "'", {}});
  }
  picture.legend(key, {0.0, 1.0, 0.0, foot / height}, 3);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    io::Panel panel;
    panel.title = maps[k].title;
    panel.x = {mm * low[0], mm * high[0]};
    panel.y = {mm * low[1], mm * high[1]};
    panel.before = "unset grid\nunset tics\nunset border\nunset xlabel\nunset ylabel";
    panel.series = cracked(maps[k], scale);
    const auto lines = outline(maps[k]);
    panel.series.insert(panel.series.end(), lines.begin(), lines.end());
    const auto row = static_cast<int>(k) / columns, column = static_cast<int>(k) % columns;
    const double left = gap + column * (panel_width + gap);
    const double bottom = height - (row + 1) * (panel_height + title);
    picture.panel(panel,
                  {left / width, (left + panel_width) / width, bottom / height, (bottom + panel_height) / height});
  }
  return picture;
}

io::Picture panels(const std::string& name, const std::vector<io::Panel>& list) {
  const auto count = static_cast<double>(list.size());
  int lines = 0;  // of the longest legend
  for (const io::Panel& p : list) lines = std::max(lines, legend_lines(p));
  const double legend = 22.0 * lines, below = legend + 64.0, height = below + 360.0;
  io::Picture picture(name, static_cast<int>(count == 1.0 ? 720 : 560 * count), static_cast<int>(height));
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double left = static_cast<double>(k) / count, width = 1.0 / count;
    picture.legend(list[k].series, {left + 0.02 * width, left + width, 4.0 / height, (legend + 4.0) / height},
                   legend_columns(list[k]));
  }
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double left = static_cast<double>(k) / count, width = 1.0 / count;
    picture.panel(list[k], {left + 0.15 * width, left + 0.96 * width, below / height, 1.0 - 34.0 / height});
  }
  return picture;
}

std::string Gallery::show(const io::Picture& picture, const std::string& name, const std::string& caption) const {
  if (!io::gnuplot_is_installed()) return "\n(no picture: gnuplot is not installed)\n";
  picture.write(work, true);
  const std::string file = "validation-" + name + ".png";
  io::replace_file(images / file, true, [&](const fs::path& temporary) {
    fs::copy_file(picture.files(work).front(), temporary, fs::copy_options::overwrite_existing);
  });
  return "\n![" + caption + "](images/" + file + ")\n";
}

}  // namespace fpz::report
