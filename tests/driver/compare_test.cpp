#include "fpz/driver/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fpz/driver/path_file.hpp"

namespace fpz::driver {
namespace {

using testing::HasSubstr;

const char* const history = "time,sig_xx,D,u_n,status\n0,0,0,0,ok\n1,100,0,0,ok\n2,50,0.5,1e-6,ok\n";

Comparison compare(const std::string& ours, const std::string& theirs, double tolerance = 1e-6) {
  CompareOptions o;
  o.stress_tolerance = o.damage_tolerance = o.jump_tolerance = tolerance;
  return compare_histories(io::parse_csv(ours, "ours"), io::parse_csv(theirs, "theirs"), o);
}

TEST(Compare, AcceptsItselfAndTheReferencesNames) {
  EXPECT_TRUE(compare(history, history).ok());
  const Comparison c = compare(history, "T,sxx,D,un\n1,100,0,0\n2,50,0.5,1e-6\n");
  EXPECT_TRUE(c.ok()) << c.report();
  EXPECT_EQ(c.rows, 2u);
  EXPECT_EQ(c.columns.size(), 3u);
}

TEST(Compare, NamesTheWorstPlace) {
  const Comparison c = compare(history, "T,sxx\n1,100.1\n2,50.2\n");
  EXPECT_FALSE(c.ok());
  EXPECT_NEAR(c.columns.at(0).difference, 0.2, 1e-12);
  EXPECT_EQ(c.columns.at(0).time, 2.0);
  EXPECT_NEAR(c.columns.at(0).relative, 0.2 / 100.1, 1e-9);
  EXPECT_THAT(c.report(), HasSubstr("FAILS"));
}

TEST(Compare, InterpolatesOnlyWhereItMustAndSaysSo) {
  const Comparison c = compare(history, "T,sxx\n0.5,50\n1.0000000001,100\n");
  EXPECT_TRUE(c.ok()) << c.report();
  EXPECT_EQ(c.interpolated, 1u);
  EXPECT_THAT(c.report(), HasSubstr("interpolated"));
}

TEST(Compare, RefusesNaNMissingColumnsAndMissingTimes) {
  EXPECT_FALSE(compare("time,sig_xx\n1,nan\n", "T,sxx\n1,1\n").ok());
  EXPECT_FALSE(compare("time,sig_xx\n1,oops\n", "T,sxx\n1,1\n").ok());
  EXPECT_THAT(compare(history, "T,sxy\n1,1\n").report(), HasSubstr("missing"));
  EXPECT_THAT(compare(history, "T,foo\n1,1\n").report(), HasSubstr("unknown"));
  EXPECT_FALSE(compare(history, "T,sxx\n3,50\n").ok());
  EXPECT_THROW((void)compare(history, "sxx\n1\n"), InputError);
}

TEST(Compare, TakesAGivenStressScale) {
  CompareOptions o;
  o.stress_tolerance = 1e-3;
  o.stress_scale = 1e6;
  EXPECT_TRUE(compare_histories(io::parse_csv(history, "a"), io::parse_csv("T,sxx\n1,200\n", "b"), o).ok());
}

}  // namespace
}  // namespace fpz::driver
