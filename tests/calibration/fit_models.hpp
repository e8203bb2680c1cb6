// Small models with exact derivatives and seeded noise for the tests of the fit.
#pragma once

#include <ceres/jet.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

#include "fpz/calibration/fit.hpp"

namespace fpz::calibration::testing {

/// Standard normal numbers, the same with every standard library (Box-Muller).
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : generator_(seed) {}
  double operator()() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * 3.14159265358979323846 * uniform());
  }
  Eigen::VectorXd vector(Eigen::Index n) {
    Eigen::VectorXd out(n);
    for (double& x : out) x = (*this)();
    return out;
  }

 private:
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
  std::mt19937_64 generator_;
};

/// f(parameters, x) for Jets of N parameters, at all x.
template <int N, class F>
Forward curve(const Eigen::VectorXd& x, F f) {
  return [x, f](const Eigen::VectorXd& p, bool derivatives) {
    using J = ceres::Jet<double, N>;
    Eigen::Matrix<J, N, 1> parameters;
    for (int k = 0; k < N; ++k) parameters[k] = J(p[k], k);
    Prediction out;
    out.values.resize(x.size());
    if (derivatives) out.jacobian.resize(x.size(), N);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const J y = f(parameters, x[i]);
      out.values[i] = y.a;
      if (derivatives) out.jacobian.row(i) = y.v.transpose();
    }
    return out;
  };
}

/// y = A p.
inline Forward linear(const Eigen::MatrixXd& a) {
  return [a](const Eigen::VectorXd& p, bool derivatives) {
    Prediction out;
    out.values = a * p;
    if (derivatives) out.jacobian = a;
    return out;
  };
}

/// y = a exp(-x/b).
inline Forward decay(const Eigen::VectorXd& x) {
  return curve<2>(x, [](const auto& p, double at) { return p[0] * exp(-at / p[1]); });
}

inline FitParameter parameter(const std::string& name, double start, double lower, double upper) {
  FitParameter p;
  p.name = name;
  p.start = start;
  p.lower = lower;
  p.upper = upper;
  return p;
}

inline Observations observations(const std::string& name, const Eigen::VectorXd& measured, double deviation,
                                 const Forward& forward, bool known = true) {
  Observations data;
  data.name = name;
  data.measured = measured;
  data.deviation = Eigen::VectorXd::Constant(measured.size(), deviation);
  data.deviation_known = known;
  data.forward = forward;
  return data;
}

/// Bounds of the decay problem: a strength and a length as in rock.
inline std::vector<FitParameter> decay_parameters() {
  return {parameter("strength", 4e6, 1e5, 1e8), parameter("length", 3e-5, 1e-6, 1e-3)};
}
inline Eigen::VectorXd decay_truth() { return Eigen::Vector2d(9.74e6, 2.77e-5); }
inline Eigen::VectorXd openings(Eigen::Index n) { return Eigen::VectorXd::LinSpaced(n, 0.0, 1e-4); }

}  // namespace fpz::calibration::testing
