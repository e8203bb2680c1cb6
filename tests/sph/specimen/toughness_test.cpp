#include "fpz/specimen/toughness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fpz/io/csv.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/specimen/scene.hpp"
#include "fpz/specimen/summary.hpp"

namespace {

using namespace fpz::specimen;

const std::filesystem::path data = FPZ_DATA_DIR;

std::string scb_complaint(const Overrides& set) {
  try {
    (void)read_scene(data / "scenes/scb.json", set);
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
  return "";
}

SemicircularBending specimen_at(double angle) {
  return *read_scene(data / "scenes/scb.json", {"notches[0].angle_deg=" + std::to_string(angle)}).toughness;
}

TEST(Toughness, TheRootCoversTheLengthOnly) {
  const StressIntensity k = stress_intensity({0.05, 0.02, 4.0, 0.25}, 0.02, 100.0);
  const double unit = 100.0 / (2.0 * 0.05 * 0.02) * std::sqrt(std::numbers::pi * 0.02);
  EXPECT_NEAR(k.K_I, 4.0 * unit, 1e-9 * unit);
  EXPECT_NEAR(k.K_II, 0.25 * unit, 1e-9 * unit);
}

TEST(Toughness, FactorsAreInterpolated) {
  const IntensityFactors f{0.35, 0.5, {0.0, 10.0, 30.0}, {3.0, 2.0, 0.0}, {0.0, 1.0, 2.0}};
  EXPECT_EQ(f.at(0.0), std::pair(3.0, 0.0));
  EXPECT_EQ(f.at(5.0), std::pair(2.5, 0.5));
  EXPECT_EQ(f.at(20.0), std::pair(1.0, 1.5));
  EXPECT_EQ(f.at(30.0), std::pair(0.0, 2.0));
}

// Polynomial of the suggested method of the ISRM (2014) for straight notches, a fit to other finite elements: half
// span over radius 0.5, stated for a/r from 0.4 on; at 0.35 it is 2.1 % lower than the converged value.
TEST(Toughness, StraightNotchAgreesWithThePublishedPolynomial) {
  const double b = 0.3495, s = 0.5;
  const double Y = -1.297 + 9.516 * s - (0.47 + 16.457 * s) * b + (1.071 + 34.401 * s) * b * b;
  EXPECT_NEAR(specimen_at(0.0).Y_I, Y, 0.025 * Y);
  EXPECT_NEAR(specimen_at(0.0).Y_II, 0.0, 1e-3);
}

TEST(Toughness, ModeIVanishesNearFiftyFourDegrees) {
  EXPECT_GT(specimen_at(52.0).Y_I, 0.1);
  EXPECT_NEAR(specimen_at(54.0).Y_I, 0.0, 0.07);  // 2 % of that of the straight notch
  EXPECT_LT(specimen_at(58.0).Y_I, 0.0);
  EXPECT_GT(specimen_at(54.0).Y_II, 0.6);
}

TEST(Toughness, NotchesThatLeanToEitherSideHaveTheSameFactors) {
  EXPECT_EQ(specimen_at(30.0).Y_I, specimen_at(-30.0).Y_I);
  EXPECT_EQ(specimen_at(30.0).Y_II, specimen_at(-30.0).Y_II);
}

// The load at which a straight notch reaches K_Ic = 2.15 MPa sqrt(mm): both files of the reference data agree.
TEST(Toughness, LoadOfLinearFractureMechanicsHasTheToughness) {
  const fpz::io::Table t = fpz::io::read_csv(data / "reference/scb_lefm.csv");
  const double K_Ic = 2.15e6 * std::sqrt(1e-3);
  const double load = t.at("peak_load").front();
  EXPECT_NEAR(stress_intensity(specimen_at(0.0), 0.02, load).K_I, K_Ic, 1e-3 * K_Ic);
  // Pure opening turns into sliding: the hoop stress criterion holds at every angle (largest over all directions).
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const StressIntensity s = stress_intensity(specimen_at(t.at("angle_deg")[k]), 0.02, t.at("peak_load")[k]);
    double largest = 0.0;
    for (double theta = -3.14; theta < 3.14; theta += 0.001) {
      const double c = std::cos(0.5 * theta);
      largest = std::max(largest, c * (s.K_I * c * c - 1.5 * s.K_II * std::sin(theta)));
    }
    EXPECT_NEAR(largest, K_Ic, 2e-3 * K_Ic) << t.at("angle_deg")[k];
  }
}

TEST(Toughness, FactorsOfAnotherGeometryAreRefused) {
  EXPECT_NE(scb_complaint({"notches[0].length=0.02"}).find("notch length over radius of the scene is 0.42"),
            std::string::npos);
  EXPECT_NE(scb_complaint({"boundaries[1].at=[-0.02, 0]"}).find("half span over radius of the scene is"),
            std::string::npos);
  EXPECT_NE(scb_complaint({"notches[0].angle_deg=70"}).find("the notch is at 70"), std::string::npos);
  EXPECT_NE(scb_complaint({"toughness.factors=missing.json"}).find("cannot read file of stress intensity factors"),
            std::string::npos);
  EXPECT_NE(scb_complaint({R"(toughness.factors={"notch_ratio": 0.35, "span_ratio": 0.5, "angle_deg": [0, 0],
                              "Y_I": [1], "Y_II": [1, 2]})"})
                .find("ascending"),
            std::string::npos);
  EXPECT_NE(scb_complaint({"toughness.type=disc"}).find("unknown choice"), std::string::npos);
}

TEST(Toughness, TheSceneInTheOutputFolderNeedsNoOtherFile) {
  const Scene s = read_scene(data / "scenes/scb.json", {"notches[0].angle_deg=20"});
  const Scene again = parse_scene(s.text, "/elsewhere/scene.json", {"notches[0].angle_deg=40"});
  EXPECT_EQ(again.toughness->Y_I, specimen_at(40.0).Y_I);
}

TEST(Toughness, FollowsFromThePeakLoad) {
  const Scene scene = read_scene(data / "scenes/scb.json");
  History h;
  h.columns = {"deflection",      "load",           "support",
               "energy_external", "energy_elastic", "energy_kinetic",
               "energy_fracture", "energy_error",   "energy_viscous"};
  for (const double load : {0.0, 100.0, 208.57, 50.0})
    h.values.insert(h.values.end(), {1e-6, load, load, 1, 1, 0, 0, 0, 0});
  const Findings f = findings(scene, h, 0.0, 0.0);
  EXPECT_NEAR(f.toughness->K_I, 67989.0, 20.0);  // 2.15 MPa sqrt(mm)
}

}  // namespace
