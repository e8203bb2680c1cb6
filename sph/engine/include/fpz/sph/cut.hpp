// Straight cuts through the body: the faces of notches that are narrower than the support of the kernel.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fpz/types.hpp"

namespace fpz::sph {

/// Particles whose connecting line at the start crosses a cut do not interact; near a tip they do in part
/// (share_of_bond). In 2-D a straight segment, given by its ends; both may lie in the body.
template <int Dim>
struct Cut {
  std::array<Vec<double, Dim>, static_cast<std::size_t>(Dim)> corner;
  /// Whether the body goes on beyond that corner. Else it is a mouth, on the surface or outside, and bonds that cross
  /// the cut are gone up to there: in part they would bridge the mouth.
  std::array<bool, static_cast<std::size_t>(Dim)> is_tip = {};
  double width = 0.0;     ///< m, of material that is missing: the faces lie half of it to either side
  double gap = 0.0;       ///< m: the faces meet when they have come nearer by this much
  double friction = 0.0;  ///< coefficient of faces that have met
};

/// Whether the straight line from p to q crosses the cut. A line through an end of the cut (to 1e-9 of its length) does
/// not, so that mirror images agree; neither does one that ends on the cut. The same for (p, q) and (q, p).
[[nodiscard]] bool crosses(const Cut<2>& cut, const Vec<double, 2>& p, const Vec<double, 2>& q);

/// Part of the bond from p to q that the cut leaves, 0 to 1. Away from tips 0 where it crosses the cut and 1 elsewhere;
/// around a tip linear in the place where it passes the line of the cut: 0 from 0.9 spacings before the tip, 1 from 0.6
/// spacings beyond it. The bonds that are left, summed along the line, then do not depend on where the particles lie,
/// and the cut is elastically as long as it is (docs/method-tips.md). The same for (p, q) and (q, p).
[[nodiscard]] double share_of_bond(const Cut<2>& cut, const Vec<double, 2>& p, const Vec<double, 2>& q, double spacing);

/// What several cuts leave.
[[nodiscard]] double share_of_bond(const std::vector<Cut<2>>& cuts, const Vec<double, 2>& p, const Vec<double, 2>& q,
                                   double spacing);

/// Whether x lies on the cut (to 1e-9 of its length) and not at its ends: such a particle belongs to neither side.
[[nodiscard]] bool lies_on(const Cut<2>& cut, const Vec<double, 2>& x);

}  // namespace fpz::sph
