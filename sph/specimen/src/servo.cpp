#include "servo.hpp"

#include <algorithm>
#include <cmath>

namespace fpz::specimen::detail {

double time_constant(const Servo& servo, const Scene& scene) {
  constexpr double passages = 10.0;  // a specimen swings about that slowly
  if (servo.time_constant > 0.0) return servo.time_constant;
  const auto [low, high] = extent(scene.body.shape);
  const double sound =
      std::sqrt(scene.parameters.young_modulus / (scene.parameters.density * scene.options.mass_scale));
  return passages * (high - low).maxCoeff() / sound;
}

double next_velocity(const ServoControl& control, double measured, double time_step, double pace, ServoState& state) {
  constexpr double integral_times = 4.0;  // time constants: critically damped, about, where the gauge follows at once
  const Servo& s = control.servo;
  if (!state.begun) state = {true, 0.0, measured, 0.0};
  const double grown = control.growth.at(state.time);
  const double lacking = state.target - measured;
  const double tau = control.time_constant;
  const double proportional = lacking / pace;
  const double wanted = s.speed * (grown + (proportional + state.sum / (integral_times * tau)) / (s.rate * tau));
  const double velocity = std::clamp(wanted, -s.fastest, s.fastest);
  if (velocity == wanted) state.sum += time_step * proportional;
  state.time += time_step * pace;
  state.target += time_step * pace * s.rate * grown;
  return pace * velocity;
}

}  // namespace fpz::specimen::detail
