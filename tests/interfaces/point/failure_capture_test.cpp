#include "fpz/point/failure_capture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

#include "fpz/point/point_update.hpp"
#include "support/materials.hpp"
#include "support/temporary_folder.hpp"

namespace fpz::point {
namespace {

std::set<std::string> files_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// A point of the length 1 m, which snaps back as it cracks.
Outcome fail() {
  const Behaviour& b = behaviour_of(Setting::plane_strain, write_properties({test::table1(1.0), {}}));
  State2 s;
  Tensor<double, 2> increment;
  increment << 1e-2, 0.0, 0.0;
  return update_point<2>(b, s, increment, s, nullptr);
}

class FailureCapture : public testing::Test {
 protected:
  FailureCapture() { set_capture_folder((folder_.path() / "new" / "folder").string()); }
  ~FailureCapture() override { set_capture_folder(""); }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path() / "new" / "folder"; }

 private:
  test::TemporaryFolder folder_;
};

// What is written is replayed in tests/interfaces/umat and c, where the driver is.
TEST_F(FailureCapture, WritesTheUpdateAndSaysWhere) {
  ASSERT_EQ(fail().status, Status::snap_back);
  const std::set<std::string> files = files_in(folder());
  ASSERT_EQ(files.size(), 1U);
  const std::filesystem::path file = folder() / *files.begin();
  EXPECT_NE(last_message().find("captured: fpz-driver replay " + file.string()), std::string::npos) << last_message();
  const std::string text = test::text_of(file);
  EXPECT_NE(text.find("\"rve_length\": 1,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"status\": \"snap_back\""), std::string::npos) << text;
}

TEST_F(FailureCapture, ThreadsDoNotCollide) {
  constexpr int each = 5;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([] {
      for (int i = 0; i < each; ++i) EXPECT_EQ(fail().status, Status::snap_back);
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(files_in(folder()).size(), 4U * each);
}

TEST_F(FailureCapture, AFullDiskIsNotFilled) {
  for (int i = 0; i < 2 * most_captures; ++i) (void)fail();
  EXPECT_LE(files_in(folder()).size(), std::size_t(most_captures));
  EXPECT_NE(last_message().find("not captured: 100 failures of this process have been"), std::string::npos);
}

TEST(FailureCaptureOff, NobodyAskedAndNothingIsSaid) {
  ASSERT_EQ(fail().status, Status::snap_back);
  EXPECT_EQ(last_message().find("captur"), std::string::npos) << last_message();
}

TEST(FailureCaptureOff, AFolderThatCannotBeMadeIsSaid) {
  set_capture_folder("/dev/null/folder");
  ASSERT_EQ(fail().status, Status::snap_back);
  EXPECT_NE(last_message().find("cannot be captured: /dev/null/folder/fpz-"), std::string::npos) << last_message();
  set_capture_folder("");
}

TEST(FailureCaptureOff, TheEnvironmentAsks) {
  const test::TemporaryFolder folder;
  ::setenv(capture_variable, folder.path().c_str(), 1);
  (void)fail();
  ::unsetenv(capture_variable);
  EXPECT_EQ(files_in(folder.path()).size(), 1U);
}

}  // namespace
}  // namespace fpz::point
