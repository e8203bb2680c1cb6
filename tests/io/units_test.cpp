#include "fpz/io/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fpz::io {
namespace {

TEST(Units, ToughnessOfTable1InBothNotations) {
  // 2.15 MPa sqrt(mm) = 0.068 MPa sqrt(m)
  EXPECT_NEAR(2.15 * *unit_factor(Quantity::toughness, "MPa.sqrt(mm)"), 2.15e6 * std::sqrt(1e-3), 1e-6);
}

TEST(Units, EnergyPerArea) {
  EXPECT_EQ(*unit_factor(Quantity::energy_per_area, "N/mm"), 1e3);
  EXPECT_EQ(*unit_factor(Quantity::energy_per_area, "J/m2"), *unit_factor(Quantity::energy_per_area, "N/m"));
}

TEST(Units, UnknownOrOfAnotherQuantity) {
  EXPECT_FALSE(unit_factor(Quantity::length, "MPa"));
  EXPECT_FALSE(unit_factor(Quantity::stress, "torr"));
  EXPECT_FALSE(unit_factor(Quantity::stress, "mPa"));  // rather MPa, but not surely
  EXPECT_FALSE(unit_factor(Quantity::toughness, "MPa.m"));
  EXPECT_FALSE(is_unit("CMOD"));
  EXPECT_FALSE(is_unit(""));
}

TEST(Units, SpellingsOfAToughness) {
  for (const char* spelling : {"MPa.sqrt(m)", "MPa sqrt(m)", "MPa*sqrt(m)", "MPa·sqrt(m)", "MPa.m^0.5", "MPa m^0.5",
                               "MPa*m^(1/2)", "MPa.m^1/2", "MPa m1/2", "MPa√m", "MPa·√m", "MPa√(m)", "MPa m½",
                               "MPa sqrt m", "MN/m^1.5", "MN/m^(3/2)", "MN/m3/2", "MN m^-3/2", "MN·m^(-1.5)"}) {
    ASSERT_TRUE(unit_factor(Quantity::toughness, spelling)) << spelling;
    EXPECT_EQ(*unit_factor(Quantity::toughness, spelling), 1e6) << spelling;
  }
  for (const char* spelling : {"MPa.sqrt(mm)", "MPa mm^0.5", "MPa√mm", "N/mm^1.5", "N/mm^(3/2)", "N mm^-1.5"}) {
    ASSERT_TRUE(unit_factor(Quantity::toughness, spelling)) << spelling;
    EXPECT_NEAR(*unit_factor(Quantity::toughness, spelling), 1e6 * std::sqrt(1e-3), 1e-9) << spelling;
  }
  // 1 ksi sqrt(in) = 1.0988 MPa sqrt(m), as handbooks print it.
  for (const char* spelling : {"ksi sqrt(in)", "ksi.in^0.5", "ksi√in"}) {
    ASSERT_TRUE(unit_factor(Quantity::toughness, spelling)) << spelling;
    EXPECT_NEAR(*unit_factor(Quantity::toughness, spelling), 1.0988e6, 1e2) << spelling;
  }
}

TEST(Units, SpellingsOfOthers) {
  EXPECT_EQ(*unit_factor(Quantity::length, "µm"), 1e-6);  // the micro sign
  EXPECT_EQ(*unit_factor(Quantity::length, "μm"), 1e-6);  // the Greek letter
  EXPECT_EQ(*unit_factor(Quantity::stress, "N/mm²"), 1e6);
  EXPECT_EQ(*unit_factor(Quantity::stress, "N/mm^2"), 1e6);
  EXPECT_EQ(*unit_factor(Quantity::density, "kg/m³"), 1.0);
  EXPECT_EQ(*unit_factor(Quantity::number, "1e-3"), 1e-3);
  EXPECT_NEAR(*unit_factor(Quantity::stress, "ksi"), 6.8948e6, 1e2);
  EXPECT_EQ(*unit_factor(Quantity::angle, "°"), 1.0);
}

}  // namespace
}  // namespace fpz::io
