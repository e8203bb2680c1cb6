#include "fpz/driver/plot.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "fpz/io/output.hpp"
#include "helpers.hpp"

namespace fpz::driver {
namespace {

io::Table some_history() { return io::parse_csv(to_csv(run_test(four_stages(100)).history), "history.csv"); }

PlotRequest request(const std::filesystem::path& folder) {
  return {"a 'title' with_underscores", folder, YieldSurface{0.6e6, 1.0e6, 33.0}, false};
}

/// Sets PATH for a scope.
class Path {
 public:
  explicit Path(const std::string& path) : before_(std::getenv("PATH")) { ::setenv("PATH", path.c_str(), 1); }
  ~Path() { ::setenv("PATH", before_.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

 private:
  std::string before_;
};

TEST(Plot, DrawsEveryPicture) {
  const TemporaryFolder folder;
  const PlotOutcome outcome = plot_history(some_history(), request(folder.path()));
  if (outcome.files.empty()) GTEST_SKIP() << outcome.warnings.at(0);
  EXPECT_TRUE(outcome.warnings.empty()) << outcome.warnings.at(0);
  EXPECT_EQ(outcome.files.size(), 16u);
  for (const auto& file : outcome.files) {
    ASSERT_TRUE(std::filesystem::exists(file)) << file;
    EXPECT_GT(std::filesystem::file_size(file), 1000u) << file;
  }
  EXPECT_THROW((void)plot_history(some_history(), request(folder.path())), io::OutputError);
}

TEST(Plot, MissingGnuplotIsAWarning) {
  const TemporaryFolder folder;
  const Path nowhere(folder.path().string());
  const PlotOutcome outcome = plot_history(some_history(), request(folder.path()));
  EXPECT_TRUE(outcome.files.empty());
  ASSERT_EQ(outcome.warnings.size(), 1u);
  EXPECT_NE(outcome.warnings[0].find("apt-get install gnuplot-nox"), std::string::npos);
}

TEST(Plot, AnUncrackedHistoryHasPicturesToo) {
  const TemporaryFolder folder;
  PathTest test = johnstone_test();
  test.stages = {stage(2, {{0, Prescribed::strain, 1e-5}})};
  const PlotOutcome outcome = plot_history(io::parse_csv(to_csv(run_test(test).history), "h"), request(folder.path()));
  if (outcome.files.empty()) GTEST_SKIP() << outcome.warnings.at(0);
  EXPECT_TRUE(outcome.warnings.empty()) << outcome.warnings.at(0);
}

}  // namespace
}  // namespace fpz::driver
