// The state of a run and the parts of a step.
#pragma once

#include <algorithm>

#include "bonds.hpp"
#include "fpz/sph/simulation.hpp"
#include "view.hpp"

namespace fpz::sph::detail {

/// A velocity component that a group prescribes.
struct PrescribedComponent {
  std::size_t slot;
  std::size_t component;
  std::size_t group;
};

template <int Dim>
struct Engine {
  static constexpr auto dimensions = static_cast<std::size_t>(Dim);
  static constexpr auto components = static_cast<std::size_t>(tensor_size<Dim>);

  RunSetup<Dim> setup;
  Material<double> material;
  fpz::Options update_options;
  double h = 0.0;   ///< smoothing length, m
  double dt = 0.0;  ///< s

  Particles<Dim> particles;
  Fields<Dim * Dim> rate;                         ///< reference: see View
  Fields<Dim> control;                            ///< reference: force of the control of zero-energy velocities, N
  int control_interval = 1;                       ///< steps from one action of the control to the next
  double control_work = 0.0, control_next = 0.0;  ///< J: so far, and by its force at n until n + 1/2
  Fields<Dim> damping;                            ///< local damping per component, zero where prescribed
  std::vector<unsigned char> flagged;
  Field damping_work, viscous_work, artificial_work;  ///< per block, J
  Field damping_next;                                 ///< per block, J: see View
  Fields<Dim> viscous_force, artificial_force;        ///< updated: of the last step, N
  std::vector<unsigned char> bad;
  std::vector<std::size_t> slot_of;

  NeighbourLists lists;
  Bonds<Dim> bonds;
  Fields<Dim> built_at;  ///< updated: positions when the lists were made
  long long builds = 0;
  long long released = 0;

  std::vector<PrescribedComponent> prescribed;
  std::vector<Vec<double, Dim>> reaction;        ///< per group
  std::vector<Vec<double, Dim>> group_velocity;  ///< at n + 1/2

  long long steps = 0;
  bool started = false;
  double prescribed_work = 0.0;
  double kinetic_start = 0.0;

  const Passes<Dim>* passes = nullptr;
  View<Dim> view;

  /// A run with the given time step, s.
  Engine(const RunSetup<Dim>& s, double time_step);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  [[nodiscard]] bool updated() const { return setup.options.configuration == Configuration::updated; }
  [[nodiscard]] double now() const { return static_cast<double>(steps) * dt; }
  /// Of a prescribed component at n + 1/2, m/s.
  [[nodiscard]] double prescribed_velocity(std::size_t group, std::size_t component) const {
    return setup.groups[group].motion[component]->velocity(now() + 0.5 * dt);
  }

  void place_particles();
  void connect_groups();
  void point_view();

  /// reference: neighbours, weights and corrections of the undeformed body.
  void build_reference_bonds();
  /// Weights and correction of one row from its list.
  void write_row(std::size_t i);
  /// Cuts bonds across open cracks (options.release_integrity).
  void release_bonds();

  /// Everything that follows from the lists, after they were read back.
  void remake_bonds();

  /// updated: lists from the current positions.
  void rebuild_lists();
  [[nodiscard]] bool lists_outdated() const;

  /// Largest angular frequency of the elastic body with its prescribed components held, 1/s. Leaves the state unusable.
  [[nodiscard]] double largest_frequency();

  /// The first half step of the velocity (eq 23).
  void start();
  /// sum m v(n-1/2).v(n+1/2)/2, J.
  [[nodiscard]] double kinetic() const;
  [[nodiscard]] Outcome step();
  /// H of a particle whose crack has the given unit normal (in the turning frame in `reference`), m: band_width() of
  /// its neighbours, those that it still has.
  [[nodiscard]] double band_length(std::size_t i, const Vec<double, Dim>& normal) const;
  /// Library update of the flagged particles of [first, last) blocks. Returns the first failure.
  [[nodiscard]] Outcome update_flagged(Index first, Index last);
  /// Forces at n, velocities to n + 1/2 over `step` (s).
  void kick(double step);
  /// Zero-energy velocities (options.zero_energy_control): acts on the velocities of the full step n, every
  /// control_interval steps with the force of all of them. There it only takes from the leap-frog's energy, so it is
  /// stable while a relative velocity does not change its sign.
  [[nodiscard]] bool control_due() const;
  void control_velocities();
  void account_control(bool acted);
  /// Upper bound of the rate at which the control damps, 1/s, in the undeformed body.
  [[nodiscard]] double control_rate() const;
  [[nodiscard]] double control_viscosity() const;
  /// Puts prescribed velocities in place of what the forces made of them; reactions and their work.
  void prescribe(double step);
  [[nodiscard]] Outcome find_bad() const;

  /// Runs f(first, last) over all blocks in chunks, on the team; the split never changes results.
  template <class F>
  void for_chunks(F&& f);
};

/// Number of threads asked for.
[[nodiscard]] int team_size(int requested);

inline constexpr Index chunk_blocks = 16;

/// First particle of a block.
[[nodiscard]] inline std::size_t lanes_begin(Index block) { return static_cast<std::size_t>(block) * lanes; }

template <int Dim>
template <class F>
void Engine<Dim>::for_chunks(F&& f) {
  const auto blocks = static_cast<Index>(particles.blocks());
  const Index chunks = (blocks + chunk_blocks - 1) / chunk_blocks;
  const int team = team_size(setup.options.threads);
#pragma omp parallel for schedule(dynamic, 1) num_threads(team) if (team > 1 && chunks > 1)
  for (Index c = 0; c < chunks; ++c) f(c * chunk_blocks, std::min((c + 1) * chunk_blocks, blocks));
}

}  // namespace fpz::sph::detail
