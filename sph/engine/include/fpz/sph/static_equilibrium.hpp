// The elastic body at rest under given forces and displacements: what a slow test tends to before anything cracks,
// without the time steps.
#pragma once

#include <memory>
#include <vector>

#include "fpz/sph/simulation.hpp"

namespace fpz::sph {

/// What acts on the particles of an arrangement, in its order. Empty: nothing.
template <int Dim>
struct StaticLoad {
  std::vector<Vec<double, Dim>> force;  ///< N (per metre of thickness in 2-D)
  /// m; of the components that the particle's group prescribes, however fast. Others are ignored.
  std::vector<Vec<double, Dim>> displacement;
};

template <int Dim>
struct StaticState {
  std::vector<Vec<double, Dim>> displacement;  ///< m, in the order of the arrangement
  std::vector<Tensor<double, Dim>> stress;     ///< Pa, likewise
  std::vector<Vec<double, Dim>> reaction;      ///< N, force on each group; zero in free components
  double residual = 0.0;                       ///< of the forces, over those that drive the body (root mean square)
  int iterations = 0;
};

/// Equilibria of the operator that runs use (`reference`: bonds, corrections, zero-energy control) with small
/// displacements. The forces come from the inner loops themselves; conjugate gradients find where they vanish, to 1e-9
/// of those that drive the body. All material is linear elastic, whatever its strength.
template <int Dim>
class StaticBody {
 public:
  /// Throws std::invalid_argument with all problems() of the set-up, for `updated`, and for the momentum form `paper`,
  /// whose forces have no energy.
  explicit StaticBody(const RunSetup<Dim>& setup);
  ~StaticBody();
  StaticBody(StaticBody&&) noexcept;
  StaticBody& operator=(StaticBody&&) noexcept;

  /// A body that nothing holds is left without rigid motion by what it does not feel; its load must be in balance.
  /// Throws std::runtime_error when the iteration does not end.
  [[nodiscard]] StaticState<Dim> equilibrium(const StaticLoad<Dim>& load);

 private:
  struct Forces;
  std::unique_ptr<Forces> forces_;
};

extern template class StaticBody<2>;

}  // namespace fpz::sph
