// What all parts of a run share: set-up, constants, clock, particles, ledger, and how work is dealt out to threads.
#pragma once

#include "bonds.hpp"
#include "fpz/options.hpp"
#include "fpz/sph/simulation.hpp"
#include "loading_clock.hpp"
#include "particle_materials.hpp"
#include "plane.hpp"
#include "team.hpp"
#include "work_ledger.hpp"

namespace fpz::sph::detail {

/// First particle of a block.
[[nodiscard]] inline std::size_t lanes_begin(Index block) { return static_cast<std::size_t>(block) * lanes; }

/// What makes velocities at n + 1/2 of the forces at n.
struct Kick {
  double step = 0.0;                           ///< s; half at the start
  double work_before = 0.0, work_after = 0.0;  ///< s, of View
  bool pushed = false;                         ///< there is an outer force
};

template <int Dim>
struct RunData {
  static_assert(Dim == 2, "the engine is for the plane: plane.hpp, the loops of passes.inl and what calls them");
  static constexpr auto dimensions = static_cast<std::size_t>(Dim);
  static constexpr auto components = static_cast<std::size_t>(tensor_size<Dim>);

  RunSetup<Dim> setup;
  ParticleMaterials<Dim> materials;
  fpz::Options update_options;
  double h = 0.0;   ///< smoothing length, m
  double dt = 0.0;  ///< s

  /// Blocks in a piece of a thread's work. Large pieces where there are many: the loops go along all fields at once,
  /// and the processor fetches ahead only in long pieces.
  Index chunk_blocks = 16;
  /// Steps go over the blocks once where they can (sweep.hpp). Only where the body is larger than caches: elsewhere it
  /// gains nothing.
  bool in_one_sweep = false;

  long long steps = 0;
  bool started = false;  ///< the velocities are half a step ahead
  LoadingClock clock;    ///< of drives and loads
  bool watched = false;  ///< someone may look at all fields at any time: every step stores them
  bool hidden = false;   ///< reference: rotation, strain and stress of elastic particles are not those of n

  Particles<Dim> particles;
  std::vector<std::size_t> slot_of;
  std::vector<int> piece;  ///< per particle: 0 of the body and what is bonded to it; its group + 1 where that is loose
  std::vector<int> group;  ///< per particle, -1 of the body
  std::vector<std::size_t> cracked;  ///< particles that are, ascending; see find_cracked()
  Fields<Dim> damping;               ///< 1 where local damping acts, 0 where the component is driven
  Fields<Dim> outer_force;           ///< of boundaries that push and of closed faces at n, N
  Mask flagged;                      ///< of the last pass: the library must update the particle
  Mask bad;                          ///< of the last pass, per block: a velocity is out of bounds
  WorkLedger<Dim> ledger;

  mutable Team team;
  const Passes<Dim>* passes = nullptr;
  View<Dim> view;

  RunData(const RunSetup<Dim>& s, double time_step);
  RunData(const RunData&) = delete;
  RunData& operator=(const RunData&) = delete;

  /// s; before the first step.
  void set_time_step(double step) { dt = view.step = step; }
  /// Options::damping from now on. The work of the last step's damping is still counted when it ends.
  void set_damping(double part) {
    view.damping_part = part;
    view.damped = view.damped || part > 0.0;
  }
  /// Drops the pairs that never have bonds: of different pieces, and of a group that keeps to itself and another one.
  void keep_apart(NeighbourLists& lists) const;
  [[nodiscard]] double now() const { return static_cast<double>(steps) * dt; }
  /// What the clock of drives and loads shows, s.
  [[nodiscard]] double loading_time() const { return clock.at(steps, dt); }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    using V = View<Dim>;
    visit_fields(self.particles, visit);
    visit(FieldInfo{"damping", Extent::particle, Keep::constant}, self.damping, &V::damping);
    visit(FieldInfo{"outer_force", Extent::particle, Keep::passing}, self.outer_force, &V::outer_force);
    visit(FieldInfo{"flagged", Extent::particle, Keep::passing}, self.flagged, &V::flagged);
    visit(FieldInfo{"bad", Extent::block, Keep::passing}, self.bad, &V::bad);
    WorkLedger<Dim>::fields(self.ledger, visit);
  }

  /// Reference: rotation and strain of particle i at n, stored or not.
  [[nodiscard]] Stretch stretch(std::size_t i) const {
    const auto& g = particles.gradient;
    return polar(g[0][i], g[1][i], g[2][i], g[3][i]);
  }
  /// Reference: stress of particle i at n, Pa, in the frame that turns with it; stored or not.
  [[nodiscard]] Symmetric stress_at(std::size_t i) const {
    const auto& s = particles.stress;
    if (!hidden || flagged[i] != 0) return {s[0][i], s[1][i], s[2][i]};
    const Elasticity<double>& bulk = materials.bulk(i);
    return elastic_stress(bulk.lambda, bulk.mu, stretch(i).strain);
  }

  [[nodiscard]] View<Dim> view_of(const Kick& kick) const {
    View<Dim> v = view;
    v.step = kick.step;
    v.work_before = kick.work_before;
    v.work_after = kick.work_after;
    v.pushed = kick.pushed;
    return v;
  }
  void clear_pushes() {
    for (Field& f : outer_force) std::fill(f.begin(), f.end(), 0.0);
  }

  /// Makes the list `cracked` anew; whenever some have cracked.
  void find_cracked();

  /// Runs f(first, last) over all blocks in chunks, on the team; the split never changes results. Defined in
  /// chunks.hpp.
  template <class F>
  void for_chunks(F&& f) const;
  /// Runs f(i) over the cracked particles on the team.
  template <class F>
  void for_cracked(F&& f) const;

 private:
  void place_particles();
  void choose_order();
  void set_initial_stress();
  void set_constants();
};

}  // namespace fpz::sph::detail
