// Scalars the library computes with: double, the forward-mode dual numbers below, or any type that behaves like
// ceres::Jet (value member `a`). Branches are always taken on value(x).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>

// For the few small functions of the inner loops: inlining them keeps their many results in registers.
#if defined(__GNUC__)
#define FPZ_INLINE inline __attribute__((always_inline))
#else
#define FPZ_INLINE inline
#endif

namespace fpz {

/// Value plus N directional derivatives, d(value)/d(seed_k) in grad[k]. Used to differentiate the discrete updates
/// exactly, sub-stepping and events included.
template <int N>
struct Dual {
  double val = 0.0;
  Eigen::Matrix<double, N, 1, Eigen::DontAlign> grad = Eigen::Matrix<double, N, 1, Eigen::DontAlign>::Zero();

  Dual() = default;
  Dual(double v) : val(v) {}  // NOLINT(google-explicit-constructor): constants mix freely with duals
  template <class Derived>
  Dual(double v, const Eigen::MatrixBase<Derived>& g) : val(v), grad(g) {}

  /// The independent variable number k.
  static Dual seed(double v, int k) {
    Dual x(v);
    x.grad[k] = 1.0;
    return x;
  }

  Dual operator-() const { return {-val, -grad}; }
  Dual& operator+=(const Dual& y) { return *this = *this + y; }
  Dual& operator-=(const Dual& y) { return *this = *this - y; }
  Dual& operator*=(const Dual& y) { return *this = *this * y; }
  Dual& operator/=(const Dual& y) { return *this = *this / y; }

  friend Dual operator+(const Dual& x, const Dual& y) { return {x.val + y.val, x.grad + y.grad}; }
  friend Dual operator-(const Dual& x, const Dual& y) { return {x.val - y.val, x.grad - y.grad}; }
  friend Dual operator*(const Dual& x, const Dual& y) { return {x.val * y.val, x.val * y.grad + y.val * x.grad}; }
  friend Dual operator/(const Dual& x, const Dual& y) {
    const double q = x.val / y.val;
    return {q, (x.grad - q * y.grad) / y.val};
  }
  friend Dual operator+(const Dual& x, double y) { return {x.val + y, x.grad}; }
  friend Dual operator+(double x, const Dual& y) { return {x + y.val, y.grad}; }
  friend Dual operator-(const Dual& x, double y) { return {x.val - y, x.grad}; }
  friend Dual operator-(double x, const Dual& y) { return {x - y.val, -y.grad}; }
  friend Dual operator*(const Dual& x, double y) { return {x.val * y, y * x.grad}; }
  friend Dual operator*(double x, const Dual& y) { return {x * y.val, x * y.grad}; }
  friend Dual operator/(const Dual& x, double y) { return {x.val / y, x.grad / y}; }
  friend Dual operator/(double x, const Dual& y) { return Dual(x) / y; }

  friend bool operator<(const Dual& x, const Dual& y) { return x.val < y.val; }
  friend bool operator>(const Dual& x, const Dual& y) { return x.val > y.val; }
  friend bool operator<=(const Dual& x, const Dual& y) { return x.val <= y.val; }
  friend bool operator>=(const Dual& x, const Dual& y) { return x.val >= y.val; }

  friend Dual sqrt(const Dual& x) {
    const double r = std::sqrt(x.val);
    return {r, x.grad / (2.0 * r)};
  }
  friend Dual exp(const Dual& x) {
    const double e = std::exp(x.val);
    return {e, e * x.grad};
  }
  friend Dual log(const Dual& x) { return {std::log(x.val), x.grad / x.val}; }
  friend Dual tan(const Dual& x) {
    const double t = std::tan(x.val);
    return {t, (1.0 + t * t) * x.grad};
  }
  friend Dual cos(const Dual& x) { return {std::cos(x.val), -std::sin(x.val) * x.grad}; }
  friend Dual sin(const Dual& x) { return {std::sin(x.val), std::cos(x.val) * x.grad}; }
  friend Dual abs(const Dual& x) { return x.val < 0.0 ? -x : x; }
};

/// The plain value of any scalar the library computes with.
template <class T>
constexpr double value(const T& x) {
  if constexpr (std::floating_point<T>) {
    return x;
  } else if constexpr (requires { x.val; }) {
    return x.val;
  } else {
    return x.a;
  }
}

}  // namespace fpz

namespace Eigen {
template <int N>
struct NumTraits<fpz::Dual<N>> : NumTraits<double> {
  using Real = fpz::Dual<N>;
  using NonInteger = fpz::Dual<N>;
  using Nested = fpz::Dual<N>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N + 1,
    AddCost = N + 1,
    MulCost = 3 * N + 1
  };
};
template <int N, class BinaryOp>
struct ScalarBinaryOpTraits<fpz::Dual<N>, double, BinaryOp> {
  using ReturnType = fpz::Dual<N>;
};
template <int N, class BinaryOp>
struct ScalarBinaryOpTraits<double, fpz::Dual<N>, BinaryOp> {
  using ReturnType = fpz::Dual<N>;
};
}  // namespace Eigen
