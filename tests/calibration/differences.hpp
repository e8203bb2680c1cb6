// Derivatives of a forward model against differences of its values.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "fpz/calibration/prediction.hpp"

namespace fpz::calibration {

using ModelValues = std::function<Prediction(const Parameters&, bool derivatives)>;

/// Compares each column k of the Jacobian, times p_k, with central differences of fourth order over relative steps
/// `step` of p_k. Tolerances are relative to the largest entry of the same row (the value and such products), but at
/// least to `least_scale`, for values that are zero to rounding.
inline void expect_derivatives(const ModelValues& model, const Parameters& p, double step = 1e-3,
                               double tolerance = 1e-7, double least_scale = 0.0) {
  const Prediction plain = model(p, false);
  const Prediction full = model(p, true);
  ASSERT_TRUE(plain.ok()) << plain.failure;
  ASSERT_TRUE(full.ok()) << full.failure;
  ASSERT_EQ(plain.jacobian.size(), 0);
  ASSERT_EQ(full.jacobian.rows(), full.values.size());
  ASSERT_EQ(full.jacobian.cols(), parameter_count);
  Eigen::MatrixXd exact(full.values.size(), parameter_count);
  Eigen::MatrixXd differences(full.values.size(), parameter_count);
  for (int k = 0; k < parameter_count; ++k) {
    const auto member = parameter_info[static_cast<std::size_t>(k)].member;
    const auto at = [&](double factor) {
      Parameters q = p;
      q.*member = p.*member * (1.0 + factor * step);
      const Prediction x = model(q, false);
      EXPECT_TRUE(x.ok()) << x.failure;
      return x.ok() ? x.values : Eigen::VectorXd(Eigen::VectorXd::Zero(full.values.size()));
    };
    differences.col(k) = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
    exact.col(k) = full.jacobian.col(k) * (p.*member);
  }
  for (Eigen::Index i = 0; i < full.values.size(); ++i) {
    const double scale = std::max({std::abs(plain.values[i]), exact.row(i).cwiseAbs().maxCoeff(), least_scale});
    EXPECT_NEAR(plain.values[i], full.values[i], 1e-3 * tolerance * scale) << "value " << i;
    for (int k = 0; k < parameter_count; ++k) {
      EXPECT_NEAR(exact(i, k), differences(i, k), tolerance * scale)
          << "value " << i << " by " << parameter_info[static_cast<std::size_t>(k)].name;
    }
  }
}

}  // namespace fpz::calibration
