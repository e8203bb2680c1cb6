// Tests of Table 1's material, built without a path file.
#pragma once

#include <string>

#include "fpz/driver/run.hpp"
#include "support/materials.hpp"
#include "support/temporary_folder.hpp"

namespace fpz::driver {

using PathTest = Test;  // inside a test body, Test is GoogleTest's

inline Test johnstone_test(Setting setting = Setting::plane_strain, double rve_length = 4e-3) {
  Test test;
  test.name = "test";
  test.parameters = test::table1(rve_length);
  test.material_name = "Johnstone";
  test.setting = setting;
  return test;
}

enum Component { xx, yy, zz, xy, xz, yz };

inline Stage stage(int increments, std::vector<ComponentControl> controls) {
  Stage s;
  s.increments = increments;
  s.controls = std::move(controls);
  return s;
}

/// The four-stage path of section 4.5 with increments `factor` times the paper's.
inline Test four_stages(int factor) {
  Test test = johnstone_test();
  const double dx = 3e-7 * factor;
  const double ds = 15e-7 * factor;
  const auto add = [&](int increments, double x, double s) {
    test.stages.push_back(
        stage(increments / factor, {{xx, Prescribed::strain_increment, x}, {xy, Prescribed::strain_increment, s}}));
  };
  add(12000, dx, 0.0);
  add(2000, dx, ds);
  add(300, -dx, -ds);
  add(1300, dx, ds);
  return test;
}

using test::TemporaryFolder;

}  // namespace fpz::driver
