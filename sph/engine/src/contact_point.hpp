// Two places on two faces that were opposite each other.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <type_traits>
#include <vector>

#include "bonds.hpp"
#include "contact_law.hpp"
#include "run_data.hpp"

namespace fpz::sph::detail {

/// What a place on a face moves with: the mean of these particles.
struct FaceSide {
  std::vector<std::size_t> particle;  ///< slots
  std::vector<double> weight;         ///< they sum to one
  std::vector<double> slope;          ///< 1/m, of the weight along the face
};

template <int Dim>
struct ContactPoint {
  std::array<FaceSide, 2> side;
  Vec<double, Dim> normal;                               ///< unit, from side 0 to side 1, in the undeformed body
  Vec<double, Dim> at_start = Vec<double, Dim>::Zero();  ///< m, from place 0 to place 1, there
  double room = 0.0;      ///< m: the gap is the distance of the places along the normal plus this
  bool of_crack = false;  ///< its first particles are the ends of a bond that was cut
  bool of_face = false;   ///< of faces that did not face each other before: its first particles are theirs, the normal
                          ///< that of side 1
  ContactLaw law;

  double slip = 0.0;      ///< m
  double pressure = 0.0;  ///< N, of the last kick
  double shear = 0.0;     ///< N, likewise, on side 1 to the left of the normal
};

template <class Archive, class S>
void transfer(Archive& archive, S& side) requires std::same_as<std::remove_const_t<S>, FaceSide> {
  archive(side.particle), archive(side.weight), archive(side.slope);
}

template <class Archive, class P>
void transfer(Archive& archive, P& p) requires std::same_as<std::remove_const_t<P>, ContactPoint<2>> {
  archive(p.side), archive(p.normal), archive(p.at_start), archive(p.room), archive(p.of_crack), archive(p.of_face);
  archive(p.law.normal_stiffness), archive(p.law.shear_stiffness), archive(p.law.friction);
  archive(p.slip), archive(p.pressure), archive(p.shear);
}

/// Spacings: of the particles that a place of a face moves with, two rows and a half.
inline constexpr double face_reach = 2.25;

/// Weights of particles with which linear fields are right at x, and their slopes along the face: the place then moves
/// as the body does, and its forces have the right moment. Nothing when the particles lie on a line, or all to one side
/// far away.
[[nodiscard]] std::optional<FaceSide> fitted_side(const RunData<2>& run, const Vec<double, 2>& x,
                                                  const Vec<double, 2>& along,
                                                  const std::vector<std::size_t>& particles);

/// Law of faces of `area` (m, per metre of thickness) with this coefficient of friction, and with the stiffness of what
/// their first particles are made of.
template <int Dim>
[[nodiscard]] ContactLaw contact_law(const RunData<Dim>& run, const std::array<FaceSide, 2>& side, double area,
                                     double friction);

/// A point for a bond that a crack has cut. Nothing for one that hardly crosses the crack or is longer than to the next
/// particles.
template <int Dim>
[[nodiscard]] std::optional<ContactPoint<Dim>> point_of_bond(const RunData<Dim>& run, const NeighbourLists& lists,
                                                             const ReleasedBond<Dim>& bond);

/// Finds the sides of such a point again, when bonds of its ends have been cut.
template <int Dim>
void fit_sides_of_bond(const RunData<Dim>& run, const NeighbourLists& lists, ContactPoint<Dim>& point);

/// The side 1 that is opposite side 0 of a point when side 1 has moved to the left of the normal by `slid` (m)
/// more than the sides that it has; nothing where the other face has ended.
template <int Dim>
[[nodiscard]] std::optional<FaceSide> side_opposite(const RunData<Dim>& run, const ContactPoint<Dim>& point,
                                                    double slid);

/// A point for every spacing of the cuts.
template <int Dim>
[[nodiscard]] std::vector<ContactPoint<Dim>> points_of_cuts(const RunData<Dim>& run);

}  // namespace fpz::sph::detail
