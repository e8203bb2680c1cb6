// The vectors of the bonds with which linear fields are exact and constant stress is in equilibrium on any arrangement
// (docs/method-operator.md).
//
// One vector per bond, w_ij = -w_ji, takes the place of V_i V_j grad W_ij:
//
//   grad u_i = 1/V_i sum_j (u_j - u_i) (x) w_ij L_i,    f_i = sum_j (P_i L_i^T + P_j L_j^T) w_ij
//
// They are those nearest to the kernel's for which, with K = (L_i + L_j)/2,
//
//   sum_j (x_j - x_i) (x) w_ij = V_i L_i^-1   for every particle,
//   sum_j K w_ij = 0                          in the directions in which a particle is not free (free_surface.hpp).
//
// Inside the body L_i is the identity. Near its surface, at platens and where neighbours are few it is the kernel's
// correction (eq 18), and the moment on the left stays what the kernel makes it: a moment V_i I there would need
// vectors that alternate from row to row.
//
// As f is the adjoint of grad u, energy and linear momentum are exact whatever the vectors are.
#pragma once

#include <vector>

#include "block_cholesky.hpp"
#include "bonds.hpp"
#include "run_data.hpp"

namespace fpz::sph::detail {

template <int Dim>
struct BondVectors {
  NeighbourLists of;                                  ///< ascending, as they were at the start
  std::vector<std::vector<Vec<double, Dim>>> vector;  ///< m^(Dim - 1), beside `of`

  [[nodiscard]] const Vec<double, Dim>& operator()(std::size_t i, int j) const;
};

/// The vectors of these bonds. Deterministic, one thread. Throws std::runtime_error when the system cannot be solved.
template <int Dim>
[[nodiscard]] BondVectors<Dim> make_bond_vectors(const RunData<Dim>& run, const NeighbourLists& lists);

/// Multipliers per particle: four of the moment, two of the balance.
inline constexpr int multipliers = 6;

/// The first of the equations that make_bond_vectors() solves, for those who compare solvers.
struct NormalEquations {
  BlockMatrix<multipliers> matrix;
  Eigen::VectorXd right;
  std::vector<int> order;  ///< of elimination
};
[[nodiscard]] NormalEquations normal_equations(const RunData<2>& run, const NeighbourLists& lists);

}  // namespace fpz::sph::detail
