// What the corrected gradient and its adjoint do exactly.
#include <Eigen/LU>
#include <cmath>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using Matrix = Mat<double, 2, 2>;

Matrix matrix(double xx, double xy, double yx, double yy) {
  Matrix m;
  m << xx, xy, yx, yy;
  return m;
}

const Matrix velocity_gradient = matrix(30.0, -20.0, 50.0, 10.0);  // 1/s

/// Neighbour lists with any number of particles and any gaps: a jittered block with a hole and ragged edges.
RunSetup<2> ragged() {
  RunSetup<2> s = block(14, 11, 0.25);
  RunSetup<2> out = s;
  out.arrangement = {};
  out.arrangement.spacing = s.arrangement.spacing;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const Vector& x = s.arrangement.position[i];
    if ((x - vec(6e-3, 5e-3)).norm() < 1.8e-3 || x[0] + x[1] < 3e-3) continue;
    out.arrangement.add(x, s.arrangement.volume[i]);
  }
  set_velocity(out, [](const Vector& x) { return Vector(velocity_gradient * x); });
  return out;
}

TEST(Gradient, LinearFieldIsExactInTheReferenceConfiguration) {
  for (const Kernel kernel : {Kernel::cubic_spline, Kernel::wendland_c2}) {
    for (const MomentumForm form : {MomentumForm::adjoint, MomentumForm::paper}) {
      RunSetup<2> s = ragged();
      s.options.kernel = kernel;
      s.options.momentum = form;
      Simulation<2> run(s);
      advance(run, 1);
      const Particles<2>& p = run.particles();
      for (std::size_t i = 0; i < p.count; ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
          const double exact = run.time_step() * velocity_gradient(static_cast<int>(k / 2), static_cast<int>(k % 2));
          EXPECT_NEAR(p.gradient[k][i], exact, 1e-12 * run.time_step() * 50.0) << "particle " << p.id[i];
        }
      }
    }
  }
}

/// F = I + dt A: rotation and stretch of every particle's step must be those of F.
TEST(Gradient, LinearMotionIsExactInTheUpdatedConfiguration) {
  for (const Kernel kernel : {Kernel::cubic_spline, Kernel::wendland_c2}) {
    RunSetup<2> s = ragged();
    s.options.configuration = Configuration::updated;
    s.options.kernel = kernel;
    s.options.viscosity_alpha = 0.0;  // acts from the start, before any stress
    Simulation<2> run(s);
    advance(run, 1);
    const Matrix f = Matrix::Identity() + run.time_step() * velocity_gradient;
    const double c = f(0, 0) + f(1, 1);
    const double d = f(1, 0) - f(0, 1);
    const double r = std::hypot(c, d);
    const Matrix q = matrix(c / r, -d / r, d / r, c / r);
    const Matrix u = q.transpose() * f;
    const Particles<2>& p = run.particles();
    for (std::size_t i = 0; i < p.count; ++i) {
      EXPECT_NEAR(p.rotation[1][i], d / r, 1e-14);
      EXPECT_NEAR(p.strain[0][i], u(0, 0) - 1.0, 3e-15);
      EXPECT_NEAR(p.strain[1][i], u(1, 1) - 1.0, 3e-15);
      EXPECT_NEAR(p.strain[2][i], u(0, 1), 3e-15);
      EXPECT_NEAR(p.density[i], s.parameters.density / f.determinant(), 1e-11);
    }
  }
}

