// Algorithm 1 (a) and the traction-continuity loop of Algorithm 2, as printed with the slips repaired
// (docs/equations.md). Kept as the named baseline `paper`. It has a small radius of convergence (docs/equations.md):
// failure is reported, never returned as a result.
#pragma once

#include <Eigen/LU>

#include "fpz/integrators/zone.hpp"
#include "fpz/options.hpp"

namespace fpz::detail {

/// Derivatives of eq 53 and eq 65 at one state, in the local frame.
template <class T, int Dim>
struct PaperDerivatives {
  Vec<T, Dim> f_t;     ///< df/dt, eq 48
  Vec<T, Dim> g_t;     ///< dg/dt, eq 49
  Vec<T, Dim> secant;  ///< diagonal of P K, eq 44-46
  Vec<T, Dim> t_d;     ///< dt/dD = -K (u + u0 - up) on the damaged components
  T r;                 ///< R = dD/dlambda, eq 52
  T f_d;               ///< df/dD
  T denominator;       ///< f_t.P K g_t - f_t.(dt/dD) R - (df/dD) R
};

template <class T, int Dim, class Law>
[[nodiscard]] PaperDerivatives<T, Dim> paper_derivatives(const Law& law, const Vec<T, Dim>& t, const T& w) {
  using std::sqrt;
  PaperDerivatives<T, Dim> d;
  const bool tension = value(t[0]) >= 0.0;
  d.f_t[0] = 2.0 * law.surface.tan_phi * (law.surface.cohesion * w - t[0] * law.surface.tan_phi);
  d.g_t[0] = 2.0 * law.surface.tan_psi * (law.surface.cohesion * w - t[0] * law.surface.tan_psi);
  d.secant[0] = tension ? T(w * law.kn) : T(law.kn);
  d.t_d[0] = tension ? T(-t[0] / w) : T(0.0);
  T slip2 = T(0.0);
  for (int k = 1; k < Dim; ++k) {
    d.f_t[k] = d.g_t[k] = 2.0 * t[k];
    d.secant[k] = w * law.ks;
    d.t_d[k] = -t[k] / w;
    slip2 += d.g_t[k] * d.g_t[k];
  }
  const T slip = value(slip2) > 0.0 ? T(sqrt(slip2)) : T(0.0);
  d.r = -law.softening.slope(law.softening.piece(value(w)), w) * (d.g_t[0] + slip);
  d.f_d =
      2.0 * law.surface.cohesion * law.surface.tan_phi * (2.0 * law.surface.tensile_strength * w - t[0]) -
      2.0 * law.surface.tan_phi * law.surface.tan_phi * law.surface.tensile_strength * law.surface.tensile_strength * w;
  d.denominator = -d.f_d * d.r;
  for (int k = 0; k < Dim; ++k) d.denominator += d.f_t[k] * (d.secant[k] * d.g_t[k] - d.t_d[k] * d.r);
  return d;
}

/// Algorithm 1 (eq 51-54) on a jump increment `du`: traction, plastic jump, slip and integrity are updated in place.
template <class T, int Dim, class Law>
void paper_return(const Law& law, CohesiveState<T, Dim>& z, const Vec<T, Dim>& du) {
  using std::sqrt;
  const PaperDerivatives<T, Dim> old = paper_derivatives(law, z.traction, z.integrity);
  for (int k = 0; k < Dim; ++k) z.traction[k] += old.secant[k] * du[k];  // steps 1, 4
  z.jump += du;
  T ts2 = T(0.0);
  for (int k = 1; k < Dim; ++k) ts2 += z.traction[k] * z.traction[k];
  const T f = law.surface.printed_value(z.traction[0], ts2, z.integrity);  // step 2
  if (value(f) < 0.0) return;                                              // step 3
  const PaperDerivatives<T, Dim> d = paper_derivatives(law, z.traction, z.integrity);
  const T multiplier = f / d.denominator;  // step 6, eq 53
  const T dd = multiplier * d.r;           // step 8
  T slip2 = T(0.0);
  for (int k = 0; k < Dim; ++k) {
    const T plastic = multiplier * d.g_t[k];  // step 7
    z.dissipated += z.traction[k] * plastic;
    z.plastic_jump[k] += plastic;
    z.traction[k] += d.t_d[k] * dd - d.secant[k] * plastic;  // step 9, eq 54
    if (k > 0) slip2 += plastic * plastic;
  }
  z.slip += value(slip2) > 0.0 ? T(sqrt(slip2)) : T(0.0);
  T s2 = T(0.0);
  for (int k = 1; k < Dim; ++k) s2 += z.traction[k] * z.traction[k];
  z.dissipated += dd * damage_energy(law, T(z.traction[0] / z.integrity), T(s2 / (z.integrity * z.integrity)));
  z.integrity -= dd;  // step 11
}

/// Whether a return ended where it should: on its yield surface to 1 % of sigma_t0 if it yielded, not outside if it did
/// not, with finite numbers and an integrity in (0, 1] that did not grow. The printed algorithm checks none of these,
/// and can end far from the surface or on the spurious branch of eq 48.
template <class T, int Dim, class Law>
[[nodiscard]] bool paper_result_is_sound(const Law& law, const CohesiveState<T, Dim>& begin,
                                         const CohesiveState<T, Dim>& z) {
  double ts2 = 0.0;
  for (int k = 1; k < Dim; ++k) ts2 += value(z.traction[k]) * value(z.traction[k]);
  const double w = value(z.integrity);
  if (!(w > 0.0 && w <= value(begin.integrity)) || !is_finite(z)) return false;
  const double f = law.surface.values().value_at(value(z.traction[0]), ts2, w);
  const double band = 0.01 * value(law.surface.tensile_strength);
  return f <= band && (w == value(begin.integrity) || f >= -band);
}

/// Diagonal-plus-rank-one tangent K^t of eq 35 and 67 at the current state, or the secant stiffness inside the yield
/// surface.
template <class T, int Dim, class Law>
[[nodiscard]] Mat<T, Dim, Dim> paper_tangent(const Law& law, const CohesiveState<T, Dim>& z) {
  const PaperDerivatives<T, Dim> d = paper_derivatives(law, z.traction, z.integrity);
  Mat<T, Dim, Dim> kt;
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) {
      const T m = d.f_t[j] * d.secant[j] / d.denominator;  // eq 65
      kt(i, j) = (d.t_d[i] * d.r - d.secant[i] * d.g_t[i]) * m;
      if (i == j) kt(i, j) += d.secant[i];
    }
  }
  return kt;
}

