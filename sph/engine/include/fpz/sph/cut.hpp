// Straight cuts through the body: the faces of notches that are narrower than the support of the kernel.
#pragma once

#include <array>
#include <cstddef>

#include "fpz/types.hpp"

namespace fpz::sph {

/// Particles whose connecting line at the start crosses a cut never interact. In 2-D a straight segment, given by its
/// ends; both may lie in the body.
template <int Dim>
struct Cut {
  std::array<Vec<double, Dim>, static_cast<std::size_t>(Dim)> corner;
};

/// Whether the straight line from p to q crosses the cut. A line through an end of the cut (to 1e-9 of its length) does
/// not, so that mirror images agree; neither does one that ends on the cut. The same for (p, q) and (q, p).
[[nodiscard]] bool crosses(const Cut<2>& cut, const Vec<double, 2>& p, const Vec<double, 2>& q);

/// Whether x lies on the cut (to 1e-9 of its length) and not at its ends: such a particle belongs to neither side.
[[nodiscard]] bool lies_on(const Cut<2>& cut, const Vec<double, 2>& x);

}  // namespace fpz::sph
