// What a crack changes in the rows of its particles: rows beyond the first no longer see across it, derivatives along
// it have no part of its opening, and at the end its bonds are cut.
#pragma once

#include "row_stability.hpp"

namespace fpz::sph::detail {

template <int Dim>
class CrackRows {
 public:
  CrackRows(RunData<Dim>& run, BondRows<Dim>& rows)
      : run_(run), rows_(rows), stability_(run, rows), straightened_(run.particles.count, 1.0) {}

  /// Finds the lean of a particle again if its crack has grown; says whether it did.
  bool straighten(std::size_t i);
  /// A crack is forgotten: the row has no lean.
  void forget(std::size_t i);
  /// Narrows the rows of particles that have begun to open.
  void narrow();
  /// Cuts bonds across open cracks (options.release_integrity), and adds them to `cut`.
  void release(std::vector<ReleasedBond<Dim>>& cut);

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.straightened_);
  }

 private:
  [[nodiscard]] double rotation_beside(std::size_t i) const;
  [[nodiscard]] double lean_of(std::size_t i, const Full& correction) const;
  /// Neighbours of a cracked particle beyond its crack, far enough away to let go.
  [[nodiscard]] std::vector<int> released_by(std::size_t i) const;
  /// The bond from cracked particle i to j as a part of the crack's faces.
  [[nodiscard]] ReleasedBond<Dim> face_of_bond(std::size_t i, std::size_t j) const;
  /// Writes rows, each once.
  void write(std::vector<std::size_t>& changed);

  RunData<Dim>& run_;
  BondRows<Dim>& rows_;
  RowStability<Dim> stability_;
  Field straightened_;  ///< integrity at which the lean was found
};

}  // namespace fpz::sph::detail
