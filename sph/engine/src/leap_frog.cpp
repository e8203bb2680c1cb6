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
  body->plan_sweep();
}

template <int Dim>
Outcome Engine<Dim>::step() {
  if (!run.started) start();
  ++run.steps;
  Kick kick = kick_over(run.dt);
  begin_sweep();
  // 1. Positions at n + 1 (eq 31); densities, stresses and cracks there (eq 19, eq 21).
  const Outcome outcome = body->advance(kick);
  if (!outcome.ok()) {
    body->force(run.view_of(kick));  // some blocks may have gone on: now all have
    return outcome;
  }
  if (contact) contact->book();
  if (control) control->let_go(run.dt);
  const std::vector<ReleasedBond<Dim>> released = body->take_released();
  if (contact && !released.empty()) contact->add(released);
  // 2. Forces at n + 1 (eq 20), velocities at n + 3/2 (eq 26).
  finish(kick);
  return find_bad();
}

/// The first half step of the velocity (eq 23).
template <int Dim>
void Engine<Dim>::start() {
  body->start();
  Kick kick = kick_over(0.5 * run.dt);
  finish(kick);
  run.started = true;
  run.ledger.kinetic_start = kinetic();
}

/// What makes velocities at n + 1/2 of forces at n, over `step` (s). Pushes are still to come.
template <int Dim>
Kick Engine<Dim>::kick_over(double step) {
  const double half = 0.5 * run.dt;
  const Kick kick = {step, run.started ? half : 0.0, half, run.view.pushed || (contact && contact->presses())};
  if (kick.pushed) run.clear_pushes();
  return kick;
}

/// One sweep where no more than the forces of some blocks change between strains and forces: where cracks grow
/// (Body::advance() holds them) and where particles are pushed.
template <int Dim>
void Engine<Dim>::begin_sweep() {
  Sweep<Dim>& sweep = body->sweep();
  sweep.begin(run.in_one_sweep && !body->changes_rows() && !(contact && contact->changes()));
  if (!sweep.in_one()) return;
  const auto hold = [&sweep](std::size_t i) { sweep.hold(i); };
  for (const auto& boundary : boundaries) boundary->for_pushed(hold);
  if (contact) contact->for_particles(hold);
}

/// Forces at n, velocities to n + 1/2.
template <int Dim>
void Engine<Dim>::finish(Kick& kick) {
  if (contact) contact->prepare();
  if (!kick.pushed && body->pushes()) {
    run.clear_pushes();
    kick.pushed = true;
  }
  if (kick.pushed) {
    for (const auto& boundary : boundaries) boundary->push();
    if (contact && contact->presses()) contact->push();
    body->push();
  }
  body->force(run.view_of(kick));
  if (contact) contact->act(kick.step);
  for (const auto& boundary : boundaries) boundary->act(kick.step);
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
