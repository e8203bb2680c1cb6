// Two places on two faces that were opposite each other.
#pragma once

#include <array>
#include <vector>

#include "contact_law.hpp"
#include "run_data.hpp"

namespace fpz::sph::detail {

/// What a place on a face moves with: the mean of these particles, with weights that sum to one.
struct FaceSide {
  std::vector<std::size_t> particle;  ///< slots
  std::vector<double> weight;
};

template <int Dim>
struct ContactPoint {
  std::array<FaceSide, 2> side;
  Vec<double, Dim> normal;                               ///< unit, from side 0 to side 1, in the undeformed body
  Vec<double, Dim> at_start = Vec<double, Dim>::Zero();  ///< m, from place 0 to place 1, there
  double room = 0.0;  ///< m: the gap is the distance of the places along the normal plus this
  ContactLaw law;

  double slip = 0.0;                                     ///< m
  double pressure = 0.0;                                 ///< N, of the last kick
  double shear = 0.0;                                    ///< N, likewise, on side 1 to the left of the normal
  Vec<double, Dim> force = Vec<double, Dim>::Zero();     ///< N, both, on side 1
  Vec<double, Dim> distance = Vec<double, Dim>::Zero();  ///< m, from place 0 to place 1 at the last kick
};

/// The state of a point; what it is made of comes from elsewhere.
template <class Archive, class P>
void transfer_state(Archive& archive, P& point) {
  archive(point.slip), archive(point.pressure), archive(point.shear), archive(point.force), archive(point.distance);
}

/// Law of a face of `area` (m, per metre of thickness) with this coefficient of friction.
template <int Dim>
[[nodiscard]] ContactLaw contact_law(const RunData<Dim>& run, double area, double friction);

/// A point for every spacing of the cuts.
template <int Dim>
[[nodiscard]] std::vector<ContactPoint<Dim>> points_of_cuts(const RunData<Dim>& run);

}  // namespace fpz::sph::detail
