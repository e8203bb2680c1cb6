// One update of a material point for foreign code: never throws, says what happened in words, captures failures.
#pragma once

#include <string>

#include "fpz/point/behaviour.hpp"
#include "fpz/point/failure_capture.hpp"
#include "fpz/point/state_layout.hpp"
#include "fpz/tangent.hpp"

namespace fpz::point {

/// What came of an update.
struct Outcome {
  Status status = Status::ok;
  int iterations = 0;              ///< of the integrator, as in Report
  int substeps = 0;                ///< the same
  bool onset = false;              ///< the fracture appeared in this update
  double stored_energy = 0.0;      ///< at the end, J/m^3 (energy.hpp)
  double dissipated_energy = 0.0;  ///< since the beginning, J/m^3

  [[nodiscard]] bool ok() const { return status == Status::ok; }
};

/// Why the thread's last failing call failed, with the way out and the file of the capture; empty before the first.
/// Successful calls do not touch it.
[[nodiscard]] const std::string& last_message() noexcept;

/// Sets it, for failures that an interface finds itself.
void set_last_message(std::string message) noexcept;

/// update(), or update_with_tangent() when `tangent` is not null, with the messages of this room. On failure `end`
/// equals `begin`, `tangent` is untouched, and the energies are those of the begin. begin and end may be the same
/// object.
template <int Dim>
[[nodiscard]] Outcome update_point(const Behaviour& behaviour, const State<double, Dim>& begin,
                                   const Tensor<double, Dim>& strain_increment, State<double, Dim>& end,
                                   Tangent<Dim>* tangent) noexcept;

/// The same on flat arrays: states as in state_layout.hpp, the strain increment in tensor components, the tangent row
/// by row, d(stress_i)/d(tensor strain_j), null if it is not wanted. Begin and end may be the same array. An array that
/// is not a state is Status::invalid_input. On failure `end` gets the numbers of `begin`.
template <int Dim>
[[nodiscard]] Outcome update_flat(const Behaviour& behaviour, const double* begin, const double* strain_increment,
                                  double* end, double* tangent) noexcept;

}  // namespace fpz::point
