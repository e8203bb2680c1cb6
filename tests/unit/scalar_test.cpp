#include "fpz/scalar.hpp"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>

namespace fpz::test {
namespace {

/// Every operation the library uses on a scalar.
template <class T>
T everything(const T& x, const T& y) {
  using std::abs;
  using std::cos;
  using std::exp;
  using std::sin;
  using std::sqrt;
  using std::tan;
  T z = sqrt(x * y + 2.0) / (1.5 + x) - exp(-y / x) * tan(x * 0.1);
  z += 2.0 * abs(x - 3.0 * y) - cos(x) * sin(y);
  z -= y / 4.0;
  z *= 1.0 - x;
  z /= x + y;
  return -z + 3.0 / y - (2.0 - x) * y;
}

TEST(Dual, AgreesWithCeresJet) {
  for (const double x : {0.3, 1.7, 40.0}) {
    for (const double y : {0.2, 5.0}) {
      const auto d = everything(Dual<2>::seed(x, 0), Dual<2>::seed(y, 1));
      const auto j = everything(ceres::Jet<double, 2>(x, 0), ceres::Jet<double, 2>(y, 1));
      EXPECT_DOUBLE_EQ(d.val, j.a);
      EXPECT_DOUBLE_EQ(d.val, everything(x, y));
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(d.grad[k], j.v[k], 1e-13 * (1.0 + std::abs(j.v[k])));
    }
  }
}

TEST(Dual, ComparesByValue) {
  const Dual<1> a = Dual<1>::seed(1.0, 0);
  const Dual<1> b(2.0);
  EXPECT_TRUE(a < b && a <= b && b > a && b >= a);
  EXPECT_EQ(value(a), 1.0);
  EXPECT_EQ(value(2.5), 2.5);
  EXPECT_EQ(value(ceres::Jet<double, 1>(3.0)), 3.0);
}

}  // namespace
}  // namespace fpz::test
