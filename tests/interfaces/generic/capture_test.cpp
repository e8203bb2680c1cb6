// A point that fails in the behaviour writes itself down, and the driver replays it.
#include "fpz/point/failure_capture.hpp"
#include "interfaces/generic/generic_call.hpp"
#include "interfaces/replayed_capture.hpp"
#include "support/materials.hpp"
#include "support/temporary_folder.hpp"

namespace fpz {
namespace {

TEST(GenericCapture, TheDriverReplaysIt) {
  const test::TemporaryFolder folder;
  test::Client c("PlaneStrain", test::table1(1.0));
  c.g1 = {1e-4, 0, 0, 0};
  ASSERT_EQ(c.call(4), 1);
  c.update();
  c.g1 = {1.01e-2, 0, 0, 3e-3 * std::sqrt(2.0)};
  ::setenv(point::capture_variable, folder.path().c_str(), 1);
  EXPECT_EQ(c.call(4), -1);
  ::unsetenv(point::capture_variable);
  EXPECT_NE(c.text().find(folder.path().string()), std::string::npos) << c.text();
  test::expect_one_snap_back(folder.path(), "0.003");
}

}  // namespace
}  // namespace fpz
