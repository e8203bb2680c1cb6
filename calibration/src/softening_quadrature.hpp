// The work of a softening zone as a quadrature along one variable z.
//
// A path gives, at every z >= 0, the rates of jump length s and of inelastic displacement k (in units of delta0), and
// the rate of work in units of the integrity w = exp(-k):
//   s = int s' dz,   k = int k' dz,   W = int exp(-k) f dz.
// All are analytic, so Gauss points on a few panels give nearly machine precision. The panels are chosen with plain
// numbers; with derivatives the same panels are used again, as constants.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "fpz/scalar.hpp"

namespace fpz::calibration {

/// Gauss-Legendre points on [0, 1] with the weights of the integrals from 0 to each point and to 1.
struct GaussPoints {
  static constexpr int n = 10;
  std::array<double, n> at{};
  std::array<double, n> weight{};
  std::array<std::array<double, n>, n> up_to{};  ///< row i: weights of the integral from 0 to at[i]
};

namespace detail {

/// Legendre polynomials P_0 ... P_n at x.
inline std::array<double, GaussPoints::n + 1> legendre(double x) {
  std::array<double, GaussPoints::n + 1> p{};
  p[0] = 1.0;
  p[1] = x;
  for (std::size_t k = 1; k < GaussPoints::n; ++k) {
    const auto m = static_cast<double>(k);
    p[k + 1] = ((2.0 * m + 1.0) * x * p[k] - m * p[k - 1]) / (m + 1.0);
  }
  return p;
}

inline GaussPoints make_gauss_points() {
  constexpr std::size_t n = GaussPoints::n;
  GaussPoints g;
  std::array<double, n> root{};
  for (std::size_t i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int k = 0; k < 20; ++k) {
      const auto p = legendre(x);
      slope = n * (p[n - 1] - x * p[n]) / (1.0 - x * x);
      x -= p[n] / slope;
    }
    root[i] = x;
    g.at[i] = 0.5 * (1.0 + x);
    g.weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  // The Lagrange polynomials in terms of Legendre's, integrated: int P_k = (P_{k+1} - P_{k-1})/(2k+1).
  for (std::size_t i = 0; i < n; ++i) {
    const auto end = legendre(root[i]);
    for (std::size_t j = 0; j < n; ++j) {
      const auto p = legendre(root[j]);
      double sum = root[i] + 1.0;
      for (std::size_t k = 1; k < n; ++k) sum += p[k] * (end[k + 1] - end[k - 1]);
      g.up_to[i][j] = 0.5 * g.weight[j] * sum;
    }
  }
  return g;
}

}  // namespace detail

[[nodiscard]] inline const GaussPoints& gauss_points() {
  static const GaussPoints points = detail::make_gauss_points();
  return points;
}

/// Rates at one z.
template <class T>
struct SofteningRate {
  T length;     ///< s'
  T softening;  ///< k'
  T work;       ///< f
};

/// The integrals from 0 to z.
template <class T>
struct SofteningSum {
  double z = 0.0;
  T length = T(0.0);
  T softening = T(0.0);
  T work = T(0.0);
  bool admissible = true;  ///< s' > 0 and everything finite at all points
};

/// Adds one panel of width h.
template <class T, class Rates>
[[nodiscard]] SofteningSum<T> add_panel(const SofteningSum<T>& begin, double h, const Rates& rates) {
  using std::exp;
  const GaussPoints& g = gauss_points();
  std::array<SofteningRate<T>, GaussPoints::n> r;
  SofteningSum<T> end = begin;
  for (std::size_t i = 0; i < GaussPoints::n; ++i) {
    r[i] = rates(begin.z + h * g.at[i]);
    if (!(value(r[i].length) > 0.0) || !std::isfinite(value(r[i].work)) || !std::isfinite(value(r[i].softening))) {
      end.admissible = false;
      return end;
    }
  }
  for (std::size_t i = 0; i < GaussPoints::n; ++i) {
    T k = begin.softening;
    for (std::size_t j = 0; j < GaussPoints::n; ++j) k += (h * g.up_to[i][j]) * r[j].softening;
    const double weight = h * g.weight[i];
    end.length += weight * r[i].length;
    end.softening += weight * r[i].softening;
    end.work += weight * exp(-k) * r[i].work;
  }
  end.z += h;
  return end;
}

/// Where a march over panels ended, and its panels.
struct SofteningMesh {
  std::vector<double> widths;
  bool reached_end = false;  ///< the prescribed length
  bool stuck = false;        ///< the length cannot grow beyond: s' <= 0 from here on
};

/// Panels from z = 0 until the length reaches `end`, k reaches `most_softening`, or z reaches `most_z`, each as wide as
/// the agreement with its two halves allows.
template <class Rates>
[[nodiscard]] SofteningMesh make_mesh(const Rates& rates, std::optional<double> end, double most_softening,
                                      double most_z) {
  constexpr double tolerance = 1e-14;
  SofteningMesh mesh;
  SofteningSum<double> now;
  double h = 0.25;
  while (now.z < most_z && now.softening < most_softening) {
    const auto half = add_panel(now, 0.5 * h, rates);
    const auto fine = half.admissible ? add_panel(half, 0.5 * h, rates) : half;
    const auto coarse = fine.admissible ? add_panel(now, h, rates) : fine;
    const auto close = [&](double a, double b) { return std::abs(a - b) <= tolerance * std::abs(b); };
    const bool good = coarse.admissible && close(coarse.length, fine.length) &&
                      close(coarse.softening, fine.softening) && close(coarse.work, fine.work);
    if (!good && h > 1e-7) {
      h *= 0.5;
      continue;
    }
    if (!coarse.admissible) {
      mesh.stuck = true;
      return mesh;
    }
    if (end && fine.length >= *end) {  // Newton for the width of the last panel, kept in a bracket
      double lo = 0.0;
      double hi = h;
      for (int k = 0; k < 60 && hi - lo > 1e-16 * h; ++k) {
        const auto trial = add_panel(now, h, rates);
        const double miss = trial.length - *end;
        (miss > 0.0 ? hi : lo) = h;
        if (std::abs(miss) <= 1e-15 * *end) break;
        const double next = h - miss / rates(now.z + h).length;
        h = next > lo && next < hi ? next : 0.5 * (lo + hi);
      }
      mesh.widths.push_back(h);
      mesh.reached_end = true;
      return mesh;
    }
    mesh.widths.push_back(0.5 * h);
    mesh.widths.push_back(0.5 * h);
    now = fine;
    h = std::min(2.0 * h, 2.0);
  }
  return mesh;
}

/// The integrals over all panels of a mesh.
template <class T, class Rates>
[[nodiscard]] SofteningSum<T> integrate(const SofteningMesh& mesh, const Rates& rates) {
  SofteningSum<T> sum;
  for (const double h : mesh.widths) sum = add_panel(sum, h, rates);
  return sum;
}

}  // namespace fpz::calibration
