// Servo control: the velocity of a boundary follows so that a gauge grows at a given rate.
#pragma once

#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen::detail {

/// A servo with what it looks at and moves.
struct ServoControl {
  Servo servo;
  std::size_t group = 0, component = 0;
  BoundGauge gauge;
  double time_constant = 0.0;  ///< s
  sph::TimeTable growth;       ///< of the rate, from 0 to 1 within its ramp
};

/// What a servo remembers, all zero at the begin of its stage. In units of its gauge.
struct ServoState {
  bool begun = false;
  double time = 0.0;    ///< s of loading since the begin
  double target = 0.0;  ///< where the gauge should be
  double sum = 0.0;     ///< integral of what it lacks over the time of the body, over the pace, times s
};

template <class Archive, class S>
void transfer(Archive& archive, S& state) requires std::same_as<std::remove_const_t<S>, ServoState> {
  auto& [begun, time, target, sum] = state;  // a member that is not handed on does not compile
  archive(begun), archive(time), archive(target), archive(sum);
}

/// That of the servo; where it states none, from the scene: the time of a wave through ten times the body's extent.
[[nodiscard]] double time_constant(const Servo& servo, const Scene& scene);

/// The velocity for the next step, m/s, when the gauge has the value `measured` and the loading goes at this pace.
///   pace speed (ramp + (e + sum(e) dt/(4 tau)) / (pace rate tau)),  e = target - measured
/// within the largest speed; what that cuts off is not summed up. Rates are those of the loading, dt and tau times of
/// the body.
[[nodiscard]] double next_velocity(const ServoControl& control, double measured, double time_step, double pace,
                                   ServoState& state);

}  // namespace fpz::specimen::detail
