// What the inner loops see: raw pointers into the arrays of a simulation, and constants. The loops are compiled once
// per instruction set, so this header and theirs include nothing that could emit shared inline code.
#pragma once

#include <cstddef>

namespace fpz::sph::detail {

/// Block b owns the columns column[b] .. column[b+1]; entry (column, lane) is at column * lanes + lane. Padding: the
/// particle itself, weight 0. See Bonds (bonds.hpp).
template <int Dim>
struct BondView {
  static constexpr auto d = static_cast<std::size_t>(Dim);
  const int* column = nullptr;
  const int* neighbour = nullptr;
  const int* run = nullptr;     // of each column: the first neighbour where those of the lanes follow it, else -1
  const int* shared = nullptr;  // of each block: its place among the stencils, else -1
  double* weight[d] = {};
  double* beside = nullptr;
  const double* stencil_weight[d] = {};
  const double* stencil_beside = nullptr;
};

template <int Dim>
struct View {
  static constexpr auto d = static_cast<std::size_t>(Dim);
  static constexpr std::size_t tensor = d * (d + 1) / 2;

  // weight = V_i V_j grad_i W_ij or what takes its place (bond_vectors.hpp; paper's momentum: L_i times that); beside,
  // in updated: (W_ij / W(spacing))^n.
  BondView<Dim> bonds;

  const double* start[d] = {};
  double* position[d] = {};
  double* velocity[d] = {};
  double* acceleration[d] = {};
  double* predicted[d] = {};
  const double* mass = nullptr;
  const double* inverse_mass = nullptr;
  double* volume = nullptr;
  double* density = nullptr;
  const double* kind = nullptr;
  // Of each particle, where there are several materials; see the constants of the same names.
  const double *own_lambda = nullptr, *own_mu = nullptr;
  const double *own_sin_phi = nullptr, *own_strength = nullptr, *own_apex = nullptr;
  double* stress[tensor] = {};
  double* strain[tensor] = {};
  double* correction[d * d] = {};  // xx, yy, xy, yx; symmetric in updated
  double* artificial[tensor] = {};
  double* gradient[d * d] = {};
  double* flux[d * d] = {};
  // Reference: the zero-energy control, with bonds of its own: weight = k_ij r_ij (N), beside = k_ij (N/m).
  BondView<Dim> control_bonds;
  const double* control_fit[tensor] = {};  // inverse of sum k_ij r_ij (x) r_ij
  const double* control_share = nullptr;   // part of its energy that a particle has left
  double* control_displacement[d] = {};
  double* control_gradient[d * d] = {};  // times the share
  double* rotation[2] = {};
  const double* damping[d] = {};      // per component: 1, zero where the velocity is driven
  const double* outer_force[d] = {};  // of boundaries that push and of closed faces
  unsigned char* flagged = nullptr;

  // Per block: work so far, and what the force at n will have done by n + 1/2.
  double* damping_work = nullptr;
  double* damping_next = nullptr;
  double* viscous_work = nullptr;
  double* artificial_work = nullptr;
  unsigned char* bad = nullptr;
  double* viscous_force[d] = {};  // updated: of the last step
  double* artificial_force[d] = {};

  // Constants.
  double step = 0.0;                                 // s; of the kick: half at the start
  double work_before = 0.0, work_after = 0.0;        // half a step each; before is zero at the start
  double lambda = 0.0, mu = 0.0;                     // of a body of one material, as the next three
  double sin_phi = 0.0, strength = 0.0, apex = 0.0;  // onset: strength = c0 cos(phi)
  double gravity[d] = {};
  double weight_scale = 1.0;  // gravity acts on mass * this
  double top_speed = 0.0;     // m/s: faster than this is an explosion
  double damping_part = 0.0;  // of the resultant force
  bool damped = false;
  bool pushed = false;  // there is an outer force
  double smoothing = 0.0, inverse_smoothing = 0.0;
  double slope_norm = 0.0;  // kernel_norm / h^2
  double reference_shape = 1.0;
  double rest_density = 0.0, sound_speed = 0.0, viscosity_alpha = 0.0, viscosity_beta = 0.0;
  double artificial_stress = 0.0;
  bool controlled = false;  // the zero-energy control is on
  bool lean = false;        // reference: rotation, strain and stress only where the library needs them
};

/// Number of a block, or of an entry of the arrays above.
using Index = std::ptrdiff_t;

/// Functions over a range of blocks [first, last).
template <int Dim>
struct Passes {
  using Pass = void (*)(const View<Dim>&, Index first, Index last);
  Pass strain_reference;  ///< positions, velocity gradient -> F, rotation, strain, elastic stress, flux, onset flags
  Pass show_reference;    ///< F -> rotation, strain, elastic stress, as strain_reference stores them unless it is lean
  Pass force_reference;   ///< internal force with that of the zero-energy control, damping, kick
  Pass drift_updated;     ///< position += step velocity; predicted velocity of the full step
  Pass strain_updated;    ///< kernel, L_i, velocity gradient -> density, rotated stress, flux, onset flags
  Pass force_updated;     ///< internal force with artificial viscosity and stress, damping, kick
};

/// The loops of one instruction set, for a kernel, a momentum form, and one material or several.
template <int Dim>
const Passes<Dim>& baseline_passes(int kernel, int momentum, bool several);
template <int Dim>
const Passes<Dim>& avx2_passes(int kernel, int momentum, bool several);
template <int Dim>
const Passes<Dim>& avx512_passes(int kernel, int momentum, bool several);

}  // namespace fpz::sph::detail
