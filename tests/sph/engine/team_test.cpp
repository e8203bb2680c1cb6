// The team of threads: every piece once, in every pass, whatever the others do.
#include "team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>
#include <vector>

namespace fpz::sph::detail {
namespace {

TEST(Team, DoesEveryPieceOnce) {
  for (const int size : {1, 2, 3, 7, 40}) {
    Team team(size);
    for (int pass = 0; pass < 2000; ++pass) {
      const int count = (pass * 37) % 101;
      std::vector<int> done(static_cast<std::size_t>(count), 0);
      team.run(count, [&](std::int64_t k) { ++done[static_cast<std::size_t>(k)]; });
      for (const int d : done) ASSERT_EQ(d, 1) << size << " threads, pass " << pass;
    }
  }
}

/// Passes of different kinds in turn, with pauses in which threads fall asleep: a late thread does the work of the
/// pass that is there.
TEST(Team, WorkOfTwoPassesIsNotMixed) {
  Team team(4);
  std::vector<long> a(64, 0), b(48, 0);
  for (int pass = 0; pass < 3000; ++pass) {
    team.run(64, [&](std::int64_t k) { a[static_cast<std::size_t>(k)] += pass; });
    team.run(48, [&](std::int64_t k) { b[static_cast<std::size_t>(k)] -= a[static_cast<std::size_t>(k)]; });
    if (pass % 500 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  long sum = 0, all = 0;
  for (int pass = 0; pass < 3000; ++pass) sum += pass, all += sum;
  for (const long x : a) EXPECT_EQ(x, sum);
  for (const long x : b) EXPECT_EQ(x, -all);
}

/// Two pieces that end only when both are in work at the same time.
TEST(Team, ThreadsShareWork) {
  Team team(2);
  std::atomic<bool> both{false};
  std::atomic<int> inside{0};
  team.run(2, [&](std::int64_t) {
    ++inside;
    while (inside.load() < 2) std::this_thread::yield();
    both = true;
  });
  EXPECT_TRUE(both);
}

TEST(Team, ManyTeamsAtATime) {
  std::vector<std::unique_ptr<Team>> teams;
  for (int k = 0; k < 10; ++k) teams.push_back(std::make_unique<Team>(3));
  std::atomic<int> sum{0};
  for (int round = 0; round < 50; ++round) {
    for (auto& team : teams) team->run(10, [&](std::int64_t k) { sum += static_cast<int>(k); });
  }
  EXPECT_EQ(sum, 50 * 10 * 45);
}

}  // namespace
}  // namespace fpz::sph::detail
