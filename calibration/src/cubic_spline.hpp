// Cubic spline with a continuous second derivative, in any scalar of the library.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "fpz/scalar.hpp"

namespace fpz::calibration {

/// Through points with growing abscissae x, at least two; the slope at the first is given, the second derivative at the
/// last is zero.
template <class T>
class CubicSpline {
 public:
  CubicSpline(std::vector<T> x, std::vector<T> y, const T& first_slope) : x_(std::move(x)), y_(std::move(y)) {
    // Continuity of the second derivative at the inner points: a tridiagonal system for the slopes (Thomas' algorithm).
    const std::size_t n = x_.size();
    const auto chord = [&](std::size_t k) -> T { return (y_[k + 1] - y_[k]) / (x_[k + 1] - x_[k]); };
    slope_.assign(n, first_slope);
    std::vector<T> upper(n, T(0.0));
    for (std::size_t k = 1; k < n; ++k) {
      const T before = T(1.0) / (x_[k] - x_[k - 1]);
      T diagonal = 2.0 * before;
      T right = 3.0 * before * chord(k - 1);
      T above(0.0);
      if (k + 1 < n) {
        above = T(1.0) / (x_[k + 1] - x_[k]);
        diagonal += 2.0 * above;
        right += 3.0 * above * chord(k);
      }
      diagonal -= before * upper[k - 1];
      upper[k] = above / diagonal;
      slope_[k] = (right - before * slope_[k - 1]) / diagonal;
    }
    for (std::size_t k = n - 1; k-- > 1;) slope_[k] -= upper[k] * slope_[k + 1];
  }

  /// The value at x; before the first point on the tangent there.
  [[nodiscard]] T at(double x) const {
    if (x <= value(x_.front())) return y_.front() + slope_.front() * (x - x_.front());
    const std::size_t k = piece(x);
    const T h = x_[k + 1] - x_[k];
    const T s = (x - x_[k]) / h;
    const T r = 1.0 - s;
    return (1.0 + 2.0 * s) * r * r * y_[k] + s * s * (3.0 - 2.0 * s) * y_[k + 1] +
           s * r * h * (r * slope_[k] - s * slope_[k + 1]);
  }

  [[nodiscard]] T slope_at(double x) const {
    if (x <= value(x_.front())) return slope_.front();
    const std::size_t k = piece(x);
    const T h = x_[k + 1] - x_[k];
    const T s = (x - x_[k]) / h;
    const T r = 1.0 - s;
    return 6.0 * s * r * (y_[k + 1] - y_[k]) / h + r * (1.0 - 3.0 * s) * slope_[k] +
           s * (3.0 * s - 2.0) * slope_[k + 1];
  }

 private:
  /// The last piece that begins below x.
  [[nodiscard]] std::size_t piece(double x) const {
    std::size_t k = 0;
    while (k + 2 < x_.size() && value(x_[k + 1]) < x) ++k;
    return k;
  }

  std::vector<T> x_;
  std::vector<T> y_;
  std::vector<T> slope_;
};

}  // namespace fpz::calibration
