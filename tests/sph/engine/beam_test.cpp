// The notched beam of section 5.1, coarse, against finite elements with the same exponential law on a straight crack.
#include <algorithm>
#include <cmath>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

constexpr double thickness = 0.04;  // m

/// 320 x 80 mm, notch 8 mm deep, span 240 mm, rollers of three layers and two columns.
RunSetup<2> beam(double dx, double speed) {
  RunSetup<2> s;
  s.parameters = concrete();
  s.options.courant = 0.8;
  s.arrangement.spacing = dx;
  add_lattice<2>(s.arrangement, vec(-0.16, 0.0), vec(0.16, 0.08), Arrangement<2>::specimen,
                 [dx](const Vector& x) { return x[1] > 8e-3 || std::abs(x[0]) > dx; });
  s.arrangement.surface = {{vec(-0.16, 0.0), vec(-dx, 0.0), vec(-dx, 8e-3), vec(dx, 8e-3), vec(dx, 0.0), vec(0.16, 0.0),
                            vec(0.16, 0.08), vec(-0.16, 0.08), vec(-0.16, 0.0)}};
  const Motion still{0.0, 0.0};
  s.groups = {{"load", {still, Motion{-speed, 1e-3}}, true},
              {"left", {std::nullopt, still}, true},
              {"right", {std::nullopt, still}, true}};
  const auto roller = [&](double x, double y, int group) {
    add_lattice<2>(s.arrangement, vec(x - dx, y), vec(x + dx, y + 3.0 * dx), group);
  };
  roller(0.0, 0.08, 0);
  roller(-0.12, -3.0 * dx, 1);
  roller(0.12, -3.0 * dx, 2);
  return s;
}

TEST(Beam, CoarseAgreesWithFiniteElements) {
  constexpr double reference_peak = 2591.5;      // N
  constexpr double reference_stiffness = 174.4;  // N/um, load over mid-depth deflection
  const double dx = 4e-3;
  const RunSetup<2> setup = beam(dx, 0.018);
  Simulation<2> run(setup);
  const std::vector<Vector>& start = setup.arrangement.position;
  std::size_t middle = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if ((start[i] - vec(0.0, 0.04)).norm() < (start[middle] - vec(0.0, 0.04)).norm()) middle = i;
  }
  const std::size_t gauge = run.slot(middle);
  double peak = 0.0;
  double load = 0.0;
  double support = 0.0;
  double weighted = 0.0;
  double squares = 0.0;
  double deflection = 0.0;
  constexpr int window = 50;  // steps that a load cell averages over
  while (deflection < 26e-6) {
    ASSERT_TRUE(run.step().ok());
    load -= run.reaction(0)[1] * thickness / window;
    support += (run.reaction(1)[1] + run.reaction(2)[1]) * thickness / window;
    if (run.steps() % window != 0) continue;
    deflection = run.particles().start[1][gauge] - run.particles().position[1][gauge];
    peak = std::max(peak, load);
    if (load > 300.0 && load < 1200.0 && deflection < 10e-6) {
      weighted += load * deflection;
      squares += deflection * deflection;
    }
    if (load > 1000.0) {
      EXPECT_NEAR(load / support, 1.0, 0.15);
    }
    load = support = 0.0;
  }
  EXPECT_NEAR(peak / reference_peak, 1.0, 0.03);
  EXPECT_NEAR(weighted / squares * 1e-6 / reference_stiffness, 1.0, 0.03);
  const Energies e = run.energies();
  EXPECT_LT(e.kinetic, 0.01 * e.elastic);
  EXPECT_LT(std::abs(e.error()), 1e-3 * e.external);
  RecordProperty("peak_N", std::to_string(peak));
}

}  // namespace
}  // namespace fpz::sph::test
