// Points that the benchmarks start from: Table 1, H = 4 mm, on stage 2 of the four-stage path.
#pragma once

#include <stdexcept>
#include <vector>

#include "support/paths.hpp"

namespace fpz::bench {

/// d eps_xx of the paper's increments (section 4.5).
inline constexpr double paper_increment = 3e-7;

template <int Dim>
[[nodiscard]] Material<double> johnstone() {
  return make_material(test::table1(), Dim == 2 ? Setting::plane_strain : Setting::three_d);
}

/// Stage 2 of the path: d eps_xy = 5 d eps_xx; in 3-D the shear is oblique.
template <int Dim>
[[nodiscard]] Tensor<double, Dim> mixed_loading(double increment) {
  Tensor<double, Dim> d = Tensor<double, Dim>::Zero();
  d[0] = increment;
  d[Dim == 2 ? 2 : 3] = 5.0 * increment;
  if constexpr (Dim == 3) d[4] = 2.0 * increment;
  return d;
}

[[nodiscard]] inline Options options_of(Method method, double tolerance = 1e-4) {
  Options o;
  o.method = method;
  o.tolerance = tolerance;
  return o;
}

inline constexpr int point_count = 16;

/// Consecutive cracked points that yield when `mixed_loading` goes on.
template <int Dim>
[[nodiscard]] std::vector<State<double, Dim>> yielding_points(const Material<double>& m) {
  const Options o = options_of(Method::accurate, 1e-10);
  State<double, Dim> s;
  const auto move = [&](const Tensor<double, Dim>& d) {
    if (!update<Dim>(m, o, s, d, s).ok()) throw std::runtime_error("yielding_points: the update failed");
  };
  Tensor<double, Dim> opening = Tensor<double, Dim>::Zero();
  opening[0] = 3e-3;
  move(opening);
  for (int k = 0; k < 40; ++k) move(mixed_loading<Dim>(3e-6));
  std::vector<State<double, Dim>> points;
  for (int k = 0; k < point_count; ++k) {
    points.push_back(s);
    move(mixed_loading<Dim>(paper_increment));
  }
  return points;
}

/// Uncracked points under tension and shear: sigma_xx goes up to `level` of sigma_t0.
template <int Dim>
[[nodiscard]] std::vector<State<double, Dim>> intact_points(const Material<double>& m, double level) {
  const double modulus = m.bulk.lambda + 2.0 * m.bulk.mu;
  std::vector<State<double, Dim>> points;
  for (int k = 0; k < point_count; ++k) {
    State<double, Dim> s;
    s.strain[0] = (level - 0.002 * k / point_count) * m.law.surface.tensile_strength / modulus;
    s.strain[Dim] = 1e-6 * k;
    s.stress = m.bulk.stress<double, Dim>(s.strain);
    points.push_back(s);
  }
  return points;
}

}  // namespace fpz::bench
