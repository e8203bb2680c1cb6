#include "free_surface.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "bonds.hpp"

namespace fpz::sph::detail {

namespace {

using Point = Vec<double, 2>;
using Free = FreeDirections<2>;
constexpr double pi = std::numbers::pi;

Point start_of(const Particles<2>& p, std::size_t i) { return {p.start[0][i], p.start[1][i]}; }

/// Adds a free normal; one that is another surface's leaves nothing to balance.
void add_normal(Free& f, const Point& normal) {
  constexpr double same = 0.85;  // cosine: the normals that a particle sees on a bent surface differ
  if (f.count == 0) {
    f.count = 1;
    f.normal = normal;
  } else if (f.count == 1 && std::abs(f.normal.dot(normal)) < same) {
    f.count = 2;
  }
}

/// Things sorted into square cells.
class Cells {
 public:
  explicit Cells(double size) : size_(size) {}
  void add(const Point& low, const Point& high, int thing) {
    for (long y = at(low[1]); y <= at(high[1]); ++y) {
      for (long x = at(low[0]); x <= at(high[0]); ++x) cells_[{x, y}].push_back(thing);
    }
  }
  /// Calls f(thing) for all in the cells that touch the square of half-width `size` about x.
  template <class F>
  void near(const Point& x, F&& f) const {
    for (long dy = -1; dy <= 1; ++dy) {
      for (long dx = -1; dx <= 1; ++dx) {
        const auto cell = cells_.find({at(x[0]) + dx, at(x[1]) + dy});
        if (cell == cells_.end()) continue;
        for (const int thing : cell->second) f(thing);
      }
    }
  }

 private:
  [[nodiscard]] long at(double x) const { return static_cast<long>(std::floor(x / size_)); }
  double size_;
  std::map<std::pair<long, long>, std::vector<int>> cells_;
};

/// A piece of a line of the surface and the pieces that it joins, -1 for none.
struct Piece {
  Point from, to;
  int before = -1, after = -1;
  bool cut = false;
  std::array<bool, 2> is_tip = {};  ///< of a cut: the body goes on there
};

void add_line(std::vector<Piece>& pieces, const std::vector<Point>& line, bool cut) {
  if (line.size() < 2) return;
  const int first = static_cast<int>(pieces.size());
  const int count = static_cast<int>(line.size()) - 1;
  const bool closed = line.front() == line.back();
  for (int k = 0; k < count; ++k) {
    Piece piece{line[static_cast<std::size_t>(k)], line[static_cast<std::size_t>(k) + 1], -1, -1, cut};
    if (k > 0 || closed) piece.before = first + (k + count - 1) % count;
    if (k + 1 < count || closed) piece.after = first + (k + 1) % count;
    pieces.push_back(piece);
  }
}

/// Place of the point of the piece that is nearest to x: 0 its begin, 1 its end.
double nearest(const Piece& p, const Point& x) {
  const Point d = p.to - p.from;
  return std::clamp((x - p.from).dot(d) / d.squaredNorm(), 0.0, 1.0);
}

/// The surface as it is described: distances to its pieces that are smallest among their neighbours count, each as a
/// surface of its own; so do corners and ends of lines, wherever they are in reach. Ahead of the tip of a cut nothing
/// is free: without balance there a cut between scattered particles acts as if it were a spacing longer.
class DescribedSurface {
 public:
  DescribedSurface(const RunData<2>& run, double reach)
      : reach_(reach),
        spacing_(run.setup.arrangement.spacing),
        platen_reach_(0.5 * reach),
        cells_(reach),
        platens_(platen_reach_) {
    for (const auto& line : run.setup.arrangement.surface) add_line(pieces_, line, false);
    for (const Cut<2>& cut : run.setup.arrangement.cuts) {
      add_line(pieces_, {cut.corner[0], cut.corner[1]}, true);
      pieces_.back().is_tip = cut.is_tip;
    }
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& p = pieces_[k];
      cells_.add(p.from.cwiseMin(p.to), p.from.cwiseMax(p.to), static_cast<int>(k));
    }
    for (std::size_t i = 0; i < run.particles.count; ++i) {
      if (run.setup.arrangement.group[run.particles.id[i]] < 0 || run.piece[i] != 0) continue;
      covers_.push_back(start_of(run.particles, i));
      platens_.add(covers_.back(), covers_.back(), static_cast<int>(covers_.size()) - 1);
    }
  }

