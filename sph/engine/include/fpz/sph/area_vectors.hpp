// The surface as the particles have it: which force each of them needs where a pressure acts.
#pragma once

#include <vector>

#include "fpz/sph/simulation.hpp"

namespace fpz::sph {

/// The outward area vector of every particle of the arrangement, m (per metre of thickness in 2-D): the force that
/// holds it in balance when there is a hydrostatic tension of 1 Pa in the whole undeformed body, boundary groups
/// included. Zero in the interior; a pressure p all round is in balance with the forces -p times these, exactly. Throws
/// std::invalid_argument with all problems() of the set-up (its loads apart), and for the momentum form `paper`, in
/// which constant stress has other forces.
template <int Dim>
[[nodiscard]] std::vector<Vec<double, Dim>> area_vectors(const RunSetup<Dim>& setup);

extern template std::vector<Vec<double, 2>> area_vectors<2>(const RunSetup<2>&);

}  // namespace fpz::sph
