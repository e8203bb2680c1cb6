// Many points in one call, in flat arrays with any distances between their numbers.
#pragma once

#include <cstddef>

#include "fpz/batch.hpp"
#include "fpz/point/behaviour.hpp"

namespace fpz::point {

/// Numbers of points in memory: component k of point i is data[i * point + k * component]. Null data: not wanted.
template <class Number>
struct View {
  Number* data = nullptr;
  std::ptrdiff_t point = 0;
  std::ptrdiff_t component = 1;

  [[nodiscard]] Number* of(std::size_t i) const { return data + static_cast<std::ptrdiff_t>(i) * point; }
};

/// The arrays of a batch, for states as in state_layout.hpp. Begin and end may be the same memory.
struct BatchArrays {
  std::size_t points = 0;
  View<const double> begin;
  View<const double> strain_increments;  ///< tensor components
  View<double> end;
  View<double> tangents;            ///< if wanted, row by row, d(stress_i)/d(tensor strain_j)
  View<double> energies;            ///< if wanted: stored, dissipated, J/m^3
  const double* lengths = nullptr;  ///< H of every point, m, one after the other; null: that of the behaviour
  int* statuses = nullptr;          ///< if wanted: a Status for every point, one after the other
};

/// Updates all points. Those that fail keep their begin state, without tangent and energies, and the others are updated
/// all the same; last_message() speaks of the one with the lowest index, which is captured. The threads as in
/// fpz::update_batch(); the result does not depend on them. The setting of the behaviour must have the dimension Dim.
template <int Dim>
[[nodiscard]] BatchReport update_batch(const Behaviour& behaviour, const BatchArrays& arrays, int threads = 0) noexcept;

}  // namespace fpz::point
