// How the deformation of the body is followed: which bonds its particles have, and what strain and force are. Two
// rooms, reference_body and updated_body, chosen in make_body().
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bonds.hpp"
#include "chunks.hpp"
#include "plane.hpp"
#include "run_data.hpp"
#include "sweep.hpp"

namespace fpz::sph::detail {

template <int Dim>
class Body {
 public:
  Body(RunData<Dim>& run, typename Passes<Dim>::Pass force_pass) : run_(run), force_pass_(force_pass) {}
  virtual ~Body() = default;
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  /// What the first forces need.
  virtual void start() {}
  /// Positions from n to n + 1, strains, stresses and cracks with them. The first failure of a particle. In a step in
  /// one sweep the velocities of most particles go on to n + 3/2 at once, as by force().
  [[nodiscard]] virtual Outcome advance(const Kick& kick) = 0;
  /// Forces at n, velocities to n + 1/2, of the blocks that have not gone there; `view` has the step of this kick.
  void force(const View<Dim>& view);
  /// Whether advance() may change the rows of bonds in this step, and with them forces anywhere.
  [[nodiscard]] virtual bool changes_rows() const { return false; }
  /// What the order of the blocks follows in steps in one sweep; when all bonds have been made.
  void plan_sweep() {
    if (run_.in_one_sweep) sweep_.plan(run_.view, run_.particles.blocks(), run_.chunk_blocks);
  }
  [[nodiscard]] Sweep<Dim>& sweep() { return sweep_; }
  /// Stores strains, stresses and rotations of n where the last step has not.
  virtual void show() {}
  /// Forces of this step besides those that force() sums: whether there are any; adds them to outer_force.
  [[nodiscard]] virtual bool pushes() const { return false; }
  virtual void push() {}

  /// What cannot be found from the particles, for snapshots; load() makes what follows from it, after the particles.
  virtual void save(Writer& archive) const = 0;
  virtual void load(Reader& archive) = 0;

  /// The bonds that were cut since the last call.
  [[nodiscard]] std::vector<ReleasedBond<Dim>> take_released() { return std::exchange(fresh_, {}); }

  /// Whether cracks have left a particle so few bonds that hardly anything holds it.
  [[nodiscard]] virtual bool is_loose(std::size_t) const { return false; }

  [[nodiscard]] const NeighbourLists& lists() const { return lists_; }
  [[nodiscard]] long long builds() const { return builds_; }      ///< of the neighbour lists
  [[nodiscard]] long long released() const { return released_; }  ///< bonds cut by cracks

 protected:
  /// Positions at which the bonds are measured.
  [[nodiscard]] virtual const Fields<Dim>& bond_positions() const = 0;
  /// Strain increment of a particle whose state at n is `begin`, in the frame of that state.
  [[nodiscard]] virtual Tensor<double, Dim> strain_increment(std::size_t i, const State<double, Dim>& begin) const = 0;
  /// Turns an updated state into the frame of n + 1.
  virtual void turn(std::size_t i, State<double, Dim>& point) const = 0;
  /// Stores what the force sums for a particle with this stress.
  virtual void set_flux(std::size_t i, const Symmetric& stress) = 0;

  /// Lets a cracked particle be as if it had not: its state becomes `state` (stress kept, strain that of an intact
  /// one). False where that cannot be.
  virtual bool forget_crack(std::size_t, const State<double, Dim>&) { return false; }
  /// Gives a particle that snaps back a shorter H, if it can.
  virtual bool shorten_band(std::size_t) { return false; }

  /// Whether forces around a cracked particle may change after its update.
  [[nodiscard]] virtual bool moves_on(std::size_t) const { return false; }

  /// Runs loops(first, last) and then the library on what they flagged, chunk by chunk; the first failure in the order
  /// of the particles. In a step in one sweep also the forces that nothing will change.
  template <class F>
  [[nodiscard]] Outcome strain_with(const Kick& kick, F&& loops);
  void point_bonds();

  template <class Archive, class Self>
  static void transfer_lists(Archive& archive, Self& self) {
    archive(self.lists_);
    archive(self.builds_);
    archive(self.released_);
  }

  /// What a particle begins the step with: intact, or with the crack that takes another plane
  /// (Options::reorientation_damage) open on it.
  [[nodiscard]] State<double, Dim> state_at_begin(std::size_t i, Material<double>& m);
  /// Whether a young crack leaves another plane to fail.
  [[nodiscard]] bool wants_another_plane(std::size_t i, const Material<double>& m) const;

  RunData<Dim>& run_;
  NeighbourLists lists_;
  Bonds<Dim> bonds_;
  long long builds_ = 0;
  long long released_ = 0;
  std::vector<ReleasedBond<Dim>> fresh_;

 private:
  struct Report {
    Outcome outcome;           ///< the first failure
    bool has_cracked = false;  ///< a particle that had not
  };

  /// Library update of the flagged particles of [first, last) blocks.
  [[nodiscard]] Report update_flagged(Index first, Index last);
  [[nodiscard]] Outcome update_particle(std::size_t i);
  [[nodiscard]] fpz::Report update_crack(std::size_t i, const Material<double>& m);
  /// Of a particle that is intact, or whose crack takes another plane.
  [[nodiscard]] fpz::Report update_onset(std::size_t i, Material<double>& m);
  void finish(std::size_t i, const Material<double>& m, double dissipated);
  /// Stores the stress at n + 1 (of the frame of n + 1) and what the force sums.
  void set_stress(std::size_t i, const Tensor<double, Dim>& stress);
  /// H of a particle that has just cracked on a plane with this normal: by the band rule, where that is asked for.
  void set_band_length(std::size_t i, const Vec<double, Dim>& normal);
  /// H of a particle whose crack has the given unit normal, m: band_width() of its neighbours, those that it still has.
  [[nodiscard]] double band_length(std::size_t i, const Vec<double, Dim>& normal) const;

  typename Passes<Dim>::Pass force_pass_;
  Sweep<Dim> sweep_;
  std::vector<Report> reports_;  ///< of the chunks
};

/// The body of the options' configuration.
template <int Dim>
[[nodiscard]] std::unique_ptr<Body<Dim>> make_body(RunData<Dim>& run);

template <int Dim>
template <class F>
Outcome Body<Dim>::strain_with(const Kick& kick, F&& loops) {
  const View<Dim> view = run_.view_of(kick);
  reports_.resize(run_.particles.blocks() / static_cast<std::size_t>(run_.chunk_blocks) + 1);
  run_.for_chunks([&](Index first, Index last) {
    loops(first, last);
    reports_[static_cast<std::size_t>(first / run_.chunk_blocks)] = update_flagged(first, last);
    if (!sweep_.in_one()) return;
    sweep_.strained(first / run_.chunk_blocks, [&](Index from, Index to) { force_pass_(view, from, to); });
  });
  bool more = false;
  for (const Report& r : reports_) {
    if (!r.outcome.ok()) return r.outcome;
    more = more || r.has_cracked;
  }
  if (more) run_.find_cracked();
  return {};
}

}  // namespace fpz::sph::detail
