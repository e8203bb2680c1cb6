// What the 2-D settings do not see: they crack on planes that contain the out-of-plane axis only, as in the paper.
#pragma once

#include <algorithm>

#include "fpz/onset.hpp"

namespace fpz {

/// Out-of-plane stress of an uncracked 2-D point: 0 in plane stress, nu (sigma_xx + sigma_yy) in plane strain. Pa.
template <class P>
[[nodiscard]] double elastic_stress_zz(const Material<P>& m, const Tensor<double, 2>& s) {
  return m.setting == Setting::plane_stress ? 0.0 : value(m.bulk.nu) * (s[0] + s[1]);
}

/// Largest F over all planes of space of an uncracked 2-D point, Pa. Above the largest over the planes that contain the
/// out-of-plane axis when that axis has the largest or smallest principal stress; not below 0 while the point is
/// uncracked: it would have cracked in 3-D.
template <class P>
[[nodiscard]] double failure_value_in_space(const Material<P>& m, const Tensor<double, 2>& stress) {
  const detail::Circle<double> c = detail::mohr_circle(stress);
  const double zz = elastic_stress_zz(m, stress);
  const double largest = std::max(c.p + c.r, zz), smallest = std::min(c.p - c.r, zz);
  return m.law.surface.largest_value(0.5 * (largest + smallest), 0.5 * (largest - smallest));
}

}  // namespace fpz
