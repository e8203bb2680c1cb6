#include "fpz/specimen/history_columns.hpp"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace fpz::specimen;

std::vector<std::string> names(const std::vector<HistoryColumn>& columns) {
  std::vector<std::string> list;
  for (const HistoryColumn& c : columns) list.push_back(c.name);
  return list;
}

/// Files of earlier versions and other programs rely on these names and on this order.
TEST(HistoryColumns, NamesAndOrder) {
  const std::vector<std::string> expected = {"step",
                                             "time",
                                             "deflection",
                                             "load",
                                             "support",
                                             "cmod",
                                             "energy_external",
                                             "energy_elastic",
                                             "energy_kinetic",
                                             "energy_fracture",
                                             "energy_zero_energy",
                                             "energy_viscous",
                                             "energy_damping",
                                             "energy_artificial",
                                             "energy_contact",
                                             "energy_friction",
                                             "energy_error",
                                             "damaged_particles",
                                             "largest_damage",
                                             "released_bonds",
                                             "failing_out_of_plane",
                                             "a",
                                             "sigma"};
  EXPECT_EQ(names(history_columns({"a", "cmod", "load", "sigma"})), expected);
}

TEST(HistoryColumns, EachHasItsNameOnceAndAMeaning) {
  const std::vector<HistoryColumn> columns = history_columns({"a"});
  std::set<std::string> seen;
  for (const HistoryColumn& c : columns) {
    EXPECT_TRUE(seen.insert(c.name).second) << c.name;
    EXPECT_FALSE(c.text.empty()) << c.name;
    EXPECT_TRUE(c.value) << c.name;
  }
}

TEST(HistoryColumns, GaugesMayNotTakeComputedOnes) {
  EXPECT_TRUE(is_computed_column("energy_viscous"));
  EXPECT_TRUE(is_computed_column("step"));
  EXPECT_FALSE(is_computed_column("load"));
  EXPECT_FALSE(is_computed_column("sigma"));
}

}  // namespace
