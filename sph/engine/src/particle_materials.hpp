// The materials of a run by particle: constants for the library, and numbers for the loops where they differ.
#pragma once

#include <limits>
#include <map>
#include <vector>

#include "fields.hpp"
#include "fpz/material.hpp"
#include "fpz/sph/archive.hpp"
#include "fpz/sph/simulation.hpp"

namespace fpz::sph::detail {

/// With one material for all, the loops take the constants of View and no particle has numbers of its own: such a body
/// costs what it did before there were others.
template <int Dim>
class ParticleMaterials {
 public:
  ParticleMaterials() = default;
  /// `id`: of the particles in the order of their slots; `padded`: with the lanes that fill the last block.
  ParticleMaterials(const RunSetup<Dim>& setup, const std::vector<std::size_t>& id, std::size_t padded);

  /// Whether the particles have numbers of their own.
  [[nodiscard]] bool differ() const { return differ_; }
  [[nodiscard]] const Parameters& parameters(std::size_t i) const { return list_[index(i)].parameters; }
  [[nodiscard]] const Elasticity<double>& bulk(std::size_t i) const { return list_[index(i)].constants.bulk; }
  /// lambda + 2 mu, Pa.
  [[nodiscard]] double confined_modulus(std::size_t i) const { return bulk(i).lambda + 2.0 * bulk(i).mu; }
  /// Whether the displacements of two neighbours have no kink between them.
  [[nodiscard]] bool equally_stiff(std::size_t i, std::size_t j) const {
    return bulk(i).lambda == bulk(j).lambda && bulk(i).mu == bulk(j).mu;
  }
  /// With this H, m.
  [[nodiscard]] Material<double> material(std::size_t i, double rve_length) const {
    Material<double> m = list_[index(i)].constants;
    set_rve_length(m, rve_length);
    return m;
  }
  /// Whether particle i has a weak plane on which it has not cracked.
  [[nodiscard]] bool has_weak_plane(std::size_t i) const {
    return !weak_.empty() && weak_[i].entry != no_entry && !weak_[i].cracked;
  }
  [[nodiscard]] const Vec<double, Dim>& weak_normal(std::size_t i) const { return weak_[i].normal; }
  /// Constants of its zone there.
  [[nodiscard]] const Material<double>& weak_material(std::size_t i) const { return list_[weak_[i].entry].constants; }
  /// Particle i cracks on its weak plane: from now on its parameters are those of the plane.
  void crack_on_weak_plane(std::size_t i) { weak_[i].cracked = true; }
  [[nodiscard]] bool cracked_on_weak_plane(std::size_t i) const { return !weak_.empty() && weak_[i].cracked; }

  void save(Writer& archive) const;
  void load(Reader& archive);

  /// Longest H for a crack without snap-back in mode I, m.
  [[nodiscard]] double longest_stable(std::size_t i) const { return list_[index(i)].longest_stable; }

  /// Gives the loops their constants: of the one material, or by particle.
  void point(View<Dim>& view);

 private:
  struct Entry {
    Parameters parameters;
    Material<double> constants;
    double longest_stable = 0.0;
  };
  static constexpr std::size_t no_entry = std::numeric_limits<std::size_t>::max();
  struct WeakPlane {
    std::size_t entry = no_entry;  ///< of the list
    Vec<double, Dim> normal = Vec<double, Dim>::Zero();
    bool cracked = false;
  };
  void add(const Parameters& p, Setting setting);
  void add_weak_planes(const RunSetup<Dim>& setup, const std::vector<std::size_t>& id);
  [[nodiscard]] std::size_t index(std::size_t i) const {
    if (cracked_on_weak_plane(i)) return weak_[i].entry;
    return differ_ ? of_slot_[i] : 0;
  }

  template <class Visit>
  void fields(Visit&& visit) {
    using V = View<Dim>;
    constexpr Extent each = Extent::particle;
    visit(FieldInfo{"lambda", each, Keep::constant}, lambda_, &V::own_lambda);
    visit(FieldInfo{"mu", each, Keep::constant}, mu_, &V::own_mu);
    visit(FieldInfo{"sin_phi", each, Keep::constant}, sin_phi_, &V::own_sin_phi);
    visit(FieldInfo{"strength", each, Keep::constant, 1.0}, strength_, &V::own_strength);
    visit(FieldInfo{"apex", each, Keep::constant}, apex_, &V::own_apex);
  }

  bool differ_ = false;
  std::vector<Entry> list_;
  std::vector<std::size_t> of_slot_;
  std::vector<WeakPlane> weak_;
  Field lambda_, mu_, sin_phi_, strength_, apex_;
};

/// A modulus for what joins two particles: of two equal pieces in series, Pa.
[[nodiscard]] inline double in_series(double a, double b) { return 2.0 * a * b / (a + b); }

}  // namespace fpz::sph::detail
