// The files in data/materials: complete, admissible, and what their names promise.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "fpz/parameters.hpp"

namespace {

nlohmann::json load(const std::string& name) {
  std::ifstream file(std::string(FPZ_DATA_DIR "/materials/") + name);
  EXPECT_TRUE(file.good()) << name;
  return nlohmann::json::parse(file);
}

fpz::Parameters parameters(const nlohmann::json& j) {
  fpz::Parameters p;
  p.young_modulus = j.at("young_modulus");
  p.poisson_ratio = j.at("poisson_ratio");
  p.density = j.at("density");
  p.tensile_strength = j.at("tensile_strength");
  p.cohesion = j.at("cohesion");
  p.friction_angle_deg = j.at("friction_angle_deg");
  p.dilation_angle_deg = j.at("dilation_angle_deg");
  p.delta0 = j.at("delta0");
  p.normal_stiffness = j.at("normal_stiffness");
  p.shear_stiffness = j.at("shear_stiffness");
  p.rve_length = 0.5e-3;  // the smallest spacing of the paper; not part of a material file
  return p;
}

class MaterialFile : public ::testing::TestWithParam<const char*> {};

TEST_P(MaterialFile, IsCompleteAndAdmissible) {
  const nlohmann::json j = load(GetParam());
  for (const char* key : {"name", "source", "units", "notes"}) {
    EXPECT_TRUE(j.contains(key) && j.at(key).is_string()) << key;
  }
  EXPECT_EQ(j.size(), j.contains("softening") ? 15u : 14u) << "ten numbers, four strings, and a choice";
  const fpz::Validation v = validate(parameters(j), fpz::Setting::plane_strain);
  EXPECT_TRUE(v.ok()) << v.report();
}

INSTANTIATE_TEST_SUITE_P(Data, MaterialFile,
                         ::testing::Values("johnstone.json", "bellego.json", "marble.json", "bellego_mode1.json",
                                           "bellego_mode1_bilinear.json"),
                         [](const auto& file_info) {
                           const std::string name = file_info.param;
                           return name.substr(0, name.find('.'));
                         });

TEST(MaterialFiles, ModeOneBeamDiffersFromTableTwoInCohesionOnly) {
  nlohmann::json table = load("bellego.json");
  nlohmann::json mode1 = load("bellego_mode1.json");
  EXPECT_LT(uniaxial_tensile_strength(parameters(table)), double(table.at("tensile_strength")));
  EXPECT_EQ(uniaxial_tensile_strength(parameters(mode1)), double(mode1.at("tensile_strength")));
  for (auto* j : {&table, &mode1}) {
    for (const char* key : {"cohesion", "name", "source", "units", "notes"}) j->erase(key);
  }
  EXPECT_EQ(table, mode1);
}

TEST(MaterialFiles, BilinearBeamDiffersInSofteningOnly) {
  nlohmann::json one = load("bellego_mode1.json");
  nlohmann::json two = load("bellego_mode1_bilinear.json");
  EXPECT_EQ(two.at("softening"), "bilinear");
  for (auto* j : {&one, &two}) {
    for (const char* key : {"softening", "name", "source", "units", "notes"}) j->erase(key);
  }
  EXPECT_EQ(one, two);
}

}  // namespace
