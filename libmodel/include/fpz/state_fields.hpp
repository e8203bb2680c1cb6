// The fields of a material point's state with their names, listed once for all that saves, restores or describes
// states.
#pragma once

#include "fpz/state.hpp"

namespace fpz {

/// Calls `f(name, field)` for the fields that every point has. S is State<T, Dim>, const or not.
template <class S, class F>
void visit_point(S& s, F&& f) {
  f("strain", s.strain);
  f("stress", s.stress);
  f("cracked", s.cracked);
}

/// The same for the fields that have a meaning only when the point is cracked.
template <class S, class F>
void visit_crack(S& s, F&& f) {
  f("frame", s.frame);
  f("traction", s.crack.traction);
  f("jump", s.crack.jump);
  f("plastic_jump", s.crack.plastic_jump);
  f("offset", s.crack.offset);
  f("slip", s.crack.slip);
  f("integrity", s.crack.integrity);
  f("dissipated", s.crack.dissipated);
}

}  // namespace fpz
