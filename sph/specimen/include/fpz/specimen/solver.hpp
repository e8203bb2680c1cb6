// How a run gets through its loading: at the speeds of the scene, or as fast as its results allow.
#pragma once

#include "fpz/words.hpp"

namespace fpz::specimen {

struct Solver {
  enum class Kind : unsigned char {
    dynamic,     ///< the speeds of the scene times `pace`
    converged,   ///< a slow test: again and again, each time half as fast, until its results stay as they are
    adaptive,    ///< a slow test: as fast as the kinetic energy allows at the moment
    relaxation,  ///< a slow test: a piece of loading, then rest until the body is in equilibrium, and so on
  };
  Kind kind = Kind::dynamic;
  double pace = 1.0;        ///< dynamic: how many times faster than the scene says
  double tolerance = 0.02;  ///< converged: largest relative change of peak load and work between the last two runs
  /// adaptive, relaxation: the kinetic energy stays, or falls, below this part of the largest energy that the body has
  /// taken up (stored, or spent on fracture and friction).
  double kinetic_part = 0.003;
  double slowest = 0.25;      ///< converged, adaptive: least pace
  double fastest = 20.0;      ///< adaptive, relaxation: largest pace
  double increment = 0.0;     ///< relaxation: s of loading between two equilibria; 0: a two-hundredth of the whole
  double rest_damping = 0.7;  ///< relaxation: local damping while it rests
};

}  // namespace fpz::specimen

namespace fpz {

template <>
struct Words<specimen::Solver::Kind> {
  using Kind = specimen::Solver::Kind;
  static constexpr Word<Kind> list[] = {{Kind::dynamic, "dynamic"},
                                        {Kind::converged, "converged"},
                                        {Kind::adaptive, "adaptive"},
                                        {Kind::relaxation, "relaxation"}};
};

}  // namespace fpz
