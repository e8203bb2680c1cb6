#include "fpz/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "support/materials.hpp"

namespace {

using fpz::Parameters;
using fpz::Setting;
using fpz::Validation;
using fpz::Violation;

// One RVE length for all tables.
Parameters table1() { return fpz::test::table1(4e-3); }
Parameters table2() { return fpz::test::table2(4e-3); }
Parameters table3() { return fpz::test::table3(4e-3); }

const Violation* find(const std::vector<Violation>& list, const std::string& field) {
  const auto it = std::find_if(list.begin(), list.end(), [&](const Violation& v) { return v.field == field; });
  return it == list.end() ? nullptr : &*it;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Largest F over a fine scan of plane angles, for uniaxial stress s; `angle_deg` receives where.
double scan(const Parameters& p, double s, double* angle_deg = nullptr) {
  const double t = std::tan(p.friction_angle_deg * fpz::degree);
  const double apex = p.cohesion - p.tensile_strength * t;
  double best = -std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 9000; ++k) {
    const double theta = 0.01 * k * fpz::degree;
    const double tn = s * std::cos(theta) * std::cos(theta);
    const double ts = s * std::cos(theta) * std::sin(theta);
    const double f = std::sqrt(ts * ts + apex * apex) - (p.cohesion - tn * t);
    if (f > best) {
      best = f;
      if (angle_deg != nullptr) *angle_deg = theta / fpz::degree;
    }
  }
  return best;
}

struct FieldCase {
  const char* field;
  double Parameters::*member;
  double bad;
  const char* constraint;
};

class BadField : public ::testing::TestWithParam<FieldCase> {};

TEST_P(BadField, IsTheOnlyErrorAndSaysWhy) {
  const FieldCase& c = GetParam();
  Parameters p = table1();
  p.*(c.member) = c.bad;
  const Validation v = validate(p, Setting::plane_strain);
  EXPECT_FALSE(v.ok());
  ASSERT_EQ(v.errors.size(), 1u) << v.report();
  EXPECT_EQ(v.errors[0].field, c.field);
  EXPECT_DOUBLE_EQ(v.errors[0].value, c.bad);
  EXPECT_EQ(v.errors[0].constraint, c.constraint);
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, BadField,
    ::testing::Values(FieldCase{"young_modulus", &Parameters::young_modulus, 0.0, "must be > 0"},
                      FieldCase{"young_modulus", &Parameters::young_modulus, -1.0, "must be > 0"},
                      FieldCase{"poisson_ratio", &Parameters::poisson_ratio, 0.5, "must be > -1 and < 0.5"},
                      FieldCase{"poisson_ratio", &Parameters::poisson_ratio, -1.0, "must be > -1 and < 0.5"},
                      FieldCase{"density", &Parameters::density, 0.0, "must be > 0"},
                      FieldCase{"tensile_strength", &Parameters::tensile_strength, -2.0, "must be > 0"},
                      FieldCase{"cohesion", &Parameters::cohesion, 0.0, "must be > 0"},
                      FieldCase{"cohesion", &Parameters::cohesion, 3e5,
                                "must be > tensile_strength * tan(friction_angle_deg) = 389644.6"},
                      FieldCase{"friction_angle_deg", &Parameters::friction_angle_deg, 0.0, "must be > 0 and < 90"},
                      FieldCase{"friction_angle_deg", &Parameters::friction_angle_deg, 90.0, "must be > 0 and < 90"},
                      FieldCase{"dilation_angle_deg", &Parameters::dilation_angle_deg, -0.5, "must be >= 0"},
                      FieldCase{"dilation_angle_deg", &Parameters::dilation_angle_deg, 33.5,
                                "must be <= friction_angle_deg = 33"},
                      FieldCase{"delta0", &Parameters::delta0, 0.0, "must be > 0"},
                      FieldCase{"normal_stiffness", &Parameters::normal_stiffness, 0.0, "must be > 0"},
                      FieldCase{"shear_stiffness", &Parameters::shear_stiffness, 0.0, "must be > 0"},
                      FieldCase{"rve_length", &Parameters::rve_length, -4e-3, "must be > 0"}),
    [](const auto& case_info) { return std::string(case_info.param.field) + '_' + std::to_string(case_info.index); });

TEST(Validate, TablesOneAndThreeAreAcceptedWithoutWarnings) {
  for (const Setting s : {Setting::plane_strain, Setting::plane_stress, Setting::three_d}) {
    EXPECT_EQ(validate(fpz::test::with_zone(table1(), fpz::CohesiveZone::consistent), s).report(), "");
    Parameters stiff = fpz::test::with_zone(table3(), fpz::CohesiveZone::consistent);
    stiff.shear_stiffness = 1e13;
    EXPECT_EQ(validate(stiff, s).report(), "");
  }
}

TEST(Validate, WarnsOfPreloadedSpringsAndOfSoftOnes) {
  const auto said = [](const Parameters& p) {
    const Validation v = validate(p, Setting::plane_strain);
    const Violation* w = find(v.warnings, "shear_stiffness");
    return w != nullptr ? w->constraint : "";
  };
  EXPECT_TRUE(contains(said(table1()), "give back up to 1.09")) << said(table1());
  EXPECT_TRUE(contains(said(table3()), "\"cohesive_zone\": \"consistent\""));
  EXPECT_TRUE(contains(said(fpz::test::with_zone(table3(), fpz::CohesiveZone::consistent)), "take 1.176471e+12 Pa/m"));
  Parameters stiff = table3();
  stiff.shear_stiffness = 1e14;
  EXPECT_EQ(said(stiff), "");
}

TEST(Validate, NonFiniteValuesAreErrorsInEveryField) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    Parameters p;
    double* const members[] = {&p.young_modulus,      &p.poisson_ratio, &p.density,
                               &p.tensile_strength,   &p.cohesion,      &p.friction_angle_deg,
                               &p.dilation_angle_deg, &p.delta0,        &p.normal_stiffness,
                               &p.shear_stiffness,    &p.rve_length};
    for (double* m : members) *m = bad;
    const Validation v = validate(p, Setting::three_d);
    ASSERT_EQ(v.errors.size(), 11u) << v.report();
    for (const Violation& e : v.errors) EXPECT_EQ(e.constraint, "must be finite") << e.field;
    EXPECT_TRUE(v.warnings.empty()) << v.report();
  }
}

