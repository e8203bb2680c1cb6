// Decides how fast the loading of a slow test goes (solver.hpp), and which steps its rows are made of.
#pragma once

#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen::detail {

/// The pace keeper's part of a checkpoint.
struct PaceState {
  long long next = 0;      ///< step at which it looks again
  double largest = 0.0;    ///< energy that the body has taken up, J/m
  double kinetic = 0.0;    ///< adaptive: mean of late, J/m
  double slope = 0.0;      ///< adaptive: change of the pace per step
  bool resting = false;    ///< relaxation: the loading stands still
  int quiet = 0;           ///< relaxation: looks in a row that found it at rest
  double target = 0.0;     ///< relaxation: s of loading at which it rests next
  long long rest_end = 0;  ///< relaxation: step at which a rest is given up
  int given_up = 0;        ///< relaxation: rests that were
};

template <class Archive, class S>
void transfer(Archive& archive, S& state) requires std::same_as<std::remove_const_t<S>, PaceState> {
  auto& [next, largest, kinetic, slope, resting, quiet, target, rest_end, given_up] = state;
  archive(next), archive(largest), archive(kinetic), archive(slope);
  archive(resting), archive(quiet), archive(target), archive(rest_end), archive(given_up);
}

/// What a step is for the history.
struct StepUse {
  bool in_row = true;        ///< its gauges count for the next row
  bool equilibrium = false;  ///< a row of its own is due
};

class PaceKeeper {
 public:
  PaceKeeper(const Scene& scene, double time_step);

  /// After a step: sets the pace of the next one.
  StepUse after_step(sph::Simulation<2>& run);
  /// Whether rows are where it says, and not at even distances of the loading.
  [[nodiscard]] bool makes_rows() const { return solver_.kind == Solver::Kind::relaxation; }

  /// What is wrong with the equilibria; empty when nothing is.
  [[nodiscard]] std::string warning() const;

  [[nodiscard]] const PaceState& state() const { return state_; }
  void restore(const PaceState& state) { state_ = state; }

 private:
  void run_up(sph::Simulation<2>& run);
  void adapt(sph::Simulation<2>& run);
  StepUse relax(sph::Simulation<2>& run);
  void begin_rest(sph::Simulation<2>& run);
  /// Whether it is time to look at the energies, which takes as long as a step.
  bool looks(const sph::Simulation<2>& run);
  /// Keeps the largest energy taken up; the kinetic energy, J/m.
  double look_at_energies(const sph::Simulation<2>& run);

  const Solver& solver_;
  double increment_;  ///< s of loading
  double damping_;    ///< that of the scene
  double swing_;      ///< s: about how slowly the specimen swings
  long long look_every_;
  PaceState state_;
};

}  // namespace fpz::specimen::detail
