// The scene of two materials that the guide of docs/scenes.md shows, coarser, on its numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fpz/io/csv.hpp"
#include "fpz/specimen/run.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

/// Normal stress at the pole of a circular inclusion over the mean one, in plane strain and an infinite plate
/// (Goodier 1933), for equal Poisson's ratios: the stress in it is even, and continuous across the pole.
double concentration(double stiffness_ratio, double poisson) {
  const double kappa = 3.0 - 4.0 * poisson, g = stiffness_ratio;
  return 0.5 * g * (kappa + 1.0) * (1.0 / (2.0 * g + kappa - 1.0) + 1.0 / (kappa * g + 1.0));
}

TEST(ShippedScenes, AStoneInMortarIsPassedByTheCrack) {
  const Scene scene = read_scene(fs::path(FPZ_DATA_DIR) / "scenes/stone_in_mortar.json",
                                 {"spacing=0.0025", "boundaries[0].velocity.y.speed=0.01", "method.courant=0.9",
                                  "stop={\"time\": 0.02}", "output.frames=0", "output.pictures=false"});
  RunRequest request;
  request.folder = fpz::test::fresh_path("stone_in_mortar");
  const RunResult r = run_scene(scene, request);
  const History& h = r.history;
  const double area = 0.08 * scene.thickness, strength = scene.parameters.tensile_strength * area;
  const double in_stone = concentration(3.0, 0.2);
  EXPECT_NEAR(in_stone, 1.298, 1e-3);
  std::size_t row = 0;
  while (row + 1 < h.rows() && h.at(row, "load") < 0.5 * strength) ++row;
  EXPECT_NEAR(h.at(row, "concentration"), in_stone, 0.05 * in_stone);  // the stone is three tenths of the width
  double peak = 0.0;
  for (std::size_t k = 0; k < h.rows(); ++k) peak = std::max(peak, h.at(k, "load"));
  EXPECT_GT(peak, strength / in_stone);
  EXPECT_LT(peak, strength);
  EXPECT_LT(h.last("load"), 0.05 * peak) << r.reason;  // parted, but for a last bridge
  // One crack across the plate, a little longer than it is wide, with the G of the mortar.
  const double g = scene.parameters.tensile_strength * scene.parameters.delta0;
  EXPECT_NEAR(h.last("energy_fracture"), g * area, 0.1 * g * area);
  const fpz::io::Table crack = fpz::io::read_csv(request.folder / "crack.csv");
  for (std::size_t k = 0; k < crack.at("x").size(); ++k) {
    EXPECT_GT(std::hypot(crack.at("x")[k], crack.at("y")[k]), 0.012 - scene.spacing) << k;
  }
}

}  // namespace
