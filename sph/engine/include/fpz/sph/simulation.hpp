// A run of the particle method: construct, step, look. Sections 2 and 5 of the paper.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fpz/parameters.hpp"
#include "fpz/sph/arrangement.hpp"
#include "fpz/sph/energy.hpp"
#include "fpz/sph/group.hpp"
#include "fpz/sph/materials.hpp"
#include "fpz/sph/options.hpp"
#include "fpz/sph/outcome.hpp"
#include "fpz/sph/particles.hpp"

namespace fpz::sph {

namespace detail {
template <int Dim>
struct Engine;
}

/// Everything that defines a run.
template <int Dim>
struct RunSetup {
  Arrangement<Dim> arrangement;
  std::vector<Group<Dim>> groups;
  std::vector<Load<Dim>> loads;
  Parameters parameters;  ///< rve_length is ignored: options.rve_length decides
  Materials materials;    ///< others than these parameters, where the body is not of one material
  WeakPlanes<Dim> weak_planes;
  Setting setting = Setting::plane_strain;
  Options<Dim> options;
  double most_damping = 0.0;  ///< largest part that set_damping() will be given; the time step is stable with it
  std::vector<Vec<double, Dim>> velocity;  ///< at the start, per particle, m/s; empty: at rest
  /// Even stress at the start, Pa, tension positive; positions are those of the stressed body.
  Tensor<double, Dim> initial_stress = Tensor<double, Dim>::Zero();
};

/// What is wrong with a set-up, one message per problem with the field's name; empty when it can run.
template <int Dim>
[[nodiscard]] std::vector<std::string> problems(const RunSetup<Dim>& setup);

/// The parameters of material k: 0 is RunSetup::parameters.
template <int Dim>
[[nodiscard]] const Parameters& parameters_of(const RunSetup<Dim>& setup, std::size_t material) {
  return material == 0 ? setup.parameters : setup.materials.further[material - 1];
}

/// The parameters of a particle of the arrangement, with its own strength.
template <int Dim>
[[nodiscard]] Parameters parameters_of_particle(const RunSetup<Dim>& setup, std::size_t id) {
  Parameters p = parameters_of(setup, setup.materials.of(id));
  p.tensile_strength *= setup.materials.strength(id);
  p.cohesion *= setup.materials.strength(id);
  return p;
}

/// The time step of eq 32, s: courant * h/sqrt(E/rho), times sqrt(mass_scale); of the fastest material.
template <int Dim>
[[nodiscard]] double courant_step(const RunSetup<Dim>& setup);

/// The longest stable time step of the elastic body of this arrangement, s: 2/omega with the largest frequency omega
/// found by power iteration (some hundred times the work of a step). Viscosity and local damping shorten it further.
template <int Dim>
[[nodiscard]] double stability_limit(const RunSetup<Dim>& setup);

/// Part of the measured limit that a run uses at most.
inline constexpr double stability_margin = 0.9;

/// The time step of a run, s: eq 32, or stability_margin * stability_limit() where that is shorter. Local damping of a
/// part a makes a force that opposes the velocity 1 + a times as large: the limit is that of a body as much stiffer.
template <int Dim>
[[nodiscard]] double time_step(const RunSetup<Dim>& setup);

/// One run. Particles interact with all others of the arrangement, boundary groups included. The result does not depend
/// on the number of threads or on the instruction set.
template <int Dim>
class Simulation {
 public:
  /// Throws std::invalid_argument with all problems().
  explicit Simulation(const RunSetup<Dim>& setup);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Advances by one time step. After a failure the state is the broken one, for inspection.
  [[nodiscard]] Outcome step();

