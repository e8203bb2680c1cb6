// The width of the band over which a crack opens, and what it is for: the energy per crack area.
#include "fpz/sph/band.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double pi = std::numbers::pi;

Vector direction(double degrees) { return vec(std::cos(degrees * pi / 180.0), std::sin(degrees * pi / 180.0)); }

/// Offsets to the 24 next points of the lattice of a and b.
std::vector<Vector> offsets(const Vector& a, const Vector& b) {
  std::vector<Vector> all;
  for (int j = -2; j <= 2; ++j) {
    for (int i = -2; i <= 2; ++i) {
      if (i != 0 || j != 0) all.push_back(i * a + j * b);
    }
  }
  return all;
}

/// On a square lattice the two rows that open: 2 d / (|cos| + |sin|), whichever way the lattice is turned.
TEST(Band, SquareLattice) {
  const double d = 2e-3;
  for (const double turned : {0.0, 17.0}) {
    const std::vector<Vector> square = offsets(d * direction(turned), d * direction(turned + 90.0));
    for (const double angle : {0.0, 10.0, 30.0, 45.0, 60.0, 90.0, 200.0}) {
      const Vector n = direction(angle);
      const double exact = 2.0 * d / (std::abs(n[0]) + std::abs(n[1]));
      EXPECT_NEAR(band_width<2>(d, direction(angle + turned), square), exact, 1e-15) << angle;
    }
  }
}

/// Crack along the columns of a sheared lattice: two columns, whatever the angle between them and the rows.
TEST(Band, ShearedLattice) {
  const double d = 2e-3;
  for (const double angle : {0.0, 10.0, 20.0, 30.0}) {
    const double shift = std::tan(angle * pi / 180.0);
    const std::vector<Vector> sheared = offsets(vec(d, 0.0), vec(-shift * d, d));
    const double apart = d * std::cos(angle * pi / 180.0);  // of the columns
    EXPECT_NEAR(band_width<2>(d, direction(angle), sheared), 2.0 * apart, 0.02 * 2.0 * apart) << angle;
  }
}

TEST(Band, NearestNeighboursInThreeDimensions) {
  std::vector<Vec<double, 3>> cubic;
  for (int c = 0; c < 3; ++c) {
    cubic.push_back(Vec<double, 3>::Unit(c));
    cubic.push_back(-Vec<double, 3>::Unit(c));
  }
  EXPECT_NEAR(band_width<3>(1.0, Vec<double, 3>::Unit(1), cubic), 2.0, 1e-15);
  const Vec<double, 3> diagonal = Vec<double, 3>::Constant(std::sqrt(1.0 / 3.0));
  EXPECT_NEAR(band_width<3>(1.0, diagonal, cubic), 2.0 * std::sqrt(1.0 / 3.0), 1e-15);
}

TEST(Band, WithoutNeighboursOffThePlaneItIsTwoSizes) {
  EXPECT_EQ(band_width<2>(1.0, vec(1.0, 0.0), {}), 2.0);
  const std::array<Vector, 2> along = {vec(0.0, 1.0), vec(0.0, -1.0)};
  EXPECT_EQ(band_width<2>(1.0, vec(1.0, 0.0), along), 2.0);
}

}  // namespace
}  // namespace fpz::sph::test
