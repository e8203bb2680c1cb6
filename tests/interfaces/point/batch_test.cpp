#include "fpz/point/batch.hpp"

#include <gtest/gtest.h>

#include "fpz/point/point_update.hpp"
#include "support/paths.hpp"

namespace fpz::point {
namespace {

constexpr std::size_t points = 700;

/// An array of `points` x `size` numbers, point by point or component by component, with gaps.
class Block {
 public:
  Block(std::size_t size, bool by_point) : size_(size), by_point_(by_point), numbers_(points * size * 2, gap) {
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t k = 0; k < size; ++k) at(i, k) = 0.0;
    }
  }
  static constexpr double gap = -7.0;
  double& at(std::size_t i, std::size_t k) {
    return numbers_[i * std::size_t(view().point) + k * std::size_t(view().component)];
  }
  [[nodiscard]] View<double> view() {
    const auto n = static_cast<std::ptrdiff_t>(by_point_ ? size_ : points);
    return by_point_ ? View<double>{numbers_.data(), 2 * n, 2} : View<double>{numbers_.data(), 2, 2 * n};
  }
  [[nodiscard]] View<const double> input() { return {view().data, view().point, view().component}; }

 private:
  std::size_t size_;
  bool by_point_;
  std::vector<double> numbers_;
};

/// How far point i has gone: some stay intact, some crack, some have cracked before.
double share(std::size_t i, int step) { return 0.02 * double(i % 50) * (step == 0 ? 0.4 : 0.6); }

template <int Dim>
void expect_single_updates(const Behaviour& b, const Tensor<double, Dim>& leg, bool by_point, bool in_place,
                           bool with_lengths, int threads) {
  constexpr std::size_t n = tensor_size<Dim>;
  Block begin(state_size<Dim>, by_point), other(state_size<Dim>, by_point), increments(n, by_point);
  Block tangents(n * n, by_point), energies(2, by_point);
  std::vector<double> lengths(points);
  std::vector<int> statuses(points, -1);
  std::vector<std::array<double, state_size<Dim>>> single(points);
  for (auto& s : single) s.fill(0.0);
  BatchReport report;
  for (int step = 0; step < 2; ++step) {
    for (std::size_t i = 0; i < points; ++i) {
      lengths[i] = b.parameters.rve_length * (1.0 + double(i % 3));
      for (std::size_t k = 0; k < n; ++k) increments.at(i, k) = leg[int(k)] * share(i, step);
    }
    Block& end = in_place ? begin : other;
    BatchArrays a{points, begin.input(), increments.input(), end.view(), {}, {}};
    a.tangents = tangents.view();
    a.energies = energies.view();
    a.lengths = with_lengths ? lengths.data() : nullptr;
    a.statuses = statuses.data();
    report = update_batch<Dim>(b, a, threads);
    ASSERT_TRUE(report.ok()) << last_message();
    for (std::size_t i = 0; i < points; ++i) {
      Behaviour own = b;
      if (with_lengths) set_rve_length(own.material, lengths[i]);
      double increment[n], tangent[n * n];
      for (std::size_t k = 0; k < n; ++k) increment[k] = increments.at(i, k);
      const Outcome out = update_flat<Dim>(own, single[i].data(), increment, single[i].data(), tangent);
      ASSERT_TRUE(out.ok());
      for (std::size_t k = 0; k < state_size<Dim>; ++k) ASSERT_EQ(end.at(i, k), single[i][k]) << state_names(Dim)[k];
      for (std::size_t k = 0; k < n * n; ++k) ASSERT_EQ(tangents.at(i, k), tangent[k]);
      ASSERT_EQ(energies.at(i, 0), out.stored_energy);
      ASSERT_EQ(energies.at(i, 1), out.dissipated_energy);
      ASSERT_EQ(statuses[i], 0);
    }
    if (!in_place) std::swap(begin, other);
  }
  EXPECT_GT(report.new_cracks, 100U);
  EXPECT_GT(report.cracked, report.new_cracks);
  EXPECT_LT(report.cracked, points);
}

TEST(PointBatch, IsTheSingleUpdateOfEveryPoint) {
  const Behaviour plane = make_behaviour(Setting::plane_strain, Statement{test::table1(1e-3), {}});
  const Behaviour solid = make_behaviour(Setting::three_d, Statement{test::table1(1e-3), {}});
  for (const int threads : {1, 2}) {
    expect_single_updates<2>(plane, test::strain2(4e-3, -1e-3, 2e-3), true, true, false, threads);
    expect_single_updates<2>(plane, test::strain2(4e-3, -1e-3, 2e-3), false, false, true, threads);
    expect_single_updates<3>(solid, test::strain3(4e-3, -1e-3, 0, 2e-3, 1e-3, 0), true, false, true, threads);
    expect_single_updates<3>(solid, test::strain3(4e-3, -1e-3, 0, 2e-3, 1e-3, 0), false, true, false, threads);
  }
}

TEST(PointBatch, PointsThatFailKeepTheirBeginAndTheFirstIsNamed) {
  const Behaviour b = make_behaviour(Setting::plane_strain, Statement{test::table1(1e-3), {}});
  Block states(state_size<2>, true), increments(3, true), energies(2, true);
  std::vector<double> lengths(points, 1e-3);
  std::vector<int> statuses(points);
  for (std::size_t i = 0; i < points; ++i) increments.at(i, 0) = 2e-3;
  lengths[300] = 1.0;  // snaps back
  lengths[500] = -1.0;
  states.at(600, 6) = 0.5;  // no state
  BatchArrays a{points, states.input(), increments.input(), states.view(), {}, {}};
  a.lengths = lengths.data();
  a.statuses = statuses.data();
  a.energies = energies.view();
  const BatchReport report = update_batch<2>(b, a, 2);
  EXPECT_EQ(report.failed, 3U);
  EXPECT_EQ(report.first_failed, 300U);
  EXPECT_EQ(report.first_status, Status::snap_back);
  EXPECT_EQ(last_message().find("point 300: snap_back: "), 0U) << last_message();
  EXPECT_NE(last_message().find("rve_length = 1 here"), std::string::npos) << last_message();
  for (const std::size_t i : {300U, 500U, 600U}) {
    EXPECT_EQ(states.at(i, 0), 0.0);
    EXPECT_NE(statuses[i], 0);
  }
  EXPECT_EQ(states.at(600, 6), 0.5);
  EXPECT_EQ(states.at(301, 0), 2e-3);
  EXPECT_EQ(statuses[301], 0);
}

}  // namespace
}  // namespace fpz::point