  [[nodiscard]] double time() const;       ///< of the body, s
  [[nodiscard]] double time_step() const;  ///< s
  [[nodiscard]] long long steps() const;
  /// What the clock of drives and loads shows, s; time() at pace 1.
  [[nodiscard]] double loading_time() const;
  [[nodiscard]] double pace() const;
  /// Steps that it would have taken to the present loading_time() at pace 1; steps() at that pace.
  [[nodiscard]] long long loading_steps() const;
  /// The particles: what is referred to follows the run from now on. Steps are slower after the first call, because
  /// they store strains, stresses and rotations that nothing else needs.
  [[nodiscard]] const Particles<Dim>& particles() const;
  /// The same until the next step, at no cost to it. After that strains, stresses and rotations of elastic particles
  /// may be old: call again.
  [[nodiscard]] const Particles<Dim>& particles_now() const;
  /// The same without any strain, stress and rotation of elastic particles, which may be old: for who looks at motions
  /// and cracks often.
  [[nodiscard]] const Particles<Dim>& motions_now() const;
  [[nodiscard]] std::size_t count() const;  ///< of particles
  /// Slot of a particle of the arrangement in the arrays of particles().
  [[nodiscard]] std::size_t slot(std::size_t id) const;
  /// Force that keeps a group on its motion, N (per metre of thickness in 2-D), from the momentum balance of its
  /// particles at the last full step; zero in free components.
  [[nodiscard]] Vec<double, Dim> reaction(std::size_t group) const;
  /// Velocity that a group has by its drives, m/s in the time of the body, half a step ahead; zero in free components.
  [[nodiscard]] Vec<double, Dim> velocity(std::size_t group) const;
  /// Of a load, at the last full step.
  [[nodiscard]] double factor(std::size_t load) const;

  /// How fast the clock of drives and loads runs from now on, in seconds per second of the body. All tables (Drive,
  /// Load) and their velocities follow it; what is steered does not. Throws std::invalid_argument below 0.
  void set_pace(double pace);
  /// Changes what drives a component of a group from now on; its force goes on without a jump where the machine has a
  /// stiffness. Throws std::invalid_argument for components that are free, and for tables with problems.
  void set_drive(std::size_t group, std::size_t component, const Drive& drive);
  /// The velocity of a steered component from now on, m/s.
  void steer(std::size_t group, std::size_t component, double velocity);
  /// Changes the factor of a load from now on.
  void set_factor(std::size_t load, const TimeTable& factor);
  /// Changes Options::damping from now on. Throws std::invalid_argument above that and RunSetup::most_damping, for
  /// which the time step was found.
  void set_damping(double part);
  /// Sums over all particles, in a fixed order.
  [[nodiscard]] Energies energies() const;
  [[nodiscard]] std::size_t cracked() const;
  /// Whether the particle in a slot has cracked on its weak plane.
  [[nodiscard]] bool cracked_on_weak_plane(std::size_t slot) const;
  /// Largest relative displacement of uncracked neighbours that gradients do not see, m: rows that alternate. NaN
  /// without zero-energy control.
  [[nodiscard]] double alternation() const;
  /// Largest overlap of faces that have met (notches, released cracks), m. NaN where nothing keeps faces apart
  /// (`updated`, or contact_stiffness 0).
  [[nodiscard]] double overlap() const;
  /// Uncracked particles that would have cracked in 3-D, on planes inclined out of the plane of the setting
  /// (out_of_plane.hpp); those that never crack do not count.
  [[nodiscard]] std::size_t failing_out_of_plane() const;
  [[nodiscard]] long long released_bonds() const;
  [[nodiscard]] long long neighbour_builds() const;
  /// Real neighbours per particle, on average.
  [[nodiscard]] double mean_neighbours() const;

  /// The complete state as bytes; restore() continues bit for bit. Throws std::runtime_error when the bytes are damaged
  /// or belong to another set-up.
  [[nodiscard]] std::vector<unsigned char> snapshot() const;
  void restore(std::span<const unsigned char> bytes);

 private:
  std::unique_ptr<detail::Engine<Dim>> engine_;
};

extern template class Simulation<2>;

}  // namespace fpz::sph
