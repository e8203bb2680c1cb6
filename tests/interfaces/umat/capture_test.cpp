// A point that fails in the UMAT writes itself down, and the driver replays it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "fpz/point/failure_capture.hpp"
#include "fpz/point/properties.hpp"
#include "interfaces/replayed_capture.hpp"
#include "interfaces/umat/umat_call.hpp"
#include "support/materials.hpp"
#include "support/temporary_folder.hpp"

namespace fpz {
namespace {

TEST(UmatCapture, TheDriverReplaysIt) {
  const test::TemporaryFolder folder;
  ::setenv(point::capture_variable, folder.path().c_str(), 1);
  test::Umat u(3, 1, point::write_properties({test::table1(1.0), {}}));
  u.call({1e-4, 0, 0, 0});
  EXPECT_FALSE(u.failed());
  u.call({1e-2, 0, 0, 3e-3});
  ::unsetenv(point::capture_variable);
  ASSERT_TRUE(u.failed());
  test::expect_one_snap_back(folder.path(), "0.0015");
}

}  // namespace
}  // namespace fpz
