// Stiffness against the displacements that the gradient of the undeformed body does not see (they alternate from
// particle to particle).
#pragma once

#include <array>

#include "bonds.hpp"
#include "boundary.hpp"
#include "plane.hpp"

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
/// between them free. When a crack has lost most of its strength and opens more than it slides, the bonds that cross it
/// are cut: they would hold energy as the square of its opening.
template <int Dim>
class ZeroEnergyControl {
 public:
  /// `strength`: stiffness in units of lambda + 2 mu, > 0.
  ZeroEnergyControl(RunData<Dim>& run, double strength);

  /// Lets go where a crack has opened further, and of bonds across it, in the step (s) to n, for which the loops have
  /// moved the displacements.
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
    visit(FieldInfo{"zero_energy_fit", each, Keep::saved}, self.fit_, &V::control_fit);
    visit(FieldInfo{"zero_energy_share", each, Keep::saved, 1.0}, self.share_, &V::control_share);
    visit(FieldInfo{"zero_energy_displacement", each, Keep::saved}, self.displacement_, &V::control_displacement);
    visit(FieldInfo{"zero_energy_gradient", each, Keep::saved}, self.gradient_, &V::control_gradient);
  }
  void save(Writer& archive) const;
  /// Throws ArchiveError.
  void load(Reader& archive);

 private:
  using Bond = std::array<std::size_t, 2>;  ///< the lower slot first
  /// Sums over a row with u = u_j - u_i: k_ij u (x) r_ij, J, and k_ij |u|^2, J.
  struct Differences {
    Full moment = {0.0, 0.0, 0.0, 0.0};
    double square = 0.0;
  };

  void make_bonds();
  /// Writes the stiffness of the bonds that particle i has at the start.
  void write_row(std::size_t i, AlikeBonds& alike);
  /// Writes what fits a gradient to the bonds that row i has now.
  void fit(std::size_t i);
  /// Writes the gradient of the displacements at n.
  void write_gradient(std::size_t i);
  /// Cuts the bonds across open cracks. What they held in the middle of the step (s) to n is dissipated.
  void cut(double step);
  [[nodiscard]] std::vector<Bond> bonds_across() const;
  /// Removes a bond from the rows of both ends.
  void remove(const Bond& bond);
  /// Part of its energy that is left to the cracked particle i with its damage and H.
  [[nodiscard]] double share_of(std::size_t i) const;
  /// With the displacements `before` (s) the end of the step.
  [[nodiscard]] Differences differences(std::size_t i, double before) const;
  /// Energy of a particle, J, `before` (s) the end of the step.
  [[nodiscard]] double stored_at(std::size_t i, double before) const;

  RunData<Dim>& run_;
  double strength_;                ///< stiffness in units of lambda + 2 mu
  NeighbourLists lists_;           ///< nearest neighbours at the start, in increasing order
  Bonds<Dim> bonds_;               ///< weight: k_ij r_ij, N; beside: k_ij, N/m
  std::vector<Bond> cut_;          ///< bonds that are no more
  Field share_;                    ///< a_i: the least share_of() since the start
  Fields<Dim*(Dim + 1) / 2> fit_;  ///< inverse of sum k_ij r_ij (x) r_ij, zero without a gradient
  Fields<Dim> displacement_;       ///< since the start: as a sum, without the rounding of positions
  Fields<Dim * Dim> gradient_;     ///< a_i G_i
};

}  // namespace fpz::sph::detail
