#include "fpz/specimen/crack.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "point_grid.hpp"

namespace fpz::specimen {
namespace {

using detail::PointGrid;

std::vector<Point> places(const std::vector<Spot>& spots) {
  std::vector<Point> points;
  for (const Spot& s : spots) points.push_back(s.at);
  return points;
}

std::vector<Spot> cracked(const std::vector<Spot>& spots, double threshold) {
  std::vector<Spot> some;
  for (const Spot& s : spots) {
    if (s.damage > 0.0 && s.damage >= threshold) some.push_back(s);
  }
  return some;
}

/// Calls f(j, distance along the normal, weight) for the particles of the strip through i: weight falls from 1 to 0
/// within `side` spacings to the side.
template <class F>
void strip(const std::vector<Spot>& spots, const PointGrid& grid, std::size_t i, double spacing, double side,
           double reach, F&& f) {
  const Point n = spots[i].normal;
  grid.near(spots[i].at, (reach + side) * spacing, [&](std::size_t j) {
    const Point d = spots[j].at - spots[i].at;
    const double off = d.dot(n);
    const double weight = 1.0 - std::abs(n[0] * d[1] - n[1] * d[0]) / (side * spacing);
    if (weight > 0.0 && std::abs(off) <= reach * spacing) f(j, off, weight);
  });
}

/// Groups of points that are connected by steps of at most `step`; `linked` may refuse a step.
template <class Linked>
std::vector<std::vector<std::size_t>> components(const std::vector<Point>& points, double step, Linked&& linked) {
  const PointGrid grid(points, step);
  std::vector<char> seen(points.size(), 0);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (seen[first] != 0) continue;
    std::vector<std::size_t>& group = groups.emplace_back(1, first);
    seen[first] = 1;
    for (std::size_t k = 0; k < group.size(); ++k) {
      const std::size_t i = group[k];
      grid.near(points[i], step, [&](std::size_t j) {
        if (seen[j] != 0 || !linked(i, j)) return;
        seen[j] = 1;
        group.push_back(j);
      });
    }
  }
  return groups;
}

/// Parents of the minimal spanning tree of some points, by Prim; the root is its own parent. Order of insertion in
/// `order`.
std::vector<std::size_t> spanning_tree(const std::vector<Point>& points, std::vector<std::size_t>& order) {
  const std::size_t n = points.size();
  std::vector<std::size_t> parent(n, 0);
  std::vector<double> best(n, 1e300);
  std::vector<char> done(n, 0);
  best[0] = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t next = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (done[i] == 0 && (next == n || best[i] < best[next])) next = i;
    }
    done[next] = 1;
    order.push_back(next);
    for (std::size_t i = 0; i < n; ++i) {
      const double d = (points[i] - points[next]).squaredNorm();
      if (done[i] == 0 && d < best[i]) best[i] = d, parent[i] = next;
    }
  }
  return parent;
}

/// The longest path in the minimal spanning tree of the points.
std::vector<std::size_t> longest_path(const std::vector<Point>& points) {
  std::vector<std::size_t> order;
  const std::vector<std::size_t> parent = spanning_tree(points, order);
  std::vector<std::vector<std::size_t>> links(points.size());
  for (const std::size_t i : order) {
    if (parent[i] != i) links[i].push_back(parent[i]), links[parent[i]].push_back(i);
  }
  std::vector<std::size_t> from(points.size());
  const auto farthest = [&](std::size_t start) {
    std::vector<double> distance(points.size(), -1.0);
    std::vector<std::size_t> queue = {start};
    distance[start] = 0.0;
    from[start] = start;
    std::size_t best = start;
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const std::size_t i = queue[k];
      if (distance[i] > distance[best]) best = i;
      for (const std::size_t j : links[i]) {
        if (distance[j] >= 0.0) continue;
        distance[j] = distance[i] + (points[j] - points[i]).norm();
        from[j] = i;
        queue.push_back(j);
      }
    }
    return best;
  };
  std::size_t i = farthest(farthest(0));
  std::vector<std::size_t> path = {i};
  while (from[i] != i) path.push_back(i = from[i]);
  return path;
}

/// The path with its zigzag averaged out, about one point per spacing.
CrackPath smooth(const std::vector<Point>& centres, const std::vector<Spot>& spots,
                 const std::vector<std::size_t>& path, double spacing) {
  CrackPath line;
  const auto n = static_cast<std::ptrdiff_t>(path.size());
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const std::ptrdiff_t half = std::min({std::ptrdiff_t{3}, k, n - 1 - k});
    Point mean = Point::Zero();
    double damage = 0.0;
    for (std::ptrdiff_t m = k - half; m <= k + half; ++m) {
      const std::size_t i = path[static_cast<std::size_t>(m)];
      mean += centres[i];
      damage = std::max(damage, spots[i].damage);
    }
    mean /= static_cast<double>(2 * half + 1);
    const bool far = line.points.empty() || (mean - line.points.back()).norm() >= 0.9 * spacing;
    if (!far && k + 1 < n) continue;
    line.points.push_back(mean);
    line.damage.push_back(damage);
  }
  return line;
}

}  // namespace

