// Structured meshes of half a beam, of half a half disc (a quarter disc), and of one arm of a specimen that is pulled
// open.
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
  using Place = std::pair<std::size_t, std::size_t>;  ///< column and row

  /// Elements whose middle (before the map) is in a hole are left out.
  Lattice(const std::vector<double>& us, const std::vector<double>& vs, const Map& map,
          const std::function<bool(double, double)>& in_hole, HalfMesh& mesh)
      : columns_(2 * us.size() - 1), rows_(2 * vs.size() - 1), index_(columns_ * rows_, -1) {
    constexpr std::array<Place, 8> corners_and_middles = {
        {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}}};
    std::vector<Place> elements;  // their first corners
    for (std::size_t i = 0; i + 2 < columns_; i += 2) {
      for (std::size_t j = 0; j + 2 < rows_; j += 2) {
        if (in_hole(at(us, i + 1), at(vs, j + 1))) continue;
        elements.emplace_back(i, j);
        for (const auto& [column, row] : corners_and_middles) index_[(i + column) * rows_ + j + row] = used;
      }
    }
    for (std::size_t k = 0; k < index_.size(); ++k) {
      if (index_[k] != used) continue;
      index_[k] = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(map(at(us, k / rows_), at(vs, k % rows_)));
    }
    for (const auto& [i, j] : elements) {
      std::array<int, 8>& element = mesh.elements.emplace_back();
      for (std::size_t k = 0; k < element.size(); ++k) {
        element[k] = node(i + corners_and_middles[k].first, j + corners_and_middles[k].second);
      }
    }
  }

  /// -1 where there is none.
  [[nodiscard]] int node(std::size_t i, std::size_t j) const { return index_[i * rows_ + j]; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }

 private:
  static constexpr int used = -2;  ///< a node that has no number yet

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

/// A unit of force in x, even over the height of a chain of sides (corner, middle, corner, ...): Simpson's rule is
/// exact, so the force has its line of action in the middle of the height. One node: a point.
std::vector<NodeForce> even_pull(const HalfMesh& mesh, const std::vector<int>& chain) {
  if (chain.size() == 1) return {{chain.front(), Eigen::Vector2d::UnitX()}};
  const auto y = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(chain[k])].y(); };
  const double height = y(chain.size() - 1) - y(0);
  std::vector<NodeForce> out;
  for (const int node : chain) out.push_back({node});
  for (std::size_t k = 0; k + 2 < chain.size(); k += 2) {
    const double a = y(k);
    const double b = y(k + 1);
    const double c = y(k + 2);
    const std::array<double, 3> parts = {-3.0 * a + 4.0 * b - c, 4.0 * (c - a), a - 4.0 * b + 3.0 * c};
    for (std::size_t i = 0; i < 3; ++i) out[k + i].force.x() += parts[i] / (6.0 * height);
  }
  return out;
}

/// Moves the points around the square about `centre` of half side r so that it becomes a circle of radius r. Points
/// farther than `reach` (in the larger of both coordinates) stay.
Eigen::Vector2d around_hole(const Eigen::Vector2d& centre, double r, double reach, const Eigen::Vector2d& x) {
  const Eigen::Vector2d from = x - centre;
  const double rank = from.cwiseAbs().maxCoeff();
  if (rank <= 0.0 || rank >= reach) return x;
  const double part = std::clamp((rank - r) / (reach - r), 0.0, 1.0);
  return centre + from * (part + (1.0 - part) * rank / from.norm());
}

