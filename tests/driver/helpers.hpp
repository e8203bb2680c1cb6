// Tests of Table 1's material, built without a path file.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "fpz/driver/run.hpp"

namespace fpz::driver {

using PathTest = Test;  // inside a test body, Test is GoogleTest's

inline Parameters johnstone(double rve_length = 4e-3) {
  Parameters p;
  p.young_modulus = 0.4e9;
  p.poisson_ratio = 0.25;
  p.density = 1540.0;
  p.tensile_strength = 0.6e6;
  p.cohesion = 1.0e6;
  p.friction_angle_deg = 33.0;
  p.dilation_angle_deg = 4.0;
  p.delta0 = 18e-6;
  p.normal_stiffness = 1e13;
  p.shear_stiffness = 1e11;
  p.rve_length = rve_length;
  return p;
}

inline Test johnstone_test(Setting setting = Setting::plane_strain, double rve_length = 4e-3) {
  Test test;
  test.name = "test";
  test.parameters = johnstone(rve_length);
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
        stage(increments / factor, {{xx, Control::strain_increment, x}, {xy, Control::strain_increment, s}}));
  };
  add(12000, dx, 0.0);
  add(2000, dx, ds);
  add(300, -dx, -ds);
  add(1300, dx, ds);
  return test;
}

/// A folder of its own that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "fpz-driver-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace fpz::driver
