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
  EXPECT_FALSE(unit_factor(Quantity::stress, "psi"));
}

}  // namespace
}  // namespace fpz::io
