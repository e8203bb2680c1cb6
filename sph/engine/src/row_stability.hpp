// The time step was made for the body as it was at the start. Where cracks cut bonds, what is left of the rows may
// oscillate faster: the highest frequency around changed rows is found, and rows that take part in it are softened.
#pragma once

#include "bond_rows.hpp"

namespace fpz::sph::detail {

template <int Dim>
class RowStability {
 public:
  RowStability(const RunData<Dim>& run, BondRows<Dim>& rows) : run_(run), rows_(rows) {}

  /// Softens rows around the changed ones until the time step bears the highest frequency there. Only
  /// where the force is the adjoint of the gradient: others have no such frequency.
  void keep(const std::vector<std::size_t>& changed);

 private:
  struct Patch;
  struct Mode {
    double square = 0.0;           ///< of the frequency, 1/s^2
    std::vector<double> energies;  ///< of the patch's rows, any unit
  };
  [[nodiscard]] Patch patch_around(const std::vector<std::size_t>& changed) const;
  /// The fastest mode of the patch, its surroundings held, by the Lanczos method.
  [[nodiscard]] Mode fastest(const Patch& patch) const;

  const RunData<Dim>& run_;
  BondRows<Dim>& rows_;
};

}  // namespace fpz::sph::detail
