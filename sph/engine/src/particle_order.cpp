#include "particle_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <tuple>

#include "bonds.hpp"

namespace fpz::sph::detail {

namespace {

constexpr double quarter_turn = 0.5 * std::numbers::pi;

/// Angle of the lines to the nearest neighbours, in [0, pi/2), rad; nothing for a point without neighbours.
std::optional<double> angle_of(const Fields<2>& x, const std::vector<int>& neighbours, std::size_t i) {
  double least = HUGE_VAL, angle = 0.0;
  for (const int neighbour : neighbours) {
    const auto j = static_cast<std::size_t>(neighbour);
    const double rx = x[0][j] - x[0][i], ry = x[1][j] - x[1][i];
    if (rx * rx + ry * ry >= least) continue;
    least = rx * rx + ry * ry;
    angle = std::atan2(ry, rx);
  }
  if (!std::isfinite(least)) return std::nullopt;
  angle -= quarter_turn * std::floor(angle / quarter_turn);
  return angle < quarter_turn ? angle : 0.0;
}

/// Direction of the rows that at least half of the points lie in, rad.
std::optional<double> direction_of_rows(Team& team, const Fields<2>& x, double spacing) {
  constexpr double reach = 1.2;           // spacings
  constexpr double same = 1e-6;           // rad, of points of one lattice
  constexpr std::size_t candidates = 64;  // points that are tried
  const std::size_t count = x[0].size();
  const NeighbourLists lists = find_neighbours<2>(team, x, count, reach * spacing);
  std::vector<std::optional<double>> angles(count);
  for (std::size_t i = 0; i < count; ++i) angles[i] = angle_of(x, lists[i], i);
  for (std::size_t k = 0; k < candidates; ++k) {
    const std::optional<double> angle = angles[(2 * k + 1) * count / (2 * candidates)];
    if (!angle) continue;
    const auto alike = std::count_if(angles.begin(), angles.end(), [&](const std::optional<double>& a) {
      const double apart = a ? std::abs(*a - *angle) : quarter_turn / 2.0;
      return std::min(apart, quarter_turn - apart) < same;
    });
    if (2 * static_cast<std::size_t>(alike) >= count) return angle;
  }
  return std::nullopt;
}

/// Rows along the direction `angle`. Most points lie on the middles of the rows.
std::vector<std::size_t> row_order(const Fields<2>& x, double spacing, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const std::size_t count = x[0].size();
  const auto across = [&](std::size_t i) { return (cosine * x[1][i] - sine * x[0][i]) / spacing; };
  double sum_cosine = 0.0, sum_sine = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    sum_cosine += std::cos(2.0 * std::numbers::pi * across(i));
    sum_sine += std::sin(2.0 * std::numbers::pi * across(i));
  }
  const double middle = std::atan2(sum_sine, sum_cosine) / (2.0 * std::numbers::pi);
  std::vector<std::tuple<double, double, std::size_t>> keyed(count);
  for (std::size_t i = 0; i < count; ++i) {
    keyed[i] = {std::round(across(i) - middle), cosine * x[0][i] + sine * x[1][i], i};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::size_t> order(count);
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const auto& k) { return std::get<2>(k); });
  return order;
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

}  // namespace

template <int Dim>
std::vector<std::size_t> particle_order(Team& team, const std::vector<Vec<double, Dim>>& points, double spacing) {
  Fields<Dim> x;
  for (std::size_t c = 0; c < x.size(); ++c) {
    for (const Vec<double, Dim>& p : points) x[c].push_back(p[static_cast<int>(c)]);
  }
  if (const auto angle = direction_of_rows(team, x, spacing)) return row_order(x, spacing, *angle);
  return curve_order<Dim>(points, spacing);
}

template std::vector<std::size_t> particle_order<2>(Team&, const std::vector<Vec<double, 2>>&, double);

}  // namespace fpz::sph::detail
