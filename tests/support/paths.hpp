// Loading paths of the verification tests: straight legs in strain, and helpers to walk along them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fpz/energy.hpp"
#include "fpz/update.hpp"
#include "support/materials.hpp"
#include "support/reference_integrator.hpp"

namespace fpz::test {

template <int Dim>
struct Path {
  std::string name;
  Parameters parameters;
  Setting setting = Setting::plane_strain;
  std::vector<Tensor<double, Dim>> legs;  ///< total strain of each leg
};

inline Tensor<double, 2> strain2(double xx, double yy, double xy) {
  Tensor<double, 2> e;
  e << xx, yy, xy;
  return e;
}
inline Tensor<double, 3> strain3(double xx, double yy, double zz, double xy, double xz, double yz) {
  Tensor<double, 3> e;
  e << xx, yy, zz, xy, xz, yz;
  return e;
}

/// Section 4.5: tension, mixed mode, unloading, reloading (data/reference/README.md).
inline Path<2> four_stage() {
  return {"four_stage",
          table1(),
          Setting::plane_strain,
          {strain2(12000 * 3e-7, 0, 0), strain2(2000 * 3e-7, 0, 2000 * 15e-7), strain2(-300 * 3e-7, 0, -300 * 15e-7),
           strain2(1300 * 3e-7, 0, 1300 * 15e-7)}};
}

/// Opening and shear together from the start: an inclined plane.
inline Path<2> mixed_mode() {
  return {"mixed_mode", table1(1e-3), Setting::plane_strain, {strain2(4e-3, -1e-3, 5e-3), strain2(6e-3, 0, -3e-3)}};
}

/// Onset under compression, then frictional sliding both ways.
inline Path<2> compressive_shear() {
  return {"compressive_shear",
          table1(1e-3),
          Setting::plane_strain,
          {strain2(-2e-3, -2e-3, 0), strain2(0, 0, 1e-2), strain2(0, 0, -8e-3), strain2(-1e-3, -1e-3, 4e-3)}};
}

/// Opening with shear, closing into contact, sliding, reversed sliding, reopening.
inline Path<2> closing() {
  return {"closing",
          table1(1e-3),
          Setting::plane_strain,
          {strain2(6e-3, 0, 1e-3), strain2(0, 0, 4e-3), strain2(-1.2e-2, 0, 0), strain2(0, 0, 6e-3),
           strain2(0, 0, -1.4e-2), strain2(1.6e-2, 0, 0), strain2(2e-3, 0, 8e-3)}};
}

/// The same in plane stress with the concrete of Table 2, whose first crack is inclined.
inline Path<2> plane_stress_cycle() {
  return {"plane_stress_cycle",
          table2(0.25e-3),
          Setting::plane_stress,
          {strain2(1e-2, 0, 2e-3), strain2(-1.5e-2, 0, 0), strain2(0, 0, 1e-2), strain2(1.2e-2, 2e-3, -1.5e-2)}};
}

/// 3-D: opening, then the shear turns round the normal, then the crack closes and slides crosswise.
inline Path<3> rotating_shear() {
  Path<3> p{"rotating_shear", table1(1e-3), Setting::three_d, {strain3(5e-3, 0, 0, 0, 0, 0)}};
  const int corners = 12;
  const double radius = 2e-3;
  const double degree = 3.14159265358979323846 / 180.0;
  double y = 0.0;
  double z = 0.0;
  for (int k = 0; k <= corners; ++k) {
    const double ny = radius * std::cos(30.0 * k * degree);
    const double nz = radius * std::sin(30.0 * k * degree);
    p.legs.push_back(strain3(2e-4, 0, 0, ny - y, nz - z, 0));
    y = ny;
    z = nz;
  }
  p.legs.push_back(strain3(-9e-3, 0, 0, 0, 0, 0));
  p.legs.push_back(strain3(0, 0, 0, 2e-3, -5e-3, 1e-3));
  return p;
}

/// The paths with every form of the zone.
template <int Dim>
std::vector<Path<Dim>> in_every_zone(const std::vector<Path<Dim>>& paths) {
  std::vector<Path<Dim>> all;
  for (const Word<CohesiveZone>& zone : Words<CohesiveZone>::list) {
    for (Path<Dim> p : paths) {
      p.name += std::string(", ") + zone.text;
      p.parameters.choices.cohesive_zone = zone.value;
      all.push_back(p);
    }
  }
  return all;
}

template <int Dim>
Matrix3 to_matrix3(const Tensor<double, Dim>& a) {
  Matrix3 m = Matrix3::Zero();
  m.topLeftCorner<Dim, Dim>() = to_matrix<double, Dim>(a);
  return m;
}

template <int Dim>
Vector3 normal_of(const State<double, Dim>& s) {
  Vector3 n = Vector3::Zero();
  if (s.cracked) n.head<Dim>() = s.frame.row(0).transpose();
  return n;
}

/// Number of equal increments of a leg whose largest component is at most `increment`.
template <int Dim>
int increments_of(const Tensor<double, Dim>& leg, double increment) {
  return std::max(1, static_cast<int>(std::ceil(leg.template lpNorm<Eigen::Infinity>() / increment * (1.0 - 1e-12))));
}

/// Largest differences met along a path.
struct PathError {
  double stress = 0.0;  ///< over sigma_t0
  double damage = 0.0;
  double dissipated = 0.0;  ///< over sigma_t0 delta0
  double normal = 0.0;      ///< angle between the planes, rad
  Status status = Status::ok;
  double final_damage = 0.0;
};

/// Walks the library and the reference along a path, `counts` increments on each leg, and compares them at about
/// `checks` points of every leg.
template <int Dim>
PathError compare(const Path<Dim>& path, const Options& options, const std::vector<int>& counts, int checks = 20) {
  const Material<double> m = make_material(path.parameters, path.setting);
  ReferenceIntegrator reference(path.parameters, path.setting);
  State<double, Dim> s;
  PathError e;
  for (std::size_t i = 0; i < path.legs.size(); ++i) {
    const Tensor<double, Dim> leg = path.legs[i];
    const int n = counts[i];
    const int stride = std::max(1, n / checks);
    for (int done = 0; done < n;) {
      const int now = std::min(stride, n - done);
      for (int k = 0; k < now; ++k) {
        const Tensor<double, Dim> d = leg / n;
        const Report r = update<Dim>(m, options, s, d, s);
        if (!r.ok()) {
          e.status = r.status;
          return e;
        }
      }
      reference.advance(to_matrix3<Dim>(leg) * (double(now) / n), normal_of(s));
      done += now;
      const Matrix3 difference = (reference.stress() - to_matrix3<Dim>(s.stress));
      const double stress = difference.topLeftCorner<Dim, Dim>().cwiseAbs().maxCoeff();
      const ReferenceState& z = reference.state();
      e.stress = std::max(e.stress, stress / path.parameters.tensile_strength);
      e.damage = std::max(e.damage, std::abs(1.0 - z.integrity - damage(s)));
      const double energy = path.parameters.tensile_strength * path.parameters.delta0;
      e.dissipated = std::max(e.dissipated, std::abs(z.dissipated - s.crack.dissipated) / energy);
      if (z.cracked && s.cracked) {
        const Vector3 n_ref = z.frame.row(0).transpose();
        e.normal = std::max(e.normal, n_ref.cross(normal_of(s)).norm());
      }
    }
  }
  e.final_damage = damage(s);
  return e;
}

/// The same with increments whose largest component is at most `increment`.
template <int Dim>
PathError compare(const Path<Dim>& path, const Options& options, double increment, int checks = 20) {
  std::vector<int> counts;
  for (const Tensor<double, Dim>& leg : path.legs) counts.push_back(increments_of<Dim>(leg, increment));
  return compare<Dim>(path, options, counts, checks);
}

}  // namespace fpz::test
