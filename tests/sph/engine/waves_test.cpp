// Elastodynamics against closed forms.
#include <algorithm>
#include <cmath>
#include <vector>

#include "fpz/material.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

/// A confined bar of length 0.1 m, one end driven with the smooth ramp to `speed` within `ramp`: plane waves of speed
/// sqrt((lambda + 2 mu)/rho).
struct Bar {
  static constexpr double length = 0.1;
  static constexpr double speed = 0.01;
  static constexpr double ramp = 1e-5;
  static constexpr int rows = 4;

  explicit Bar(int columns, Configuration configuration) : setup(block(columns, rows, 0.0, length / columns)) {
    const double dx = length / columns;
    setup.options.configuration = configuration;
    setup.options.viscosity_alpha = 0.0;
    setup.options.artificial_stress = 0.0;
    setup.options.courant = 0.2;
    setup.options.zero_energy_control = 0.0;  // the order of the gradient alone
    const Motion still{0.0, 0.0};
    add_group(setup, {"walls", {std::nullopt, still}, true}, [](const Vector&) { return true; });
    add_group(setup, {"driven", {Motion{speed, ramp}, still}, true}, [dx](const Vector& x) { return x[0] < dx; });
    add_group(setup, {"fixed", {still, still}, true}, [dx](const Vector& x) { return x[0] > length - dx; });
    const Material<double> m = make_material(setup.parameters, setup.setting);
    celerity = std::sqrt((m.bulk.lambda + 2.0 * m.bulk.mu) / setup.parameters.density);
    driven_at = 0.5 * dx;
  }

  RunSetup<2> setup;
  double celerity = 0.0;
  double driven_at = 0.0;
};

/// Relative error (maximum norm) of the velocities of a middle row when the wave is at 60 % of the bar.
double wave_error(int columns, Configuration configuration) {
  const Bar bar(columns, configuration);
  Simulation<2> run(bar.setup);
  advance(run, static_cast<long long>(0.6 * Bar::length / bar.celerity / run.time_step()));
  const Drive drive = Motion{Bar::speed, Bar::ramp};
  const Particles<2>& p = run.particles();
  double worst = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double arrival = (p.start[0][i] - bar.driven_at) / bar.celerity;
    const double time = run.time() + 0.5 * run.time_step();  // velocities are half a step ahead
    worst = std::max(worst, std::abs(p.velocity[0][i] - drive.table.at(time - arrival)));
  }
  return worst / Bar::speed;
}

TEST(Waves, ConfinedBarConvergesInBothConfigurations) {
  for (const Configuration c : {Configuration::reference, Configuration::updated}) {
    const double coarse = wave_error(50, c);
    const double middle = wave_error(100, c);
    const double fine = wave_error(200, c);
    RecordProperty(c == Configuration::reference ? "reference_error" : "updated_error", std::to_string(fine));
    EXPECT_LT(fine, 0.02);
    // First order: the driven and the free ends of the gradient are one-sided.
    EXPECT_GT(std::log2(coarse / middle), 1.0);
    EXPECT_GT(std::log2(middle / fine), 1.0);
  }
}

double mean_stress(const Simulation<2>& run, double from, double to) {
  const Particles<2>& p = run.particles();
  double sum = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.start[0][i] < from || p.start[0][i] > to) continue;
    sum += p.stress[0][i];
    ++n;
  }
  return sum / n;
}

TEST(Waves, StressIsImpedanceTimesVelocityAndDoublesAtAFixedEnd) {
  const Bar bar(200, Configuration::reference);
  Simulation<2> run(bar.setup);
  const double exact = -bar.setup.parameters.density * bar.celerity * Bar::speed;
  const double crossing = Bar::length / bar.celerity;
  advance(run, static_cast<long long>(0.9 * crossing / run.time_step()));
  EXPECT_NEAR(mean_stress(run, 0.015, 0.04) / exact, 1.0, 5e-3);
  advance(run, static_cast<long long>(0.9 * crossing / run.time_step()));
  EXPECT_NEAR(mean_stress(run, 0.06, 0.085) / exact, 2.0, 1e-2);
  EXPECT_NEAR(run.reaction(2)[0] / (exact * Bar::rows * Bar::length / 200), 2.0, 2e-2);
}

/// The cantilever of Gray, Monaghan and Swift: first bending mode, period 0.254 s for these sizes.
double plate_period(Configuration configuration, int layers, double control = Options<2>{}.zero_energy_control) {
  constexpr double length = 0.2;
  constexpr double thickness = 0.02;
  const double dx = thickness / layers;
  const int clamped = 3;
  RunSetup<2> s;
  s.parameters = unbreakable();
  s.parameters.young_modulus = 2e6;
  s.parameters.poisson_ratio = 0.3975;
  s.parameters.density = 1000.0;
  s.options.threads = 1;
  s.options.configuration = configuration;
  s.options.zero_energy_control = control;
  s.arrangement.spacing = dx;
  add_lattice<2>(s.arrangement, vec(-clamped * dx, 0.0), vec(length, thickness));
  const Motion still{0.0, 0.0};
  add_group(s, {"clamp", {still, still}, true}, [](const Vector& x) { return x[0] < 0.0; });
  const double k = 1.875 / length;
  const double c0 = std::sqrt(s.parameters.young_modulus / (3.0 * (1.0 - 2.0 * s.parameters.poisson_ratio)) / 1000.0);
  const auto shape = [k](double x) {
    const double kl = 1.875;
    const double m = std::sin(kl) + std::sinh(kl);
    const double n = std::cos(kl) + std::cosh(kl);
    const double q = 2.0 * (std::cos(kl) * std::sinh(kl) - std::sin(kl) * std::cosh(kl));
    return (m * (std::cos(k * x) - std::cosh(k * x)) - n * (std::sin(k * x) - std::sinh(k * x))) / q;
  };
  set_velocity(s, [&](const Vector& x) { return vec(0.0, x[0] < 0.0 ? 0.0 : 0.01 * c0 * shape(x[0])); });
  Simulation<2> run(s);
  std::size_t tip = 0;
  double nearest = 1.0;
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const double d = (s.arrangement.position[i] - vec(length, 0.5 * thickness)).norm();
    if (d < nearest) {
      nearest = d;
      tip = run.slot(i);
    }
  }
  // Half a period from rest position to the next passage.
  double before = 0.0;
  while (run.time() < 0.4) {
    const Outcome o = run.step();
    EXPECT_TRUE(o.ok()) << o.message();
    if (!o.ok()) return 0.0;
    const double now = run.particles().position[1][tip] - run.particles().start[1][tip];
    if (run.steps() > 10 && before > 0.0 && now <= 0.0) {
      return 2.0 * (run.time() - run.time_step() * now / (now - before));
    }
    before = now;
  }
  return 0.0;
}

/// Thin-plate theory gives 0.254 s; the plane strain solid of thickness L/10 is about 1 % slower.
TEST(Waves, OscillatingPlateConverges) {
  const double coarse = plate_period(Configuration::reference, 5) / 0.254 - 1.0;
  const double fine = plate_period(Configuration::reference, 10) / 0.254 - 1.0;
  EXPECT_LT(fine, 0.065);
  EXPECT_GT(fine, 0.0);
  EXPECT_GT(std::log2(coarse / fine), 1.4);
  // Without a control in either.
  EXPECT_NEAR(plate_period(Configuration::updated, 5), plate_period(Configuration::reference, 5, 0.0), 0.04 * 0.254);
}

}  // namespace
}  // namespace fpz::sph::test
