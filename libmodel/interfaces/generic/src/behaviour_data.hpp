// What a client hands to a 'generic' behaviour: pointers into its own memory, in the order that the convention fixes.
#pragma once

namespace fpz::generic {

/// The state at the beginning of a step: read only.
struct BeginState {
  const double* gradients;
  const double* thermodynamic_forces;
  const double* mass_density;         ///< never read: some clients leave it uninitialised
  const double* material_properties;  ///< never read: those of the end hold during the step, as in MFront
  const double* internal_state_variables;
  const double* stored_energy;             ///< J/m^3; may be null
  const double* dissipated_energy;         ///< J/m^3; may be null
  const double* external_state_variables;  ///< never read: nothing depends on them
};

/// The state at the end of a step: forces, internal variables and energies are written.
struct EndState {
  const double* gradients;
  double* thermodynamic_forces;
  const double* mass_density;  ///< never read
  const double* material_properties;
  double* internal_state_variables;
  double* stored_energy;      ///< J/m^3; may be null
  double* dissipated_energy;  ///< J/m^3; may be null
  const double* external_state_variables;
};

struct BehaviourData {
  char* error_message;     ///< null, or room for message_size characters
  double dt;               ///< never read: the law knows no time
  double* K;               ///< K[0] on entry says what is wanted (request.hpp); on exit the operator, row by row
  double* rdt;             ///< advice on the next step; null, or written when the step fails
  double* speed_of_sound;  ///< m/s; written when it is asked for, otherwise not touched
  BeginState s0;
  EndState s1;
};

inline constexpr int message_size = 512;  ///< of the client's error message, with the final zero

/// What a behaviour returns. The convention also has 0, an unreliable result, which this one never gives.
enum Result : int { failed = -1, done = 1 };

}  // namespace fpz::generic
