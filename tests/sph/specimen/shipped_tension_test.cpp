// Shipped scenes in which tension breaks a specimen: strengths, forces and crack paths against closed forms and
// published ranges. What the same scenes give at other spacings is in docs/tests-tension.md.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fpz/io/input_error.hpp"
#include "shipped.hpp"

namespace {

using namespace fpz::specimen;
using fpz::test::Extent;
using fpz::test::run_shipped;
using fpz::test::ShippedRun;

/// Height of the crack, as a mean of the damage, in the strip between two places x.
double height_between(const std::vector<Spot>& spots, double left, double right) {
  double sum = 0.0, weight = 0.0;
  for (const Spot& s : spots) {
    if (s.at[0] < left || s.at[0] > right || s.damage < 0.25) continue;
    sum += s.damage * s.at[1], weight += s.damage;
  }
  return sum / weight;
}

std::size_t row_at(const History& h, double time) {
  std::size_t row = 0;
  while (row + 1 < h.rows() && h.at(row, "time") < time) ++row;
  return row;
}

/// Nooru-Mohamed's plate. A process zone longer than the ligament makes it nearly plastic: without shear it has nine
/// tenths of the strength of its ligament. With shear it is weaker, and the cracks curve away from each other.
TEST(ShippedTension, DoubleEdgeNotchedPlateUnderShearThenTension) {
  constexpr double ligament = 0.15, thickness = 0.05, shear = 10e3;
  const ShippedRun r = run_shipped("double_edge_notched", {"spacing=0.004", "stages[1].stop.deflection=2e-5"});
  ASSERT_EQ(r.result.stages.size(), 2u);
  EXPECT_NE(r.result.stages[0].reason.find("stop.kinetic_below"), std::string::npos);
  EXPECT_NE(r.result.reason.find("stop.deflection"), std::string::npos) << r.result.reason;
  const History& h = r.history();
  // The shear force goes from one half to the other through the ligament, and stays what it is to the end.
  const std::size_t begin = row_at(h, r.result.stages[0].end);
  EXPECT_NEAR(h.at(begin, "load"), 0.0, 1e-6 * shear);
  const double even = shear / (ligament * thickness);
  EXPECT_NEAR(h.at(begin, "ligament"), even, 0.05 * even);
  for (std::size_t row = begin; row < h.rows(); ++row) {
    EXPECT_NEAR(h.at(row, "shear"), shear, 1e-6 * shear);
    EXPECT_NEAR(h.at(row, "shear_support"), shear, 0.05 * shear);  // waves of the crack
  }
  // On the right the crack is above the notches, on the left below.
  const double apart = height_between(r.spots, 0.02, 0.07) - height_between(r.spots, -0.07, -0.02);
  EXPECT_GT(apart, 1.5 * r.scene.spacing);
  EXPECT_LT(apart, 0.04);

  const ShippedRun pulled =
      run_shipped("double_edge_notched", {"spacing=0.004", "boundaries[1].force.x.value=0", "stages[0].stop.time=1e-3",
                                          "stages[1].stop.deflection=1.2e-5"});
  const double strength = pulled.scene.parameters.tensile_strength * ligament * thickness;
  EXPECT_LT(pulled.found.peak_load, strength);
  EXPECT_GT(pulled.found.peak_load, 0.85 * strength);
  EXPECT_LT(r.found.peak_load, 0.9 * pulled.found.peak_load);
  EXPECT_GT(r.found.peak_load, 0.6 * pulled.found.peak_load);
}

/// Winkler's panel: the peak of the tests, and of both fracture energies with which they are simulated.
TEST(ShippedTension, LPanelBreaksAtThePeakOfTheTests) {
  const ShippedRun r = run_shipped("l_panel", {"spacing=0.01", "stop.load_below=0.5"});
  EXPECT_NE(r.result.reason.find("stop.load_below"), std::string::npos) << r.result.reason;
  EXPECT_GT(r.found.peak_load, 7.0e3);
  EXPECT_LT(r.found.peak_load, 8.0e3);
  EXPECT_LT(r.found.kinetic_ratio, 0.02);
  // From the corner into the standing leg, nowhere else.
  const Extent crack = fpz::test::cracked_extent(r.spots);
  EXPECT_NEAR(crack.right, 0.25, 1.5 * r.scene.spacing);
  EXPECT_LT(crack.left, 0.17);
  EXPECT_GT(crack.low, 0.25 - 2.0 * r.scene.spacing);
  EXPECT_LT(crack.high, 0.29);
}

/// The disc between bonded platens of 4 mm, in which only tension governs, cracks first at the load of the closed form.
TEST(ShippedTension, DiscCracksAtTheLoadOfTheClosedForm) {
  const ShippedRun r = run_shipped("disc", {"spacing=0.001", "stop.load_below=0.95"});
  const History& h = r.history();
  std::size_t row = 0;
  while (row + 1 < h.rows() && h.at(row, "damaged_particles") == 0.0) ++row;
  const double splitting = 0.5 * std::numbers::pi * 0.05 * 0.025 * r.scene.parameters.tensile_strength;
  EXPECT_NEAR(h.at(row, "load"), splitting, 0.03 * splitting);
}

/// Between flat platens and between jaws: the stresses of the closed form at the centre while the disc is elastic, and
/// the peak when the one across the load reaches the strength. The process zone, twice the diameter, lets the load rise
/// a little; the crack lies along it.
TEST(ShippedTension, BrazilianDiscsSplitAtTheLoadOfTheClosedForm) {
  constexpr double diameter = 0.05, thickness = 0.025;
  for (const char* name : {"brazilian_jaws", "brazilian_flat"}) {
    const ShippedRun r = run_shipped(name, {"spacing=0.001", "stop.load_below=0.8"});
    EXPECT_NE(r.result.reason.find("stop.load_below"), std::string::npos) << r.result.reason;
    const History& h = r.history();
    const double splitting = 0.5 * std::numbers::pi * diameter * thickness * r.scene.parameters.tensile_strength;
    std::size_t half = 0;
    while (h.at(half, "load") < 0.5 * splitting) ++half;
    const double unit = 2.0 * h.at(half, "load") / (std::numbers::pi * diameter * thickness);
    EXPECT_NEAR(h.at(half, "sxx"), unit, 0.04 * unit) << name;
    EXPECT_NEAR(h.at(half, "syy"), -3.0 * unit, 0.04 * 3.0 * unit) << name;
    EXPECT_GT(r.found.peak_load, splitting) << name;
    EXPECT_LT(r.found.peak_load, 1.1 * splitting) << name;
    EXPECT_LT(r.found.kinetic_ratio, 0.01) << name;
    // The tips of the wedges under the platens aside.
    double beside = 0.0, along = 0.0;
    for (const Spot& s : r.spots) {
      if (s.damage < 0.5 || std::abs(s.at[1]) > 0.3 * diameter) continue;
      beside = std::max(beside, std::abs(s.at[0]));
      along = std::max(along, std::abs(s.at[1]));
    }
    EXPECT_LT(beside, 4.0 * r.scene.spacing) << name;
    EXPECT_GT(along, 0.2 * diameter) << name;
  }
}

/// A central crack along the load and one in pure mode II. The peak of the first is below that of linear fracture
/// mechanics with K_Ic^2 = E' G, and above that for a crack that is longer by half of the process zone E' G/strength^2
/// at either tip; wings grow from the tips towards the jaws.
TEST(ShippedTension, CrackedDiscsGrowWingsToTheJaws) {
  constexpr double radius = 0.05, thickness = 0.025, half = 0.015, spacing = 0.0015;
  const std::string coarse = "spacing=" + std::to_string(spacing);
  const ShippedRun straight = run_shipped("cracked_disc", {coarse, "stop.load_below=0.95"});
  const fpz::Parameters& m = straight.scene.parameters;
  const double modulus = m.young_modulus / (1.0 - m.poisson_ratio * m.poisson_ratio);
  const double energy = straight.found.fracture_energy, zone = modulus * energy / std::pow(m.tensile_strength, 2);
  // K_I = P sqrt(a)/(sqrt(pi) R) N_I; for N_I at the angle 0 see shipped_elastic_test.cpp, here with the next terms.
  const auto linear = [&](double a, double factor) {
    return std::sqrt(modulus * energy * std::numbers::pi / a) * radius * thickness / factor;
  };
  EXPECT_NEAR(linear(half, 1.135551), 25.5e3, 0.1e3);
  EXPECT_LT(straight.found.peak_load, linear(half, 1.135551));
  EXPECT_GT(straight.found.peak_load,
            linear(half + 0.5 * zone, 1.35));  // a/R = 0.48, between 1.243 (0.4) and 1.387 (0.5)
  const ShippedRun sheared = run_shipped("cracked_disc", {coarse, "stop.load_below=0.95", "notches[0].angle_deg=27.5",
                                                          "notches[0].mouth=[0.0069263,-0.0133052]"});
  EXPECT_LT(sheared.found.peak_load, straight.found.peak_load);
  for (const ShippedRun* r : {&straight, &sheared}) {
    const double angle = (r == &straight ? 0.0 : 27.5) * std::numbers::pi / 180.0;
    const Point tip = half * Point(-std::sin(angle), std::cos(angle));
    // Each wing begins at its tip and turns to the line of the load.
    double nearest = 1e300, highest = 0.0, at_its_end = 0.0;
    for (const Spot& s : r->spots) {
      if (s.damage < 0.5 || s.at[1] < 0.0) continue;
      nearest = std::min(nearest, (s.at - tip).norm());
      if (s.at[1] > highest) highest = s.at[1], at_its_end = s.at[0];
    }
    EXPECT_LT(nearest, 2.0 * spacing) << angle;
    EXPECT_GT(highest, tip[1] + 0.005) << angle;
    EXPECT_LT(std::abs(at_its_end), std::max(std::abs(tip[0]), 2.0 * spacing)) << angle;
  }
}

/// Compact tension until after its peak: the stiffness of ASTM E399 for displacements on the load line (with grips at
/// the edges in place of pins), the crack on the ligament, the peak below that of linear fracture mechanics.
TEST(ShippedTension, CompactTensionBeginsAsTheStandardSays) {
  const ShippedRun r = run_shipped("compact_tension", {"spacing=0.004", "stop.load_below=0.8"});
  EXPECT_NE(r.result.reason.find("stop.load_below"), std::string::npos) << r.result.reason;
  const fpz::Parameters& m = r.scene.parameters;
  const double modulus = m.young_modulus / (1.0 - m.poisson_ratio * m.poisson_ratio), a = 0.4, w = 0.1, b = 0.05;
  const double compliance = std::pow((1.0 + a) / (1.0 - a), 2) *
                            (2.163 + a * (12.219 + a * (-20.065 + a * (-0.9925 + a * (20.609 - 9.9314 * a))))) /
                            (modulus * b);
  EXPECT_NEAR(r.found.stiffness * compliance, 1.0, 0.1);
  const double f = (2.0 + a) * (0.886 + a * (4.64 + a * (-13.32 + a * (14.72 - 5.6 * a)))) / std::pow(1.0 - a, 1.5);
  EXPECT_LT(r.found.peak_load, std::sqrt(modulus * r.found.fracture_energy * w) * b / f);
  const Extent crack = fpz::test::cracked_extent(r.spots);
  EXPECT_NEAR(crack.left, 0.04, 1.5 * r.scene.spacing);
  EXPECT_LT(std::max(-crack.low, crack.high), 2.0 * r.scene.spacing);
}

double farthest_from(double line, int component, const std::vector<Spot>& spots) {
  double most = 0.0;
  for (const Spot& s : spots) {
    if (s.damage > 0.9) most = std::max(most, std::abs(s.at[component] - line));
  }
  return most;
}

/// Energy that the cracks have taken over G times the ligament (m^2). A tenth of the peak load is left: less than one.
double part_of_ligament(const ShippedRun& r, double ligament) {
  return r.history().last("energy_fracture") / (r.found.fracture_energy * ligament);
}

/// Ahead of this crack the stress along the ligament is the higher one: its particles must not keep the planes that it
/// asks for first, or the crack goes round them. What is left beside the crack keeps its frequencies below the time
/// step.
TEST(ShippedTension, CompactTensionBreaksItsLigamentOnly) {
  const ShippedRun r =
      run_shipped("compact_tension", {"spacing=0.0025", "method.courant=0.9", "boundaries[0].velocity.y.speed=0.01",
                                      "boundaries[1].velocity.y.speed=-0.01"});
  EXPECT_NE(r.result.reason.find("stop.load_below"), std::string::npos) << r.result.reason;
  EXPECT_NEAR(part_of_ligament(r, 0.06 * 0.05), 0.8, 0.2);
  EXPECT_LT(std::abs(r.history().last("energy_error")), 0.005 * r.history().last("energy_external"));
  EXPECT_LT(farthest_from(0.0, 1, r.spots), 2.0 * r.scene.spacing);
}

/// Straight down from the cut, with equal forces on both bearings.
TEST(ShippedTension, WedgeSplittingBreaksItsLigamentOnly) {
  const ShippedRun r =
      run_shipped("wedge_splitting", {"boundaries[0].velocity.x.speed=-0.01", "boundaries[1].velocity.x.speed=0.01"});
  EXPECT_NE(r.result.reason.find("stop.load_below"), std::string::npos) << r.result.reason;
  EXPECT_NEAR(part_of_ligament(r, 0.055 * 0.1), 0.8, 0.2);
  EXPECT_LT(farthest_from(0.0, 0, r.spots), 3.0 * r.scene.spacing);
  const History& h = r.history();
  for (std::size_t row = 0; h.at(row, "load") < 0.999 * r.found.peak_load; ++row) {
    EXPECT_NEAR(h.at(row, "support"), h.at(row, "load"), 0.02 * r.found.peak_load);
  }
}

/// A lever on two rollers shares the load as statics has it. The crack begins at the notch and leans towards the inner
/// support.
TEST(ShippedTension, FourPointShearSharesTheLoadAsTheLeverDoes) {
  constexpr double ligament = 0.08, thickness = 0.1;
  const ShippedRun r = run_shipped("four_point_shear", {"spacing=0.00667", "stop.load_below=0.7"});
  EXPECT_NE(r.result.reason.find("stop."), std::string::npos) << r.result.reason;
  const History& h = r.history();
  double worst = 0.0;  // over the peak load, up to it
  for (std::size_t row = 0; h.at(row, "load") < 0.999 * r.found.peak_load; ++row) {
    const double load = h.at(row, "load");
    worst = std::max(worst, std::abs(h.at(row, "inner") - 10.0 / 11.0 * load) / r.found.peak_load);
    worst = std::max(worst, std::abs(h.at(row, "outer") - 1.0 / 11.0 * load) / r.found.peak_load);
  }
  EXPECT_LT(worst, 0.015);
  EXPECT_LT(h.last("load"), 0.75 * r.found.peak_load);
  EXPECT_LT(r.found.kinetic_ratio_after, 0.05);
  // A beam without a stress peak at its notch cracks when 3/2 of the mean shear stress is the strength; if its notch
  // did nothing, the strut from the inner load to the inner support would split, like a disc of its length.
  const double strength = r.scene.parameters.tensile_strength, strut = std::hypot(0.04, 0.1);
  EXPECT_GT(9.0 / 11.0 * r.found.peak_load, 2.0 / 3.0 * strength * ligament * thickness);
  EXPECT_LT(10.0 / 11.0 * r.found.peak_load, 0.5 * std::numbers::pi * strut * thickness * strength);
  double nearest = 1e300, sum = 0.0, weight = 0.0;
  for (const Spot& s : r.spots) {
    if (s.damage < 0.5) continue;
    nearest = std::min(nearest, (s.at - Point(0.0, 0.08)).norm());
    if (s.at[1] > 0.04 && s.at[1] < 0.075) sum += s.damage * s.at[0], weight += s.damage;
  }
  EXPECT_LT(nearest, 2.0 * r.scene.spacing);
  EXPECT_LT(sum / weight, 0.0);
  EXPECT_GT(sum / weight, -0.02);
}

/// Without confinement the onset surface sqrt(r^2 + A^2) = c cos(phi) + r sin(phi) is reached at the stress 2 r.
TEST(ShippedTension, UniaxialCompressionBreaksAtItsStrength) {
  const ShippedRun r = run_shipped("uniaxial_compression", {"spacing=0.005", "stop.load_below=0.8"});
  EXPECT_NE(r.result.reason.find("stop.load_below"), std::string::npos) << r.result.reason;
  const fpz::Parameters& m = r.scene.parameters;
  const double phi = m.friction_angle_deg * std::numbers::pi / 180.0, sine = std::sin(phi);
  const double apex = m.cohesion - m.tensile_strength * std::tan(phi), c = m.cohesion * std::cos(phi);
  const double radius =
      (c * sine + std::sqrt(c * c * sine * sine + (1.0 - sine * sine) * (c * c - apex * apex))) / (1.0 - sine * sine);
  const double strength = 2.0 * radius * 0.05 * 0.05;
  EXPECT_NEAR(strength, 70.8e3, 0.1e3);
  EXPECT_NEAR(r.found.peak_load, strength, 0.04 * strength);  // ten rows between bonded platens
}

TEST(ShippedTension, ALeverThatStandsBesideTheBeamIsNamed) {
  const auto said = [](const char* change) -> std::string {
    try {
      (void)read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes/four_point_shear.json", {change});
    } catch (const fpz::io::InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(said("spacing=0.005"), "");
  EXPECT_NE(said("boundaries[0].also_at=[[-0.5,0.1]]").find("boundaries[0].also_at: the platen is off the body"),
            std::string::npos);
  EXPECT_NE(said("boundaries[0].also_at=[[0.025,0.1]]").find("boundaries[0].also_at"), std::string::npos);
  EXPECT_NE(said("boundaries[0].hinge=true").find("give the point [x, y]"), std::string::npos);
}

}  // namespace
