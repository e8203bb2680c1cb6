// Specimens on which the loops of the particle method are timed.
#pragma once

#include <cmath>
#include <random>

#include "fpz/sph/simulation.hpp"

namespace fpz::bench {

enum class Layout { lattice, turned, scattered };

inline const char* name_of(Layout layout) {
  return layout == Layout::lattice ? "lattice" : layout == Layout::turned ? "lattice at 20 degrees" : "scattered";
}

/// A bar of columns x rows spacings (1 mm), pulled slowly at its ends, far below its strength.
inline sph::RunSetup<2> bar(int columns, int rows, const sph::Options<2>& options, Layout layout = Layout::lattice) {
  constexpr double spacing = 1e-3;
  using Point = Vec<double, 2>;
  sph::RunSetup<2> s;
  s.options = options;
  s.parameters = {45e9, 0.24, 2400.0, 2.9e6, 5e6, 37.0, 5.0, 16.4e-6, 1e14, 1e11, 2e-3};
  s.arrangement.spacing = spacing;
  const double width = columns * spacing, height = rows * spacing;
  if (layout == Layout::turned) {
    const double angle = 20.0 * M_PI / 180.0, cosine = std::cos(angle), sine = std::sin(angle);
    const int reach = columns + rows;
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        const Point x(spacing * (cosine * i - sine * j), spacing * (sine * i + cosine * j));
        if (x[0] > 0.0 && x[0] < width && x[1] > 0.0 && x[1] < height) s.arrangement.add(x, spacing * spacing);
      }
    }
  } else {
    add_lattice<2>(s.arrangement, Point(0.0, 0.0), Point(width, height));
  }
  if (layout == Layout::scattered) {
    std::mt19937_64 rng(5);
    std::uniform_real_distribution<double> shift(-0.15 * spacing, 0.15 * spacing);
    for (Point& x : s.arrangement.position) x += Point(shift(rng), shift(rng));
    s.options.gradient = sph::Gradient::kernel;  // the same loops; the vectors of consistent ones take minutes
  }
  s.groups = {{"left", {sph::Motion{0.0, 0.0}, sph::Motion{0.0, 0.0}}, true},
              {"right", {sph::Motion{1e-3, 1e-4}, std::nullopt}, true}};
  for (std::size_t i = 0; i < s.arrangement.size(); ++i) {
    const double x = s.arrangement.position[i][0];
    if (x < 3.0 * spacing) s.arrangement.group[i] = 0;
    if (x > width - 3.0 * spacing) s.arrangement.group[i] = 1;
  }
  return s;
}

/// The same bar with every twentieth column so weak that it cracks first.
inline sph::RunSetup<2> bar_with_cracks(int columns, int rows, const sph::Options<2>& options) {
  sph::RunSetup<2> s = bar(columns, rows, options);
  Parameters weak = s.parameters;
  weak.tensile_strength *= 0.01, weak.cohesion *= 0.01;
  s.materials.further = {weak};
  for (const auto& x : s.arrangement.position) {
    s.materials.of_particle.push_back(static_cast<int>(x[0] / s.arrangement.spacing) % 20 == 10 ? 1 : 0);
  }
  s.groups[1].drive[0] = sph::Motion{0.05, 1e-6};
  return s;
}

}  // namespace fpz::bench
