// One time step: leap-frog with positions, stresses and densities at full steps and velocities between them (eq 22-31;
// the stress is advanced with the velocity between, so nothing but the velocity seen by the viscosity is extrapolated).
#include <cmath>

#include "engine.hpp"

namespace fpz::sph::detail {

namespace {
constexpr long long release_interval = 16;  // steps between searches for open bonds: openings grow slowly
}

template <int Dim>
void Engine<Dim>::kick(double step) {
  View<Dim> v = view;
  v.step = step;
  v.work_before = started ? 0.5 * dt : 0.0;
  v.work_after = 0.5 * dt;
  const auto pass = updated() ? passes->force_updated : passes->force_reference;
  for_chunks([&](Index first, Index last) { pass(v, first, last); });
  const bool acts = control_due();
  if (acts) control_velocities();
  prescribe(step);
  account_control(acts);
}

template <int Dim>
void Engine<Dim>::prescribe(double step) {
  Particles<Dim>& p = particles;
  std::vector<Vec<double, Dim>> old_reaction = reaction;
  std::vector<Vec<double, Dim>> old_velocity = group_velocity;
  for (std::size_t g = 0; g < setup.groups.size(); ++g) {
    for (std::size_t c = 0; c < dimensions; ++c) {
      if (setup.groups[g].motion[c]) group_velocity[g][static_cast<int>(c)] = prescribed_velocity(g, c);
    }
    reaction[g].setZero();
  }
  for (const PrescribedComponent& d : prescribed) {
    const auto c = static_cast<int>(d.component);
    double& velocity = p.velocity[d.component][d.slot];
    double& acceleration = p.acceleration[d.component][d.slot];
    const double target = group_velocity[d.group][c];
    const double lacking = (target - velocity) / step;
    reaction[d.group][c] += p.mass[d.slot] * lacking;
    acceleration += lacking;
    velocity = target;
  }
  // Trapezoidal in the force: the work that makes the leap-frog's energy exact for an elastic body.
  for (std::size_t g = 0; g < setup.groups.size(); ++g) {
    if (started) prescribed_work += 0.5 * dt * (old_reaction[g] + reaction[g]).dot(old_velocity[g]);
  }
}

template <int Dim>
void Engine<Dim>::start() {
  if (updated()) {  // weights and corrections, without motion
    View<Dim> v = view;
    v.step = 0.0;
    for_chunks([&](Index first, Index last) { passes->drift(v, first, last); });
    for_chunks([&](Index first, Index last) { passes->gradient_updated(v, first, last); });
  }
  kick(0.5 * dt);
  started = true;
  kinetic_start = kinetic();
}

template <int Dim>
double Engine<Dim>::kinetic() const {
  const Particles<Dim>& p = particles;
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    for (std::size_t c = 0; c < dimensions; ++c) {
      sum += 0.5 * p.mass[i] * p.velocity[c][i] * (p.velocity[c][i] - dt * p.acceleration[c][i]);
    }
  }
  return sum;
}

template <int Dim>
Outcome Engine<Dim>::step() {
  if (!started) start();
  ++steps;
  std::vector<Outcome> failures(particles.blocks() / static_cast<std::size_t>(chunk_blocks) + 1);
  const auto update = [&](Index first, Index last) {
    (updated() ? passes->gradient_updated : passes->gradient_reference)(view, first, last);
    failures[static_cast<std::size_t>(first / chunk_blocks)] = update_flagged(first, last);
  };
  if (updated()) {
    for_chunks([&](Index first, Index last) {
      passes->drift(view, first, last);
      for (std::size_t i = lanes_begin(first); i < lanes_begin(last); ++i) {
        particles.volume[i] = particles.mass[i] * view.weight_scale / particles.density[i];
      }
    });
    if (lists_outdated()) {
      rebuild_lists();
      point_view();
    }
    for_chunks(update);
  } else {
    for_chunks([&](Index first, Index last) {
      passes->drift(view, first, last);
      update(first, last);
    });
    if (setup.options.release_integrity > 0.0 && steps % release_interval == 0) release_bonds();
  }
  for (const Outcome& f : failures) {
    if (!f.ok()) return f;
  }
  kick(dt);
  return find_bad();
}

template <int Dim>
Outcome Engine<Dim>::find_bad() const {
  for (std::size_t b = 0; b < bad.size(); ++b) {
    if (bad[b] == 0) continue;
    for (std::size_t i = b * lanes; i < std::min((b + 1) * lanes, particles.count); ++i) {
      double v2 = 0.0;
      for (std::size_t c = 0; c < dimensions; ++c) v2 += particles.velocity[c][i] * particles.velocity[c][i];
      if (v2 < view.top_speed * view.top_speed) continue;
      Outcome o;
      o.failure = std::isfinite(v2) ? Failure::too_fast : Failure::not_finite;
      o.particle = particles.id[i];
      o.time = now();
      o.speed = std::sqrt(v2);
      return o;
    }
  }
  return {};
}

template void Engine<2>::kick(double);
template void Engine<2>::prescribe(double);
template void Engine<2>::start();
template double Engine<2>::kinetic() const;
template Outcome Engine<2>::step();
template Outcome Engine<2>::find_bad() const;

}  // namespace fpz::sph::detail
