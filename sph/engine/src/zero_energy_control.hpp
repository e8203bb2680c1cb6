// Stiffness against the displacements that the gradient of the undeformed body does not see (they alternate from
// particle to particle).
#pragma once

#include "bonds.hpp"
#include "boundary.hpp"

namespace fpz::sph::detail {

/// Every particle has the energy 1/4 sum k_ij |u_j - u_i - G_i r_ij|^2 over its nearest neighbours, G_i being the
/// displacement gradient that makes it smallest and r_ij the bond in the undeformed body. The force is the exact
/// derivative of the sum of these energies: a bond pulls with k_ij times the part of u_j - u_i that the mean of its two
/// gradients does not explain. Nothing for affine displacements, so none for rotations, on any arrangement.
///
/// A bond ends when a particle at one of its ends cracks: what it held is dissipated. Dropping bonds never raises the
/// energy of the rest, because their gradients are fitted anew.
template <int Dim>
class ZeroEnergyControl {
 public:
  /// `strength`: stiffness in units of lambda + 2 mu, > 0.
  ZeroEnergyControl(RunData<Dim>& run, double strength);

  /// Moves the displacements on by `step` (s) with the velocities at n - 1/2 and ends the bonds of new cracks.
  void advance(double step);
  /// Its force at n, which the kick then adds to the others.
  void act();
  /// Energy that it holds at n, J.
  [[nodiscard]] double stored() const;
  void forget_displacements();

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    using V = View<Dim>;
    constexpr Extent each = Extent::particle;
    visit(FieldInfo{"zero_energy_fit", each, Keep::saved}, self.fit_, &V::zero_energy_fit);
    visit(FieldInfo{"zero_energy_displacement", each, Keep::saved}, self.displacement_, &V::zero_energy_displacement);
    visit(FieldInfo{"zero_energy_gradient", each, Keep::passing}, self.gradient_, &V::zero_energy_gradient);
    visit(FieldInfo{"zero_energy_force", each, Keep::passing}, self.force_, &V::zero_energy_force);
  }
  void save(Writer& archive) const { fields(*this, Transfer<Writer>{archive}); }
  void load(Reader& archive) {
    fields(*this, Transfer<Reader>{archive});
    fields(*this, Spoil{run_.particles.count});
    connect();
  }

 private:
  /// All bonds between uncracked particles.
  void connect();
  /// Writes the stiffness of the bonds that particle i has, and what fits a gradient to them.
  void write_row(std::size_t i);
  /// Particles that have cracked since the last call, and their neighbours.
  [[nodiscard]] std::vector<std::size_t> note_new_cracks();
  void move(double step);
  [[nodiscard]] double stored_at(std::size_t i) const;

  RunData<Dim>& run_;
  double strength_;                ///< Pa
  NeighbourLists lists_;           ///< nearest neighbours at the start
  Bonds<Dim> bonds_;               ///< weight: k_ij r_ij
  Field stiffness_;                ///< k_ij, N/m, beside the weights
  Mask ended_;                     ///< per particle: cracked, its bonds are gone
  Fields<Dim*(Dim + 1) / 2> fit_;  ///< inverse of sum k_ij r_ij (x) r_ij, zero without a gradient
  Fields<Dim> displacement_;       ///< since the start: as a sum, without the rounding of positions
  Fields<Dim * Dim> gradient_;     ///< G_i
  Fields<Dim> force_;              ///< N
};

}  // namespace fpz::sph::detail
