#include "fpz/point/point_update.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "fpz/energy.hpp"
#include "support/paths.hpp"

namespace fpz::point {
namespace {

/// The path in `parts` increments a leg, by the flat update and by the library side by side: the same numbers.
template <int Dim>
void expect_the_librarys_numbers(const test::Path<Dim>& path, int parts, bool with_tangent) {
  const Behaviour& b = behaviour_of(path.setting, write_properties({path.parameters, {}}));
  const Material<double> m = make_material(path.parameters, path.setting);
  constexpr int n = tensor_size<Dim>;
  State<double, Dim> s;
  double flat[state_size<Dim>] = {};
  double tangent[std::size_t{n} * n];
  int cracked = 0;
  for (const Tensor<double, Dim>& leg : path.legs) {
    const Tensor<double, Dim> increment = leg / parts;
    for (int k = 0; k < parts; ++k) {
      Tangent<Dim> expected_tangent = Tangent<Dim>::Zero();
      const Report report = with_tangent ? update_with_tangent<Dim>(m, {}, s, increment, s, expected_tangent)
                                         : update<Dim>(m, {}, s, increment, s);
      ASSERT_TRUE(report.ok());
      const Outcome out = update_flat<Dim>(b, flat, increment.data(), flat, with_tangent ? tangent : nullptr);
      ASSERT_TRUE(out.ok());
      EXPECT_EQ(out.onset, report.onset);
      EXPECT_EQ(out.iterations, report.iterations);
      EXPECT_EQ(out.stored_energy, stored_energy(m, s));
      EXPECT_EQ(out.dissipated_energy, dissipated_energy(m, s));
      double expected[state_size<Dim>];
      store<Dim>(s, expected, 1);
      for (std::size_t i = 0; i < state_size<Dim>; ++i) ASSERT_EQ(flat[i], expected[i]) << state_names(Dim)[i];
      for (int i = 0; with_tangent && i < n * n; ++i) ASSERT_EQ(tangent[i], expected_tangent(i / n, i % n));
      cracked += s.cracked ? 1 : 0;
    }
  }
  EXPECT_GT(cracked, parts);
}

TEST(PointUpdate, GivesTheLibrarysNumbers) {
  for (const bool with_tangent : {false, true}) {
    for (const auto& path : test::in_every_zone<2>({test::four_stage(), test::plane_stress_cycle()})) {
      expect_the_librarys_numbers<2>(path, 50, with_tangent);
    }
    expect_the_librarys_numbers<3>(test::rotating_shear(), 10, with_tangent);
  }
}

// Length in mm, stress in MPa (N/mm^2), energies in N/mm^2: the model has no unit of its own.
TEST(PointUpdate, AnyConsistentUnitsDo) {
  const test::Path<2> path = test::four_stage();
  Parameters p = path.parameters;
  for (double Parameters::*stress :
       {&Parameters::young_modulus, &Parameters::tensile_strength, &Parameters::cohesion}) {
    p.*stress *= 1e-6;
  }
  for (double Parameters::*stiffness : {&Parameters::normal_stiffness, &Parameters::shear_stiffness}) {
    p.*stiffness *= 1e-9;
  }
  for (double Parameters::*length : {&Parameters::delta0, &Parameters::rve_length}) p.*length *= 1e3;
  const Behaviour metres = make_behaviour(path.setting, Statement{path.parameters, {}});
  const Behaviour millimetres = make_behaviour(path.setting, Statement{p, {}});
  State2 a, b;
  for (const Tensor<double, 2>& leg : path.legs) {
    for (int k = 0; k < 20; ++k) {
      const Tensor<double, 2> increment = leg / 20;
      const Outcome of_a = update_point<2>(metres, a, increment, a, nullptr);
      const Outcome of_b = update_point<2>(millimetres, b, increment, b, nullptr);
      ASSERT_TRUE(of_a.ok() && of_b.ok());
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(b.stress[i], a.stress[i] * 1e-6, 1e-9 * p.tensile_strength);
      EXPECT_NEAR(of_b.dissipated_energy, of_a.dissipated_energy * 1e-6, 1e-9 * of_a.dissipated_energy * 1e-6 + 1e-20);
    }
  }
  EXPECT_GT(damage(b), 0.5);
}

TEST(PointUpdate, FailureKeepsTheBeginAndSaysWhatHelps) {
  const Behaviour& b = behaviour_of(Setting::plane_strain, write_properties({test::table1(1.0), {}}));
  double begin[state_size<2>] = {};
  const double small[] = {1e-5, 2e-5, 3e-5}, large[] = {1e-2, 0.0, 0.0};
  ASSERT_TRUE(update_flat<2>(b, begin, small, begin, nullptr).ok());
  double end[state_size<2>];
  double tangent[9] = {42.0};
  const Outcome out = update_flat<2>(b, begin, large, end, tangent);
  EXPECT_EQ(out.status, Status::snap_back);
  for (std::size_t k = 0; k < state_size<2>; ++k) EXPECT_EQ(end[k], begin[k]);
  EXPECT_EQ(tangent[0], 42.0);
  EXPECT_GT(out.stored_energy, 0.0);
  EXPECT_EQ(last_message().find("snap_back: "), 0U);
  EXPECT_NE(last_message().find("rve_length = 1 here; in mode I it must be < "), std::string::npos) << last_message();
}

TEST(PointUpdate, WhatIsNotFiniteOrNoStateIsInvalid) {
  const Behaviour& b = behaviour_of(Setting::plane_strain, write_properties({test::table1(), {}}));
  double state[state_size<2>] = {};
  double increment[] = {1e-5, std::numeric_limits<double>::quiet_NaN(), 0.0};
  EXPECT_EQ(update_flat<2>(b, state, increment, state, nullptr).status, Status::invalid_input);
  for (const double x : state) EXPECT_EQ(x, 0.0);
  increment[1] = 0.0;
  state[6] = 0.5;
  double end[state_size<2>] = {};
  EXPECT_EQ(update_flat<2>(b, state, increment, end, nullptr).status, Status::invalid_input);
  EXPECT_EQ(end[6], 0.5);
  EXPECT_NE(last_message().find("\"cracked\" is 0 or 1"), std::string::npos);
}

}  // namespace
}  // namespace fpz::point
