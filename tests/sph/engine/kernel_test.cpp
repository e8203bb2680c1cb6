#include "fpz/sph/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fpz::sph::test {
namespace {

constexpr Kernel kernels[] = {Kernel::cubic_spline, Kernel::wendland_c2};

template <int Dim>
double integral(Kernel k, double h) {
  constexpr int n = 20000;
  constexpr double pi = 3.14159265358979323846;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double r = (i + 0.5) * kernel_support * h / n;
    const double shell = Dim == 2 ? 2.0 * pi * r : 4.0 * pi * r * r;
    sum += shell * kernel_norm<Dim>(k, h) * kernel_shape(k, r / h);
  }
  return sum * kernel_support * h / n;
}

TEST(Kernel, IntegralIsOne) {
  for (const Kernel k : kernels) {
    EXPECT_NEAR(integral<2>(k, 0.7), 1.0, 1e-8);
    EXPECT_NEAR(integral<3>(k, 0.7), 1.0, 1e-8);
  }
}

TEST(Kernel, SlopeIsTheDerivative) {
  for (const Kernel k : kernels) {
    for (double q = 0.01; q < 2.2; q += 0.03) {
      const double d = 1e-6;
      const double slope = -(kernel_shape(k, q + d) - kernel_shape(k, q - d)) / (2.0 * d) / q;
      EXPECT_NEAR(kernel_slope(k, q), slope, 1e-7) << q;
    }
    EXPECT_TRUE(std::isfinite(kernel_slope(k, 0.0)));
    EXPECT_EQ(kernel_slope(k, 2.0), 0.0);
    EXPECT_EQ(kernel_shape(k, 2.5), 0.0);
  }
}

}  // namespace
}  // namespace fpz::sph::test
