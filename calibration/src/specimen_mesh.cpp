// Structured meshes of half a beam and of half a half disc (a quarter disc).
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "fpz/calibration/notched_specimen.hpp"

namespace fpz::calibration {
namespace {

/// Where the elements have to be small: the wanted size between two places, growing with the distance from them.
struct Focus {
  double from;
  double to;
  double size;
};

/// Wanted element size at x.
double element_size(const std::vector<Focus>& foci, double growth, double x) {
  double size = std::numeric_limits<double>::infinity();
  for (const Focus& f : foci) size = std::min(size, f.size + growth * std::max({f.from - x, x - f.to, 0.0}));
  return size;
}

/// Element edges from breaks.front() to breaks.back(): through every break, with sizes near the wanted ones.
std::vector<double> grid_lines(const std::vector<double>& breaks, const std::vector<Focus>& foci, double growth,
                               int least_first) {
  constexpr int parts = 400;  // of the integral of 1/size over one interval
  std::vector<double> lines = {breaks.front()};
  for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
    const double h = (breaks[b + 1] - breaks[b]) / parts;
    std::vector<double> number(parts + 1, 0.0);  // elements from the break to each part's end
    for (int k = 0; k < parts; ++k) {
      const double size = element_size(foci, growth, breaks[b] + (k + 0.5) * h);
      number[static_cast<std::size_t>(k) + 1] = number[static_cast<std::size_t>(k)] + h / size;
    }
    const int n = std::max(static_cast<int>(std::ceil(number.back() - 1e-6)), b == 0 ? least_first : 1);
    for (int i = 1; i < n; ++i) {
      const double wanted = number.back() * i / n;
      const auto above = std::upper_bound(number.begin(), number.end(), wanted);
      const auto k = static_cast<std::size_t>(above - number.begin()) - 1;
      lines.push_back(breaks[b] + h * (static_cast<double>(k) + (wanted - number[k]) / (number[k + 1] - number[k])));
    }
    lines.push_back(breaks[b + 1]);
  }
  return lines;
}

/// Places in increasing order, those that coincide (to rounding) once.
std::vector<double> sorted_breaks(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  const double tolerance = 1e-9 * places.back();
  const auto end = std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a <= tolerance; });
  places.erase(end, places.end());
  return places;
}

/// Nodes of a lattice of eight-node quadrilaterals: two lattice steps per element, no node in an element's middle.
class Lattice {
 public:
  using Map = std::function<Eigen::Vector2d(double, double)>;

  Lattice(const std::vector<double>& us, const std::vector<double>& vs, const Map& map, HalfMesh& mesh)
      : columns_(2 * us.size() - 1), rows_(2 * vs.size() - 1), index_(columns_ * rows_, -1) {
    for (std::size_t i = 0; i < columns_; ++i) {
      for (std::size_t j = 0; j < rows_; ++j) {
        if (i % 2 == 1 && j % 2 == 1) continue;
        index_[i * rows_ + j] = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back(map(at(us, i), at(vs, j)));
      }
    }
    for (std::size_t i = 0; i + 2 < columns_; i += 2) {
      for (std::size_t j = 0; j + 2 < rows_; j += 2) {
        mesh.elements.push_back({node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i, j + 2), node(i + 1, j),
                                 node(i + 2, j + 1), node(i + 1, j + 2), node(i, j + 1)});
      }
    }
  }

  [[nodiscard]] int node(std::size_t i, std::size_t j) const { return index_[i * rows_ + j]; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }

 private:
  static double at(const std::vector<double>& lines, std::size_t i) {
    return i % 2 == 0 ? lines[i / 2] : 0.5 * (lines[i / 2] + lines[i / 2 + 1]);
  }

  std::size_t columns_;
  std::size_t rows_;
  std::vector<int> index_;
};

std::size_t line_at(const std::vector<double>& lines, double place) {
  const auto nearest = std::min_element(
      lines.begin(), lines.end(), [place](double a, double b) { return std::abs(a - place) < std::abs(b - place); });
  return static_cast<std::size_t>(nearest - lines.begin());
}

/// An even pressure between two lines of a row of sides: Simpson's rule on each side. One line: a point.
std::vector<NodeShare> spread(const std::vector<double>& lines, std::size_t from, std::size_t to,
                              const std::function<int(std::size_t)>& node) {
  if (from == to) return {{node(2 * from), 1.0}};
  std::vector<NodeShare> out;
  for (std::size_t k = 2 * from; k <= 2 * to; ++k) out.push_back({node(k), 0.0});
  for (std::size_t k = from; k < to; ++k) {
    const double part = (lines[k + 1] - lines[k]) / (lines[to] - lines[from]);
    const std::size_t first = 2 * (k - from);
    out[first].share += part / 6.0;
    out[first + 1].share += part * 4.0 / 6.0;
    out[first + 2].share += part / 6.0;
  }
  return out;
}

}  // namespace

HalfMesh make_mesh(const NotchedSpecimen& s) {
  const bool beam = s.shape == SpecimenShape::beam;
  const double height = s.height();
  const double width = beam ? 0.5 * s.length : s.radius;
  const double half_span = 0.5 * s.span;
  const double half_roller = 0.5 * s.roller_width;
  const double load_from = s.load_span > 0.0 ? 0.5 * s.load_span - half_roller : 0.0;
  const double load_to = 0.5 * s.load_span + half_roller;
  const double ligament_size = s.mesh.ligament_fraction * s.ligament();
  const double tip_size = s.mesh.tip_fraction * ligament_size;
  const double support_size = s.mesh.support_fraction * height;
  const double growth = s.mesh.growth;

  // 1. Grid lines.
  std::vector<Focus> foci = {{0.0, 0.0, tip_size}, {half_span - half_roller, half_span + half_roller, support_size}};
  if (s.load_span > 0.0) foci.push_back({load_from, load_to, support_size});
  const std::vector<double> us = grid_lines(
      sorted_breaks({0.0, load_from, load_to, half_span - half_roller, half_span, half_span + half_roller, width}),
      foci, growth, 2);
  const std::vector<double> vs =
      grid_lines(sorted_breaks({0.0, s.notch, 0.5 * height, height}),
                 {{s.notch, s.notch, tip_size}, {s.notch, height, ligament_size}}, growth, 2);

  // 2. The quarter disc is the unit square under a map that keeps the mid-line and the flat side as they are.
  const auto map = [beam, r = s.radius](double x, double y) -> Eigen::Vector2d {
    if (beam) return {x, y};
    const double u = x / r;
    const double v = y / r;
    return {x * std::sqrt(1.0 - 0.5 * v * v), y * std::sqrt(1.0 - 0.5 * u * u)};
  };
  HalfMesh mesh;
  mesh.thickness = s.thickness;
  const Lattice lattice(us, vs, map, mesh);

  // 3. Mid-line, load and support.
  for (std::size_t j = 0; j < lattice.rows(); ++j) mesh.mid_line.push_back(lattice.node(0, j));
  mesh.tip = static_cast<int>(2 * line_at(vs, s.notch));
  mesh.mid_depth = lattice.node(0, 2 * line_at(vs, 0.5 * height));
  const std::size_t top = lattice.rows() - 1;
  mesh.load =
      spread(us, line_at(us, load_from), line_at(us, load_to), [&](std::size_t i) { return lattice.node(i, top); });
  mesh.support = spread(us, line_at(us, half_span - half_roller), line_at(us, half_span + half_roller),
                        [&](std::size_t i) { return lattice.node(i, 0); });
  return mesh;
}

}  // namespace fpz::calibration
