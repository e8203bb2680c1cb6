// Constant stress on particles that were moved at random: no force on any particle whose stress it is, inside and at
// free surfaces; linear fields exact, also after cuts. Each of these fails with the vectors of the kernel.
#include <Eigen/LU>
#include <cmath>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using Matrix = Mat<double, 2, 2>;

constexpr double size = 1e-3;  // m, of a particle

/// columns x rows particles moved by up to `moved` spacings, with the lines of their surface; volumes are equal.
RunSetup<2> patch(int columns, int rows, double moved) {
  RunSetup<2> s = block(columns, rows, 0.0, size);
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> shift(-moved * size, moved * size);
  for (Vector& x : s.arrangement.position) x += vec(shift(rng), shift(rng));
  const double width = columns * size, height = rows * size;
  s.arrangement.surface = {{vec(0.0, 0.0), vec(width, 0.0), vec(width, height), vec(0.0, height), vec(0.0, 0.0)}};
  return s;
}

/// One step of the motion in which stress is `axial` along x alone (plane strain), to first order.
Matrix uniaxial_rate(const Parameters& p, double rate) {
  Matrix a = Matrix::Zero();
  a(0, 0) = rate;
  a(1, 1) = -p.poisson_ratio / (1.0 - p.poisson_ratio) * rate;
  return a;
}

/// Largest forces, over stress times spacing, after one step of uniaxial tension between ends that are held.
struct Forces {
  double inside = 0.0, surface = 0.0;
};

Forces forces_in_tension(double moved, Gradient gradient) {
  constexpr int columns = 44, rows = 24;
  RunSetup<2> s = patch(columns, rows, moved);
  s.options.gradient = gradient;
  s.options.zero_energy_control = 0.0;
  const Matrix a = uniaxial_rate(s.parameters, 1.0);  // 1/s: strains of 1e-7, whose squares are below rounding
  set_velocity(s, [&](const Vector& x) { return Vector(a * x); });
  // Prescribed: the ends are no free surfaces of this stress.
  const Motion still{0.0, 0.0};
  add_group(s, {"left", {still, still}, true}, [](const Vector& x) { return x[0] < 3.0 * size; });
  add_group(s, {"right", {still, still}, true}, [](const Vector& x) { return x[0] > (columns - 3) * size; });
  Simulation<2> run(s);
  advance(run, 1);
  const Particles<2>& p = run.particles();
  Forces f;
  double stress = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double x = p.start[0][i] / size, y = p.start[1][i] / size;
    if (x < 12.5 || x > columns - 12.5) continue;  // near the held ends stress is another, and nothing is balanced
    stress = std::max(stress, std::abs(p.stress[0][i]));
    const double force = p.mass[i] * std::hypot(p.acceleration[0][i], p.acceleration[1][i]);
    double& largest = y > 4.0 && y < rows - 4.0 ? f.inside : f.surface;
    largest = std::max(largest, force);
  }
  return {f.inside / (stress * size), f.surface / (stress * size)};
}

TEST(Patch, ConstantStressIsInEquilibrium) {
  for (const double moved : {0.0, 0.1, 0.2, 0.3}) {
    const Forces f = forces_in_tension(moved, Gradient::consistent);
    EXPECT_LT(f.inside, 1e-11) << moved;
    EXPECT_LT(f.surface, 1e-11) << moved;
    if (moved > 0.0) {
      const Forces kernel = forces_in_tension(moved, Gradient::kernel);
      EXPECT_GT(kernel.inside, 1e-2) << moved;
      EXPECT_GT(kernel.surface, 1e-2) << moved;
    }
  }
}

}  // namespace
}  // namespace fpz::sph::test