/// One step of linear motion makes a uniform stress. On a lattice the force on every particle with a full neighbourhood
/// of particles with full neighbourhoods is zero, in both forms.
TEST(Gradient, ConstantStressGivesNoForceInsideALattice) {
  for (const Variant& v : variants) {
    RunSetup<2> s = block(16, 15);
    s.options.configuration = v.configuration;
    s.options.momentum = v.momentum;
    s.options.viscosity_alpha = 0.0;
    set_velocity(s, [](const Vector& x) { return Vector(velocity_gradient * x); });
    Simulation<2> run(s);
    advance(run, 1);
    const Particles<2>& p = run.particles();
    double boundary = 0.0;
    double inside = 0.0;
    for (std::size_t i = 0; i < p.count; ++i) {
      const double f = p.mass[i] * std::hypot(p.acceleration[0][i], p.acceleration[1][i]);
      const double x = p.start[0][i] * 1e3;
      const double y = p.start[1][i] * 1e3;
      double& largest = x > 5.0 && x < 11.0 && y > 5.0 && y < 10.0 ? inside : boundary;
      largest = std::max(largest, f);
    }
    EXPECT_LT(inside, 1e-11 * boundary) << to_string(v.configuration) << to_string(v.momentum);
  }
}

/// On any arrangement the adjoint force does exactly the virtual work of the stress on a linear velocity field:
/// sum f.(A x) = -sum V sigma : A. (Neither form makes the force vanish particle by particle there.)
TEST(Gradient, AdjointForceDoesTheWorkOfTheStress) {
  for (const Configuration configuration : {Configuration::reference, Configuration::updated}) {
    for (const Kernel kernel : {Kernel::cubic_spline, Kernel::wendland_c2}) {
      RunSetup<2> s = ragged();
      s.options.configuration = configuration;
      s.options.kernel = kernel;
      s.options.viscosity_alpha = 0.0;
      s.options.artificial_stress = 0.0;
      Simulation<2> run(s);
      advance(run, 1);
      const Particles<2>& p = run.particles();
      const bool updated = configuration == Configuration::updated;
      // In `updated` stress is in space and the gradients are those of the current positions.
      const double cosine = updated ? 1.0 : p.rotation[0][0];
      const double sine = updated ? 0.0 : p.rotation[1][0];
      const Matrix r = matrix(cosine, -sine, sine, cosine);
      const Fields<2>& x = updated ? p.position : p.start;
      const Matrix other = matrix(1.0, 2.0, -3.0, 0.5);
      double work = 0.0;
      double exact = 0.0;
      for (std::size_t i = 0; i < p.count; ++i) {
        const Vector f = p.mass[i] * vec(p.acceleration[0][i], p.acceleration[1][i]);
        work += f.dot(other * vec(x[0][i], x[1][i]));
        const Matrix stress = matrix(p.stress[0][i], p.stress[2][i], p.stress[2][i], p.stress[1][i]);
        exact -= p.volume[i] * (r * stress).cwiseProduct(other).sum();
      }
      EXPECT_NEAR(work, exact, 1e-11 * std::abs(exact));
    }
  }
}

/// Collinear neighbours: the gradient along the line is exact, none is made up across it. A lone particle has none.
TEST(Gradient, DegenerateNeighbourhoods) {
  RunSetup<2> s;
  s.parameters = unbreakable();
  s.arrangement.spacing = 1e-3;
  for (int i = 0; i < 6; ++i) s.arrangement.add(vec(0.6e-3 * i, 0.8e-3 * i), 1e-6);
  s.arrangement.add(vec(1.0, 1.0), 1e-6);
  s.options.threads = 1;
  set_velocity(s, [](const Vector& x) { return Vector(velocity_gradient * x); });
  Simulation<2> run(s);
  advance(run, 1);
  const Vector along = vec(0.6, 0.8);
  const Particles<2>& p = run.particles();
  for (std::size_t i = 0; i < p.count; ++i) {
    const Matrix g = matrix(p.gradient[0][i], p.gradient[1][i], p.gradient[2][i], p.gradient[3][i]);
    const bool lone = p.id[i] == 6;
    const Matrix exact =
        lone ? Matrix(Matrix::Zero()) : Matrix(run.time_step() * velocity_gradient * along * along.transpose());
    EXPECT_LT((g - exact).norm(), 1e-17) << p.id[i];
  }
}

}  // namespace
}  // namespace fpz::sph::test
