// Smoothing kernels with support 2h: value and gradient (section 2.2 of the paper).
#pragma once

#include <cstdint>

#if defined(__GNUC__)
#define FPZ_SPH_INLINE inline __attribute__((always_inline))
#else
#define FPZ_SPH_INLINE inline
#endif

namespace fpz::sph {

enum class Kernel : std::uint8_t { cubic_spline, wendland_c2 };

/// Radius of the support in units of the smoothing length h, both kernels.
inline constexpr double kernel_support = 2.0;

/// Factor that makes the kernel's integral one: W(r) = norm * shape(r/h), 1/m^Dim.
template <int Dim>
[[nodiscard]] inline double kernel_norm(Kernel kernel, double h) {
  constexpr double pi = 3.14159265358979323846;
  static_assert(Dim == 2 || Dim == 3);
  const double volume = Dim == 2 ? h * h : h * h * h;
  if (kernel == Kernel::cubic_spline) return (Dim == 2 ? 10.0 / (7.0 * pi) : 1.0 / pi) / volume;
  return (Dim == 2 ? 7.0 / (4.0 * pi) : 21.0 / (16.0 * pi)) / volume;
}

/// Shape of the kernel at q = r/h >= 0; W(r) = norm * shape.
template <Kernel K>
[[nodiscard]] FPZ_SPH_INLINE double kernel_shape(double q) {
  const double outer = q < 2.0 ? 2.0 - q : 0.0;
  if constexpr (K == Kernel::cubic_spline) {
    const double inner = q < 1.0 ? 1.0 - q : 0.0;
    return 0.25 * outer * outer * outer - inner * inner * inner;
  } else {
    const double a = 0.25 * outer * outer;
    return a * a * (2.0 * q + 1.0);
  }
}

/// -shape'(q)/q >= 0, finite at q = 0: the gradient with respect to x_i is norm/h^2 times this times (x_j - x_i).
template <Kernel K>
[[nodiscard]] FPZ_SPH_INLINE double kernel_slope(double q) {
  const double outer = q < 2.0 ? 2.0 - q : 0.0;
  if constexpr (K == Kernel::cubic_spline) {
    const double far = 0.75 * outer * outer / (q < 1.0 ? 1.0 : q);
    return q < 1.0 ? 3.0 - 2.25 * q : far;
  } else {
    return 0.625 * outer * outer * outer;
  }
}

[[nodiscard]] inline double kernel_shape(Kernel kernel, double q) {
  return kernel == Kernel::cubic_spline ? kernel_shape<Kernel::cubic_spline>(q) : kernel_shape<Kernel::wendland_c2>(q);
}
[[nodiscard]] inline double kernel_slope(Kernel kernel, double q) {
  return kernel == Kernel::cubic_spline ? kernel_slope<Kernel::cubic_spline>(q) : kernel_slope<Kernel::wendland_c2>(q);
}

}  // namespace fpz::sph
