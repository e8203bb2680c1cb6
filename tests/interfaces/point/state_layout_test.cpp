#include "fpz/point/state_layout.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <set>

#include "support/paths.hpp"

namespace fpz::point {
namespace {

/// A point of the path that has opened, slid and closed a little.
template <int Dim>
State<double, Dim> worn(const test::Path<Dim>& path) {
  const Material<double> m = make_material(path.parameters, path.setting);
  State<double, Dim> s;
  for (std::size_t leg = 0; leg < 3; ++leg) EXPECT_TRUE(update<Dim>(m, {}, s, path.legs[leg], s).ok());
  EXPECT_TRUE(s.cracked);
  return s;
}

template <int Dim>
void expect_round_trip(const State<double, Dim>& s) {
  constexpr std::ptrdiff_t stride = 3;
  std::vector<double> array(state_size<Dim> * stride, -7.0);
  store<Dim>(s, array.data(), stride);
  State<double, Dim> back;
  ASSERT_TRUE(load<Dim>(array.data(), stride, back));
  std::vector<double> again(array.size(), -7.0);
  store<Dim>(back, again.data(), stride);
  EXPECT_EQ(array, again);
  EXPECT_EQ(back.frame, s.frame);
  EXPECT_EQ(back.crack.jump, s.crack.jump);
  EXPECT_EQ(back.crack.integrity, s.crack.integrity);
  EXPECT_EQ(back.crack.dissipated, s.crack.dissipated);
  for (std::size_t k = 0; k < array.size(); ++k) {
    EXPECT_TRUE(k % stride == 0 || array[k] == -7.0) << "written between the numbers";
  }
}

TEST(StateLayout, RoundTrip) {
  expect_round_trip<2>(worn(test::four_stage()));
  expect_round_trip<3>(worn(test::rotating_shear()));
  State2 intact;
  intact.strain << 1e-5, -2e-5, 3e-5;
  intact.stress << 1.0, 2.0, 3.0;
  expect_round_trip<2>(intact);
}

template <int Dim>
void expect_names() {
  const std::vector<std::string>& names = state_names(Dim);
  EXPECT_EQ(names.size(), state_size<Dim>);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), state_size<Dim>);
}

TEST(StateLayout, NamesSayWhereANumberIs) {
  expect_names<2>();
  expect_names<3>();
  const State3 s = worn(test::rotating_shear());
  double array[state_size<3>];
  store<3>(s, array, 1);
  const auto at = [&](const std::string& name) {
    const auto& names = state_names(3);
    return array[std::find(names.begin(), names.end(), name) - names.begin()];
  };
  EXPECT_EQ(at("strain_xz"), s.strain[4]);
  EXPECT_EQ(at("stress_zz"), s.stress[2]);
  EXPECT_EQ(at("cracked"), 1.0);
  EXPECT_EQ(at("frame_n_y"), s.frame(0, 1));
  EXPECT_EQ(at("frame_s2_x"), s.frame(2, 0));
  EXPECT_EQ(at("jump_s1"), s.crack.jump[1]);
  EXPECT_EQ(at("integrity"), s.crack.integrity);
  EXPECT_EQ(at("damage"), damage(s));
  EXPECT_GT(at("damage"), 0.1);
}

TEST(StateLayout, ZerosAreAFreshPoint) {
  const std::vector<double> zeros(state_size<3>, 0.0);
  State3 s = worn(test::rotating_shear());
  ASSERT_TRUE(load<3>(zeros.data(), 1, s));
  const State3 fresh;
  EXPECT_FALSE(s.cracked);
  EXPECT_EQ(s.frame, fresh.frame);
  EXPECT_EQ(s.crack.integrity, 1.0);
  EXPECT_EQ(s.crack.jump, fresh.crack.jump);
  std::vector<double> written(state_size<3>, 5.0);
  store<3>(fresh, written.data(), 1);
  EXPECT_EQ(written, zeros);
}

TEST(StateLayout, WhatIsNoStateIsRefused) {
  double array[state_size<2>];
  store<2>(worn(test::four_stage()), array, 1);
  const auto refused_with = [&](std::size_t k, double x) {
    double other[state_size<2>];
    std::copy(std::begin(array), std::end(array), other);
    other[k] = x;
    State2 s;
    return !load<2>(other, 1, s);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused_with(0, 1.0));
  for (const double flag : {0.5, 2.0, -1.0, nan}) EXPECT_TRUE(refused_with(6, flag)) << flag;
  EXPECT_TRUE(refused_with(7, 0.7));
  EXPECT_TRUE(refused_with(8, nan));
  EXPECT_TRUE(refused_with(20, 1.5));
  EXPECT_TRUE(refused_with(20, -0.1));
  EXPECT_TRUE(refused_with(20, nan));
}

}  // namespace
}  // namespace fpz::point
