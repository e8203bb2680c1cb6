#include "fpz/batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/materials.hpp"

namespace fpz::test {
namespace {

template <int Dim>
struct Cloud {
  std::vector<State<double, Dim>> begin;
  std::vector<Tensor<double, Dim>> increments;
};

/// Points from untouched to fully open: each is first strained at random, then gets its increment.
template <int Dim>
Cloud<Dim> random_cloud(const Material<double>& m, const Options& o, std::size_t size) {
  std::mt19937_64 rng(7);
  std::normal_distribution<double> normal(0.0, 1e-3);
  Cloud<Dim> cloud;
  for (std::size_t i = 0; i < size; ++i) {
    State<double, Dim> s;
    Tensor<double, Dim> a, b;
    for (int k = 0; k < tensor_size<Dim>; ++k) {
      a[k] = normal(rng);
      b[k] = 0.1 * normal(rng);
    }
    EXPECT_TRUE(update<Dim>(m, o, s, a, s).ok());
    cloud.begin.push_back(s);
    cloud.increments.push_back(b);
  }
  return cloud;
}

template <int Dim>
void expect_same(const State<double, Dim>& a, const State<double, Dim>& b) {
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(a.strain, b.strain);
  ASSERT_EQ(a.cracked, b.cracked);
  if (!a.cracked) return;
  EXPECT_EQ(a.crack.plastic_jump, b.crack.plastic_jump);
  EXPECT_EQ(a.crack.integrity, b.crack.integrity);
  EXPECT_EQ(a.crack.dissipated, b.crack.dissipated);
}

template <int Dim>
void batch_equals_points(Setting setting) {
  const Material<double> m = make_material(table1(1e-3), setting);
  Options o;
  o.method = Method::implicit;
  const Cloud<Dim> cloud = random_cloud<Dim>(m, o, 3000);
  for (const int threads : {1, 2, 3}) {
    std::vector<State<double, Dim>> end(cloud.begin.size());
    std::vector<Tangent<Dim>> tangents(cloud.begin.size());
    const BatchReport report = update_batch<Dim>(m, o, cloud.begin, cloud.increments, end, tangents, threads);
    EXPECT_TRUE(report.ok());
    std::size_t cracked = 0;
    for (std::size_t i = 0; i < end.size(); ++i) {
      State<double, Dim> one;
      Tangent<Dim> tangent;
      ASSERT_TRUE(update_with_tangent<Dim>(m, o, cloud.begin[i], cloud.increments[i], one, tangent).ok());
      expect_same<Dim>(one, end[i]);
      EXPECT_EQ(tangent, tangents[i]);
      cracked += one.cracked ? 1 : 0;
    }
    EXPECT_EQ(report.cracked, cracked);
    EXPECT_GT(cracked, end.size() / 4);
    EXPECT_LT(cracked, end.size());
    EXPECT_GT(report.new_cracks, 0u);
    EXPECT_GT(report.iterations, 0);
  }
}

TEST(Batch, EqualsSinglePoints2DOnAnyNumberOfThreads) { batch_equals_points<2>(Setting::plane_strain); }
TEST(Batch, EqualsSinglePoints3DOnAnyNumberOfThreads) { batch_equals_points<3>(Setting::three_d); }

TEST(Batch, InPlace) {
  const Material<double> m = make_material(table1(1e-3), Setting::plane_strain);
  const Options o;
  const Cloud<2> cloud = random_cloud<2>(m, o, 500);
  std::vector<State2> end(cloud.begin.size());
  std::vector<State2> same = cloud.begin;
  ASSERT_TRUE(update_batch<2>(m, o, cloud.begin, cloud.increments, end).ok());
  ASSERT_TRUE(update_batch<2>(m, o, same, cloud.increments, same).ok());
  for (std::size_t i = 0; i < end.size(); ++i) expect_same<2>(end[i], same[i]);
}

TEST(Batch, NamesTheFirstFailingPointAndUpdatesTheOthers) {
  const Material<double> m = make_material(table1(1e-3), Setting::plane_strain);
  const Options o;
  Cloud<2> cloud = random_cloud<2>(m, o, 2000);
  cloud.increments[1503][1] = std::nan("");
  cloud.increments[777][0] = INFINITY;
  for (const int threads : {1, 2}) {
    std::vector<State2> end(cloud.begin.size());
    const BatchReport report = update_batch<2>(m, o, cloud.begin, cloud.increments, end, {}, threads);
    EXPECT_EQ(report.failed, 2u);
    EXPECT_EQ(report.first_failed, 777u);
    EXPECT_EQ(report.first_status, Status::invalid_input);
    expect_same<2>(end[777], cloud.begin[777]);
    EXPECT_NE(end[778].strain, cloud.begin[778].strain);
    EXPECT_NE(end[1999].strain, cloud.begin[1999].strain);
  }
}

TEST(Batch, RefusesSpansOfDifferentLengths) {
  const Material<double> m = make_material(table1(), Setting::plane_strain);
  std::vector<State2> begin(3), end(2);
  std::vector<Tensor<double, 2>> d(3, Tensor<double, 2>::Zero());
  EXPECT_THROW((void)update_batch<2>(m, Options{}, begin, d, end), std::invalid_argument);
}

}  // namespace
}  // namespace fpz::test
