// Damps the velocities that the gradient of the undeformed body does not see (they alternate from particle to
// particle).
#pragma once

#include "bonds.hpp"
#include "boundary.hpp"

namespace fpz::sph::detail {

/// Acts on the velocities of the full step n, every `interval_` steps with the force of all of them. There it only
/// takes from the leap-frog's energy, so it is stable while a relative velocity does not change its sign.
template <int Dim>
class ZeroEnergyControl {
 public:
  /// `viscosity` in Pa s, > 0.
  ZeroEnergyControl(RunData<Dim>& run, const NeighbourLists& lists, double viscosity);

  /// Upper bound of the rate at which it damps when it acts in every step, 1/s, in the undeformed body.
  [[nodiscard]] double rate() const { return rate_; }
  [[nodiscard]] bool due() const { return run_.started && run_.steps % interval_ == 0; }
  /// Adds its force at n to accelerations and to the velocities at n + 1/2.
  void act(const Boundaries<Dim>& boundaries);
  /// Its work, when the boundaries have acted on the velocities too.
  void account(bool acted);

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    using V = View<Dim>;
    visit(FieldInfo{"zero_energy_rate", Extent::particle, Keep::passing}, self.gradient_, &V::zero_energy_rate);
    visit(FieldInfo{"zero_energy_force", Extent::particle, Keep::passing}, self.force_, &V::zero_energy_force);
  }
  void save(Writer& archive) const { archive(next_); }
  void load(Reader& archive) {
    archive(next_);
    fields(*this, Spoil{run_.particles.count});
  }

 private:
  [[nodiscard]] double rate_of(const NeighbourLists& lists, double viscosity) const;

  RunData<Dim>& run_;
  Fields<Dim * Dim> gradient_;  ///< of the velocities at n, 1/s
  Fields<Dim> force_;           ///< N
  double rate_ = 0.0;
  int interval_ = 1;   ///< steps from one action to the next
  double next_ = 0.0;  ///< J, what its force at n will have taken by n + 1/2
};

}  // namespace fpz::sph::detail