TEST(Validate, DefaultParametersReportEveryUnsetFieldAtOnce) {
  const Validation v = validate(Parameters{}, Setting::plane_strain);
  // poisson_ratio = 0 and dilation_angle_deg = 0 are admissible values; the latter is warned about.
  EXPECT_EQ(v.errors.size(), 9u) << v.report();
  EXPECT_EQ(find(v.errors, "poisson_ratio"), nullptr);
  EXPECT_NE(find(v.warnings, "dilation_angle_deg"), nullptr);
}

TEST(Validate, ErrorsOfSingleValuesAndOfPairsAreReportedTogether) {
  Parameters p = table1();
  p.young_modulus = -1.0;
  p.cohesion = 3e5;
  p.dilation_angle_deg = 40.0;
  p.rve_length = 0.0;
  const Validation v = validate(p, Setting::plane_strain);
  EXPECT_EQ(v.errors.size(), 4u) << v.report();
  for (const char* field : {"young_modulus", "cohesion", "dilation_angle_deg", "rve_length"}) {
    EXPECT_NE(find(v.errors, field), nullptr) << field;
  }
}

TEST(Validate, CohesionAtTheBoundIsRejectedAndJustAboveAccepted) {
  Parameters p = table1();
  const double bound = p.tensile_strength * std::tan(p.friction_angle_deg * fpz::degree);
  p.cohesion = bound;
  EXPECT_FALSE(validate(p, Setting::plane_strain).ok());
  p.cohesion = bound * (1.0 + 1e-12);
  EXPECT_TRUE(validate(p, Setting::plane_strain).ok());
}

TEST(Validate, DilationEqualToFrictionIsAccepted) {
  Parameters p = table1();
  p.dilation_angle_deg = p.friction_angle_deg;
  EXPECT_TRUE(validate(p, Setting::plane_strain).ok());
}

TEST(Validate, WarnsAtAndAboveTheSnapBackLength) {
  Parameters p = table1();
  p.rve_length = 14.3e-3;
  EXPECT_EQ(find(validate(p, Setting::plane_strain).warnings, "rve_length"), nullptr);
  p.rve_length = 15e-3;
  const Validation v = validate(p, Setting::plane_strain);
  EXPECT_TRUE(v.ok());
  const Violation* w = find(v.warnings, "rve_length");
  ASSERT_NE(w, nullptr);
  EXPECT_TRUE(contains(w->constraint, "= 0.0144:")) << w->constraint;
  EXPECT_DOUBLE_EQ(w->value, 15e-3);
  p.rve_length = snap_back_length(p, Setting::plane_strain);
  EXPECT_NE(find(validate(p, Setting::plane_strain).warnings, "rve_length"), nullptr);
}

