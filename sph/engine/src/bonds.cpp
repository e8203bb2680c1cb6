#include "bonds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
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
  const double square = (1.0 - 1e-9) * reach * reach;  // on a lattice rounding would choose among those at the edge
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
          if (j != i && r2 < square) list.push_back(at->second);
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

Vec<double, 2> AlikeBonds::operator()(const Vec<double, 2>& line) {
  for (const Vec<double, 2>& kind : kinds_) {
    if ((line - kind).cwiseAbs().maxCoeff() < near_) return kind;
    if ((line + kind).cwiseAbs().maxCoeff() < near_) return -kind;
  }
  if (kinds_.size() < most_kinds) kinds_.push_back(line);
  return line;
}

template <int Dim>
void Bonds<Dim>::own(std::size_t block) {
  shared[block] = -1;
  for (int c = column[block]; c < column[block + 1]; ++c) {
    const int* j = &neighbour[static_cast<std::size_t>(c) * lanes];
    bool follows = true;
    for (std::size_t l = 1; l < lanes; ++l) follows = follows && j[l] == j[0] + static_cast<int>(l);
    run[static_cast<std::size_t>(c)] = follows ? j[0] : -1;
  }
}

namespace {

bool same_in_all_lanes(const Field& f, std::size_t first) {
  if (f.empty()) return true;
  return std::all_of(&f[first], &f[first] + lanes, [&](double x) { return x == f[first]; });
}

}  // namespace

template <int Dim>
void Bonds<Dim>::share() {
  for (Field& w : stencil_weight) w.clear();
  stencil_beside.clear();
  std::map<std::vector<double>, int> known;
  for (std::size_t b = 0; b < shared.size(); ++b) {
    const auto first = static_cast<std::size_t>(column[b]), last = static_cast<std::size_t>(column[b + 1]);
    std::vector<double> bonds;
    bool uniform = last > first;
    for (std::size_t c = first; uniform && c < last; ++c) {
      uniform = run[c] >= 0 && same_in_all_lanes(beside, c * lanes);
      for (const Field& w : weight) uniform = uniform && same_in_all_lanes(w, c * lanes), bonds.push_back(w[c * lanes]);
      bonds.push_back(beside.empty() ? 0.0 : beside[c * lanes]);
    }
    if (!uniform) continue;
    const auto [at, is_new] = known.try_emplace(bonds, static_cast<int>(stencil_weight[0].size()));
    shared[b] = at->second;
    for (std::size_t c = first; is_new && c < last; ++c) {
      for (std::size_t d = 0; d < weight.size(); ++d) stencil_weight[d].push_back(weight[d][c * lanes]);
      if (!beside.empty()) stencil_beside.push_back(beside[c * lanes]);
    }
  }
}

template <int Dim>
BondView<Dim> Bonds<Dim>::view() {
  BondView<Dim> v{column.data(),        neighbour.data(), run.data(), shared.data(), {}, beside.data(), {},
                  stencil_beside.data()};
  for (std::size_t d = 0; d < weight.size(); ++d) {
    v.weight[d] = weight[d].data();
    v.stencil_weight[d] = stencil_weight[d].data();
  }
  return v;
}

template <int Dim>
Bonds<Dim> pack(const NeighbourLists& lists, std::size_t padded, Beside beside) {
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
  bonds.run.resize(static_cast<std::size_t>(bonds.column.back()));
  bonds.shared.resize(padded / lanes);
  for (std::size_t b = 0; b < bonds.shared.size(); ++b) bonds.own(b);
  for (Field& w : bonds.weight) w.assign(bonds.entries(), 0.0);
  if (beside == Beside::a_number) bonds.beside.assign(bonds.entries(), 0.0);
  return bonds;
}

template NeighbourLists find_neighbours<2>(Team&, const Fields<2>&, std::size_t, double);
template NeighbourLists find_neighbours<3>(Team&, const Fields<3>&, std::size_t, double);
template void separate<2>(NeighbourLists&, const std::vector<Cut<2>>&, const Fields<2>&);
template void drop_without_share<2>(NeighbourLists&, const std::vector<Cut<2>>&, const Fields<2>&, double);
template struct Bonds<2>;
template struct Bonds<3>;
template Bonds<2> pack<2>(const NeighbourLists&, std::size_t, Beside);
template Bonds<3> pack<3>(const NeighbourLists&, std::size_t, Beside);

}  // namespace fpz::sph::detail
