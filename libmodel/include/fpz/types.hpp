// Vectors, tensor components, settings and statuses shared by the whole library. SI units; tension positive; shear
// strains are tensor components (not engineering shears).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "fpz/scalar.hpp"
#include "fpz/words.hpp"

namespace fpz {

/// One degree in radians.
inline constexpr double degree = 3.14159265358979323846 / 180.0;

/// Stored vectors and matrices: unaligned, so that a state has one size whatever the compiler's flags are.
template <class T, int N>
using Vec = Eigen::Matrix<T, N, 1, Eigen::DontAlign>;
template <class T, int R, int C>
using Mat = Eigen::Matrix<T, R, C, Eigen::DontAlign | (R == 1 && C != 1 ? Eigen::RowMajor : Eigen::ColMajor)>;

/// Number of stored components of a symmetric tensor: 2-D (xx, yy, xy); 3-D (xx, yy, zz, xy, xz, yz).
template <int Dim>
inline constexpr int tensor_size = Dim == 2 ? 3 : 6;

template <class T, int Dim>
using Tensor = Vec<T, tensor_size<Dim>>;

/// Kinematic setting. Both plane settings use the 2-D types; the out-of-plane components are derived.
enum class Setting : std::uint8_t { plane_strain, plane_stress, three_d };

/// The outcome of an update. Anything but `ok` leaves the end state equal to the begin state.
enum class Status : std::uint8_t {
  ok = 0,
  non_convergence,  ///< the integrator's iteration failed: take a smaller
                    ///< increment or another integrator
  snap_back,        ///< no unique solution under strain control (docs/equations.md):
                    ///< smaller H or jump control
  no_plastic_flow,  ///< dilation angle 0 and pure opening: the flow rule (eq 50)
                    ///< has no direction to relax the traction
  invalid_input     ///< a NaN or infinite strain or state; an integrator that does not know the material's zone
};

template <>
struct Words<Status> {
  static constexpr Word<Status> list[] = {{Status::ok, "ok"},
                                          {Status::non_convergence, "non_convergence"},
                                          {Status::snap_back, "snap_back"},
                                          {Status::no_plastic_flow, "no_plastic_flow"},
                                          {Status::invalid_input, "invalid_input"}};
};

template <>
struct Words<Setting> {
  static constexpr Word<Setting> list[] = {
      {Setting::plane_strain, "plane_strain"}, {Setting::plane_stress, "plane_stress"}, {Setting::three_d, "3d"}};
};

/// The 3x3 (2x2) matrix of a symmetric tensor's components.
template <class T, int Dim>
[[nodiscard]] Mat<T, Dim, Dim> to_matrix(const Tensor<T, Dim>& a) {
  Mat<T, Dim, Dim> m;
  if constexpr (Dim == 2) {
    m << a[0], a[2], a[2], a[1];
  } else {
    m << a[0], a[3], a[4], a[3], a[1], a[5], a[4], a[5], a[2];
  }
  return m;
}

/// Double contraction a : b of two symmetric tensors in stored components.
template <int Dim, class A, class B>
[[nodiscard]] auto double_dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  if constexpr (Dim == 2) {
    return a[0] * b[0] + a[1] * b[1] + 2.0 * (a[2] * b[2]);
  } else {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
  }
}

template <class T, int N>
[[nodiscard]] FPZ_INLINE T squared_norm(const Vec<T, N>& v) {
  T s = T(0.0);
  for (int k = 0; k < N; ++k) s += v[k] * v[k];
  return s;
}

template <class T, int N>
[[nodiscard]] bool is_finite(const Vec<T, N>& v) {
  for (int k = 0; k < N; ++k) {
    if (!std::isfinite(value(v[k]))) return false;
  }
  return true;
}

/// Component-wise conversion between scalar types (constants lifted to duals, or values taken from them).
template <class To, class From, int R, int C, int O>
[[nodiscard]] Eigen::Matrix<To, R, C, O> convert(const Eigen::Matrix<From, R, C, O>& a) {
  Eigen::Matrix<To, R, C, O> b;
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    if constexpr (std::floating_point<To>) {
      b.data()[k] = value(a.data()[k]);
    } else {
      b.data()[k] = To(a.data()[k]);
    }
  }
  return b;
}

}  // namespace fpz
