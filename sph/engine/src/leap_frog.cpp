// The time integration (eq 22 to eq 31): positions, stresses and densities at full steps n, velocities half a step
// ahead. Stress and density go from full step to full step with the velocity between: one step takes the place of the
// half steps of the start (eq 22, eq 24), the full ones (eq 25, eq 27) and the extrapolations (eq 28, eq 30). Only the
// velocity that the viscosity sees is extrapolated (eq 29, in the drift).
#include <algorithm>
#include <cmath>

#include "engine.hpp"

namespace fpz::sph::detail {

template <int Dim>
Engine<Dim>::Engine(const RunSetup<Dim>& setup, double time_step)
    : run(setup, time_step), boundaries(make_boundaries(run)), body(make_body(run)) {
  const Options<Dim>& options = setup.options;
  if (options.configuration == Configuration::reference && options.zero_energy_control > 0.0) {
    control.emplace(run, options.zero_energy_control);
  }
  if (options.configuration == Configuration::reference && options.contact_stiffness > 0.0) {
    contact.emplace(run, boundaries, body->lists());
  }
}

template <int Dim>
Outcome Engine<Dim>::step() {
  if (!run.started) start();
  ++run.steps;
  // 1. Positions at n + 1 (eq 31); densities, stresses and cracks there (eq 19, eq 21).
  const Outcome outcome = body->advance();
  if (!outcome.ok()) return outcome;
  if (contact) contact->book();
  if (control) control->let_go(run.dt);
  const std::vector<ReleasedBond<Dim>> released = body->take_released();
  if (contact && !released.empty()) contact->add(released);
  // 2. Forces at n + 1 (eq 20), velocities at n + 3/2 (eq 26).
  kick(run.dt);
  return find_bad();
}

/// The first half step of the velocity (eq 23).
template <int Dim>
void Engine<Dim>::start() {
  body->start();
  kick(0.5 * run.dt);
  run.started = true;
  run.ledger.kinetic_start = kinetic();
}

/// Forces at n, velocities to n + 1/2 over `step` (s).
template <int Dim>
void Engine<Dim>::kick(double step) {
  const bool touching = contact && contact->prepare();
  View<Dim> view = run.view;
  view.step = step;
  view.work_before = run.started ? 0.5 * run.dt : 0.0;
  view.work_after = 0.5 * run.dt;
  view.pushed = view.pushed || touching || body->pushes();
  if (view.pushed) {
    for (Field& f : run.outer_force) std::fill(f.begin(), f.end(), 0.0);
    for (const auto& boundary : boundaries) boundary->push();
    if (touching) contact->push();
    body->push();
  }
  body->force(view);
  if (contact) contact->act(step);
  for (const auto& boundary : boundaries) boundary->act(step);
}

/// The first particle whose velocity the last kick has made too large or not finite.
template <int Dim>
Outcome Engine<Dim>::find_bad() const {
  const Particles<Dim>& p = run.particles;
  for (std::size_t b = 0; b < run.bad.size(); ++b) {
    if (run.bad[b] == 0) continue;
    for (std::size_t i = b * lanes; i < std::min((b + 1) * lanes, p.count); ++i) {
      double v2 = 0.0;
      for (std::size_t c = 0; c < run.dimensions; ++c) v2 += p.velocity[c][i] * p.velocity[c][i];
      if (v2 < run.view.top_speed * run.view.top_speed) continue;
      Outcome o;
      o.failure = std::isfinite(v2) ? Failure::too_fast : Failure::not_finite;
      o.particle = p.id[i];
      o.time = run.now();
      o.speed = std::sqrt(v2);
      o.loose = body->is_loose(i);
      return o;
    }
  }
  return {};
}

template Engine<2>::Engine(const RunSetup<2>&, double);
template Outcome Engine<2>::step();

}  // namespace fpz::sph::detail
