// The particles of a run as structure of arrays, in the order of a space-filling curve, padded to whole blocks of
// lanes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fpz/sph/lanes.hpp"
#include "fpz/state.hpp"

namespace fpz::sph {

using Field = std::vector<double>;
/// N components of a vector or tensor.
template <int N>
using Fields = std::array<Field, static_cast<std::size_t>(N)>;

/// Times: positions, stress and density are at the full step n, `velocity` at n + 1/2, `acceleration` at n.
template <int Dim>
struct Particles {
  static constexpr int dimensions = Dim;

  std::size_t count = 0;        ///< real particles; the arrays are longer, up to a whole block
  std::vector<std::size_t> id;  ///< index in the arrangement
  Fields<Dim> start;
  Fields<Dim> position;
  Fields<Dim> velocity;
  Fields<Dim> acceleration;
  Fields<Dim> predicted;  ///< updated: velocity at the full step (eq 29)
  Field mass;             ///< inertia, mass scaling included
  Field inverse_mass;     ///< zero for padding
  Field volume;           ///< reference: of the undeformed particle; updated: current
  Field density;          ///< updated: kg/m^3, without mass scaling
  Field length;           ///< H, m; with RveLength::Rule::band of cracked particles only, else their size
  Field fracture;         ///< energy dissipated by the crack, J: the sum of volume times its density over the steps
  Field kind;
  Fields<tensor_size<Dim>> stress;  ///< reference: in the frame that turns with the particle
  Fields<tensor_size<Dim>> strain;  ///< reference: U - I; updated: increment of the last step
  Fields<Dim * Dim> correction;     ///< L_i: xx, yy, xy, yx; the identity in the reference form with paper's momentum
  Fields<tensor_size<Dim>> artificial;    ///< updated: artificial stress of the particle, Pa
  Fields<Dim * Dim> gradient;             ///< reference: F - I, row-major; updated: not used
  Fields<Dim * Dim> flux;                 ///< what the force sums: stress times correction, row-major
  Fields<2> rotation;                     ///< cosine, sine: total (reference) or of the last step (updated)
  std::vector<State<double, Dim>> point;  ///< of cracked particles; reference: in the turning frame

  [[nodiscard]] std::size_t padded() const { return mass.size(); }
  [[nodiscard]] std::size_t blocks() const { return mass.size() / lanes; }
  [[nodiscard]] Tensor<double, Dim> stress_of(std::size_t i) const {
    Tensor<double, Dim> s;
    for (int k = 0; k < tensor_size<Dim>; ++k) s[k] = stress[static_cast<std::size_t>(k)][i];
    return s;
  }
};

}  // namespace fpz::sph
