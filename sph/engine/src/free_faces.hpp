// Where the body ends now: its outer surface, its notches and the faces of its cracks; and which of these ends have
// come near each other though they did not face each other before.
#pragma once

#include <vector>

#include "contact_point.hpp"

namespace fpz::sph::detail {

/// A place on the surface in front of a particle that has nothing before it.
template <int Dim>
struct FreeFace {
  std::size_t particle;
  Vec<double, Dim> at;      ///< m, in the undeformed body
  Vec<double, Dim> normal;  ///< unit, outward, there
  bool is_edge;             ///< nothing is beside the particle: others do not meet it, it meets others
  FaceSide side;            ///< `slope` is along the normal's left
};

/// The faces are found from the bonds that are left, so that those of outlines, holes, notches and cracks are one. They
/// lie on the lines of the surface and the cuts where the arrangement describes them, else half the size of the
/// particle before it. Only `reference` has them.
template <int Dim>
class FreeFaces {
 public:
  /// `lists` are those of the body; they must live as long as this.
  FreeFaces(const RunData<Dim>& run, const NeighbourLists& lists);

  /// After bonds have been cut.
  void refit(const std::vector<ReleasedBond<Dim>>& released);
  /// Whether a face has moved so far since the last search, or changed, that others than then may touch;
  /// or a part of that.
  [[nodiscard]] bool search_is_due(double part = 1.0) const;
  /// Points between faces that are opposite each other and nearer than half a spacing, one for each face that has such
  /// a partner: each pair of surfaces has them from both sides, with half of the area each. Without those that were
  /// neighbours in the undeformed body and those that `facing` joins already.
  [[nodiscard]] std::vector<ContactPoint<Dim>> search(const std::vector<ContactPoint<Dim>>& facing);

  void save(Writer& archive) const;
  /// After the lists of the body.
  void load(Reader& archive);

 private:
  using Vector = Vec<double, Dim>;
  struct Line {
    Vector from, to;
  };
  /// A face as it lies now.
  struct Present {
    Vector at, normal;
  };

  void describe_surface();
  void find_all();
  [[nodiscard]] std::optional<FreeFace<Dim>> face_of(std::size_t particle) const;
  [[nodiscard]] FaceSide side_at(std::size_t particle, const Vector& at, const Vector& normal) const;
  void put_on_surface(FreeFace<Dim>& face) const;
  [[nodiscard]] Present present(const FreeFace<Dim>& face) const;
  [[nodiscard]] ContactPoint<Dim> joined(const FreeFace<Dim>& face, const FreeFace<Dim>& other, double along) const;

  const RunData<Dim>& run_;
  const NeighbourLists& lists_;
  std::vector<Line> lines_;
  std::vector<FreeFace<Dim>> faces_;  ///< in ascending order of their particles
  std::vector<Vector> searched_at_;   ///< displacements of their particles at the last search, m
  bool changed_ = true;
};

}  // namespace fpz::sph::detail
