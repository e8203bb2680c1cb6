// Points sorted into square cells, to find those near a place.
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen::detail {

class PointGrid {
 public:
  PointGrid(const std::vector<Point>& points, double cell) : points_(points), cell_(cell) {
    for (std::size_t i = 0; i < points.size(); ++i) cells_[key(index(points[i][0]), index(points[i][1]))].push_back(i);
  }

  /// Calls f(i) for every point within `radius` of x, in a fixed order.
  template <class F>
  void near(const Point& x, double radius, F&& f) const {
    const auto reach = static_cast<std::int64_t>(std::ceil(radius / cell_));
    for (std::int64_t dy = -reach; dy <= reach; ++dy) {
      for (std::int64_t dx = -reach; dx <= reach; ++dx) {
        const auto at = cells_.find(key(index(x[0]) + dx, index(x[1]) + dy));
        if (at == cells_.end()) continue;
        for (const std::size_t i : at->second) {
          if ((points_[i] - x).squaredNorm() <= radius * radius) f(i);
        }
      }
    }
  }

 private:
  [[nodiscard]] std::int64_t index(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }
  [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return (static_cast<std::uint64_t>(i) << 32U) ^ (static_cast<std::uint64_t>(j) & 0xffffffffU);
  }

  const std::vector<Point>& points_;
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

}  // namespace fpz::specimen::detail
