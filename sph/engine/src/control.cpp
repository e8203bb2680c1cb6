// Control of the velocities that the gradient does not see, in the reference configuration.
#include <cmath>

#include "engine.hpp"

namespace fpz::sph::detail {

template <int Dim>
bool Engine<Dim>::control_due() const {
  return view.control_viscosity > 0.0 && started && steps % control_interval == 0;
}

/// Pa s; with mass scaling so that its rate keeps its ratio to the time step.
template <int Dim>
double Engine<Dim>::control_viscosity() const {
  return setup.options.zero_energy_control * view.rest_density * view.sound_speed * h *
         std::sqrt(setup.options.mass_scale);
}

/// Pairwise dampers: no rate exceeds twice the largest sum of a particle's coefficients over its mass.
template <int Dim>
double Engine<Dim>::control_rate() const {
  const Particles<Dim>& p = particles;
  double largest = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    double sum = 0.0;
    for (const int neighbour : lists[i]) {
      const auto j = static_cast<std::size_t>(neighbour);
      double square = 0.0;
      for (std::size_t c = 0; c < dimensions; ++c)
        square += (p.start[c][j] - p.start[c][i]) * (p.start[c][j] - p.start[c][i]);
      const double slope = view.slope_norm * kernel_slope(setup.options.kernel, std::sqrt(square) / h);
      sum += slope * p.volume[i] * p.volume[j] * square / (square + 0.01 * h * h);
    }
    largest = std::max(largest, sum * p.inverse_mass[i]);
  }
  return 2.0 * control_viscosity() * largest;
}

template <int Dim>
void Engine<Dim>::control_velocities() {
  Particles<Dim>& p = particles;
  for_chunks([&](Index first, Index last) {
    for (std::size_t c = 0; c < dimensions; ++c) {
      for (std::size_t i = lanes_begin(first); i < lanes_begin(last); ++i) {
        p.predicted[c][i] = p.velocity[c][i] - 0.5 * dt * p.acceleration[c][i];
      }
    }
  });
  for (const PrescribedComponent& d : prescribed) {
    const double before = p.velocity[d.component][d.slot] - dt * p.acceleration[d.component][d.slot];
    p.predicted[d.component][d.slot] = 0.5 * (before + prescribed_velocity(d.group, d.component));
  }
  for_chunks([&](Index first, Index last) { passes->gradient_control(view, first, last); });
  for_chunks([&](Index first, Index last) { passes->force_control(view, first, last); });
}

/// Half of the work of a force with the velocity before it, half with the one after it, counted when that has happened.
template <int Dim>
void Engine<Dim>::account_control(bool acted) {
  control_work += control_next;
  control_next = 0.0;
  if (!acted) return;
  const Particles<Dim>& p = particles;
  for (std::size_t c = 0; c < dimensions; ++c) {
    for (std::size_t i = 0; i < p.count; ++i) {
      control_work -= 0.5 * dt * control[c][i] * (p.velocity[c][i] - dt * p.acceleration[c][i]);
      control_next -= 0.5 * dt * control[c][i] * p.velocity[c][i];
    }
  }
}

template bool Engine<2>::control_due() const;
template double Engine<2>::control_viscosity() const;
template double Engine<2>::control_rate() const;
template void Engine<2>::control_velocities();
template void Engine<2>::account_control(bool);

}  // namespace fpz::sph::detail
