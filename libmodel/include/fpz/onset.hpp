// Fracture onset: the plane on which the yield value F (law/hyperbola.hpp) first reaches zero (section 4.1).
//
// Two ways to the same answer: the closed form (docs/equations.md) and the paper's scan over plane orientations. Plane
// convention. In 2-D the plane contains the out-of-plane axis. Two conjugate planes are equally critical whenever the
// critical plane is inclined. The fixed rule takes the normal turned counter-clockwise (about +z in 2-D) from the
// direction of the largest principal stress; in 3-D the turn is about the intermediate principal axis, whose sense is
// fixed by making its z component positive (then y, then x). A preferred normal, when given, overrides the rule.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "fpz/material.hpp"
#include "fpz/options.hpp"
#include "fpz/state.hpp"

namespace fpz {

/// A plane through the point with its tractions.
template <class T, int Dim>
struct Plane {
  Mat<T, Dim, Dim> frame;       ///< R, rows (n, s1[, s2]): traction in the local
                                ///< frame is R sigma n
  Vec<T, Dim> traction;         ///< local traction, Pa
  T failure_value = T(-1e300);  ///< F on the plane, Pa; >= 0 means fracture
};

namespace detail {

/// Centre and radius of the in-plane Mohr circle, and the direction of its largest principal stress.
template <class T>
struct Circle {
  T p;
  T r;
  Vec<T, 2> axis;
};

template <class T>
[[nodiscard]] Circle<T> mohr_circle(const Tensor<T, 2>& s) {
  using std::sqrt;
  Circle<T> c;
  c.p = (s[0] + s[1]) * 0.5;
  const T d = (s[0] - s[1]) * 0.5;
  const T r2 = d * d + s[2] * s[2];
  const double size = std::max({std::abs(value(s[0])), std::abs(value(s[1])), std::abs(value(s[2]))});
  if (value(r2) <= 1e-28 * size * size) {  // isotropic: every plane is equally loaded; take x
    c.r = T(0.0);
    c.axis << T(1.0), T(0.0);
    return c;
  }
  c.r = sqrt(r2);
  if (value(d) >= 0.0) {  // half-angle formulas, away from cancellation
    const T x = sqrt((1.0 + d / c.r) * 0.5);
    c.axis << x, s[2] / (2.0 * c.r * x);
  } else {
    T y = sqrt((1.0 - d / c.r) * 0.5);
    if (value(s[2]) < 0.0) y = -y;
    c.axis << s[2] / (2.0 * c.r * y), y;
  }
  return c;
}

/// Principal stresses (largest first) and a right-handed set of principal directions (columns).
template <class T>
struct Principal {
  Vec<T, 3> values;
  Mat<T, 3, 3> axes;
};

/// Projects a fixed direction onto the span of two degenerate principal axes, so that the choice is repeatable.
inline void align_degenerate(Mat<double, 3, 3>& v, int i, int j, const Vec<double, 3>& preferred) {
  const double x = v.col(i).dot(preferred);
  const double y = v.col(j).dot(preferred);
  const double norm = std::hypot(x, y);
  if (norm < 1e-6) return;
  const Vec<double, 3> a = (x * v.col(i) + y * v.col(j)) / norm;
  const Vec<double, 3> b = (-y * v.col(i) + x * v.col(j)) / norm;
  v.col(i) = a;
  v.col(j) = b;
}

template <class T>
[[nodiscard]] Principal<T> principal_stresses(const Tensor<T, 3>& stress, const Vec<double, 3>& preferred) {
  const Mat<double, 3, 3> s = to_matrix<double, 3>(convert<double>(stress));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver{Eigen::Matrix3d(s)};
  Mat<double, 3, 3> v;
  Vec<double, 3> l;
  for (int k = 0; k < 3; ++k) {
    v.col(k) = solver.eigenvectors().col(2 - k);
    l[k] = solver.eigenvalues()[2 - k];
  }
  const double close = 1e-12 * std::max(std::abs(l[0]), std::abs(l[2]));
  const Vec<double, 3> direction = preferred.squaredNorm() > 0.0 ? preferred : Vec<double, 3>(Vec<double, 3>::UnitX());
  if (l[0] - l[2] <= close) {
    v.setIdentity();
    align_degenerate(v, 0, 1, direction);
  } else if (l[0] - l[1] <= close) {
    align_degenerate(v, 0, 1, direction);
  } else if (l[1] - l[2] <= close) {
    align_degenerate(v, 2, 1, direction);
  }
  // Sense of the intermediate axis: z component positive, then y, then x.
  for (const int k : {2, 1, 0}) {
    if (std::abs(v(k, 1)) > 1e-9) {
      if (v(k, 1) < 0.0) v.col(1) = -v.col(1);
      break;
    }
  }
  v.col(2) = Eigen::Vector3d(v.col(0)).cross(Eigen::Vector3d(v.col(1)));
  Principal<T> out;
  if constexpr (std::floating_point<T>) {
    out.values = l;
    out.axes = v;
  } else {  // first-order perturbation carries the derivatives
    const Mat<T, 3, 3> vt = convert<T>(v);
    const Mat<T, 3, 3> d = vt.transpose() * (to_matrix<T, 3>(stress) * vt);
    for (int i = 0; i < 3; ++i) {
      out.values[i] = d(i, i);
      Vec<T, 3> a = vt.col(i);
      for (int j = 0; j < 3; ++j) {
        if (j != i && std::abs(l[i] - l[j]) > close) a += vt.col(j) * T(d(j, i) / (l[i] - l[j]));
      }
      out.axes.col(i) = a;
    }
  }
  return out;
}

/// The two conjugate normals cos(theta) e1 +- sin(theta) e3; true picks the second.
template <int Dim, class T>
[[nodiscard]] bool second_is_preferred(const Vec<T, Dim>& first, const Vec<T, Dim>& second,
                                       const Vec<double, 3>& preferred) {
  double a = 0.0;
  double b = 0.0;
  for (int k = 0; k < Dim; ++k) {
    a += value(first[k]) * preferred[k];
    b += value(second[k]) * preferred[k];
  }
  return std::abs(b) > std::abs(a) * (1.0 + 1e-12) + 1e-300;
}

}  // namespace detail

/// The critical plane of a stress state in closed form (docs/equations.md): largest F over all planes, its normal and
/// traction.
template <int Dim, class T, class P>
[[nodiscard]] Plane<T, Dim> critical_plane(const Material<P>& m, const Tensor<T, Dim>& stress,
                                           const Vec<double, 3>& preferred = Vec<double, 3>::Zero()) {
  Plane<T, Dim> plane;
  if constexpr (Dim == 2) {
    detail::Circle<T> c = detail::mohr_circle(stress);
    if (value(c.r) == 0.0 && preferred.template head<2>().squaredNorm() > 0.0) {
      const Vec<double, 2> axis = preferred.template head<2>().normalized();
      c.axis = convert<T>(axis);
    }
    const Inclination<T> i = m.law.surface.critical_inclination(c.r);
    Vec<T, 2> n, other;
    n << i.cosine * c.axis[0] - i.sine * c.axis[1], i.cosine * c.axis[1] + i.sine * c.axis[0];
    other << i.cosine * c.axis[0] + i.sine * c.axis[1], i.cosine * c.axis[1] - i.sine * c.axis[0];
    plane.frame = frame_from<T>(detail::second_is_preferred<2>(n, other, preferred) ? other : n);
    plane.failure_value = m.law.surface.largest_value(c.p, c.r);
  } else {
    const detail::Principal<T> s = detail::principal_stresses(stress, preferred);
    const T p = (s.values[0] + s.values[2]) * 0.5;
    const T r = (s.values[0] - s.values[2]) * 0.5;
    const Inclination<T> i = m.law.surface.critical_inclination(r);
    // Counter-clockwise about e2 turns e1 towards e2 x e1 = -e3.
    const Vec<T, 3> e1 = s.axes.col(0);
    const Vec<T, 3> e2 = s.axes.col(1);
    const Vec<T, 3> e3 = s.axes.col(2);
    const Vec<T, 3> n = e1 * i.cosine - e3 * i.sine;
    const Vec<T, 3> other = e1 * i.cosine + e3 * i.sine;
    plane.frame = frame_from<T>(detail::second_is_preferred<3>(n, other, preferred) ? other : n, e2);
    plane.failure_value = m.law.surface.largest_value(p, r);
  }
  plane.traction = local_traction<T, Dim>(plane.frame, stress);
  return plane;
}

/// The paper's scan (section 4.1) in 2-D: all normals from 0 to 180 degrees at `resolution_deg`; the first of equal
/// maxima wins unless a preferred normal decides. Works on the monotone F, so the spurious branch of eq 48 cannot win.
template <int Dim, class T, class P>
[[nodiscard]] Plane<T, Dim> scan_planes(const Material<P>& m, const Tensor<T, Dim>& stress, double resolution_deg,
                                        const Vec<double, 3>& preferred = Vec<double, 3>::Zero()) {
  const int steps = std::max(1, static_cast<int>(std::lround(180.0 / resolution_deg)));
  const Tensor<double, Dim> sv = convert<double>(stress);
  const auto surface = m.law.surface.values();
  Mat<double, Dim, Dim> best = Mat<double, Dim, Dim>::Identity();
  double best_value = -1e300;
  const double tie = 1e-12 * (surface.cohesion + sv.template lpNorm<Eigen::Infinity>());
  const auto consider = [&](const Mat<double, Dim, Dim>& frame) {
    const Vec<double, Dim> t = local_traction<double, Dim>(frame, sv);
    const double f = surface.value_at(t[0], t.template tail<Dim - 1>().squaredNorm(), 1.0);
    const Vec<double, Dim> n = frame.row(0).transpose();
    const Vec<double, Dim> old = best.row(0).transpose();
    if (f > best_value + tie || (f > best_value - tie && detail::second_is_preferred<Dim>(old, n, preferred))) {
      best = frame;
      best_value = f;
    }
  };
  for (int i = 0; i < steps; ++i) {
    const double a = i * 180.0 / steps * degree;
    if constexpr (Dim == 2) {
      Vec<double, 2> n;
      n << std::cos(a), std::sin(a);
      consider(frame_from<double>(n));
    } else {  // polar angle from z in [0, 90], azimuth spacing kept about equal
              // on the sphere
      const double polar = 0.5 * a;
      const int around = std::max(1, static_cast<int>(std::lround(2.0 * steps * std::sin(polar))));
      for (int j = 0; j < around; ++j) {
        const double b = j * 2.0 * 3.14159265358979323846 / around;
        Vec<double, 3> n, s2;
        n << std::sin(polar) * std::cos(b), std::sin(polar) * std::sin(b), std::cos(polar);
        s2 << -std::sin(b), std::cos(b), 0.0;
        consider(frame_from<double>(n, s2));
      }
    }
  }
  Plane<T, Dim> plane;
  plane.frame = convert<T>(best);
  plane.traction = local_traction<T, Dim>(plane.frame, stress);
  plane.failure_value = m.law.surface.value_at(
      plane.traction[0], squared_norm(Vec<T, Dim - 1>(plane.traction.template tail<Dim - 1>())), 1.0);
  return plane;
}

/// Cheap test that a stress is inside the onset surface. False means "look closer", true is certain.
template <int Dim, class P>
[[nodiscard]] FPZ_INLINE bool surely_intact(const Material<P>& m, const Tensor<double, Dim>& s) {
  return m.law.surface.template surely_intact<Dim>(s);
}

/// Where on the straight stress path begin + x (end - begin), x in [0, 1], the failure value reaches zero; the largest
/// F over all planes is a convex function of x, so there is one crossing. Requires F(end) >= 0. Returns 0 when F(begin)
/// >= 0.
template <int Dim, class T, class P>
[[nodiscard]] T onset_fraction(const Material<P>& m, const Tensor<T, Dim>& begin, const Tensor<T, Dim>& end) {
  const Tensor<T, Dim> rate = end - begin;
  const auto at = [&](double x) { return critical_plane<Dim>(m, Tensor<T, Dim>(begin + rate * T(x))); };
  // Slope of the largest F: the plane is stationary, so only its traction changes (envelope theorem).
  const auto slope = [&](const Plane<T, Dim>& plane) {
    return m.law.surface.value_rate(plane.traction, local_traction<T, Dim>(plane.frame, rate));
  };
  if (value(at(0.0).failure_value) >= 0.0) return T(0.0);
  double x = 1.0;
  Plane<T, Dim> plane = at(x);
  for (int k = 0; k < 60; ++k) {  // Newton from the right of a convex function: monotone, quadratic
    const double step = value(plane.failure_value) / slope(plane);
    if (!(step > 0.0) || !std::isfinite(step)) break;
    const double next = std::max(x - step, 0.0);
    if (next == x) break;
    x = next;
    plane = at(x);
    if (std::abs(step) <= 1e-15) break;
  }
  if constexpr (std::floating_point<T>) {
    return x;
  } else {
    return T(T(x) - plane.failure_value / slope(plane));
  }
}

/// How far the stress can go along `rate` before a plane fails, in units of `rate`: sought from `first` on by doubling
/// up to `last`; nothing when no plane fails there.
template <int Dim>
[[nodiscard]] std::optional<double> distance_to_onset(const Material<double>& m, const Tensor<double, Dim>& stress,
                                                      const Tensor<double, Dim>& rate, double first, double last) {
  for (double reach = first; reach < last; reach *= 2.0) {
    const Tensor<double, Dim> far = stress + reach * rate;
    if (critical_plane<Dim>(m, far).failure_value >= 0.0) return reach * onset_fraction<Dim>(m, stress, far);
  }
  return std::nullopt;
}

/// Moves an uncracked point elastically by the fraction x of the strain increment `dstrain`, whose stress is `dstress`.
template <int Dim, class T>
void go_elastically(State<T, Dim>& s, const Tensor<T, Dim>& dstrain, const Tensor<T, Dim>& dstress, const T& x) {
  s.strain += dstrain * x;
  s.stress += dstress * x;
}

/// The plane search chosen by the options.
template <int Dim, class T, class P>
[[nodiscard]] Plane<T, Dim> find_plane(const Material<P>& m, const Options& o, const Tensor<T, Dim>& stress) {
  return o.scan_resolution_deg > 0.0 ? scan_planes<Dim>(m, stress, o.scan_resolution_deg, o.preferred_normal)
                                     : critical_plane<Dim>(m, stress, o.preferred_normal);
}

/// Cracks a point whose stress has reached the onset surface, on its critical plane.
template <int Dim, class T, class P>
void open_crack(const Material<P>& m, const Options& o, State<T, Dim>& s) {
  const Plane<T, Dim> plane = find_plane<Dim>(m, o, s.stress);
  s.cracked = true;
  s.frame = plane.frame;
  s.crack = cracked_at<T, Dim>(m.law, plane.traction);
}

}  // namespace fpz
