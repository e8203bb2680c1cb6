// The smooth curve of a monotonic test against the path by steps, and its smoothness in the parameters.
#include "fpz/calibration/monotonic_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fpz/calibration/mid_line.hpp"
#include "specimens.hpp"

namespace fpz::calibration {
namespace {

using test::beam;
using test::concrete;
using test::semicircular;

Eigen::VectorXd by_steps(const Condensation& body, const Parameters& p, const Eigen::VectorXd& readings) {
  MidLine path(body, p, {}, false);
  Eigen::VectorXd out(readings.size());
  for (Eigen::Index k = 0; k < readings.size(); ++k) {
    EXPECT_EQ(path.advance(readings[k]), "");
    out[k] = path.load();
  }
  return out;
}

/// On the same mesh both differ by the waves that the cracking of the nodes puts on the path by steps; on a mesh four
/// times as fine these are gone, and the smooth curve on the coarse one is no worse than the steps there.
TEST(MonotonicCurve, AgreesWithThePathBySteps) {
  for (const NotchedSpecimen& s : {beam(), semicircular()}) {
    NotchedSpecimen fine = s;
    fine.mesh.ligament_fraction /= 4.0;
    const Parameters p = concrete();
    const Condensation body = condense(s, p.poisson_ratio);
    const Condensation fine_body = condense(fine, p.poisson_ratio);
    const Eigen::VectorXd cmod = Eigen::VectorXd::LinSpaced(100, 1e-7, 2e-4);
    const MonotonicCurve smooth = monotonic_curve(body, p, {}, cmod, false);
    const MonotonicCurve fine_smooth = monotonic_curve(fine_body, p, {}, cmod, false);
    ASSERT_EQ(smooth.failure + fine_smooth.failure, "");
    const Eigen::VectorXd steps = by_steps(body, p, cmod);
    const Eigen::VectorXd fine_steps = by_steps(fine_body, p, cmod);
    const double peak = fine_steps.maxCoeff();
    EXPECT_LE((smooth.load - steps).cwiseAbs().maxCoeff(), 1.2e-3 * peak);
    EXPECT_LE((fine_smooth.load - fine_steps).cwiseAbs().maxCoeff(), 4e-4 * peak);
    EXPECT_LE((smooth.load - fine_steps).cwiseAbs().maxCoeff(),
              1.05 * (steps - fine_steps).cwiseAbs().maxCoeff() + 2e-5 * peak);
  }
}

/// The largest jump of dP/dE at a reading near the peak, over its mean change, while E grows by 8 % in steps.
template <class DerivativeAt>
double roughness(const DerivativeAt& derivative_at) {
  constexpr int steps = 200;
  double last = 0.0;
  double largest = 0.0;
  double sum = 0.0;
  for (int k = 0; k <= steps; ++k) {
    Parameters p = concrete();
    p.young_modulus *= 1.0 + 0.08 * k / steps;
    const double now = derivative_at(p);
    if (k > 0) {
      largest = std::max(largest, std::abs(now - last));
      sum += std::abs(now - last);
    }
    last = now;
  }
  return largest / (sum / steps);
}

TEST(MonotonicCurve, DerivativesDoNotJumpWhereNodesCrack) {
  const Condensation body = condense(beam(), concrete().poisson_ratio, true);
  const double cmod = 1.4e-5;  // behind the peak, where dP/dE is small
  const double smooth = roughness([&](const Parameters& p) {
    const MonotonicCurve c = monotonic_curve(body, p, {}, Eigen::VectorXd::Constant(1, cmod), true);
    EXPECT_EQ(c.failure, "");
    return c.derivatives(0, static_cast<int>(PathInput::young_modulus));
  });
  const double steps = roughness([&](const Parameters& p) {
    MidLine path(body, p, {}, true);
    EXPECT_EQ(path.advance(cmod), "");
    return path.load_derivatives()[static_cast<int>(PathInput::young_modulus)];
  });
  EXPECT_LT(smooth, 4.0);
  EXPECT_GT(steps, 10.0);  // the kinks of which this curve is free
}

TEST(MonotonicCurve, StaysOnTheElasticLineBeforeTheFirstCrack) {
  const Parameters p = concrete();
  const Condensation body = condense(beam(), p.poisson_ratio);
  const double stiffness = p.young_modulus / body.body.gauge_load[static_cast<int>(Gauge::cmod)];
  const Control control{Gauge::cmod, 1e-6, 2e-9};
  const Eigen::Vector3d readings(0.0, 1e-6, 1.05e-6);
  const MonotonicCurve c = monotonic_curve(body, p, control, readings, false);
  ASSERT_EQ(c.failure, "");
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double expected = (readings[k] - 1e-6) / (1.0 / stiffness + 2e-9);
    EXPECT_NEAR(c.load[k], expected, 1e-9 * stiffness * 1e-6);
  }
}

}  // namespace
}  // namespace fpz::calibration
