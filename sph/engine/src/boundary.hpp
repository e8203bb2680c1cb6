// A condition on the motion of some particles: one room per kind, and one line in make_boundaries() where it is chosen.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "run_data.hpp"

namespace fpz::sph::detail {

/// Acts in two ways. push() adds forces to those of the body before the velocities are made; act() changes the
/// velocities at n + 1/2 that all forces at n have made: a prescribed velocity takes the place of what is there, and
/// the acceleration becomes what that took. Boundaries act in the order of the set-up: groups, then loads.
template <int Dim>
class Boundary {
 public:
  explicit Boundary(RunData<Dim>& run) : run_(run) {}
  virtual ~Boundary() = default;
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;

  /// Adds its forces at n to RunData::outer_force, N, in positions that are at n; their work goes to the ledger.
  virtual void push() {}
  /// Calls visit(slot) for the particles that push() pushes.
  virtual void for_pushed(const std::function<void(std::size_t)>& /*visit*/) const {}
  /// Velocities to n + 1/2 over `step` (s; half a time step at the start); its work goes to the ledger.
  virtual void act(double /*step*/) {}
  /// Its homogeneous form, for the frequencies of the body: zero velocity where it is prescribed.
  virtual void hold() {}
  /// Marks the components of particles whose velocity it makes, a bit for each, whether prescribed or by its own mass.
  virtual void mark_driven(Mask& /*components*/) const {}
  /// Force that it exerts at n, N (per metre of thickness in 2-D).
  [[nodiscard]] virtual Vec<double, Dim> reaction() const = 0;
  /// Velocity at n + 1/2 of what it drives, m/s; zero in free components.
  [[nodiscard]] virtual Vec<double, Dim> velocity() const { return Vec<double, Dim>::Zero(); }
  /// Present factor of a load.
  [[nodiscard]] virtual double factor() const { return 1.0; }
  /// Longest time step that is stable for it, s.
  [[nodiscard]] virtual double stable_step() const { return std::numeric_limits<double>::infinity(); }
  /// Changes what drives a component, from n on. Throws std::invalid_argument when it was free.
  virtual void set_drive(std::size_t component, const Drive& drive);
  /// The velocity of a component that is steered, m/s, from n on.
  virtual void steer(std::size_t component, double velocity);
  /// Changes the factor of a load, from n on.
  virtual void set_factor(const TimeTable& factor);
  /// Its state, for snapshots.
  virtual void save(Writer& archive) const = 0;
  virtual void load(Reader& archive) = 0;

 protected:
  /// Gives a component of a particle the velocity (m/s) that it has at n + 1/2; the force which that takes over `step`
  /// (s) on top of what acts, N.
  double impose(std::size_t slot, std::size_t component, double velocity, double step) {
    Particles<Dim>& p = run_.particles;
    const double lacking = (velocity - p.velocity[component][slot]) / step;
    p.acceleration[component][slot] += lacking;
    p.velocity[component][slot] = velocity;
    return p.mass[slot] * lacking;
  }

  RunData<Dim>& run_;
};

/// Slots of the particles of a group.
template <int Dim>
[[nodiscard]] std::vector<std::size_t> slots_of_group(const RunData<Dim>& run, std::size_t group);

template <int Dim>
using Boundaries = std::vector<std::unique_ptr<Boundary<Dim>>>;

/// One boundary for each group of the set-up, then one for each load.
template <int Dim>
[[nodiscard]] Boundaries<Dim> make_boundaries(RunData<Dim>& run);

}  // namespace fpz::sph::detail
