// Constants of the bulk and of the cohesive zone, derived once from the parameters.
#pragma once

#include <cmath>

#include "fpz/law/cohesive_law.hpp"
#include "fpz/parameters.hpp"
#include "fpz/types.hpp"

namespace fpz {

/// Linear elastic bulk (eq 36), sigma = lambda tr(eps) I + 2 mu eps on the stored components. For plane stress `lambda`
/// is the condensed 2 lambda mu / (lambda + 2 mu), so that the in-plane law keeps this form.
template <class P>
struct Elasticity {
  P lambda{};
  P mu{};
  P nu{};

  template <class T, int Dim>
  [[nodiscard]] FPZ_INLINE Tensor<T, Dim> stress(const Tensor<T, Dim>& strain) const {
    T trace = strain[0] + strain[1];
    if constexpr (Dim == 3) trace += strain[2];
    const T pressure = lambda * trace;
    const P two_mu = 2.0 * mu;
    Tensor<T, Dim> s;
    for (int k = 0; k < Dim; ++k) s[k] = pressure + two_mu * strain[k];
    for (int k = Dim; k < tensor_size<Dim>; ++k) s[k] = two_mu * strain[k];
    return s;
  }
};

/// The inverse of Elasticity::stress(): the strain of an elastic stress, stored components.
template <int Dim, class P>
[[nodiscard]] Tensor<P, Dim> elastic_strain(const Elasticity<P>& bulk, const Tensor<P, Dim>& stress) {
  const P trace = stress.template head<Dim>().sum();
  Tensor<P, Dim> e = stress / (2.0 * bulk.mu);
  const P pressure = bulk.lambda / (Dim * bulk.lambda + 2.0 * bulk.mu) * trace / (2.0 * bulk.mu);
  for (int k = 0; k < Dim; ++k) e[k] -= pressure;
  return e;
}

/// sigma : C^-1 : sigma / 2 of a piece of the given volume, J.
template <int Dim>
[[nodiscard]] double elastic_energy(const Elasticity<double>& bulk, const Tensor<double, Dim>& stress, double volume) {
  const double trace = stress.template head<Dim>().sum();
  const double lambda = bulk.lambda;
  const double mu = bulk.mu;
  return volume * 0.25 / mu * (double_dot<Dim>(stress, stress) - lambda / (Dim * lambda + 2.0 * mu) * trace * trace);
}

/// Everything an update needs to know about the material.
template <class P>
struct Material {
  Setting setting = Setting::plane_strain;
  Elasticity<P> bulk;
  CohesiveLaw<P> law;
  SeriesCompliance<P> series;
  P rve_length{};      ///< H, m
  P inverse_length{};  ///< 1/H, 1/m
};

/// Replaces the RVE length H (m); everything else is kept. Cheap: two divisions.
template <class P>
void set_rve_length(Material<P>& m, const P& length) {
  m.rve_length = length;
  m.inverse_length = 1.0 / length;
  m.series.normal = length / (m.bulk.lambda + 2.0 * m.bulk.mu);
  m.series.shear = length / m.bulk.mu;
}

/// Derives the constants. The parameters must have passed validate(); this function does not check them again.
template <class P>
[[nodiscard]] Material<P> make_material(const BasicParameters<P>& p, Setting setting) {
  Material<P> m;
  m.setting = setting;
  m.bulk.nu = p.poisson_ratio;
  m.bulk.mu = p.young_modulus / (2.0 * (1.0 + p.poisson_ratio));
  m.bulk.lambda = p.young_modulus * p.poisson_ratio / ((1.0 + p.poisson_ratio) * (1.0 - 2.0 * p.poisson_ratio));
  if (setting == Setting::plane_stress)
    m.bulk.lambda = p.young_modulus * p.poisson_ratio / (1.0 - p.poisson_ratio * p.poisson_ratio);
  m.law = make_cohesive_law(p);
  set_rve_length(m, p.rve_length);
  return m;
}

}  // namespace fpz
