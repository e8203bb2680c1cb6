// The one place where a run-time Setting becomes a compile-time dimension, and the maps between six named components
// and the stored ones.
#pragma once

#include <array>
#include <type_traits>

#include "fpz/energy.hpp"

namespace fpz::driver {

/// Calls f with std::integral_constant<int, 2 or 3>.
template <class F>
decltype(auto) with_dimension(Setting setting, F&& f) {
  if (setting == Setting::three_d) return f(std::integral_constant<int, 3>{});
  return f(std::integral_constant<int, 2>{});
}

/// Index of a named component (xx, yy, zz, xy, xz, yz) among the stored ones; -1 for those derived in 2-D.
template <int Dim>
[[nodiscard]] constexpr int stored_index(int component) {
  if constexpr (Dim == 3) return component;
  return component < 2 ? component : (component == 3 ? 2 : -1);
}

/// The stored components spread over the six named ones; those that are not stored are left at zero.
template <int Dim>
[[nodiscard]] std::array<double, 6> spread(const Tensor<double, Dim>& a) {
  std::array<double, 6> full{};
  for (int c = 0; c < 6; ++c) {
    if (const int k = stored_index<Dim>(c); k >= 0) full[static_cast<std::size_t>(c)] = a[k];
  }
  return full;
}

/// All six strains of a state, the out-of-plane one included.
template <int Dim>
[[nodiscard]] std::array<double, 6> full_strain(const Material<double>& m, const State<double, Dim>& s) {
  std::array<double, 6> full = spread<Dim>(s.strain);
  if constexpr (Dim == 2) full[2] = strain_zz(m, s);
  return full;
}

/// All six stresses of a state, the out-of-plane one included. Pa.
template <int Dim>
[[nodiscard]] std::array<double, 6> full_stress(const Material<double>& m, const State<double, Dim>& s) {
  std::array<double, 6> full = spread<Dim>(s.stress);
  if constexpr (Dim == 2) full[2] = stress_zz(m, s);
  return full;
}

}  // namespace fpz::driver
