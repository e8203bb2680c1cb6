// Softening: how inelastic displacement turns into damage (eq 47). The library works with the integrity w = 1 - D,
// which stays exact when D is within rounding of 1.
#pragma once

#include <cmath>

#include "fpz/material.hpp"

namespace fpz {

/// Ratio w_end / w_begin after an inelastic displacement increment `kappa` = d(up_n) + d(up_s) >= 0 (m), eq 47.
template <class T, class P>
[[nodiscard]] T integrity_ratio(const CohesiveLaw<P>& law, const T& kappa) {
  using std::exp;
  return exp(-kappa * law.inverse_delta0);
}

/// Rate dw/dkappa = -w/delta0 of eq 47 (1/m).
template <class T, class P>
[[nodiscard]] T integrity_slope(const CohesiveLaw<P>& law, const T& integrity) {
  return -integrity * law.inverse_delta0;
}

}  // namespace fpz