/// One arm of a specimen that two opposite forces pull open, with its part of the ligament. y = 0 is the face that the
/// notch comes from.
HalfMesh make_arm(const NotchedSpecimen& s) {
  const double place = 0.5 * s.span;
  const double width = 0.5 * s.length;
  const double reach = s.hole > 0.0 ? 0.5 * s.hole : 0.5 * s.roller_width;
  const double top = s.load_depth + reach;
  const double bottom = s.load_depth - reach;
  const double right = place + 0.5 * s.hole;
  const double ligament_size = s.mesh.ligament_fraction * s.ligament();
  const double tip_size = s.mesh.tip_fraction * ligament_size;
  double load_size = s.mesh.support_fraction * std::min(s.depth, s.length);
  if (reach > 0.0) load_size = std::min(load_size, 0.5 * reach);

  // 1. Grid lines.
  const double growth = s.mesh.growth;
  const std::vector<double> us =
      grid_lines(sorted_breaks({0.0, 0.5 * s.groove_width, place - 0.5 * s.hole, place, right, width}),
                 {{0.0, 0.0, tip_size}, {place - 0.5 * s.hole, right, load_size}}, growth, 2);
  const std::vector<double> vs = grid_lines(
      sorted_breaks({0.0, s.groove_depth, bottom, s.load_depth, top, s.notch, s.depth}),
      {{s.notch, s.notch, tip_size}, {s.notch, s.depth, ligament_size}, {bottom, top, load_size}}, growth, 2);

  // 2. Mesh without groove and hole.
  const Eigen::Vector2d centre(place, s.load_depth);
  const double around = std::min({place, width - place, s.load_depth, s.depth - s.load_depth});
  const auto map = [&](double x, double y) -> Eigen::Vector2d {
    return s.hole > 0.0 ? around_hole(centre, 0.5 * s.hole, around, {x, y}) : Eigen::Vector2d(x, y);
  };
  const auto in_hole = [&](double x, double y) {
    if (x < 0.5 * s.groove_width && y < s.groove_depth) return true;
    return s.hole > 0.0 && (Eigen::Vector2d(x, y) - centre).cwiseAbs().maxCoeff() < 0.5 * s.hole;
  };
  HalfMesh mesh;
  mesh.thickness = s.thickness;
  const Lattice lattice(us, vs, map, in_hole, mesh);

  // 3. Mid-line.
  const std::size_t mouth = 2 * line_at(vs, s.groove_width > 0.0 ? s.groove_depth : 0.0);
  for (std::size_t j = mouth; j < lattice.rows(); ++j) mesh.mid_line.push_back(lattice.node(0, j));
  mesh.tip = static_cast<int>(2 * line_at(vs, s.notch) - mouth);
  mesh.load_line = s.load_depth;

  // 4. The force acts outwards, on the outer half of the hole where there is one; what a wedge presses in the direction
  //    of the notch goes into a support below the ligament, which is the node that is held.
  std::vector<int> chain;
  const auto add = [&](std::size_t i, std::size_t j) { chain.push_back(lattice.node(i, j)); };
  const std::size_t middle = 2 * line_at(us, place);
  const std::size_t outer = 2 * line_at(us, right);
  const std::size_t low = 2 * line_at(vs, bottom);
  const std::size_t high = 2 * line_at(vs, top);
  for (std::size_t i = middle; i < outer; ++i) add(i, low);
  for (std::size_t j = low; j <= high; ++j) add(outer, j);
  for (std::size_t i = outer; i-- > middle;) add(i, high);
  mesh.forces = even_pull(mesh, chain);
  for (NodeForce& f : mesh.forces) f.force.y() = s.wedge_slope * f.force.x();
  mesh.held = mesh.mid_line.back();
  return mesh;
}

}  // namespace

HalfMesh make_mesh(const NotchedSpecimen& s) {
  if (is_pulled_open(s.shape)) return make_arm(s);
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
  const Lattice lattice(
      us, vs, map, [](double, double) { return false; }, mesh);

  // 3. Mid-line, load and support.
  for (std::size_t j = 0; j < lattice.rows(); ++j) mesh.mid_line.push_back(lattice.node(0, j));
  mesh.tip = static_cast<int>(2 * line_at(vs, s.notch));
  mesh.mid_depth = lattice.node(0, 2 * line_at(vs, 0.5 * height));
  const std::size_t top = lattice.rows() - 1;
  const auto load =
      spread(us, line_at(us, load_from), line_at(us, load_to), [&](std::size_t i) { return lattice.node(i, top); });
  mesh.support = spread(us, line_at(us, half_span - half_roller), line_at(us, half_span + half_roller),
                        [&](std::size_t i) { return lattice.node(i, 0); });
  for (const NodeShare& n : load) mesh.forces.push_back({n.node, {0.0, -0.5 * n.share}});
  for (const NodeShare& n : mesh.support) mesh.forces.push_back({n.node, {0.0, 0.5 * n.share}});
  mesh.held = mesh.support.front().node;
  return mesh;
}

}  // namespace fpz::calibration
