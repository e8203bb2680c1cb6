// What a failing point leaves behind, in tests of the interfaces.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "fpz/driver/replay.hpp"

namespace fpz::test {

/// One capture of a snap-back is in the folder, and the driver finds the same; its strain increment has the normal
/// strain 0.01 and, as a tensor component, this shear.
inline void expect_one_snap_back(const std::filesystem::path& folder, const char* shear) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++files;
    const driver::Replay replay = driver::replay(entry.path());
    EXPECT_EQ(replay.captured, Status::snap_back);
    EXPECT_EQ(replay.now, Status::snap_back);
    EXPECT_NE(replay.text.find("0.01"), std::string::npos) << replay.text;
    EXPECT_NE(replay.text.find(shear), std::string::npos) << "a tensor shear\n" << replay.text;
  }
  EXPECT_EQ(files, 1);
}

}  // namespace fpz::test
