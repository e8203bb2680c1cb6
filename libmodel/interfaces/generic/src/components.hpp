// Between the components of a client and those of the model. A client has xx, yy, zz, xy, and in three dimensions xz,
// yz; its shears are sqrt(2) times the tensor components.
//
// In two dimensions the model has xx, yy, xy. Along z it stays elastic: with c = nu in the plane-strain hypotheses and
// c = 0 in plane stress, the strain eps_zz acts on the plane as c eps_zz in xx and yy, and sigma_zz = c (sigma_xx +
// sigma_yy) + E eps_zz, or 0. So a strain along z (generalised plane strain, or a thermal strain that the client has
// subtracted) is exact.
#pragma once

#include "fpz/point/behaviour.hpp"
#include "fpz/tangent.hpp"

namespace fpz::generic {

inline constexpr double root2 = 1.41421356237309504880;

/// Number of a client's components of strain or stress.
template <int Dim>
inline constexpr int components = Dim == 2 ? 4 : 6;

/// c above.
[[nodiscard]] inline double axial_ratio(const point::Behaviour& b) {
  return b.setting == Setting::plane_strain ? b.parameters.poisson_ratio : 0.0;
}

/// sigma_zz of a strain along z alone, over that strain; Pa.
[[nodiscard]] inline double axial_modulus(const point::Behaviour& b) {
  return b.setting == Setting::plane_strain ? b.parameters.young_modulus : 0.0;
}

/// Model strain of a client's strain.
template <int Dim>
[[nodiscard]] Tensor<double, Dim> model_strain(const point::Behaviour& b, const double* gradient) {
  Tensor<double, Dim> e;
  if constexpr (Dim == 2) {
    const double axial = axial_ratio(b) * gradient[2];
    e << gradient[0] + axial, gradient[1] + axial, gradient[3] / root2;
  } else {
    for (int k = 0; k < 6; ++k) e[k] = k < 3 ? gradient[k] : gradient[k] / root2;
  }
  return e;
}

/// Model stress of a client's stress; Pa.
template <int Dim>
[[nodiscard]] Tensor<double, Dim> model_stress(const double* force) {
  Tensor<double, Dim> s;
  if constexpr (Dim == 2) {
    s << force[0], force[1], force[3] / root2;
  } else {
    for (int k = 0; k < 6; ++k) s[k] = k < 3 ? force[k] : force[k] / root2;
  }
  return s;
}

/// A client's stress of the model's; `axial_stress` is the part of sigma_zz that does not come from the plane (2-D).
template <int Dim>
void write_force(const point::Behaviour& b, const Tensor<double, Dim>& stress, double axial_stress, double* force) {
  if constexpr (Dim == 2) {
    force[0] = stress[0];
    force[1] = stress[1];
    force[2] = axial_ratio(b) * (stress[0] + stress[1]) + axial_stress;
    force[3] = root2 * stress[2];
  } else {
    for (int k = 0; k < 6; ++k) force[k] = k < 3 ? stress[k] : root2 * stress[k];
  }
}

/// A client's operator d(force_i)/d(gradient_j), row by row, of the model's d(stress)/d(strain).
template <int Dim>
void write_operator(const point::Behaviour& b, const Tangent<Dim>& t, double* k) {
  if constexpr (Dim == 2) {
    const double c = axial_ratio(b);
    Mat<double, 3, 4> by_gradient;  // d(model stress)/d(gradient)
    by_gradient << t.col(0), t.col(1), c * (t.col(0) + t.col(1)), t.col(2) / root2;
    for (int j = 0; j < 4; ++j) {
      k[j] = by_gradient(0, j);
      k[4 + j] = by_gradient(1, j);
      k[8 + j] = c * (by_gradient(0, j) + by_gradient(1, j));
      k[12 + j] = root2 * by_gradient(2, j);
    }
    k[8 + 2] += axial_modulus(b);
  } else {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) k[6 * i + j] = t(i, j) * (i < 3 ? 1.0 : root2) / (j < 3 ? 1.0 : root2);
    }
  }
}

}  // namespace fpz::generic
