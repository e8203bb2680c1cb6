// Strain and energy of a stress: the elastic law of a particle that has not cracked, turned round.
#pragma once

#include "fpz/material.hpp"

namespace fpz::sph::detail {

template <int Dim>
[[nodiscard]] Tensor<double, Dim> elastic_strain(const Elasticity<double>& bulk, const Tensor<double, Dim>& stress) {
  const double trace = stress.template head<Dim>().sum();
  Tensor<double, Dim> e = stress / (2.0 * bulk.mu);
  const double pressure = bulk.lambda / (Dim * bulk.lambda + 2.0 * bulk.mu) * trace / (2.0 * bulk.mu);
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

}  // namespace fpz::sph::detail
