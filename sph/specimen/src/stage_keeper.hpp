// Leads a run through its stages: when one ends, what changes for the next one, and servo control within them.
#pragma once

#include "fpz/specimen/run.hpp"
#include "recorder.hpp"
#include "servo.hpp"

namespace fpz::specimen {

template <class Archive, class S>
void transfer(Archive& archive, S& stage) requires std::same_as<std::remove_const_t<S>, EndedStage> {
  auto& [name, reason, begin, end, kinetic_ratio] = stage;  // a member that is not handed on does not compile
  archive(name), archive(reason), archive(begin), archive(end), archive(kinetic_ratio);
}

}  // namespace fpz::specimen

namespace fpz::specimen::detail {

/// The stage keeper's part of a checkpoint.
struct StageState {
  std::size_t index = 0;      ///< of the present stage
  long long first_step = 0;   ///< of the present stage
  std::size_t first_row = 0;  ///< rows that were there when it began
  std::vector<EndedStage> ended;
  std::vector<std::string> warnings;
  std::vector<ServoState> servos;  ///< of the present stage, in the order of its boundaries and components
};

template <class Archive, class State>
void transfer(Archive& archive, State& state) requires std::same_as<std::remove_const_t<State>, StageState> {
  auto& [index, first_step, first_row, ended, warnings, servos] =
      state;  // a member that is not handed on does not compile
  archive(index), archive(first_step), archive(first_row), archive(ended), archive(warnings), archive(servos);
}

class StageKeeper {
 public:
  StageKeeper(const Scene& scene, const Specimen& specimen, double time_step);

  /// Lets what is servo-controlled follow its gauge, for the step that comes.
  void steer(sph::Simulation<2>& run);
  /// After a row: ends the stage when one of its rules is met and begins the next one. Which rule ended the run, in
  /// words, when that was the last stage; else empty. `changed` tells that a stage has ended.
  [[nodiscard]] std::string after_row(sph::Simulation<2>& run, const Recorder& recorder, bool& changed);
  /// Notes the end of the last stage when the run is over otherwise.
  void finish(const sph::Simulation<2>& run, const std::string& reason);

  [[nodiscard]] const std::vector<EndedStage>& ended() const { return state_.ended; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return state_.warnings; }

  [[nodiscard]] const StageState& state() const { return state_; }
  void restore(StageState state);

 private:
  [[nodiscard]] const Stage& stage() const { return scene_.stages[state_.index]; }
  void begin_next(sph::Simulation<2>& run, std::size_t rows);
  void change(sph::Simulation<2>& run, const Stage& next);
  /// How the boundaries are driven from that stage on.
  void take_over(const Stage& next);
  /// The servos of a stage: of the boundaries as they are driven in it.
  void find_servos();
  void judge_start(double present, const TimeCourse& course, const std::string& who);

  const Scene& scene_;
  const Specimen& specimen_;
  double time_step_;
  std::vector<Actuations> drive_;  ///< of the boundaries in the present stage
  std::vector<ServoControl> servos_;
  StageState state_;
};

}  // namespace fpz::specimen::detail