/// Algorithm 2, lines 17-37, on the drive d0 -> d1 (traction of the uncracked bulk times the series compliance). With
/// zero compliance the jump itself is driven and Algorithm 1 runs once.
template <class T, int Dim, class Law>
[[nodiscard]] Report integrate_paper(const Zone<Law>& zone, const Options& options, const CohesiveState<T, Dim>& begin,
                                     const Drive<T, Dim>& drive, CohesiveState<T, Dim>& end) {
  const Law& law = zone.law;
  const auto& series = zone.series;
  const Vec<T, Dim>& d0 = drive.from;
  const Vec<T, Dim>& d1 = drive.to;
  Report report;
  report.substeps = 1;
  report.iterations = 1;
  CohesiveState<T, Dim> z = begin;
  if (value(series.normal) == 0.0) {
    paper_return(law, z, Vec<T, Dim>(d1 - d0));
    if (!paper_result_is_sound(law, begin, z)) {
      report.status = Status::non_convergence;
      return report;
    }
    end = z;
    return report;
  }
  Vec<T, Dim> stiffness = Vec<T, Dim>::Constant(T(1.0 / series.shear));  // B = n.a0.n/H
  stiffness[0] = T(1.0 / series.normal);
  Vec<T, Dim> du;  // line 17, eq 56
  const PaperDerivatives<T, Dim> first = paper_derivatives(law, z.traction, z.integrity);
  for (int k = 0; k < Dim; ++k) du[k] = stiffness[k] * (d1[k] - d0[k]) / (stiffness[k] + first.secant[k]);
  paper_return(law, z, du);
  double scale = 0.0;  // |n.sigma_0| of eq 62: the traction at onset
  for (int k = 0; k < Dim; ++k) {
    const double t = value((k == 0 ? law.kn : law.ks) * z.offset[k]);
    scale += t * t;
  }
  scale = std::sqrt(scale);
  for (;; ++report.iterations) {
    Vec<T, Dim> r;  // eq 57
    double norm = 0.0;
    for (int k = 0; k < Dim; ++k) {
      r[k] = stiffness[k] * (d1[k] - z.jump[k]) - z.traction[k];
      norm += value(r[k]) * value(r[k]);
    }
    norm = std::sqrt(norm);
    if (norm <= options.tolerance * scale && value(z.integrity) > 0.0 && value(z.integrity) <= value(begin.integrity))
      break;
    if (report.iterations >= options.max_iterations || !std::isfinite(norm) || !(value(z.integrity) > 0.0)) {
      report.status = Status::non_convergence;
      return report;
    }
    T ts2 = T(0.0);
    for (int k = 1; k < Dim; ++k) ts2 += z.traction[k] * z.traction[k];
    Mat<T, Dim, Dim> c = Mat<T, Dim, Dim>::Constant(T(0.0));
    // Line 29: eq 67 holds while the point yields; inside the surface the tangent is the secant stiffness.
    const double inside = -1e-9 * value(law.surface.cohesion) * value(law.surface.cohesion);
    if (value(law.surface.printed_value(z.traction[0], ts2, z.integrity)) >
        inside * value(z.integrity) * value(z.integrity)) {
      c = paper_tangent(law, z);
    } else {
      const PaperDerivatives<T, Dim> d = paper_derivatives(law, z.traction, z.integrity);
      for (int k = 0; k < Dim; ++k) c(k, k) = d.secant[k];
    }
    for (int k = 0; k < Dim; ++k) c(k, k) += stiffness[k];
    paper_return(law, z, Vec<T, Dim>(c.inverse() * r));  // lines 30-34, eq 59-61
  }
  if (!paper_result_is_sound(law, begin, z)) {
    report.status = Status::non_convergence;
    return report;
  }
  end = z;
  return report;
}

}  // namespace fpz::detail
