// Boundary groups: particles that move together, with some velocity components prescribed and the others free.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "fpz/types.hpp"

namespace fpz::sph {

/// A velocity that rises smoothly (a cubic, no jump of acceleration at its ends beyond a finite one) from zero to
/// `speed` (m/s) within `ramp` (s) and stays.
struct Motion {
  double speed = 0.0;
  double ramp = 0.0;

  [[nodiscard]] double velocity(double time) const {
    if (time >= ramp) return speed;
    const double x = std::max(time / ramp, 0.0);
    return speed * x * x * (3.0 - 2.0 * x);
  }
};

template <int Dim>
struct Group {
  std::string name;
  std::array<std::optional<Motion>, static_cast<std::size_t>(Dim)> motion;  ///< per component; empty: free
  bool elastic = true;                                                      ///< its particles never crack
};

}  // namespace fpz::sph
