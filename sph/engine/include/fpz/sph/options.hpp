// Options of the particle method, with the defaults of a quasi-static fracture test of a small specimen. What files,
// checks and tables know about each of them is in option_table.hpp.
#pragma once

#include <cstdint>

#include "fpz/options.hpp"
#include "fpz/sph/kernel.hpp"
#include "fpz/types.hpp"

namespace fpz::sph {

enum class Configuration : std::uint8_t {
  reference,  ///< total Lagrangian: neighbours and kernel gradients of the undeformed body, once
  updated     ///< the paper: neighbours and gradients of the current positions, every step
};

enum class MomentumForm : std::uint8_t {
  adjoint,  ///< sum V_i V_j (sigma_i L_i + sigma_j L_j) grad W_ij: adjoint of eq 21, conserves momentum
  paper     ///< eq 20: L_i on both stresses
};

/// What the gradients and forces of the reference configuration are made of.
enum class Gradient : std::uint8_t {
  consistent,  ///< vectors of the bonds that keep constant stress in equilibrium; the paper's momentum form has none
  kernel       ///< kernel gradients with L_i, eq 17
};

/// What the length H of a cracked particle is.
struct RveLength {
  enum class Rule : std::uint8_t {
    spacing,  ///< the particle's own size V^(1/Dim) (the paper)
    band,     ///< the width over which a crack really spreads: where it begins band_width() of band.hpp; in
              ///< `reference` measured as it opens (crack_bands.hpp)
    number    ///< `value` for all
  };
  Rule rule = Rule::band;
  double value = 0.0;  ///< m
};

/// Which compiled version of the inner loops to run. All give the same bits.
enum class InstructionSet : std::uint8_t { best, baseline, avx2, avx512 };

template <int Dim>
struct Options {
  Configuration configuration = Configuration::reference;
  MomentumForm momentum = MomentumForm::adjoint;
  Gradient gradient = Gradient::consistent;
  Kernel kernel = Kernel::cubic_spline;
  double smoothing_ratio = 1.2;  ///< h / spacing
  double courant = 0.5;          ///< largest time step in units of h/sqrt(E/rho), eq 32 (see time_step())
  RveLength rve_length;
  Method method = Method::implicit;  ///< integrator of cracked particles
  double viscosity_alpha = 0.5;      ///< updated: linear artificial viscosity
  double viscosity_beta = 0.0;       ///< updated: quadratic artificial viscosity
  double artificial_stress = 0.2;    ///< updated: fraction of a tensile principal stress that repels close particles
  double skin = 0.3;                 ///< updated: margin of the neighbour lists, in spacings
  /// reference: stiffness, in units of lambda + 2 mu, against relative displacements of uncracked neighbours that the
  /// mean of the gradients at the two does not explain. The gradient does not see displacements that alternate from
  /// particle to particle. 0: off.
  double zero_energy_control = 0.2;
  /// reference: stiffness of closed faces, in units of (lambda + 2 mu)/spacing (mu/spacing in shear). 0: they pass
  /// through each other.
  double contact_stiffness = 10.0;
  double damping = 0.0;     ///< local damping: this part of the resultant force opposes the velocity
  double mass_scale = 1.0;  ///< inertia is multiplied by this (gravity is not)
  /// reference: the bonds of a crack whose integrity 1 - D is below this are cut where the displacements of their two
  /// ends differ by at least half of its opening. 0: never, and rows of cracked particles are not narrowed.
  double release_integrity = 0.02;
  /// reference: a crack with a damage below this takes another plane when that one fails. Ahead of a tip the stress
  /// along the path may reach the strength before the one across it, and a particle has one plane. 0: never.
  double reorientation_damage = 0.02;
  Vec<double, Dim> gravity = Vec<double, Dim>::Zero();  ///< m/s^2
  int threads = 0;                                      ///< 0: all that OpenMP offers
  InstructionSet instruction_set = InstructionSet::best;
};

}  // namespace fpz::sph

namespace fpz {

template <>
struct Words<sph::Configuration> {
  static constexpr Word<sph::Configuration> list[] = {{sph::Configuration::reference, "reference"},
                                                      {sph::Configuration::updated, "updated"}};
};

template <>
struct Words<sph::MomentumForm> {
  static constexpr Word<sph::MomentumForm> list[] = {{sph::MomentumForm::adjoint, "adjoint"},
                                                     {sph::MomentumForm::paper, "paper"}};
};

template <>
struct Words<sph::Gradient> {
  static constexpr Word<sph::Gradient> list[] = {{sph::Gradient::consistent, "consistent"},
                                                 {sph::Gradient::kernel, "kernel"}};
};

template <>
struct Words<sph::Kernel> {
  static constexpr Word<sph::Kernel> list[] = {{sph::Kernel::cubic_spline, "cubic_spline"},
                                               {sph::Kernel::wendland_c2, "wendland_c2"}};
};

/// The rules that are words; `number` is stated by the number itself.
template <>
struct Words<sph::RveLength::Rule> {
  static constexpr Word<sph::RveLength::Rule> list[] = {{sph::RveLength::Rule::spacing, "spacing"},
                                                        {sph::RveLength::Rule::band, "band"}};
};

template <>
struct Words<sph::InstructionSet> {
  static constexpr Word<sph::InstructionSet> list[] = {{sph::InstructionSet::best, "best"},
                                                       {sph::InstructionSet::baseline, "baseline"},
                                                       {sph::InstructionSet::avx2, "avx2"},
                                                       {sph::InstructionSet::avx512, "avx512"}};
};

}  // namespace fpz
