#include "fpz/point/behaviour.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "support/materials.hpp"

namespace fpz::point {
namespace {

std::vector<double> list_of(const Parameters& p) { return write_properties({p, {}}); }

std::string complaint(const std::vector<double>& list, double rve_length = 0.0) {
  try {
    (void)behaviour_of(Setting::plane_strain, list, rve_length);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "none";
}

TEST(Behaviour, IsTheLibrarysMaterial) {
  const Parameters p = test::table2();
  const Behaviour& b = behaviour_of(Setting::plane_stress, list_of(p));
  const Material<double> m = make_material(p, Setting::plane_stress);
  EXPECT_EQ(b.material.bulk.lambda, m.bulk.lambda);
  EXPECT_EQ(b.material.series.normal, m.series.normal);
  EXPECT_EQ(b.material.law.zone, m.law.zone);
  EXPECT_EQ(b.snap_back_length, snap_back_length(p, Setting::plane_stress));
}

TEST(Behaviour, IsFoundAgainByItsBytes) {
  std::vector<double> list = list_of(test::table1());
  const Behaviour* first = &behaviour_of(Setting::plane_strain, list);
  EXPECT_EQ(first, &behaviour_of(Setting::plane_strain, std::vector<double>(list)));
  EXPECT_NE(first, &behaviour_of(Setting::plane_stress, list));
  list[0] *= 1.0 + 1e-15;
  EXPECT_NE(first, &behaviour_of(Setting::plane_strain, list));
  EXPECT_EQ(behaviour_of(Setting::plane_strain, list).parameters.young_modulus, list[0]);
}

TEST(Behaviour, MoreMaterialsThanAreKept) {
  for (int round = 0; round < 2; ++round) {
    for (int k = 1; k <= 100; ++k) {
      Parameters p = test::table1();
      p.young_modulus *= k;
      EXPECT_EQ(behaviour_of(Setting::plane_strain, list_of(p)).parameters.young_modulus, p.young_modulus);
    }
  }
}

TEST(Behaviour, LengthOfThePlaceWhereTheListHasNone) {
  std::vector<double> list = list_of(test::table1());
  EXPECT_EQ(behaviour_of(Setting::plane_strain, list, 7.0).parameters.rve_length, 4e-3);
  list[10] = 0.0;
  for (const double h : {1e-3, 2e-3, 1e-3}) {
    const Behaviour& b = behaviour_of(Setting::plane_strain, list, h);
    const Material<double> m = make_material(test::table1(h), Setting::plane_strain);
    EXPECT_EQ(b.parameters.rve_length, h);
    EXPECT_EQ(b.material.series.normal, m.series.normal);
    EXPECT_EQ(b.material.series.shear, m.series.shear);
    EXPECT_EQ(b.material.inverse_length, m.inverse_length);
  }
  EXPECT_EQ(complaint(list, 0.0), "property 11, rve_length = 0: must be > 0\n");
  EXPECT_EQ(complaint(list, -1.0), "property 11, rve_length = -1: must be > 0\n");
  EXPECT_EQ(complaint(list, std::numeric_limits<double>::quiet_NaN()),
            "property 11, rve_length = nan: must be finite\n");
  EXPECT_EQ(complaint(list, 1e-3), "none");
}

TEST(Behaviour, FaultsNameNumberNameValueAndConstraint) {
  std::vector<double> list = list_of(test::table1());
  list[4] = 3e5;
  list[7] = -1.0;
  EXPECT_EQ(complaint(list),
            "property 8, delta0 = -1: must be > 0\n"
            "property 5, cohesion = 3e+05: must be > tensile_strength * tan(friction_angle_deg) = 389644.6\n");
  list = list_of(test::table1());
  list[14] = 2.0;
  EXPECT_EQ(complaint(list), "property 15, integrator_tolerance = 2: must be > 0 and < 1\n");
  list.resize(8);
  EXPECT_EQ(complaint(list), "8 properties are given; missing: normal_stiffness, shear_stiffness\n");
  list = list_of(test::with_zone(test::table1(), CohesiveZone::consistent));
  list[13] = 2.0;
  EXPECT_NE(complaint(list).find("paper integrates the published zone only"), std::string::npos);
}

TEST(Behaviour, DoubtfulValuesAreWarnedOf) {
  const auto warnings = [](double length) {
    return make_behaviour(Setting::plane_strain,
                          list_of(test::with_zone(test::table1(length), CohesiveZone::consistent)))
        .warnings;
  };
  EXPECT_EQ(warnings(4e-3), "");
  const std::string warning = warnings(1.0);
  EXPECT_EQ(warning.find("property 11, rve_length = 1: should be < "), 0U) << warning;
}

}  // namespace
}  // namespace fpz::point
