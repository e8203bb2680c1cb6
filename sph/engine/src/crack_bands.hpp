// H of cracked particles of the undeformed body while their cracks open: the band over which a crack has really spread.
#pragma once

#include <limits>

#include "bonds.hpp"
#include "plane.hpp"
#include "run_data.hpp"

namespace fpz::sph::detail {

/// A crack opens several rows of particles, which share its opening as the particles lie: two equal rows along a
/// lattice, four unequal ones obliquely to it. The strain eps_i by which row i opens, summed over the rows with their
/// widths, is the opening of the crack, because that is how gradients see a jump. With
///
///   H_i = opening / eps_i
///
/// the zones of all rows have the jump and with it the traction of the same crack, and the energy that they dissipate
/// is that of one crack: sum V_i eps_i' t = A t opening'. The opening is the mean of eps over a window around the
/// particle, which is smooth along the crack and counts the rows across it, times the width of that window; so no place
/// of a crack and no direction of a lattice has to be known.
///
/// Rows change their shares while a crack is finding its place. H is therefore found anew every few steps from what is
/// open by then, times opening/jump, which leads back a jump that has gone ahead or stayed behind. The stress, the jump
/// and all that the zone remembers stay as they are; what the H of another moment would have made of the jump goes into
/// a shift of the strain from which the point goes on.
template <int Dim>
class CrackBands {
 public:
  /// H of a crack with less integrity stays: next to nothing is left to dissipate, and its bonds are cut.
  static constexpr double least_integrity = 0.02;

  explicit CrackBands(RunData<Dim>& run) : run_(run) {
    const std::size_t count = run.particles.count;
    for (Field& c : shift_) c.assign(count, 0.0);
    for (Field& c : opened_) c.assign(count, 0.0);
    wanted_.assign(count, 0.0);
    at_first_.assign(count, 0.0);
    longest_.assign(count, 0.0);
    window_of_.assign(count, no_window);
  }

  /// Finds H of the cracked particles again, at strains and stresses of n.
  void follow();
  /// Gives particle i the H of the arrangement back, for good, when it has a longer one: a long H can snap back in
  /// shear. False when there is nothing to shorten.
  bool shorten(std::size_t i);
  /// A crack is forgotten: the strain of its particle changes by this at the same deformation.
  void forget(std::size_t i, const Tensor<double, Dim>& change);
  /// Strain of the material point of particle i less the strain of the particle.
  [[nodiscard]] Tensor<double, Dim> shift(std::size_t i) const;

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    for (auto& c : self.shift_) archive(c);
    archive(self.at_first_);
    archive(self.longest_);
  }

 private:
  struct Plane;  ///< the crack of a particle and how it opens
  /// Over what is averaged around a particle, as long as its crack has this frame.
  struct Window {
    struct Part {
      std::size_t particle;
      double weight;  ///< m^2
    };
    Mat<double, Dim, Dim> frame;
    std::vector<Part> parts;
    double all = 0.0;  ///< sum of the weights, m^2
  };
  static constexpr std::size_t no_window = std::numeric_limits<std::size_t>::max();

  void find_opened(std::size_t i);
  /// opened_ of particle j along the jump of a crack with this plane.
  [[nodiscard]] double strain_along(const Plane& plane, std::size_t j) const;
  /// Width of the window times the mean opening strain in it, m.
  [[nodiscard]] double opening_around(const Plane& plane, std::size_t i) const;
  [[nodiscard]] Window window_around(std::size_t i) const;
  void begin(std::size_t i);  ///< with a particle that has just cracked
  [[nodiscard]] double length_of(std::size_t i) const;
  void change_length(std::size_t i, double length);

  RunData<Dim>& run_;
  NeighbourLists lists_;                ///< the windows, made with the first crack
  std::vector<std::size_t> window_of_;  ///< of each particle: its place among them
  std::vector<Window> windows_;
  Fields<tensor_size<Dim>> shift_;   ///< saved
  Field at_first_;                   ///< saved: the H of the arrangement, m, of cracked particles
  Field longest_;                    ///< saved: m, of cracked particles
  Fields<tensor_size<Dim>> opened_;  ///< strain less elastic strain, zero where there is no crack
  Field wanted_;                     ///< H of cracked particles that their openings want now, m
};

}  // namespace fpz::sph::detail
