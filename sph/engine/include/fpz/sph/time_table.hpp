// A quantity over time: what boundaries and loads follow.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace fpz::sph {

/// Values at some moments: straight between them, or smooth (a cubic whose slope is zero at every moment). Before the
/// first moment the first value, after the last one the last.
struct TimeTable {
  std::vector<double> time;   ///< s after `start`, ascending
  std::vector<double> value;  ///< of each time: m/s, m, N or a pure number
  bool smooth = false;
  double start = 0.0;  ///< s: where the clock of the table is at zero

  [[nodiscard]] double at(double t) const {
    const double x = t - start;
    const auto next = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), x) - time.begin());
    if (next == 0) return value.front();
    if (next == time.size()) return value.back();
    const double part = (x - time[next - 1]) / (time[next] - time[next - 1]);
    const double rise = value[next] - value[next - 1];
    return value[next - 1] + (smooth ? rise * part * part * (3.0 - 2.0 * part) : rise * part);
  }
  /// s: nothing changes from here on.
  [[nodiscard]] double end() const { return start + time.back(); }

  /// One value for all times.
  [[nodiscard]] static TimeTable constant(double x) { return {{0.0}, {x}, false, 0.0}; }
  /// From one value to another, smoothly within `ramp` (s).
  [[nodiscard]] static TimeTable rise(double from, double to, double ramp) {
    if (!(ramp > 0.0)) return constant(to);
    return {{0.0, ramp}, {from, to}, true, 0.0};
  }
};

/// What is wrong with a table; empty when it can be used.
[[nodiscard]] std::string problem_of(const TimeTable& table);

template <class Archive, class T>
void transfer(Archive& archive, T& table) requires std::same_as<std::remove_const_t<T>, TimeTable> {
  auto& [time, value, smooth, start] = table;  // a member that is not handed on does not compile
  archive(time), archive(value), archive(smooth), archive(start);
}

}  // namespace fpz::sph
