#include "fpz/specimen/bifurcation.hpp"

#include <gtest/gtest.h>

namespace {

using namespace fpz::specimen;

CrackPath straight(double x, double length) { return {{Point(x, 0.0), Point(x, length)}, {1.0, 1.0}}; }

TEST(Bifurcation, SeveralLongCracksAreSaid) {
  const std::string said =
      warning_of_bifurcation({straight(0.0, 0.04), straight(0.03, 0.03), straight(0.1, 0.01)}, 1e-3);
  EXPECT_NE(said.find("2 cracks of similar length have opened (40, 30 mm)"), std::string::npos) << said;
}

TEST(Bifurcation, OneCrackOrShortOnesAreNot) {
  EXPECT_EQ(warning_of_bifurcation({}, 1e-3), "");
  EXPECT_EQ(warning_of_bifurcation({straight(0.0, 0.04), straight(0.03, 0.015)}, 1e-3), "");
  EXPECT_EQ(warning_of_bifurcation({straight(0.0, 0.005), straight(0.03, 0.005)}, 1e-3), "");
}

}  // namespace
