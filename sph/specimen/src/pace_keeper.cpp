#include "pace_keeper.hpp"

#include <algorithm>
#include <cmath>

#include "servo.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr int looks_per_swing = 20;

}  // namespace

PaceKeeper::PaceKeeper(const Scene& scene, double time_step)
    : solver_(scene.solver),
      increment_(scene.solver.increment > 0.0 ? scene.solver.increment : scene.stop.time / 200.0),
      damping_(scene.options.damping),
      swing_(time_constant({}, scene)) {
  look_every_ = std::max(1LL, std::llround(swing_ / looks_per_swing / time_step));
  state_.target = increment_;
}

double PaceKeeper::look_at_energies(const sph::Simulation<2>& run) {
  const sph::Energies e = run.energies();
  state_.largest = std::max(state_.largest, e.elastic - e.elastic_start + e.fracture + e.friction);
  return e.kinetic;
}

StepUse PaceKeeper::after_step(sph::Simulation<2>& run) {
  switch (solver_.kind) {
    case Solver::Kind::dynamic:
    case Solver::Kind::converged:
      if (run.pace() != solver_.pace) run_up(run);
      return {};
    case Solver::Kind::adaptive:
      adapt(run);
      return {};
    case Solver::Kind::relaxation:
      return relax(run);
  }
  return {};
}

/// Smoothly to the pace that is wanted.
void PaceKeeper::run_up(sph::Simulation<2>& run) {
  run.set_pace(sph::TimeTable::rise(std::min(1.0, solver_.pace), solver_.pace, swing_).at(run.time()));
}

bool PaceKeeper::looks(const sph::Simulation<2>& run) {
  if (run.steps() < state_.next) return false;
  state_.next = run.steps() + look_every_;
  return true;
}

/// The kinetic energy of a body that is led through equilibria is as the square of the pace. That of a swing must not
/// count, or the pace would swing with it: hence a mean. The pace changes by a factor of e within half a swing at most.
void PaceKeeper::adapt(sph::Simulation<2>& run) {
  constexpr double mean_over = 0.5, e_within = 0.5;  // swings
  if (looks(run)) {
    const double interval = static_cast<double>(look_every_) * run.time_step();
    const double part = std::min(1.0, interval / (mean_over * swing_));
    state_.kinetic += part * (std::max(look_at_energies(run), 0.0) - state_.kinetic);
    const double most = std::exp(interval / (e_within * swing_));
    const double wanted = std::sqrt(solver_.kinetic_part * state_.largest / std::max(state_.kinetic, 1e-300));
    const double pace = run.pace() * std::clamp(wanted, 1.0 / most, most);
    state_.slope = (std::clamp(pace, solver_.slowest, solver_.fastest) - run.pace()) / static_cast<double>(look_every_);
  }
  if (state_.slope != 0.0) run.set_pace(run.pace() + state_.slope);
}

StepUse PaceKeeper::relax(sph::Simulation<2>& run) {
  if (!state_.resting) {
    if (run.loading_time() < state_.target) {
      run.set_pace(solver_.fastest);
    } else {
      begin_rest(run);
    }
    return {false, false};
  }
  if (!looks(run)) return {false, false};
  // Over half a swing: what swings is without motion twice in a period.
  constexpr int enough = looks_per_swing / 2;
  state_.quiet = look_at_energies(run) <= solver_.kinetic_part * state_.largest ? state_.quiet + 1 : 0;
  if (state_.quiet < enough && run.steps() < state_.rest_end) return {false, false};
  if (state_.quiet < enough) ++state_.given_up;
  state_.resting = false;
  state_.target = run.loading_time() + increment_;
  run.set_pace(solver_.fastest);
  run.set_damping(damping_);
  return {true, true};
}

void PaceKeeper::begin_rest(sph::Simulation<2>& run) {
  constexpr double longest_rest = 100.0;  // swings: what still moves is breaking
  state_.resting = true;
  state_.quiet = 0;
  state_.next = run.steps() + look_every_;
  state_.rest_end = run.steps() + std::llround(longest_rest * swing_ / run.time_step());
  run.set_pace(0.0);
  run.set_damping(solver_.rest_damping);
}

std::string PaceKeeper::warning() const {
  if (state_.given_up == 0) return {};
  return std::to_string(state_.given_up) +
         " rests of solver \"relaxation\" were given up before the body was at rest (kinetic_part): their rows are no "
         "equilibria; the body breaks by itself there, or needs more rest_damping";
}

}  // namespace fpz::specimen::detail
