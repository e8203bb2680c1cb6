#include "fpz/driver/tangent_check.hpp"

#include <gtest/gtest.h>

#include "helpers.hpp"

namespace fpz::driver {
namespace {

class TangentOfMethod : public testing::TestWithParam<Method> {};

TEST_P(TangentOfMethod, MatchesDifferencesAlongTheFourStages) {
  PathTest test = four_stages(10);
  test.options.method = GetParam();
  TangentCheckOptions options;
  options.every = 7;
  const TangentCheck check = check_tangent(test, options);
  EXPECT_TRUE(check.ok()) << check.report(options);
  EXPECT_GT(check.checked, 200);
  EXPECT_LE(check.kinks, 4);  // onset and begin of yielding
}

INSTANTIATE_TEST_SUITE_P(Methods, TangentOfMethod, testing::Values(Method::implicit, Method::accurate));

TEST(TangentCheck, FailsAboveTheTolerance) {
  TangentCheckOptions options;
  options.every = 50;
  options.tolerance = 1e-18;
  EXPECT_FALSE(check_tangent(four_stages(10), options).ok());
}

}  // namespace
}  // namespace fpz::driver