  void look(const Point& x, Free& f) const {
    platens_.near(x, [&](int k) {
      f.at_platen = f.at_platen || (covers_[static_cast<std::size_t>(k)] - x).norm() < platen_reach_;
    });
    cells_.near(x, [&](int k) { consider(x, static_cast<std::size_t>(k), f); });
  }

 private:
  void consider(const Point& x, std::size_t k, Free& f) const {
    constexpr double smooth = 0.94;  // cosine of the turn between two pieces of one smooth line
    const Piece& p = pieces_[k];
    const double t = nearest(p, x);
    const Point foot = p.from + t * (p.to - p.from);
    const double distance = (x - foot).norm();
    if (distance >= reach_ || (!p.cut && covered(foot))) return;
    const Point direction = (p.to - p.from).normalized();
    const Point normal(-direction[1], direction[0]);
    if (t > 0.0 && t < 1.0) add_normal(f, normal);
    if (p.before < 0 && !p.is_tip[0] && (x - p.from).norm() < reach_) f.count = 2;
    if ((x - p.to).norm() >= reach_ || p.is_tip[1]) return;
    if (p.after < 0) {
      f.count = 2;
      return;
    }
    const Piece& next = pieces_[static_cast<std::size_t>(p.after)];
    if (direction.dot((next.to - next.from).normalized()) < smooth) {
      f.count = 2;
    } else if (t >= 1.0 && nearest(next, x) <= 0.0) {
      add_normal(f, distance > 1e-6 * spacing_ ? Point((x - foot) / distance) : normal);
    }
  }

  [[nodiscard]] bool covered(const Point& foot) const {
    bool found = false;
    platens_.near(
        foot, [&](int k) { found = found || (covers_[static_cast<std::size_t>(k)] - foot).norm() < 1.2 * spacing_; });
    return found;
  }

