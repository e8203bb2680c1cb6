// Crack planes: local frames, tractions on a plane, and the tensors that a jump on it makes.
#pragma once

#include "fpz/types.hpp"

namespace fpz {

/// Local frame from the normal: s1 is n turned by +90 degrees about z (2-D), or s1 = s2 x n with the given s2 (3-D).
template <class T>
[[nodiscard]] Mat<T, 2, 2> frame_from(const Vec<T, 2>& n) {
  Mat<T, 2, 2> r;
  r << n[0], n[1], -n[1], n[0];
  return r;
}
template <class T>
[[nodiscard]] Mat<T, 3, 3> frame_from(const Vec<T, 3>& n, const Vec<T, 3>& s2) {
  Mat<T, 3, 3> r;
  for (int k = 0; k < 3; ++k) {
    r(0, k) = n[k];
    r(1, k) = s2[(k + 1) % 3] * n[(k + 2) % 3] - s2[(k + 2) % 3] * n[(k + 1) % 3];
    r(2, k) = s2[k];
  }
  return r;
}

/// Traction R sigma n on the plane of a frame (eq 55), local components, Pa. Scalar arithmetic throughout: packed loads
/// of freshly stored components would stall, and this is called twice in every update of a cracked point.
template <class T, int Dim>
[[nodiscard]] FPZ_INLINE Vec<T, Dim> local_traction(const Mat<T, Dim, Dim>& frame, const Tensor<T, Dim>& stress) {
  Vec<T, Dim> global, local;
  if constexpr (Dim == 2) {
    global[0] = stress[0] * frame(0, 0) + stress[2] * frame(0, 1);
    global[1] = stress[2] * frame(0, 0) + stress[1] * frame(0, 1);
  } else {
    global[0] = stress[0] * frame(0, 0) + stress[3] * frame(0, 1) + stress[4] * frame(0, 2);
    global[1] = stress[3] * frame(0, 0) + stress[1] * frame(0, 1) + stress[5] * frame(0, 2);
    global[2] = stress[4] * frame(0, 0) + stress[5] * frame(0, 1) + stress[2] * frame(0, 2);
  }
  for (int i = 0; i < Dim; ++i) {
    local[i] = frame(i, 0) * global[0];
    for (int k = 1; k < Dim; ++k) local[i] += frame(i, k) * global[k];
  }
  return local;
}

/// Components of sym(n (x) U): the strain, times a length, of a jump U on a plane (eq 33-34).
template <class T, int Dim>
[[nodiscard]] FPZ_INLINE Tensor<T, Dim> symmetric_product(const Vec<T, Dim>& n, const Vec<T, Dim>& jump) {
  Tensor<T, Dim> e;
  for (int k = 0; k < Dim; ++k) e[k] = n[k] * jump[k];
  e[Dim] = 0.5 * (n[0] * jump[1] + n[1] * jump[0]);
  if constexpr (Dim == 3) {
    e[4] = 0.5 * (n[0] * jump[2] + n[2] * jump[0]);
    e[5] = 0.5 * (n[1] * jump[2] + n[2] * jump[1]);
  }
  return e;
}

}  // namespace fpz
