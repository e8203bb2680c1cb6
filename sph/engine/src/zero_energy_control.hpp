// Stiffness against the displacements that the gradient of the undeformed body does not see (they alternate from
// particle to particle).
#pragma once

#include "bonds.hpp"
#include "boundary.hpp"

namespace fpz::sph::detail {

/// Every particle has the energy 1/4 sum k_ij |u_j - u_i - G_i r_ij|^2 over its nearest neighbours, G_i being the
/// displacement gradient that makes it smallest and r_ij the bond in the undeformed body. The force is the exact
/// derivative of the sum of these energies: a bond pulls with k_ij times the part of u_j - u_i that the mean of its two
/// gradients does not explain. Nothing for affine displacements, so none for rotations, on any arrangement. Bonds
/// between particles of different stiffness have none: displacements have a kink there.
///
/// A particle loses its energy, and no other's, as its crack opens: all of it when it has opened by as much strain
/// (D delta0/H) as the rock bears elastically (sigma_t0/E). What it held is dissipated. Its neighbours keep theirs,
/// with the bonds to it: so rows beside a crack cannot alternate, or crack in two places, row by row, with what is
/// between them free.
template <int Dim>
class ZeroEnergyControl {
 public:
  /// `strength`: stiffness in units of lambda + 2 mu, > 0.
  ZeroEnergyControl(RunData<Dim>& run, double strength);

  /// Lets go where a crack has opened further in the step (s) to n, for which the loops have moved the displacements.
  void let_go(double step);
  /// Energy that it holds at n, J.
  [[nodiscard]] double stored() const;
  /// Largest over the particles with all of their energy: root mean square of |u_j - u_i - G_i r_ij|, weighted with
  /// k_ij, m.
  [[nodiscard]] double alternation() const;
  void forget_displacements();

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    using V = View<Dim>;
    constexpr Extent each = Extent::particle;
    visit(FieldInfo{"zero_energy_fit", each, Keep::constant}, self.fit_, &V::control_fit);
    visit(FieldInfo{"zero_energy_share", each, Keep::saved, 1.0}, self.share_, &V::control_share);
    visit(FieldInfo{"zero_energy_displacement", each, Keep::saved}, self.displacement_, &V::control_displacement);
    visit(FieldInfo{"zero_energy_gradient", each, Keep::saved}, self.gradient_, &V::control_gradient);
  }
  void save(Writer& archive) const { fields(*this, Transfer<Writer>{archive}); }
  void load(Reader& archive) { fields(*this, Transfer<Reader>{archive}); }

 private:
  /// Writes the stiffness of the bonds that particle i has, and what fits a gradient to them.
  void write_row(std::size_t i, AlikeBonds& alike);
  /// Part of its energy that is left to the cracked particle i with its damage and H.
  [[nodiscard]] double share_of(std::size_t i) const;
  /// Energy of a particle, J, `before` (s) the end of the step.
  [[nodiscard]] double stored_at(std::size_t i, double before) const;

  RunData<Dim>& run_;
  double strength_;                ///< stiffness in units of lambda + 2 mu
  NeighbourLists lists_;           ///< nearest neighbours at the start
  Bonds<Dim> bonds_;               ///< weight: k_ij r_ij, N; beside: k_ij, N/m
  Field share_;                    ///< a_i: the least share_of() since the start
  Fields<Dim*(Dim + 1) / 2> fit_;  ///< inverse of sum k_ij r_ij (x) r_ij, zero without a gradient
  Fields<Dim> displacement_;       ///< since the start: as a sum, without the rounding of positions
  Fields<Dim * Dim> gradient_;     ///< a_i G_i
};

}  // namespace fpz::sph::detail
