#include "fpz/jump_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fpz/energy.hpp"
#include "fpz/update.hpp"
#include "support/materials.hpp"

namespace fpz::test {
namespace {

/// Uniaxial strain far beyond the snap-back length (14.4 mm): the closed form of mode I along the whole path.
TEST(Continuation, FollowsModeOneThroughSnapBack) {
  const Parameters p = table1(30e-3);
  const Material<double> m = make_material(p, Setting::plane_strain);
  const double modulus = m.bulk.lambda + 2.0 * m.bulk.mu;
  Options o;
  o.tolerance = 1e-9;
  State2 s;
  Tensor<double, 2> direction;
  direction << 2.0, 0.0, 0.0;  // its size does not matter
  double kappa = 0.0;
  double smallest = 1.0;
  for (const double step : {1e-6, 3e-6, 5e-6, 1e-5, 4e-5, 1e-4}) {
    double load = 0.0;
    const double before = s.strain[0];
    ASSERT_TRUE(update_controlled<2>(m, o, s, direction, step, s, load).ok());
    kappa += step;
    const double traction = p.tensile_strength * std::exp(-kappa / p.delta0);
    EXPECT_NEAR(s.crack.traction[0], traction, 1e-8 * p.tensile_strength);
    EXPECT_NEAR(s.strain[0], traction / modulus + kappa / p.rve_length, 1e-11);
    EXPECT_NEAR(load, s.strain[0] - before, 1e-16);
    EXPECT_NEAR(s.crack.plastic_jump[0] + s.crack.slip, kappa, 1e-12 * kappa);
    smallest = std::min(smallest, load);
  }
  EXPECT_LT(smallest, 0.0);  // the strain did turn round
  // Strain control cannot take the first of these steps.
  State2 onset;
  Tensor<double, 2> d;
  d << p.tensile_strength / modulus + 1e-6, 0.0, 0.0;
  EXPECT_EQ(update<2>(m, o, onset, d, onset).status, Status::snap_back);
}

/// Where strain control works, jump control must find the same states: mixed mode, sliding under compression, 3-D.
template <int Dim>
void agrees_with_strain_control(Setting setting, const Tensor<double, Dim>& first, const Tensor<double, Dim>& second) {
  const Material<double> m = make_material(table1(1e-3), setting);
  Options o;
  o.tolerance = 1e-9;
  State<double, Dim> s;
  ASSERT_TRUE(update<Dim>(m, o, s, first, s).ok());
  for (const double step : {1e-7, 1e-6, 5e-6, 2e-5}) {
    double load = 0.0;
    State<double, Dim> controlled;
    ASSERT_TRUE(update_controlled<Dim>(m, o, s, second, step, controlled, load).ok());
    State<double, Dim> strained;
    const Tensor<double, Dim> d = second * (load / second.template lpNorm<Eigen::Infinity>());
    ASSERT_TRUE(update<Dim>(m, o, s, d, strained).ok());
    EXPECT_LE((strained.stress - controlled.stress).norm(), 1e-7 * m.law.surface.tensile_strength);
    EXPECT_NEAR(damage(strained), damage(controlled), 1e-8);
    EXPECT_NEAR(dissipated_energy(m, strained), dissipated_energy(m, controlled),
                1e-7 * m.law.surface.tensile_strength * m.law.softening.length() / m.rve_length);
    s = controlled;
  }
}

TEST(Continuation, AgreesWithStrainControlInMixedMode) {
  Tensor<double, 2> first, second;
  first << 3e-3, 0.0, 0.0;
  second << 1.0, -0.2, 3.0;
  agrees_with_strain_control<2>(Setting::plane_strain, first, second);
}

TEST(Continuation, AgreesWithStrainControlInCompressiveShear) {
  Tensor<double, 2> first, second;
  first << -2e-3, 0.0, 0.0;
  second << 0.0, 0.0, 1.0;
  agrees_with_strain_control<2>(Setting::plane_strain, first, second);
}

TEST(Continuation, AgreesWithStrainControlIn3D) {
  Tensor<double, 3> first, second;
  first << 3e-3, 1e-4, 0.0, 2e-4, 0.0, 0.0;
  second << 1.0, 0.0, 0.2, 2.0, -1.5, 0.3;
  agrees_with_strain_control<3>(Setting::three_d, first, second);
}

TEST(Continuation, RefusesWhatItCannotDo) {
  const Material<double> m = make_material(table1(), Setting::plane_strain);
  const Options o;
  State2 end;
  double load = 0.0;
  Tensor<double, 2> none = Tensor<double, 2>::Zero();
  EXPECT_EQ(update_controlled<2>(m, o, State2(), none, 1e-6, end, load).status, Status::invalid_input);
  Tensor<double, 2> squeeze;
  squeeze << -1.0, -1.0, 0.0;  // isotropic compression never cracks
  EXPECT_EQ(update_controlled<2>(m, o, State2(), squeeze, 1e-6, end, load).status, Status::non_convergence);
  EXPECT_FALSE(end.cracked);
  EXPECT_EQ(end.stress, none);
}

}  // namespace
}  // namespace fpz::test