  double reach_, spacing_;
  double platen_reach_;  // the particles that touch them
  std::vector<Piece> pieces_;
  std::vector<Point> covers_;
  Cells cells_, platens_;
};

/// The largest angle without a neighbour, radian, and the direction of its middle.
struct Gap {
  double angle = 2.0 * pi;
  Point direction = Point::UnitX();
};

Gap widest_gap(const Particles<2>& p, std::size_t i, const std::vector<int>& list, double radius) {
  std::vector<double> angle;
  for (const int j : list) {
    const Point r = start_of(p, static_cast<std::size_t>(j)) - start_of(p, i);
    if (r.norm() < radius) angle.push_back(std::atan2(r[1], r[0]));
  }
  Gap widest;
  if (angle.size() < 2) return widest;
  std::sort(angle.begin(), angle.end());
  widest.angle = 0.0;
  for (std::size_t k = 0; k < angle.size(); ++k) {
    const double next = k + 1 < angle.size() ? angle[k + 1] : angle[0] + 2.0 * pi;
    if (next - angle[k] <= widest.angle) continue;
    const double middle = 0.5 * (angle[k] + next);
    widest = {next - angle[k], Point(std::cos(middle), std::sin(middle))};
  }
  return widest;
}

/// Normal of the parabola through points about the origin, weighted towards it; all directions free when they lie on
/// none (a corner, a notch tip).
Free fit_normal(const std::vector<Point>& points, double window, double spacing) {
  constexpr double rough = 0.35;  // of the spacing, root mean square: rows moved by 0.3 spacings have 0.2
  const Free none{2, Point::UnitX(), false};
  std::vector<std::pair<Point, double>> weighted;
  Point mean = Point::Zero();
  double sum = 0.0;
  for (const Point& x : points) {
    const double q = x.norm() / window;
    if (q >= 1.0) continue;
    const double w = (1.0 - q * q) * (1.0 - q * q);
    weighted.emplace_back(x, w);
    mean += w * x;
    sum += w;
  }
  if (weighted.size() < 4) return none;
  mean /= sum;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& [x, w] : weighted) spread += w * (x - mean) * (x - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
  const Point across = axes.eigenvectors().col(0), along = axes.eigenvectors().col(1);
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto terms = [&](const Point& x) {
    const double s = x.dot(along) / window;
    return Eigen::Vector3d(1.0, s, s * s);
  };
  for (const auto& [x, w] : weighted) {
    matrix += w * terms(x) * terms(x).transpose();
    right += w * x.dot(across) * terms(x);
  }
  matrix(2, 2) += 0.02 * sum;
  const Eigen::Vector3d line = matrix.ldlt().solve(right);
  double square = 0.0;
  for (const auto& [x, w] : weighted) square += w * std::pow(x.dot(across) - line.dot(terms(x)), 2);
  if (std::sqrt(square / sum) > rough * spacing) return none;
  return {1, Point((across - line[1] / window * along).normalized()), false};
}

/// Whether a component of the particle's velocity is prescribed.
bool is_prescribed(const RunData<2>& run, std::size_t i) {
  const int g = run.setup.arrangement.group[run.particles.id[i]];
  if (g < 0) return false;
  const auto& drive = run.setup.groups[static_cast<std::size_t>(g)].drive;
  return std::any_of(drive.begin(), drive.end(), [](const auto& d) { return d.has_value(); });
}

/// The surface as the particles show it: those with a wide angle without a neighbour lie on it.
std::vector<Free> estimated_surface(const RunData<2>& run, double reach) {
  const Particles<2>& p = run.particles;
  const double spacing = run.setup.arrangement.spacing;
  const double window = 10.0 * spacing;
  const NeighbourLists lists = find_neighbours<2>(run.team, p.start, p.count, 2.0 * spacing);
  std::vector<std::size_t> rim;
  std::vector<Point> outward;
  Cells cells(window);
  for (std::size_t i = 0; i < p.count; ++i) {
    const Gap gap = widest_gap(p, i, lists[i], 2.0 * spacing);
    if (is_prescribed(run, i) || gap.angle < 105.0 / 180.0 * pi) continue;
    cells.add(start_of(p, i), start_of(p, i), static_cast<int>(rim.size()));
    rim.push_back(i);
    outward.push_back(gap.direction);
  }
  std::vector<Free> on_rim;
  for (std::size_t n = 0; n < rim.size(); ++n) {
    const Point x = start_of(p, rim[n]);
    std::vector<Point> points;
    cells.near(x, [&](int k) {  // those on the same side of the body
      const auto other = static_cast<std::size_t>(k);
      if (outward[other].dot(outward[n]) > 0.5) points.emplace_back(start_of(p, rim[other]) - x);
    });
    Free f{2, Point::UnitX(), false};
    for (double w = window; f.count == 2 && w > 0.4 * window; w *= 0.8) f = fit_normal(points, w, spacing);
    on_rim.push_back(f);
  }
  std::vector<Free> all(p.count);
  for (std::size_t i = 0; i < p.count; ++i) {
    double closest = reach;
    std::vector<int> seen;
    cells.near(start_of(p, i), [&](int k) {
      const double distance = (start_of(p, rim[static_cast<std::size_t>(k)]) - start_of(p, i)).norm();
      if (distance >= reach) return;
      seen.push_back(k);
      if (distance < closest) all[i] = on_rim[static_cast<std::size_t>(k)];
      closest = std::min(closest, distance);
    });
    for (const int k : seen) {
      const Free& other = on_rim[static_cast<std::size_t>(k)];
      if (other.count == 2) all[i].count = 2;
      add_normal(all[i], other.normal);
    }
  }
  return all;
}

}  // namespace

template <int Dim>
std::vector<FreeDirections<Dim>> find_free_directions(const RunData<Dim>& run) {
  const double spacing = run.setup.arrangement.spacing;
  const double reach = kernel_support * run.h + 0.5 * spacing;
  std::vector<Free> all(run.particles.count);
  // Particles on the surface lie about half a spacing below it.
  if (run.setup.arrangement.surface.empty()) all = estimated_surface(run, reach - 0.4 * spacing);
  const DescribedSurface described(run, reach);
  for (std::size_t i = 0; i < all.size(); ++i) {
    described.look(start_of(run.particles, i), all[i]);
    if (run.piece[i] != 0) all[i].at_platen = true;  // its own surface is not described
    if (all[i].at_platen) all[i].count = 2;          // particles of a group among them: they are their own platen
  }
  return all;
}

template std::vector<FreeDirections<2>> find_free_directions<2>(const RunData<2>&);

}  // namespace fpz::sph::detail
