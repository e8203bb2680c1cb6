#include "fpz/point/properties.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "fpz/law/softening.hpp"
#include "support/materials.hpp"

namespace fpz::point {
namespace {

TEST(Properties, CountIsThatOfTheTables) {
  EXPECT_EQ(properties().size(), property_count);
  std::set<std::string> names;
  for (const Property& p : properties()) names.insert(p.name);
  EXPECT_EQ(names.size(), property_count);
}

TEST(Properties, FirstAreTheParametersInTheirOrder) {
  for (std::size_t k = 0; k < parameter_table<double>.size(); ++k) {
    EXPECT_EQ(properties()[k].name, parameter_table<double>[k].name);
  }
  EXPECT_EQ(properties()[11].name, "softening");
  EXPECT_EQ(properties()[13].name, "integrator_name");
  EXPECT_EQ(properties()[13].values, "0 (accurate), 1 (implicit) or 2 (paper)");
  EXPECT_EQ(properties()[14].default_value, Options{}.tolerance);
  EXPECT_EQ(properties().back().name, "integrator_preferred_normal_z");
}

TEST(Properties, EveryNumberArrivesWhereItBelongs) {
  std::vector<double> list = {45e9, 0.24, 2400, 2.9e6, 2.9e6, 37, 5, 16e-6, 1e14, 1e11, 1e-3,
                              1,    1,    2,    1e-4,  7,     9,  2, 0.1,   0.2,  0.3};
  const Statement s = read_properties(list, 5.0);
  EXPECT_EQ(s.parameters.cohesion, 2.9e6);
  EXPECT_EQ(s.parameters.rve_length, 1e-3);
  EXPECT_EQ(s.parameters.choices.softening, softening_kind<BilinearSoftening>);
  EXPECT_EQ(s.parameters.choices.cohesive_zone, CohesiveZone::published);
  EXPECT_EQ(s.options.method, Method::paper);
  EXPECT_EQ(s.options.tolerance, 1e-4);
  EXPECT_EQ(s.options.max_iterations, 7);
  EXPECT_EQ(s.options.max_substeps, 9);
  EXPECT_EQ(s.options.scan_resolution_deg, 2.0);
  EXPECT_EQ(s.options.preferred_normal, (Vec<double, 3>(0.1, 0.2, 0.3)));
  EXPECT_EQ(write_properties(s), list);
}

TEST(Properties, MissingOnesAtTheEndAreTheDefaults) {
  const Parameters p = test::table1();
  std::vector<double> list = write_properties({p, {}});
  list.resize(10);
  const Statement s = read_properties(list, 0.25);
  EXPECT_EQ(s.parameters.rve_length, 0.25);
  EXPECT_EQ(s.parameters.choices.cohesive_zone, CohesiveZone::consistent);
  EXPECT_EQ(s.options.tolerance, Options{}.tolerance);
  EXPECT_EQ(s.options.max_substeps, Options{}.max_substeps);
  list.resize(property_count, 0.0);
  EXPECT_EQ(write_properties(read_properties(list, 0.25)), write_properties(s));
}

std::string complaint(const std::vector<double>& list) {
  try {
    (void)read_properties(list, 1.0);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "none";
}

TEST(Properties, FaultsNameNumberNameValueAndConstraint) {
  std::vector<double> list = write_properties({test::table1(), {}});
  list[11] = 2.0;
  list[13] = 0.5;
  list[15] = 10.5;
  EXPECT_EQ(complaint(list),
            "property 12, softening = 2: must be 0 (exponential) or 1 (bilinear)\n"
            "property 14, integrator_name = 0.5: must be 0 (accurate), 1 (implicit) or 2 (paper)\n"
            "property 16, integrator_max_iterations = 10.5: must be an integer\n");
  list.resize(property_count + 1);
  EXPECT_EQ(complaint(list),
            "22 properties are given, and only 21 are known: the last one is integrator_preferred_normal_z");
}

}  // namespace
}  // namespace fpz::point