double opened_length(const std::vector<Spot>& spots, double spacing) {
  constexpr double side = 2.0;    // spacings: wide enough that few particles in a strip make no error
  constexpr double reach = 4.5;   // spacings; bands are two to four columns wide
  constexpr double sample = 4.0;  // a whole number: exact on a lattice
  const std::vector<Point> points = places(spots);
  const PointGrid grid(points, spacing);
  double length = 0.0;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    if (spots[i].damage <= 0.0) continue;
    double sum = 0.0, squares = 0.0, cubes = 0.0, before = 0.0, beyond = 0.0;
    strip(spots, grid, i, spacing, side, reach, [&](std::size_t j, double off, double weight) {
      const Spot& s = spots[j];
      const double damage = s.volume * s.damage * weight;
      sum += damage;
      squares += damage * s.damage;
      cubes += damage * s.damage * s.damage;
      const double material = s.volume * weight * std::max(0.0, 1.0 - std::abs(off) / (sample * spacing));
      const double behind = off < 0.0 ? 1.0 : off > 0.0 ? 0.0 : 0.5;
      before += behind * material;
      beyond += (1.0 - behind) * material;
    });
    // The width of the strip as the particles sample it; narrower at the ends of a crack on the surface. A crack along
    // the surface, or a platen, has material on one side only.
    const double one_sided = 2.0 * std::max(before, beyond), both = before + beyond;
    const double width = (both < 0.75 * one_sided ? one_sided : both) / (sample * spacing);
    length += spots[i].volume * spots[i].damage * (cubes / squares) / sum * width;
  }
  return length;
}

double CrackPath::length() const {
  double sum = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k) sum += (points[k] - points[k - 1]).norm();
  return sum;
}

std::vector<CrackPath> crack_paths(const std::vector<Spot>& all, double spacing, double threshold) {
  constexpr double join = 2.2, wide = 2.5, shortest = 4.0;  // spacings
  const std::vector<Spot> spots = cracked(all, threshold);
  const std::vector<Point> points = places(spots);
  const PointGrid grid(points, spacing);
  std::vector<Point> centres = points;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    double moment = 0.0, sum = 0.0;
    strip(spots, grid, i, spacing, 1.0, wide, [&](std::size_t j, double off, double weight) {
      moment += weight * spots[j].damage * off;
      sum += weight * spots[j].damage;
    });
    centres[i] += moment / sum * spots[i].normal;
  }
  std::vector<CrackPath> lines;
  std::vector<std::size_t> left(spots.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  // The longest path of every connected group; then of what lies beside these paths, until only specks are left.
  while (!left.empty()) {
    std::vector<Point> some;
    for (const std::size_t i : left) some.push_back(centres[i]);
    std::vector<Point> covered;
    for (const auto& group : components(some, join * spacing, [](std::size_t, std::size_t) { return true; })) {
      std::vector<Point> members;
      for (const std::size_t k : group) members.push_back(some[k]);
      std::vector<std::size_t> path = longest_path(members);
      for (std::size_t& k : path) k = left[group[k]];
      CrackPath line = smooth(centres, spots, path, spacing);
      const bool long_enough = line.length() >= shortest * spacing;
      if (long_enough) lines.push_back(std::move(line));
      // A speck is used up as a whole.
      if (long_enough) {
        for (const std::size_t i : path) covered.push_back(centres[i]);
      } else {
        covered.insert(covered.end(), members.begin(), members.end());
      }
    }
    const PointGrid used(covered, spacing);
    std::erase_if(left, [&](std::size_t i) {
      bool near = false;
      used.near(centres[i], wide * spacing, [&](std::size_t) { near = true; });
      return near;
    });
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const CrackPath& a, const CrackPath& b) { return a.length() > b.length(); });
  return lines;
}

std::vector<double> piece_areas(const std::vector<Spot>& all, const std::vector<Notch>& notches, double spacing,
                                double threshold) {
  std::vector<Spot> whole;
  for (const Spot& s : all) {
    if (s.damage <= threshold) whole.push_back(s);
  }
  const std::vector<Point> points = places(whole);
  // Nearest neighbours only: a crack one particle wide separates.
  const auto groups = components(points, 1.3 * spacing, [&](std::size_t i, std::size_t j) {
    return std::none_of(notches.begin(), notches.end(),
                        [&](const Notch& n) { return crosses(cut_of(n), points[i], points[j]); });
  });
  std::vector<double> areas;
  for (const auto& group : groups) {
    double sum = 0.0;
    for (const std::size_t i : group) sum += whole[i].volume;
    areas.push_back(sum);
  }
  std::sort(areas.rbegin(), areas.rend());
  return areas;
}

}  // namespace fpz::specimen
