#include "stage_keeper.hpp"

#include <cmath>
#include <sstream>

#include "stop_rules.hpp"

namespace fpz::specimen::detail {
namespace {

double kinetic_over_elastic(const sph::Simulation<2>& run) {
  const sph::Energies e = run.energies();
  return e.elastic > 0.0 ? e.kinetic / e.elastic : std::nan("");
}

std::string in_short(double x) {
  std::ostringstream s;
  s.precision(3);
  s << x;
  return s.str();
}

}  // namespace

StageKeeper::StageKeeper(const Scene& scene, const Specimen& specimen, double time_step)
    : scene_(scene), specimen_(specimen), time_step_(time_step) {
  for (const Boundary& b : scene.boundaries) drive_.push_back(b.drive);
  find_servos();
}

void StageKeeper::find_servos() {
  servos_.clear();
  for (std::size_t g = 0; g < drive_.size(); ++g) {
    for (std::size_t c = 0; c < 2; ++c) {
      if (!drive_[g][c] || !drive_[g][c]->servo) continue;
      const Servo& servo = *drive_[g][c]->servo;
      servos_.push_back({servo, g, c, specimen_.gauges.at(servo.gauge), time_constant(servo, scene_),
                         sph::TimeTable::rise(0.0, 1.0, servo.ramp)});
    }
  }
  state_.servos.assign(servos_.size(), {});
}

void StageKeeper::steer(sph::Simulation<2>& run) {
  for (std::size_t k = 0; k < servos_.size(); ++k) {
    const ServoControl& s = servos_[k];
    const double measured = s.gauge.value(run, scene_.thickness);
    const double velocity = next_velocity(s, measured, time_step_, run.pace(), state_.servos[k]);
    run.steer(s.group, s.component, velocity);
  }
}

std::string StageKeeper::after_row(sph::Simulation<2>& run, const Recorder& recorder, bool& changed) {
  const StopState now{scene_,     specimen_,
                      stage(),    run,
                      recorder,   run.loading_steps() - state_.first_step,
                      time_step_, recorder.history().rows() - state_.first_row};
  std::string reason = stop_reason(now);
  changed = !reason.empty();
  if (reason.empty()) return reason;
  const bool equilibrium = stage().stop.kinetic_below && reason == stop_reason_of_time();
  if (equilibrium) {
    state_.warnings.push_back("stage \"" + stage().name +
                              "\" ended by its time before it was at rest (stop.kinetic_below): "
                              "kinetic over elastic energy " +
                              in_short(kinetic_over_elastic(run)) + "; give it more time, or damping");
  }
  if (state_.index + 1 == scene_.stages.size()) return reason;
  finish(run, reason);
  begin_next(run, recorder.history().rows());
  return {};
}

void StageKeeper::finish(const sph::Simulation<2>& run, const std::string& reason) {
  const double begin = static_cast<double>(state_.first_step) * time_step_;
  state_.ended.push_back({stage().name, reason, begin, run.loading_time(), kinetic_over_elastic(run)});
}

void StageKeeper::begin_next(sph::Simulation<2>& run, std::size_t rows) {
  ++state_.index;
  state_.first_step = run.loading_steps();
  state_.first_row = rows;
  change(run, stage());
  find_servos();
}

/// A table that does not begin with what is there makes a jump.
void StageKeeper::judge_start(double present, const TimeCourse& course, const std::string& who) {
  if (course.form != TimeCourse::Form::table) return;
  const double first = course.table.value.front(), size = std::max(course.largest(), std::abs(present));
  if (std::abs(first - present) <= 0.01 * size) return;
  state_.warnings.push_back("stage \"" + stage().name + "\": " + who + " jumps from " + in_short(present) + " to " +
                            in_short(first) +
                            ", the first value of its table; {\"value\", \"ramp\"} begins with what is there");
}

void StageKeeper::take_over(const Stage& next) {
  for (const auto& [g, drive] : next.boundaries) {
    for (std::size_t c = 0; c < 2; ++c) {
      if (drive[c]) drive_[g][c] = drive[c];
    }
  }
}

void StageKeeper::change(sph::Simulation<2>& run, const Stage& next) {
  for (const auto& [g, drive] : next.boundaries) {
    for (std::size_t c = 0; c < 2; ++c) {
      if (!drive[c]) continue;
      const auto k = static_cast<int>(c);
      const double velocity = run.velocity(g)[k] / run.pace(), force = run.reaction(g)[k] * scene_.thickness;
      if (drive[c]->kind == sph::Drive::Kind::force) judge_start(force, drive[c]->course, scene_.boundaries[g].name);
      run.set_drive(g, c, drive[c]->starting(run.loading_time(), velocity, force, scene_.thickness));
      run.steer(g, c, run.pace() * velocity);
    }
  }
  take_over(next);
  for (const auto& [k, course] : next.loads) {
    judge_start(run.factor(k), course, scene_.loads[k].name);
    run.set_factor(k, course.starting(run.loading_time(), run.factor(k)));
  }
  if (next.damping) run.set_damping(*next.damping);
}

void StageKeeper::restore(StageState state) {
  for (std::size_t n = 1; n <= state.index; ++n) take_over(scene_.stages[n]);
  find_servos();
  state_ = std::move(state);
}

}  // namespace fpz::specimen::detail
