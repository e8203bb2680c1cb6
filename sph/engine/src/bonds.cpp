#include "bonds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace fpz::sph::detail {

namespace {

/// Cell coordinates packed so that a run along x is contiguous: 21 bits each, offset to be positive.
template <int Dim>
std::uint64_t cell_key(const std::array<std::int64_t, 3>& cell) {
  constexpr std::int64_t offset = std::int64_t{1} << 20;
  std::uint64_t key = 0;
  for (auto c = static_cast<std::size_t>(Dim); c-- > 0;)
    key = (key << 21) | static_cast<std::uint64_t>(cell[c] + offset);
  return key;
}

template <int Dim>
std::array<std::int64_t, 3> cell_of(const Fields<Dim>& position, std::size_t i, double inverse) {
  constexpr double limit = 1 << 19;
  std::array<std::int64_t, 3> cell = {0, 0, 0};
  for (std::size_t c = 0; c < position.size(); ++c) {
    const double x = std::floor(position[c][i] * inverse);
    cell[c] = static_cast<std::int64_t>(std::isfinite(x) ? std::clamp(x, -limit, limit) : limit);
  }
  return cell;
}

}  // namespace

template <int Dim>
NeighbourLists find_neighbours(Team& team, const Fields<Dim>& position, std::size_t count, double reach) {
  const double inverse = 1.0 / reach;
  std::vector<std::pair<std::uint64_t, int>> cells(count);
  for (std::size_t i = 0; i < count; ++i) {
    cells[i] = {cell_key<Dim>(cell_of<Dim>(position, i, inverse)), static_cast<int>(i)};
  }
  std::sort(cells.begin(), cells.end());
  NeighbourLists lists(count);
  const auto find = [&](std::size_t i) {
    const std::array<std::int64_t, 3> own = cell_of<Dim>(position, i, inverse);
    std::vector<int>& list = lists[i];
    for (std::int64_t dz = Dim == 3 ? -1 : 0; dz <= (Dim == 3 ? 1 : 0); ++dz) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const std::uint64_t low = cell_key<Dim>({own[0] - 1, own[1] + dy, own[2] + dz});
        auto at = std::lower_bound(cells.begin(), cells.end(), std::pair<std::uint64_t, int>{low, -1});
        for (; at != cells.end() && at->first <= low + 2; ++at) {
          const auto j = static_cast<std::size_t>(at->second);
          double r2 = 0.0;
          for (std::size_t c = 0; c < position.size(); ++c) {
            const double d = position[c][j] - position[c][i];
            r2 += d * d;
          }
          if (j != i && r2 < reach * reach) list.push_back(at->second);
        }
      }
    }
    std::sort(list.begin(), list.end());
  };
  constexpr std::size_t piece = 1024;
  team.run(static_cast<std::int64_t>((count + piece - 1) / piece), [&](std::int64_t k) {
    const std::size_t first = static_cast<std::size_t>(k) * piece;
    for (std::size_t i = first; i < std::min(first + piece, count); ++i) find(i);
  });
  return lists;
}

namespace {

/// Drops the pairs for which gone(p, q) holds, with their places at the start.
template <int Dim, class Gone>
void drop_pairs(NeighbourLists& lists, const Fields<Dim>& start, Gone&& gone) {
  const auto point = [&start](std::size_t i) { return Vec<double, Dim>(start[0][i], start[1][i]); };
  for (std::size_t i = 0; i < lists.size(); ++i) {
    std::erase_if(lists[i], [&](int j) { return gone(point(i), point(static_cast<std::size_t>(j))); });
  }
}

}  // namespace

template <int Dim>
void separate(NeighbourLists& lists, const std::vector<Cut<Dim>>& cuts, const Fields<Dim>& start) {
  if (cuts.empty()) return;
  drop_pairs<Dim>(lists, start, [&](const auto& p, const auto& q) {
    return std::any_of(cuts.begin(), cuts.end(), [&](const Cut<Dim>& cut) { return crosses(cut, p, q); });
  });
}

template <int Dim>
void drop_without_share(NeighbourLists& lists, const std::vector<Cut<Dim>>& cuts, const Fields<Dim>& start,
                        double spacing) {
  if (cuts.empty()) return;
  drop_pairs<Dim>(lists, start,
                  [&](const auto& p, const auto& q) { return share_of_bond(cuts, p, q, spacing) <= 0.0; });
}

template <int Dim>
std::vector<std::size_t> curve_order(const std::vector<Vec<double, Dim>>& points, double cell) {
  Vec<double, Dim> low = points.front();
  for (const Vec<double, Dim>& p : points) low = low.cwiseMin(p);
  std::vector<std::pair<std::uint64_t, std::size_t>> keyed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint64_t key = 0;
    for (int c = 0; c < Dim; ++c) {
      const auto x = static_cast<std::uint64_t>((points[i][c] - low[c]) / cell);
      for (int bit = 0; bit < 20; ++bit) key |= ((x >> bit) & 1U) << (bit * Dim + c);
    }
    keyed[i] = {key, i};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::size_t> order(points.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const auto& k) { return k.second; });
  return order;
}

template <int Dim>
Bonds<Dim> pack(const NeighbourLists& lists, std::size_t padded, bool with_closeness) {
  Bonds<Dim> bonds;
  bonds.column.push_back(0);
  for (std::size_t b = 0; b < padded / lanes; ++b) {
    std::size_t width = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t i = b * lanes + l;
      if (i < lists.size()) width = std::max(width, lists[i].size());
    }
    for (std::size_t k = 0; k < width; ++k) {
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t i = b * lanes + l;
        const bool real = i < lists.size() && k < lists[i].size();
        bonds.neighbour.push_back(real ? lists[i][k] : static_cast<int>(i));
      }
    }
    bonds.column.push_back(bonds.column.back() + static_cast<int>(width));
  }
  for (Field& w : bonds.weight) w.assign(bonds.neighbour.size(), 0.0);
  if (with_closeness) bonds.closeness.assign(bonds.neighbour.size(), 0.0);
  return bonds;
}

template NeighbourLists find_neighbours<2>(Team&, const Fields<2>&, std::size_t, double);
template NeighbourLists find_neighbours<3>(Team&, const Fields<3>&, std::size_t, double);
template void separate<2>(NeighbourLists&, const std::vector<Cut<2>>&, const Fields<2>&);
template void drop_without_share<2>(NeighbourLists&, const std::vector<Cut<2>>&, const Fields<2>&, double);
template std::vector<std::size_t> curve_order<2>(const std::vector<Vec<double, 2>>&, double);
template std::vector<std::size_t> curve_order<3>(const std::vector<Vec<double, 3>>&, double);
template Bonds<2> pack<2>(const NeighbourLists&, std::size_t, bool);
template Bonds<3> pack<3>(const NeighbourLists&, std::size_t, bool);

}  // namespace fpz::sph::detail
