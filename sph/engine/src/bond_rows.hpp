// The bonds of the undeformed body, a row for each particle: their vectors, and the correction with which the row's
// gradient is exact for linear fields. Rows are written at the start and again where bonds were cut or rows narrowed.
#pragma once

#include <optional>
#include <utility>

#include "bond_vectors.hpp"
#include "bonds.hpp"
#include "plane.hpp"
#include "run_data.hpp"

namespace fpz::sph::detail {

template <int Dim>
class BondRows {
 public:
  /// Packs the lists into the bonds and writes all rows; run, lists and bonds must outlive this.
  BondRows(RunData<Dim>& run, NeighbourLists& lists, Bonds<Dim>& bonds);

  /// Weights and correction of a row from its list.
  void write(std::size_t i);
  void write_all();
  /// The same under load. The force of this step is half that of the old row, half that of the new one, as the strains
  /// before and after it are: with either of them alone the step would not balance its energies.
  void rewrite(std::size_t i);
  /// What rows that changed in this step add to the force of the new ones: particle, N.
  [[nodiscard]] std::vector<std::pair<std::size_t, Vec<double, Dim>>> take_half_way() {
    return std::exchange(half_way_, {});
  }
  [[nodiscard]] bool has_half_way() const { return !half_way_.empty(); }

  [[nodiscard]] const std::vector<int>& neighbours(std::size_t i) const { return lists_[i]; }
  /// Whether lost bonds have left a row too little for a whole gradient.
  [[nodiscard]] bool is_loose(std::size_t i) const { return has_lost_[i] != 0 && least_moment(i) < least_whole; }
  /// Drops the bond on both sides; the rows of both are to be written.
  void cut(std::size_t i, int j);

  /// Whether a bond is short across the crack of i, where that row is narrowed; true elsewhere.
  [[nodiscard]] bool is_near(std::size_t i, std::size_t j) const;
  /// Leaves a cracked particle the bonds that are short across its crack, if its own gradient and its neighbours' can
  /// do without the others; says whether it did, once. The rows of all of them are to be written.
  bool narrow(std::size_t i);

  /// Sum of a vector from i to its neighbours (x) the bond's vector, over the volume: the gradient before L_i.
  template <class Difference>
  [[nodiscard]] Full sum(std::size_t i, Difference&& difference) const {
    Full s = {0.0, 0.0, 0.0, 0.0};
    const double inverse = 1.0 / run_.particles.volume[i];
    for (std::size_t k = 0; k < lists_[i].size(); ++k) {
      const std::size_t entry = bonds_.entry(i, k);
      add_product(s, inverse * difference(static_cast<std::size_t>(lists_[i][k])),
                  Vec<double, Dim>(bonds_.weight[0][entry], bonds_.weight[1][entry]));
    }
    return s;
  }
  /// Calls visit(neighbour, x, y) with the vector of each bond of a row.
  template <class Visit>
  void for_bonds(std::size_t i, Visit&& visit) const {
    for (std::size_t k = 0; k < lists_[i].size(); ++k) {
      const std::size_t entry = bonds_.entry(i, k);
      visit(static_cast<std::size_t>(lists_[i][k]), bonds_.weight[0][entry], bonds_.weight[1][entry]);
    }
  }
  /// From now on a row sees only this part of its gradient: at once, and whenever it is written again.
  void soften(std::size_t i, double part);
  /// L_i of eq 18; of a row that has lost most of its bonds, or is softened, less than that.
  [[nodiscard]] Full correction(std::size_t i) const;
  /// The gradient of a crack that the neighbours of a particle see along it, over that across it: derivatives along
  /// the crack are then taken in the direction t - lean n. Sets L_i, without it correction().
  void set_lean(std::size_t i, double lean, const Full& correction);
  [[nodiscard]] double lean(std::size_t i) const { return leans_[i]; }
  /// Of a row that is to be written.
  void forget_lean(std::size_t i) { leans_[i] = 0.0; }

  /// What the force sums for a particle with this stress.
  void set_flux(std::size_t i, const Symmetric& stress);

  /// Leans, narrowed rows, those that have lost bonds, those softened; after reading, all rows are to be written.
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.leans_);
    archive(self.width_);
    archive(self.has_lost_);
    archive(self.softened_);
  }

 private:
  /// Part of the moment below which a row that has lost bonds sees less than the whole gradient: a straight face leaves
  /// 0.5. The few bonds of what is nearly loose would otherwise have frequencies beyond the time step.
  static constexpr double least_whole = 0.35;

  static void add_product(Full& sum, const Vec<double, Dim>& a, const Vec<double, Dim>& b) {
    sum.xx += a[0] * b[0];
    sum.xy += a[0] * b[1];
    sum.yx += a[1] * b[0];
    sum.yy += a[1] * b[1];
  }
  [[nodiscard]] Vec<double, Dim> between(std::size_t i, std::size_t j) const;
  /// V_i V_j grad W_ij of the undeformed body, or what takes its place; none for bonds that are not near.
  [[nodiscard]] Vec<double, Dim> vector_of(std::size_t i, int j) const;
  /// Smaller singular value of the moment that the row would have.
  [[nodiscard]] double least_moment(std::size_t i) const;
  [[nodiscard]] Full moment(std::size_t i) const;
  void set_correction(std::size_t i, const Full& c);
  /// Adds a part of the force of a row to half_way_.
  void add_half_way(std::size_t i, double part);
  /// Changes a row by f(), under load.
  template <class F>
  void change(std::size_t i, F&& f);

  RunData<Dim>& run_;
  NeighbourLists& lists_;
  Bonds<Dim>& bonds_;
  std::optional<BondVectors<Dim>> vectors_;  ///< none: those of the kernel
  Field leans_;
  Mask has_lost_;   ///< a bond was cut
  Field softened_;  ///< part of the gradient that is seen
  enum class Width : char { whole, narrow, refused };
  std::vector<Width> width_;
  std::vector<std::pair<std::size_t, Vec<double, Dim>>> half_way_;
};

}  // namespace fpz::sph::detail
