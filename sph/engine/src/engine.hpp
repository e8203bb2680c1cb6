// A run taken together: body, boundaries, zero-energy control, and the time steps that join them.
#pragma once

#include <optional>

#include "body.hpp"
#include "contact.hpp"
#include "zero_energy_control.hpp"

namespace fpz::sph::detail {

template <int Dim>
struct Engine {
  RunData<Dim> run;
  Boundaries<Dim> boundaries;
  std::unique_ptr<Body<Dim>> body;
  std::optional<ZeroEnergyControl<Dim>> control;
  std::optional<Contact<Dim>> contact;

  /// A run with the given time step, s.
  Engine(const RunSetup<Dim>& setup, double time_step);

  /// One time step: leap_frog.cpp.
  [[nodiscard]] Outcome step();

  [[nodiscard]] Energies energies() const;
  /// sum m v(n-1/2).v(n+1/2)/2, J.
  [[nodiscard]] double kinetic() const;

  /// Accelerations and stresses of the elastic body that was displaced from rest by the velocities times one second.
  /// Leaves the state unusable, the velocities included.
  void accelerate_from_rest();
  /// Largest angular frequency of the elastic body of the reference configuration with its prescribed components held,
  /// 1/s. Leaves the state unusable.
  [[nodiscard]] double largest_frequency();
  /// Longest stable time step of that body, s. Leaves the state as it was.
  [[nodiscard]] double stability_limit();

  /// The state that changes during a run; load() after save() continues bit for bit.
  void save(Writer& archive) const;
  void load(Reader& archive);

 private:
  void start();
  [[nodiscard]] Kick kick_over(double step);
  void begin_sweep();
  void finish(Kick& kick);
  [[nodiscard]] Outcome find_bad() const;
};

}  // namespace fpz::sph::detail
