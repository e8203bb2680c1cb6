// Where the particles are at the start: positions, volumes and the boundary group each belongs to.
#pragma once

#include <functional>
#include <vector>

#include "fpz/sph/cut.hpp"
#include "fpz/types.hpp"

namespace fpz::sph {

/// Particles of the undeformed body. In 2-D volumes are areas: everything is per metre of thickness.
template <int Dim>
struct Arrangement {
  double spacing = 0.0;  ///< dx, m: the smoothing length is a multiple of it
  std::vector<Vec<double, Dim>> position;
  std::vector<double> volume;  ///< m^Dim
  std::vector<int> group;      ///< index of the boundary group, or specimen
  std::vector<Cut<Dim>> cuts;  ///< particles do not interact across these, boundary particles included
  /// Surface of the undeformed body as lines of straight pieces, closed ones end where they begin. Empty: the engine
  /// estimates it from the particles.
  std::vector<std::vector<Vec<double, Dim>>> surface;

  static constexpr int specimen = -1;

  [[nodiscard]] std::size_t size() const { return position.size(); }
  void add(const Vec<double, Dim>& x, double v, int g = specimen) {
    position.push_back(x);
    volume.push_back(v);
    group.push_back(g);
  }
};

/// Adds the points of a square (cubic) lattice that fills the box [low, high], points at the centres of their cells,
/// for which `inside` holds (all, when empty). The box must be a whole number of spacings wide, else the lattice starts
/// at `low` and stops where a cell no longer fits.
template <int Dim>
void add_lattice(Arrangement<Dim>& a, const Vec<double, Dim>& low, const Vec<double, Dim>& high,
                 int group = Arrangement<Dim>::specimen,
                 const std::function<bool(const Vec<double, Dim>&)>& inside = {}) {
  int n[3] = {1, 1, 1};
  double cell = 1.0;
  for (int c = 0; c < Dim; ++c) {
    n[c] = static_cast<int>((high[c] - low[c]) / a.spacing + 1e-6);
    cell *= a.spacing;
  }
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const int index[3] = {i, j, k};
        Vec<double, Dim> x;
        for (int c = 0; c < Dim; ++c) x[c] = low[c] + (index[c] + 0.5) * a.spacing;
        if (!inside || inside(x)) a.add(x, cell, group);
      }
    }
  }
}

}  // namespace fpz::sph
