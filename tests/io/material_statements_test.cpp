// Material files that state other quantities than the parameters.
#include <gtest/gtest.h>

#include <cmath>

#include "fpz/io/material_conversion.hpp"
#include "fpz/io/material_file.hpp"

namespace fpz::io {
namespace {

/// A file with the three parameters that have no other form, and what is given.
std::string file_with(const std::string& rest) {
  return R"({"density": 2400, "dilation_angle_deg": 5, "normal_stiffness": 1e14, "shear_stiffness": 1e14,
)" + rest +
         '}';
}

const std::string elastic = R"("young_modulus": {"value": 30, "unit": "GPa"}, "poisson_ratio": 0.2)";
const std::string strength = R"("tensile_strength": {"value": 4, "unit": "MPa"}, "friction_angle_deg": 35)";
const std::string cohesion = R"("cohesion": {"value": 20, "unit": "MPa"})";
const std::string energy = R"("delta0": {"value": 20, "unit": "um"})";

std::string joined(std::initializer_list<std::string> parts) {
  std::string text;
  for (const std::string& p : parts) text += (text.empty() ? "" : ",\n") + p;
  return text;
}

std::optional<MaterialFile> parse(const std::string& text, std::string* message = nullptr) {
  const ReadLimits limits;
  Problems problems(limits.problems);
  JsonValue root;
  std::optional<MaterialFile> m;
  try {
    if (parse_json(text, "m.json", limits, problems, root)) {
      m = read_material(InputReader("m.json", limits, problems), Place(root), "m");
    }
    problems.throw_if_any();
  } catch (const InputError& e) {
    if (message != nullptr) *message = e.what();
    return std::nullopt;
  }
  return m;
}

Parameters good(const std::string& rest) {
  std::string message;
  const auto m = parse(file_with(rest), &message);
  EXPECT_TRUE(m) << message;
  return m ? m->parameters : Parameters();
}

void expect_refused(const std::string& rest, const std::string& part) {
  std::string message;
  EXPECT_FALSE(parse(file_with(rest), &message)) << rest;
  EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
}

TEST(MaterialStatements, UnitsOfTheParameters) {
  const Parameters p = good(joined({elastic, strength, cohesion, energy}));
  EXPECT_EQ(p.young_modulus, 30e9);
  EXPECT_DOUBLE_EQ(p.delta0, 20e-6);
  expect_refused(
      joined({R"("young_modulus": {"value": 30, "unit": "kN"}, "poisson_ratio": 0.2)", strength, cohesion, energy}),
      "m.json:2: young_modulus.unit: unknown unit \"kN\"");
}

TEST(MaterialStatements, BulkAndShearModulus) {
  for (const char* pair :
       {R"("bulk_modulus": {"value": 20, "unit": "GPa"}, "shear_modulus": {"value": 12, "unit": "GPa"})",
        R"("K": 20e9, "G": 12e9)", R"("K": 20e9, "poisson_ratio": 0.25)",
        R"("shear_modulus": 12e9, "young_modulus": 30e9)"}) {
    const Parameters p = good(joined({pair, strength, cohesion, energy}));
    EXPECT_NEAR(p.young_modulus, 30e9, 1e-3) << pair;
    EXPECT_NEAR(p.poisson_ratio, 0.25, 1e-14) << pair;
  }
}

TEST(MaterialStatements, EnergyAndToughness) {
  EXPECT_DOUBLE_EQ(good(joined({elastic, strength, cohesion, R"("fracture_energy": 80)"})).delta0, 20e-6);
  EXPECT_DOUBLE_EQ(good(joined({elastic, strength, cohesion, R"("G_I": {"value": 0.08, "unit": "N/mm"})"})).delta0,
                   20e-6);
  const double k2 = 1.5e6 * 1.5e6;
  EXPECT_DOUBLE_EQ(good(joined({elastic, strength, cohesion, R"("K_Ic": {"value": 1.5, "unit": "MPa√m"})"})).delta0,
                   k2 * (1.0 - 0.04) / 30e9 / 4e6);
  EXPECT_DOUBLE_EQ(good(joined({elastic, strength, cohesion,
                                R"("toughness": {"value": 1.5, "unit": "MPa m^0.5", "setting": "plane_stress"})"}))
                       .delta0,
                   k2 / 30e9 / 4e6);
}

TEST(MaterialStatements, Strengths) {
  const std::string phi = R"("friction_angle_deg": 35)";
  EXPECT_EQ(good(joined({elastic, R"("brazilian_strength": {"value": 4, "unit": "MPa"})", phi, cohesion, energy}))
                .tensile_strength,
            4e6);
  EXPECT_EQ(
      good(joined({elastic, R"("bending_strength": {"value": 6, "unit": "MPa", "depth": {"value": 100, "unit": "mm"}})",
                   phi, cohesion, energy}))
          .tensile_strength,
      tensile_from_bending(6e6, 0.1));
  EXPECT_EQ(good(joined({elastic, strength, R"("UCS": {"value": 80, "unit": "MPa"})", energy})).cohesion,
            cohesion_from_compression(80e6, 35.0, 4e6).value());
}

TEST(MaterialStatements, AllAtOnceAndSaid) {
  std::string message;
  const auto m = parse(file_with(R"x("K": {"value": 20, "unit": "GPa"}, "G": {"value": 12, "unit": "GPa"},
"brazilian_strength": {"value": 4, "unit": "MPa"},
"UCS": {"value": 80, "unit": "MPa"}, "friction_angle_deg": 35,
"K_Ic": {"value": 1.5, "unit": "MPa.sqrt(m)"})x"),
                       &message);
  ASSERT_TRUE(m) << message;
  ASSERT_EQ(m->conversions.size(), 4U);
  EXPECT_EQ(
      m->conversions[0],
      "m.json:2: young_modulus = 3e+10 Pa, poisson_ratio = 0.25 from bulk_modulus = 20 GPa and shear_modulus = 12 "
      "GPa: E = 9 K G/(3 K + G), nu = (3 K - 2 G)/(6 K + 2 G)");
  EXPECT_EQ(m->conversions[3],
            "m.json:5: delta0 = 1.7578e-05 m from toughness = 1.5 MPa.sqrt(m): G_I = K_Ic^2 (1 - nu^2)/E = 70.312 J/m2 "
            "(plane strain, Irwin 1957), delta0 = G_I/tensile_strength");
}

TEST(MaterialStatements, DoubledOrContradictoryOnesAreRefused) {
  expect_refused(joined({elastic, R"("K": 20e9)", strength, cohesion, energy}),
                 "two elastic constants determine the others");
  expect_refused(joined({elastic, strength, cohesion, energy, R"("fracture_energy": 80)"}),
                 "fracture_energy = 80 J/m2 beside delta0 = 20 um (line 5): one of them determines delta0");
  expect_refused(joined({elastic, strength, cohesion, R"("G_I": 80, "K_Ic": 1.5e6)"}), "one of them determines delta0");
  expect_refused(joined({elastic, strength, R"("brazilian_strength": 4e6)", cohesion, energy}),
                 "one of them determines tensile_strength");
  expect_refused(joined({elastic, strength, cohesion, R"("UCS": 80e6)", energy}), "one of them determines cohesion");
  expect_refused(joined({R"("K": 20e9, "bulk_modulus": 20e9, "G": 12e9)", strength, cohesion, energy}),
                 "two elastic constants determine the others");
}

TEST(MaterialStatements, WhatIsMissingIsNamedWithWhatWouldDo) {
  expect_refused(joined({elastic, strength, cohesion}),
                 "missing key \"delta0\" (or \"fracture_energy\" or \"toughness\")");
  expect_refused(joined({R"("K": 20e9)", strength, cohesion, energy}), "missing key \"young_modulus\"");
  expect_refused(joined({elastic, R"("bending_strength": 6e6, "friction_angle_deg": 35)", cohesion, energy}),
                 "needs the depth of the beam");
}

TEST(MaterialStatements, SlipsAreNamed) {
  expect_refused(joined({elastic, strength, cohesion, R"("toughness": 1.5)"}),
                 "toughness = 1.5 Pa.sqrt(m) is far below any value");
  expect_refused(joined({elastic, strength, cohesion, R"("toughness": -1e6)"}), "must be > 0");
  expect_refused(
      joined({elastic, strength, cohesion, R"("toughness": {"value": 1, "unit": "MPa√m", "setting": "3d"})"}),
      "it must be plane_strain or plane_stress");
  expect_refused(joined({elastic, strength, R"("UCS": 3e6)", energy}), "is too low for a tensile strength of 4e+06 Pa");
  expect_refused(joined({elastic, R"("brazilian_strength": 4e6, "friction_angle_deg": 35, "cohesion": 6e6)", energy}),
                 "a disc cracks on an inclined plane");
}

/// What differs from a file follows it: a toughness keeps its meaning when the strength is another.
TEST(MaterialStatements, DifferencesReplaceWhatDeterminesTheSame) {
  const auto base = parse(file_with(joined({elastic, strength, cohesion, R"("G_I": 80)"})));
  ASSERT_TRUE(base);
  const ReadLimits limits;
  const auto with = [&](const std::string& text) {
    Problems problems(limits.problems);
    JsonValue root;
    EXPECT_TRUE(parse_json(text, "d.json", limits, problems, root));
    const auto m = read_difference(InputReader("d.json", limits, problems), Place(root), *base);
    return m ? m->parameters : Parameters();
  };
  EXPECT_DOUBLE_EQ(with(R"({"tensile_strength": 8e6})").delta0, 10e-6);
  EXPECT_DOUBLE_EQ(with(R"({"delta0": 15e-6})").delta0, 15e-6);
  EXPECT_DOUBLE_EQ(with(R"({"K": 20e9, "G": 12e9})").poisson_ratio, 0.25);
  EXPECT_DOUBLE_EQ(with(R"({"poisson_ratio": 0.3})").poisson_ratio, 0.3);
  EXPECT_EQ(with(R"({"K": 20e9})").young_modulus, 0.0);  // refused: which two of three?
}

}  // namespace
}  // namespace fpz::io