TEST(Validate, PlaneStressHasItsOwnSnapBackLength) {
  Parameters p = table1();
  p.rve_length = 13e-3;  // between 12.8 mm (plane stress) and 14.4 mm (plane strain)
  EXPECT_EQ(find(validate(p, Setting::plane_strain).warnings, "rve_length"), nullptr);
  const Validation v = validate(p, Setting::plane_stress);
  const Violation* w = find(v.warnings, "rve_length");
  ASSERT_NE(w, nullptr);
  EXPECT_TRUE(contains(w->constraint, "E/(1 - nu^2)")) << w->constraint;
  EXPECT_TRUE(contains(w->constraint, "= 0.0128:")) << w->constraint;
}

TEST(Validate, WarnsAboutZeroDilation) {
  Parameters p = table1();
  p.dilation_angle_deg = 0.0;
  const Validation v = validate(p, Setting::plane_strain);
  EXPECT_TRUE(v.ok());
  EXPECT_NE(find(v.warnings, "dilation_angle_deg"), nullptr);
}

TEST(Validate, WarnsThatTableTwoDoesNotCrackInModeOne) {
  const Validation v = validate(table2(), Setting::plane_strain);
  EXPECT_TRUE(v.ok());
  const Violation* w = find(v.warnings, "cohesion");
  ASSERT_NE(w, nullptr);
  EXPECT_TRUE(contains(w->constraint, "at 2667")) << w->constraint;
  EXPECT_TRUE(contains(w->constraint, "= 4109")) << w->constraint;
}

TEST(Validate, ReportHasOneLinePerEntry) {
  Parameters p = table1();
  p.cohesion = 3e5;
  p.dilation_angle_deg = 0.0;
  EXPECT_EQ(validate(p, Setting::plane_strain).report(),
            "error: cohesion = 3e+05: must be > tensile_strength * tan(friction_angle_deg) = 389644.6\n"
            "warning: dilation_angle_deg = 0: should be > 0: pure opening has no solution without dilation\n");
}

TEST(SnapBackLength, TableOne) {
  EXPECT_NEAR(snap_back_length(table1(), Setting::plane_strain), 14.4e-3, 1e-15);
  EXPECT_NEAR(snap_back_length(table1(), Setting::three_d), 14.4e-3, 1e-15);
  EXPECT_NEAR(snap_back_length(table1(), Setting::plane_stress), 12.8e-3, 1e-15);
}

TEST(UniaxialTensileStrength, IsSigmaT0ForTablesOneAndThree) {
  EXPECT_EQ(uniaxial_tensile_strength(table1()), 0.6e6);
  EXPECT_EQ(uniaxial_tensile_strength(table3()), 3.6e6);
}

TEST(UniaxialTensileStrength, IsLowerAndInclinedForTableTwo) {
  const Parameters p = table2();
  const double s = uniaxial_tensile_strength(p);
  EXPECT_NEAR(s, 2.67e6, 0.005e6);
  double angle = 0.0;
  scan(p, s, &angle);
  EXPECT_NEAR(angle, 23.5, 0.05);
}

TEST(UniaxialTensileStrength, AgreesWithAScanOverPlanes) {
  for (const double phi : {5.0, 20.0, 33.0, 45.0, 60.0, 75.0}) {
    for (const double ratio : {1.001, 1.1, 1.5, 2.0, 5.0}) {  // c0 over its lower bound
      Parameters p = table1();
      p.friction_angle_deg = phi;
      p.cohesion = ratio * p.tensile_strength * std::tan(phi * fpz::degree);
      const double s = uniaxial_tensile_strength(p);
      EXPECT_LE(s, p.tensile_strength);
      // The scan misses the critical angle by up to 0.005 degrees, an error of second order in F.
      EXPECT_NEAR(scan(p, s), 0.0, 1e-7 * p.cohesion) << "phi " << phi << " ratio " << ratio;
    }
  }
}

TEST(UniaxialTensileStrength, IsContinuousWhereTheModeChanges) {
  Parameters p = table2();
  const double t = std::tan(p.friction_angle_deg * fpz::degree);
  const double threshold = p.tensile_strength * (t + 0.5 / t);
  p.cohesion = threshold * (1.0 + 1e-9);
  EXPECT_EQ(uniaxial_tensile_strength(p), p.tensile_strength);
  p.cohesion = threshold * (1.0 - 1e-9);
  EXPECT_NEAR(uniaxial_tensile_strength(p), p.tensile_strength, 1e-6 * p.tensile_strength);
}

}  // namespace
