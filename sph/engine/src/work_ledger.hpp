// Work done on and in the body, as the leap-frog counts it: half of a force's work with the velocity before it, half
// with the one after it, the latter when that motion has happened.
#pragma once

#include "fields.hpp"

namespace fpz::sph::detail {

template <int Dim>
struct WorkLedger {
  double external = 0.0;                        ///< J, of the boundaries
  double zero_energy = 0.0;                     ///< J, that the zero-energy control held in bonds that ended
  double kinetic_start = 0.0;                   ///< J
  double elastic_start = 0.0;                   ///< J
  Field damping, viscous, artificial;           ///< J, taken so far, per block
  Field damping_next;                           ///< J, what the damping force at n will have taken by n + 1/2
  Fields<Dim> viscous_force, artificial_force;  ///< updated: of the last step, N

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    using V = View<Dim>;
    constexpr Keep saved = Keep::saved;
    visit(FieldInfo{"damping_work", Extent::block, saved}, self.damping, &V::damping_work);
    visit(FieldInfo{"damping_next", Extent::block, saved}, self.damping_next, &V::damping_next);
    visit(FieldInfo{"viscous_work", Extent::block, saved}, self.viscous, &V::viscous_work);
    visit(FieldInfo{"artificial_work", Extent::block, saved}, self.artificial, &V::artificial_work);
    visit(FieldInfo{"viscous_force", Extent::particle, saved}, self.viscous_force, &V::viscous_force);
    visit(FieldInfo{"artificial_force", Extent::particle, saved}, self.artificial_force, &V::artificial_force);
  }

  template <class Archive, class Self>
  static void transfer_sums(Archive& archive, Self& self) {
    archive(self.external);
    archive(self.zero_energy);
    archive(self.kinetic_start);
    archive(self.elastic_start);
  }
};

}  // namespace fpz::sph::detail
