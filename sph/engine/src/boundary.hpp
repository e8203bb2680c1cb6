// A condition on the motion of some particles: one room per kind, and one line in make_boundaries() where it is chosen.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "run_data.hpp"

namespace fpz::sph::detail {

/// Acts on the velocities at n + 1/2 that the forces at n have made. A force F (N) adds F/m to the acceleration of a
/// particle and step F/m to its velocity; a prescribed velocity takes the place of what is there, and the acceleration
/// becomes what that took. Boundaries act in the order of the set-up's groups.
template <int Dim>
class Boundary {
 public:
  explicit Boundary(RunData<Dim>& run) : run_(run) {}
  virtual ~Boundary() = default;
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;

  /// Velocities to n + 1/2 over `step` (s; half a time step at the start); its work goes to the ledger.
  virtual void act(double step) = 0;
  /// Its homogeneous form, for the frequencies of the body: zero velocity where it is prescribed.
  virtual void hold() {}
  /// Force that it exerts at n, N (per metre of thickness in 2-D).
  [[nodiscard]] virtual Vec<double, Dim> reaction() const = 0;
  /// Longest time step that is stable for it, s.
  [[nodiscard]] virtual double stable_step() const { return std::numeric_limits<double>::infinity(); }
  /// Its state, for snapshots.
  virtual void save(Writer& archive) const = 0;
  virtual void load(Reader& archive) = 0;

 protected:
  RunData<Dim>& run_;
};

template <int Dim>
using Boundaries = std::vector<std::unique_ptr<Boundary<Dim>>>;

/// One boundary for each group of the set-up.
template <int Dim>
[[nodiscard]] Boundaries<Dim> make_boundaries(RunData<Dim>& run);

}  // namespace fpz::sph::detail
