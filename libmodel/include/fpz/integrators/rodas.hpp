// RODAS: a linearly implicit Runge-Kutta (Rosenbrock) method of order 4 with an embedded one of order 3, L-stable and
// stiffly accurate. Coefficients from Hairer & Wanner, Solving Ordinary Differential Equations II (2nd ed.), section
// IV.7. It needs one Jacobian and one small inverse per step and no iteration, so a step cannot fail to converge.
#pragma once

#include <Eigen/LU>

#include "fpz/types.hpp"

namespace fpz::detail {

struct Rodas {
  static constexpr int stages = 6;
  static constexpr double gamma = 0.25;
  static constexpr double a[6][5] = {
      {},
      {1.544000000000000},
      {0.9466785280815826, 0.2557011698983284},
      {3.314825187068521, 2.896124015972201, 0.9986419139977817},
      {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950},
      {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1.0}};
  static constexpr double c[6][5] = {
      {},
      {-5.668800000000000},
      {-2.430093356833875, -0.2063599157091915},
      {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
      {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
      {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
  /// Dense output of order 3 (the same book, section VI.4, and its program RODAS): at the middle y = (y0 + y1)/2 +
  /// sum_i (d[0][i]/4 + d[1][i]/8) u_i. Good in stiff phases too, where Hermite's is not.
  static constexpr double d[2][5] = {
      {10.12623508344586, -7.487995877610167, -34.80091861555747, -7.992771707568823, 1.025137723295662},
      {-0.6762803392801253, 6.087714651680015, 16.43084320892478, 24.76722511418386, -6.594389125716872}};
};

template <class T, int N>
struct RodasStep {
  bool defined = false;  ///< false: the rates do not exist at a stage
  Vec<T, N> y;
  Vec<T, N> error;   ///< difference to the embedded third-order solution
  Vec<T, N> middle;  ///< half way, where it is wanted
};

/// One step of size h for the autonomous system y' = f(y). `rates(y, f)` writes f and returns whether it exists.
template <class T, int N, class F>
[[nodiscard]] RodasStep<T, N> rodas_step(const Vec<T, N>& y0, const Vec<T, N>& f0, const Mat<T, N, N>& jacobian,
                                         const T& h, const F& rates, bool with_middle = false) {
  RodasStep<T, N> out;
  Mat<T, N, N> e = -jacobian;
  const T diagonal = 1.0 / (h * Rodas::gamma);
  for (int k = 0; k < N; ++k) e(k, k) += diagonal;
  const Mat<T, N, N> inverse = e.inverse();
  Vec<T, N> u[Rodas::stages];
  Vec<T, N> yi = y0;
  for (int i = 0; i < Rodas::stages; ++i) {
    Vec<T, N> rhs = f0;
    if (i > 0) {
      yi = y0;
      for (int j = 0; j < i; ++j) yi += u[j] * T(Rodas::a[i][j]);
      if (!rates(yi, rhs)) return out;
      for (int j = 0; j < i; ++j) rhs += u[j] * T(Rodas::c[i][j] / h);
    }
    u[i] = inverse * rhs;
  }
  out.y = yi + u[Rodas::stages - 1];
  out.error = u[Rodas::stages - 1];
  out.defined = is_finite(out.y);
  if (with_middle) {
    out.middle = (y0 + out.y) * T(0.5);
    for (int i = 0; i < 5; ++i) out.middle += u[i] * T(0.25 * Rodas::d[0][i] + 0.125 * Rodas::d[1][i]);
  }
  return out;
}

}  // namespace fpz::detail
