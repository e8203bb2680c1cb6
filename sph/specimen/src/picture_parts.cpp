#include "picture_parts.hpp"

#include <algorithm>
#include <sstream>

#include "fpz/io/gnuplot.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/output.hpp"

namespace fpz::specimen::detail {

std::string line(const char* colour, const char* dash) {
  return "lines lw 2 lc rgb '" + std::string(colour) + "' " + dash;
}

std::string text_of(double x, int digits) {
  std::ostringstream s;
  s.precision(digits);
  s << x;
  return s.str();
}

io::Picture with_legend(const std::string& name, const io::Panel& panel, int columns) {
  const auto entries = static_cast<int>(panel.series.size());
  const int more = 22 * (std::max(1, (entries + columns - 1) / columns) - 1);  // pixels for rows below the first
  const double height = 520.0 + more;
  io::Picture picture(name, 760, static_cast<int>(height));
  picture.legend(panel.series, {0.1, 0.95, 0.0, (47.0 + more) / height}, columns);
  picture.panel(panel, {0.12, 0.95, (109.0 + more) / height, 1.0 - 42.0 / height});
  return picture;
}

std::vector<Point> positions(const PointCloud& cloud) {
  std::vector<Point> at;
  for (std::size_t i = 0; i < cloud.size(); ++i) at.emplace_back(cloud.points[3 * i], cloud.points[3 * i + 1]);
  return at;
}

const PointData& field(const PointCloud& cloud, const char* name) {
  const PointData* d = cloud.find(name);
  if (d == nullptr) throw io::InputError(std::string("a frame has no field \"") + name + "\"");
  return *d;
}

const std::vector<ColourClass>& damage_classes() {
  static const std::vector<ColourClass> classes = {
      {"boundary", "#9FB3C8"}, {"D < 0.05", "#E4E4E0"}, {"to 0.25", "#F7D774"},  {"to 0.5", "#F2A541"},
      {"to 0.75", "#E0662B"},  {"to 0.9", "#B3261E"},   {"above 0.9", "#5C0A12"}};
  return classes;
}

ParticleMap damage_map(const PointCloud& cloud, std::string title) {
  ParticleMap map{std::move(title), positions(cloud), {}, {}};
  const auto& damage = field(cloud, "damage").values;
  const auto& group = field(cloud, "group").values;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double d = damage[i];
    const std::size_t k = d < 0.05 ? 1 : d <= 0.25 ? 2 : d <= 0.5 ? 3 : d <= 0.75 ? 4 : d <= 0.9 ? 5 : 6;
    map.colour.push_back(group[i] >= 0.0 ? 0 : k);
  }
  return map;
}

void write_pictures(const std::vector<io::Picture>& pictures, const std::filesystem::path& folder, bool force,
                    PictureOutcome& outcome) {
  for (const io::Picture& p : pictures) {
    try {
      p.write(folder, force);
      for (const std::filesystem::path& f : p.files(folder)) outcome.files.push_back(f);
    } catch (const io::OutputError& e) {
      outcome.warnings.emplace_back(e.what());
    }
  }
}

bool gnuplot_missing(PictureOutcome& outcome) {
  if (io::gnuplot_is_installed()) return false;
  outcome.warnings.emplace_back("no pictures: gnuplot is not installed (apt-get install gnuplot-nox)");
  return true;
}

}  // namespace fpz::specimen::detail
