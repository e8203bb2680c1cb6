// Contact of faces that have met: they press on each other, never pull, and slide with friction.
#pragma once

#include <array>
#include <vector>

#include "boundary.hpp"
#include "contact_point.hpp"
#include "free_faces.hpp"

namespace fpz::sph::detail {

/// The forces at n are those that the law gives at the gaps of n + 1 which they leave: implicit in the contact alone,
/// which may be as stiff as one likes at any time step, and changes nothing while faces are open. They are found point
/// by point, again and again (projected Gauss-Seidel), from those of the step before. One thread: bits do not depend on
/// the team.
template <int Dim>
class Contact {
 public:
  /// `lists` are those of the body; they must live as long as this.
  Contact(RunData<Dim>& run, const Boundaries<Dim>& boundaries, const NeighbourLists& lists);

  /// The faces of cracks, from bonds that have just been cut. Those that were pressed together touch.
  void add(const std::vector<ReleasedBond<Dim>>& released);

  /// Whether prepare() may give points other particles in this step.
  [[nodiscard]] bool changes() const { return changes_; }
  /// Whether faces have pressed on each other in the step before.
  [[nodiscard]] bool presses() const;
  /// Calls visit(slot) for the particles of all faces: those that push() pushes, and whose velocities book() and
  /// prepare() read.
  template <class Visit>
  void for_particles(Visit&& visit) const {
    for (const Member& m : members_) visit(m.slot);
  }

  /// Books the first half of the work of the last forces, after the positions have been moved.
  void book();
  /// Gaps at n.
  void prepare();
  /// Adds the forces of the step before to RunData::outer_force.
  void push();
  /// The rest of the forces at n, on velocities that the kick over `step` (s) has made; books their work.
  void act(double step);

  /// J, held in closed faces at n.
  [[nodiscard]] double stored() const;
  /// J, taken so far: what is stored, and what friction and impacts have dissipated.
  [[nodiscard]] double taken() const { return taken_; }
  /// Largest overlap of two faces at n, m.
  [[nodiscard]] double overlap() const;

  void save(Writer& archive) const;
  void load(Reader& archive);

 private:
  using Vector = Vec<double, Dim>;

  /// A particle of a face: its velocity with the forces found so far, and what a newton second adds to it.
  struct Member {
    std::size_t slot;
    Vector velocity;
    Vector inverse_mass;  ///< 1/kg, zero of components that are prescribed
  };
  /// What the displacement of a member does to the places of a point, positive on side 1.
  struct Share {
    std::size_t member;
    double weight;
    double slope;                                 ///< 1/m: what it turns the face by
    Vector press = Vector::Zero(), drag = press;  ///< derivatives of gap and shift: its part of pressure and shear
  };
  /// A point as the particles lie at n.
  struct Place {
    std::vector<Share> shares;
    double gap = 0.0, shift = 0.0;               ///< m
    double normal_give = 0.0, shear_give = 0.0;  ///< m/N: what a newton adds to gap and shift at n + 1
    double pressure = 0.0, shear = 0.0;          ///< N, of the step before
    double closing = 0.0, sliding = 0.0;         ///< m, of the last step: by what gap and shift have grown
  };

  void find_prescribed(const Boundaries<Dim>& boundaries);
  void find_members();
  static void add_shares(const ContactPoint<Dim>& point, const std::vector<std::size_t>& slots, Place& place);
  [[nodiscard]] bool has_slid(std::size_t k, double part = 1.0) const;
  [[nodiscard]] bool may_change() const;
  void refit(const std::vector<ReleasedBond<Dim>>& released);
  /// Gives points that have slid the partners that are opposite now, and drops those where nothing is; says whether
  /// there were any.
  bool follow_slip();
  /// Finds the faces that are opposite each other now, of those that did not face each other before; says whether there
  /// are or were any.
  bool meet();
  void begin(std::size_t k, bool touches);
  void follow(ContactPoint<Dim>& point, Place& place) const;
  /// Points whose particles have changed go on at the gap and the shift that they had.
  void go_on(const std::vector<std::size_t>& changed, const std::vector<Place>& before);
  /// By how much gap and shift have grown in the last step.
  void find_motion(Place& place) const;
  /// J, that the forces of a point take over half of the last step.
  [[nodiscard]] static double half_work(const ContactPoint<Dim>& point, const Place& place) {
    return -0.5 * (point.pressure * place.closing + point.shear * place.sliding);
  }
  /// Gap and shift of a point whose shares are known, and their derivatives.
  void look(const ContactPoint<Dim>& point, Place& place) const;
  void look_at_all();
  void predict(double step);
  void find_gives(Place& place, double step) const;
  /// Pressure and shear of one point with what the others have done so far; the size of the change, N.
  [[nodiscard]] double correct(ContactPoint<Dim>& point, const Place& place, double step);
  void apply(ContactPoint<Dim>& point, const Place& place, double step);

  RunData<Dim>& run_;
  const NeighbourLists& lists_;
  FreeFaces<Dim> faces_;
  Mask prescribed_;  ///< per particle, a bit for each component
  std::vector<ContactPoint<Dim>> points_;
  std::vector<Place> places_;
  std::vector<Member> members_;
  double taken_ = 0.0;  ///< J
  bool changes_ = true;
};

}  // namespace fpz::sph::detail
