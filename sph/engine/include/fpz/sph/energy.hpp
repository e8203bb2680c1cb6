// The energies of a run and their balance.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace fpz::sph {

/// Joule (per metre of thickness in 2-D). The balance is external = elastic + kinetic + fracture + zero_energy +
/// viscous + damping + artificial + contact + friction, all counted from the start; kinetic is the difference from the
/// start.
struct Energies {
  double external = 0.0;     ///< work of boundaries, loads and gravity
  double elastic = 0.0;      ///< stored in bulk and cohesive zones
  double kinetic = 0.0;      ///< sum m v(n-1/2).v(n+1/2)/2, the leap-frog's own invariant
  double fracture = 0.0;     ///< dissipated by the cohesive zones
  double zero_energy = 0.0;  ///< stored in the zero-energy control
  double viscous = 0.0;      ///< dissipated by artificial viscosity, and by the zero-energy control where cracks begin
  double damping = 0.0;      ///< dissipated by local damping
  double artificial = 0.0;   ///< taken by the artificial stress (may be negative)
  double contact = 0.0;      ///< stored where faces press on each other
  double friction = 0.0;     ///< dissipated where faces slide and where they hit each other
  double kinetic_start = 0.0;
  double elastic_start = 0.0;  ///< of an initial stress

  /// What the balance lacks: zero for exact integration.
  [[nodiscard]] constexpr double error() const;
};

/// Side of the balance: what comes in, what is kept or taken, and what was there at the start.
enum class EnergyRole : std::uint8_t { source, sink, initial };

struct EnergyTerm {
  std::string_view name;  ///< "energy_" + name is the column of a history
  double Energies::*member;
  EnergyRole role;
  std::string_view text;  ///< one line for tables
};

/// The one list of the terms, in the order in which they are added and reported.
// clang-format off
inline constexpr std::array<EnergyTerm, 12> energy_terms = {{
    {"external",      &Energies::external,      EnergyRole::source,  "work of boundaries, loads and gravity"},
    {"elastic",       &Energies::elastic,       EnergyRole::sink,    "stored in the bulk and in cohesive zones"},
    {"kinetic",       &Energies::kinetic,       EnergyRole::sink,    "kinetic, of the leap-frog"},
    {"kinetic_start", &Energies::kinetic_start, EnergyRole::initial, "kinetic at the start"},
    {"elastic_start", &Energies::elastic_start, EnergyRole::initial, "elastic at the start"},
    {"fracture",      &Energies::fracture,      EnergyRole::sink,    "dissipated by the cohesive zones"},
    {"zero_energy",   &Energies::zero_energy,   EnergyRole::sink,    "stored in the zero-energy control"},
    {"viscous",       &Energies::viscous,       EnergyRole::sink,
     "dissipated by artificial viscosity, by the zero-energy control where cracks begin, and where H is measured again "
     "(it can come back)"},
    {"damping",       &Energies::damping,       EnergyRole::sink,    "dissipated by local damping"},
    {"artificial",    &Energies::artificial,    EnergyRole::sink,    "taken by the artificial stress"},
    {"contact",       &Energies::contact,       EnergyRole::sink,    "stored where faces press on each other"},
    {"friction",      &Energies::friction,      EnergyRole::sink,
     "dissipated where faces slide and where they hit each other"},
}};
// clang-format on

constexpr double Energies::error() const {
  double in = 0.0;
  double taken = 0.0;
  for (const EnergyTerm& term : energy_terms) {
    const double energy = this->*term.member;
    if (term.role == EnergyRole::source) in += energy;
    if (term.role == EnergyRole::sink) taken += energy;
    if (term.role == EnergyRole::initial) taken -= energy;
  }
  return in - taken;
}

/// Calls report(name, J) for what a history shows: every term but the initial one, then "error".
template <class Report>
constexpr void for_each_energy(const Energies& e, Report&& report) {
  for (const EnergyTerm& term : energy_terms) {
    if (term.role != EnergyRole::initial) report(term.name, e.*term.member);
  }
  report(std::string_view("error"), e.error());
}

}  // namespace fpz::sph
