// Total Lagrangian: bonds and their vectors in the undeformed body, built once, cut where a crack has fully opened.
// Strain is U - I of the deformation gradient, stress stays in the frame that turns with the particle.
#pragma once

#include <optional>

#include "body.hpp"
#include "bond_vectors.hpp"
#include "crack_bands.hpp"

namespace fpz::sph::detail {

template <int Dim>
class ReferenceBody final : public Body<Dim> {
 public:
  explicit ReferenceBody(RunData<Dim>& run);

  [[nodiscard]] Outcome advance() override;
  void force(const View<Dim>& view) override;
  void save(Writer& archive) const override;
  void load(Reader& archive) override;

 protected:
  [[nodiscard]] const Fields<Dim>& bond_positions() const override { return this->run_.particles.start; }
  [[nodiscard]] Tensor<double, Dim> strain_increment(std::size_t i, const State<double, Dim>& begin) const override;
  void turn(std::size_t, State<double, Dim>&) const override {}
  void set_flux(std::size_t i, const Symmetric& stress) override;
  bool shorten_band(std::size_t i) override { return bands_ && bands_->shorten(i); }

 private:
  /// Weights and correction of one row from its list.
  void write_row(std::size_t i);
  /// V_i V_j grad W_ij of the undeformed body, or what takes its place; padding has none.
  [[nodiscard]] Vec<double, Dim> vector_of(std::size_t i, int j) const;
  /// L_i from the moment of the row's vectors over its volume.
  [[nodiscard]] Full correction_of_row(const Full& moment) const;
  /// Sum of a vector from i to its neighbours (x) the bond's vector, over the volume.
  template <class Difference>
  [[nodiscard]] Full sum_over_row(std::size_t i, Difference&& difference) const;
  [[nodiscard]] Full moment_of_row(std::size_t i) const;
  /// Sets L_i, with what leans_ adds.
  void set_correction(std::size_t i, const Full& c);
  /// Finds leans_ of the cracked particles again.
  void straighten(Index first, Index last);
  [[nodiscard]] double rotation_beside(std::size_t i) const;
  [[nodiscard]] double lean_of(std::size_t i, const Full& correction) const;
  /// Cuts bonds across open cracks (options.release_integrity).
  void release_bonds();
  /// Neighbours of a cracked particle beyond its crack, far enough away to let go.
  [[nodiscard]] std::vector<int> released_by(std::size_t i) const;

  std::optional<BondVectors<Dim>> vectors_;  ///< none: those of the kernel
  /// The gradient of a crack that the neighbours of a particle see, over that across it: 0 where they lie evenly, or
  /// where there is no crack. Along the crack its opening has no such derivative; what the row makes of it would be a
  /// shear.
  Field leans_;
  Field straightened_;                    ///< integrity at which leans_ was found
  std::optional<CrackBands<Dim>> bands_;  ///< none: H is a number or the size
};

}  // namespace fpz::sph::detail
