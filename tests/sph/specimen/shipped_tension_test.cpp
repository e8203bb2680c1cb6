// Shipped scenes in which tension breaks a specimen: strengths, forces and crack paths against closed forms and
// published ranges. What the same scenes give at other spacings is in docs/tests-tension.md.
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
