#include "fpz/io/plausibility.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "fpz/io/material_file.hpp"

namespace fpz::io {
namespace {

Judgement of(std::string_view name, double number, std::string_view unit) {
  const Typical t = typical_parameter(name);
  return judge(name, {number * unit_factor(t.quantity, unit).value(), number, unit}, t);
}

void expect_guess(const Judgement& j, const std::string& guess) {
  EXPECT_EQ(j.verdict, Verdict::impossible) << j.text;
  EXPECT_NE(j.text.find(guess + " was probably meant"), std::string::npos) << j.text;
}

TEST(Plausibility, UsualValuesPass) {
  EXPECT_EQ(of("tensile_strength", 3.9e6, "Pa").verdict, Verdict::plausible);
  EXPECT_EQ(of("delta0", 16.4, "um").verdict, Verdict::plausible);
  EXPECT_EQ(of("young_modulus", 0.4e9, "Pa").verdict, Verdict::plausible);  // Johnstone, soft
  EXPECT_EQ(of("density", 2.4, "g/cm3").verdict, Verdict::plausible);
}

TEST(Plausibility, WholeMessage) {
  EXPECT_EQ(of("tensile_strength", 3.9, "Pa").text,
            "tensile_strength = 3.9 Pa is far below any value for rock and concrete (50000 to 3e+07 Pa); 3.9 MPa was "
            "probably meant: write 3.9e+06 or \"unit\": \"MPa\"");
}

TEST(Plausibility, GuessesTheSlip) {
  expect_guess(of("young_modulus", 37.0, "Pa"), "37 GPa");
  expect_guess(of("young_modulus", 37000.0, "Pa"), "37000 MPa");
  expect_guess(of("delta0", 16.4, "m"), "16.4 um");
  expect_guess(of("delta0", 16.4e-3, "m"), "0.0164 mm");
  expect_guess(of("tensile_strength", 3.9e6, "MPa"), "3900000 Pa");
  expect_guess(of("density", 2.4, "kg/m3"), "2.4 g/cm3");
  expect_guess(of("friction_angle_deg", 0.61, "deg"), "0.61 rad");
  expect_guess(of("poisson_ratio", 22.0, ""), "22 %");
  expect_guess(of("normal_stiffness", 1e5, "Pa/m"), "1e+05 GPa/m");
}

TEST(Plausibility, ALittleOutsideIsDoubtful) {
  const Judgement j = of("tensile_strength", 45.0, "MPa");
  EXPECT_EQ(j.verdict, Verdict::doubtful);
  EXPECT_NE(j.text.find("above the usual value"), std::string::npos) << j.text;
}

TEST(Plausibility, NoGuessWhereNoUnitFits) {
  const Judgement j = of("poisson_ratio", -0.3, "");
  EXPECT_EQ(j.verdict, Verdict::impossible);
  EXPECT_EQ(j.text.find("was probably meant"), std::string::npos) << j.text;
}

TEST(Plausibility, EveryKeyOfAMaterialHasARange) {
  for (const auto& key : material_keys) {
    const Plausible t = typical_parameter(key.name).range;
    EXPECT_LT(t.far_low, t.low) << key.name;
    EXPECT_LT(t.low, t.high) << key.name;
    EXPECT_LT(t.high, t.far_high) << key.name;
  }
  EXPECT_THROW((void)typical_parameter("hardness"), std::invalid_argument);
}

}  // namespace
}  // namespace fpz::io
