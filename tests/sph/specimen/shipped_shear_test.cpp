// Shipped scenes of shear and compression, coarse, each on its number.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fpz/specimen/run.hpp"
#include "support/temporary_folder.hpp"

namespace {

using fpz::degree;
using namespace fpz::specimen;

RunResult run(const char* name, Overrides set, const std::string& folder) {
  set.insert(set.end(), {"output.pictures=false", "output.history_rows=500"});
  RunRequest request;
  request.folder = fpz::test::fresh_path(folder);
  request.threads = 1;
  RunResult r = run_scene(read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes" / name, set), request);
  EXPECT_EQ(r.ending, Ending::finished) << r.reason;
  for (const std::string& w : r.warnings) EXPECT_EQ(w.find("not quasi-static"), std::string::npos) << w;
  return r;
}

std::size_t first_row(const History& h, const char* gauge, double above) {
  std::size_t row = 0;
  while (row + 1 < h.rows() && h.at(row, gauge) < above) ++row;
  return row;
}

double mean(const History& h, const char* gauge, std::size_t from) {
  double sum = 0.0;
  for (std::size_t row = from; row < h.rows(); ++row) sum += h.at(row, gauge);
  return sum / static_cast<double>(h.rows() - from);
}

double largest(const History& h, const char* gauge) {
  double most = -1e300;
  for (std::size_t row = 0; row < h.rows(); ++row) most = std::max(most, h.at(row, gauge));
  return most;
}

/// Shear force over displacement while it rises from one value to another.
double shear_stiffness(const History& h, double from, double to) {
  const std::size_t a = first_row(h, "load", from), b = first_row(h, "load", to);
  return (h.at(b, "load") - h.at(a, "load")) / (h.at(b, "deflection") - h.at(a, "deflection"));
}

/// Coulomb: the joint sticks, as stiff as no joint, up to N tan(phi), which is peak and residual in one.
TEST(ShippedShear, AFlatJointSlidesAtTheFrictionOfTheNormalForce) {
  const History whole =
      run("shear_box_stress.json", {"spacing=0.004", "notches=[]", "stages[1].stop.gauges.deflection.above=4e-6"},
          "shear_whole")
          .history;
  for (const auto& [force, friction_deg] : {std::pair{10e3, 30.0}, std::pair{5e3, 40.0}}) {
    const History h = run("shear_box_stress.json",
                          {"spacing=0.004", "boundaries[0].force.y.value=" + std::to_string(-force),
                           "notches[0].friction_angle_deg=" + std::to_string(friction_deg)},
                          "shear_stress")
                          .history;
    const double right = force * std::tan(friction_deg * degree);
    EXPECT_NEAR(shear_stiffness(h, 0.2 * right, 0.6 * right), shear_stiffness(whole, 1e3, 3e3),
                0.02 * shear_stiffness(whole, 1e3, 3e3));
    EXPECT_NEAR(largest(h, "load"), right, 0.01 * right);
    const std::size_t sliding = first_row(h, "deflection", 1.5e-5);
    EXPECT_NEAR(mean(h, "load", sliding), right, 2e-3 * right);
    EXPECT_NEAR(mean(h, "support", sliding), right, 2e-3 * right);
    EXPECT_NEAR(mean(h, "normal", sliding), force, 1e-3 * force);
    EXPECT_NEAR(h.last("rise"), h.at(sliding, "rise"), 1e-3 * (h.last("deflection") - h.at(sliding, "deflection")));
    EXPECT_EQ(h.last("damaged_particles"), 0.0);
  }
}

/// A joint that rises by the angle i: the block climbs, the spring presses harder, T = N tan(phi + i). The spring of
/// the machine is in series with the block, whose stiffnesses are those of pressing and sticking.
TEST(ShippedShear, AnInclinedJointClimbsAgainstTheMachine) {
  const double machine = 5e7, rise = std::tan(15.0 * degree);
  const RunResult r = run("shear_box_stiffness.json", {"spacing=0.004"}, "shear_stiffness");
  const History& h = r.history;
  ASSERT_EQ(r.stages.size(), 2u);
  const std::size_t pressed = first_row(h, "time", r.stages[0].end);
  const double n0 = h.at(pressed, "normal"), normal_stiffness = n0 / -h.at(pressed, "rise");
  EXPECT_NEAR(n0, machine * (102e-6 + h.at(pressed, "rise")), 2e-3 * n0);
  const double sticking = shear_stiffness(h, 0.2 * n0, 0.6 * n0), steep = std::tan(45.0 * degree);
  const std::size_t begin = first_row(h, "deflection", 5e-5), end = h.rows() - 1;
  for (const std::size_t row : {begin, (begin + end) / 2, end}) {
    const double n = h.at(row, "normal"), slip = h.at(row, "deflection") - h.at(row, "load") / sticking;
    EXPECT_NEAR(h.at(row, "load"), n * steep, 5e-3 * n);
    EXPECT_NEAR(h.at(row, "rise") - h.at(pressed, "rise"), slip * rise - (n - n0) / normal_stiffness,
                0.01 * slip * rise);
  }
  const double k = machine * rise, wanted = k / (1.0 + k * steep / sticking + machine / normal_stiffness);
  const double slope =
      (h.at(end, "normal") - h.at(begin, "normal")) / (h.last("deflection") - h.at(begin, "deflection"));
  EXPECT_NEAR(slope, wanted, 0.02 * wanted);
  EXPECT_GT(h.at(end, "normal"), 1.4 * n0);
}

/// The same machine on a flat joint: nothing climbs, the normal force stays.
TEST(ShippedShear, AFlatJointLeavesTheMachineAlone) {
  const RunResult r = run("shear_box_stiffness.json",
                          {"spacing=0.004", "notches[0].mouth=[-0.05, 0]", "notches[0].angle_deg=-90",
                           "stages[1].stop.gauges.deflection.above=8e-5"},
                          "shear_flat");
  const History& h = r.history;
  const double n0 = h.at(first_row(h, "time", r.stages[0].end), "normal"), right = n0 * std::tan(30.0 * degree);
  const std::size_t sliding = first_row(h, "deflection", 3e-5);
  EXPECT_NEAR(mean(h, "normal", sliding), n0, 2e-3 * n0);
  EXPECT_NEAR(mean(h, "load", sliding), right, 2e-3 * right);
}

}  // namespace
