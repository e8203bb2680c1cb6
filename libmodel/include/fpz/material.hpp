// Constants of the bulk and of the cohesive law, derived once from the parameters.
#pragma once

#include <cmath>

#include "fpz/parameters.hpp"
#include "fpz/types.hpp"

namespace fpz {

/// Linear elastic bulk, sigma = lambda tr(eps) I + 2 mu eps on the stored components. For plane stress `lambda` is the
/// condensed 2 lambda mu / (lambda + 2 mu), so that the in-plane law keeps this form.
template <class P>
struct Elasticity {
  P lambda{};
  P mu{};
  P nu{};

  template <class T, int Dim>
  [[nodiscard]] FPZ_INLINE Tensor<T, Dim> stress(const Tensor<T, Dim>& strain) const {
    T trace = strain[0] + strain[1];
    if constexpr (Dim == 3) trace += strain[2];
    const T pressure = lambda * trace;
    const P two_mu = 2.0 * mu;
    Tensor<T, Dim> s;
    for (int k = 0; k < Dim; ++k) s[k] = pressure + two_mu * strain[k];
    for (int k = Dim; k < tensor_size<Dim>; ++k) s[k] = two_mu * strain[k];
    return s;
  }
};

/// Constants of the mixed-mode cohesive law (eq 44-50), with the reciprocals that the inner loops multiply by.
template <class P>
struct CohesiveLaw {
  P kn{};                ///< Kn, Pa/m
  P ks{};                ///< Ks, Pa/m
  P tensile_strength{};  ///< sigma_t0, Pa
  P cohesion{};          ///< c0, Pa
  P tan_phi{};
  P tan_psi{};
  P delta0{};         ///< m
  P apex{};           ///< A = c0 - sigma_t0 tan phi, Pa: the scale of the yield hyperbola
  P flexibility_n{};  ///< 1/Kn, m/Pa
  P flexibility_s{};  ///< 1/Ks, m/Pa
  P cot_phi{};
  P inverse_delta0{};  ///< 1/m
  P inverse_apex{};    ///< 1/Pa
  P normal_0{};        ///< on the surface tau_n = normal_0 - cot(phi) R with R = sqrt(|tau_s|^2 + A^2)
  P flow_0{};          ///< on the surface m_n = tan(psi) (c0 - tau_n tan(psi)) = flow_0 + flow_1 R
  P flow_1{};
};

/// Compliance in series with the cohesive zone, in the local frame: jump = drive - compliance * traction. The elastic
/// bulk of an RVE gives B^-1 = H diag(1/(lambda+2mu), 1/mu, 1/mu) (docs/equations.md); zero means the jump itself is
/// driven.
template <class P>
struct SeriesCompliance {
  P normal{};  ///< m/Pa
  P shear{};   ///< m/Pa
};

/// Everything an update needs to know about the material.
template <class P>
struct Material {
  Setting setting = Setting::plane_strain;
  Elasticity<P> bulk;
  CohesiveLaw<P> law;
  SeriesCompliance<P> series;
  P rve_length{};      ///< H, m
  P inverse_length{};  ///< 1/H, 1/m
  P sin_phi{};
  P cos_phi{};
};

template <class P>
[[nodiscard]] CohesiveLaw<P> make_cohesive_law(const BasicParameters<P>& p) {
  using std::tan;
  CohesiveLaw<P> law;
  law.kn = p.normal_stiffness;
  law.ks = p.shear_stiffness;
  law.tensile_strength = p.tensile_strength;
  law.cohesion = p.cohesion;
  law.tan_phi = tan(p.friction_angle_deg * degree);
  law.tan_psi = tan(p.dilation_angle_deg * degree);
  law.delta0 = p.delta0;
  law.apex = p.cohesion - p.tensile_strength * law.tan_phi;
  law.flexibility_n = 1.0 / p.normal_stiffness;
  law.flexibility_s = 1.0 / p.shear_stiffness;
  law.cot_phi = 1.0 / law.tan_phi;
  law.inverse_delta0 = 1.0 / p.delta0;
  law.inverse_apex = 1.0 / law.apex;
  law.normal_0 = law.cohesion * law.cot_phi;
  law.flow_0 = law.tan_psi * (law.cohesion - law.tan_psi * law.normal_0);
  law.flow_1 = law.tan_psi * law.tan_psi * law.cot_phi;
  return law;
}

/// Replaces the RVE length H (m); everything else is kept. Cheap: two divisions.
template <class P>
void set_rve_length(Material<P>& m, const P& length) {
  m.rve_length = length;
  m.inverse_length = 1.0 / length;
  m.series.normal = length / (m.bulk.lambda + 2.0 * m.bulk.mu);
  m.series.shear = length / m.bulk.mu;
}

/// Derives the constants. The parameters must have passed validate(); this function does not check them again.
template <class P>
[[nodiscard]] Material<P> make_material(const BasicParameters<P>& p, Setting setting) {
  using std::cos;
  using std::sin;
  Material<P> m;
  m.setting = setting;
  m.bulk.nu = p.poisson_ratio;
  m.bulk.mu = p.young_modulus / (2.0 * (1.0 + p.poisson_ratio));
  m.bulk.lambda = p.young_modulus * p.poisson_ratio / ((1.0 + p.poisson_ratio) * (1.0 - 2.0 * p.poisson_ratio));
  if (setting == Setting::plane_stress)
    m.bulk.lambda = p.young_modulus * p.poisson_ratio / (1.0 - p.poisson_ratio * p.poisson_ratio);
  m.law = make_cohesive_law(p);
  m.sin_phi = sin(p.friction_angle_deg * degree);
  m.cos_phi = cos(p.friction_angle_deg * degree);
  set_rve_length(m, p.rve_length);
  return m;
}

/// The plain values of a law or compliance that carries derivatives: solvers iterate on these. A plain one is passed
/// through.
template <class P>
[[nodiscard]] CohesiveLaw<double> values(const CohesiveLaw<P>& a) {
  return {value(a.kn),
          value(a.ks),
          value(a.tensile_strength),
          value(a.cohesion),
          value(a.tan_phi),
          value(a.tan_psi),
          value(a.delta0),
          value(a.apex),
          value(a.flexibility_n),
          value(a.flexibility_s),
          value(a.cot_phi),
          value(a.inverse_delta0),
          value(a.inverse_apex),
          value(a.normal_0),
          value(a.flow_0),
          value(a.flow_1)};
}
[[nodiscard]] inline const CohesiveLaw<double>& values(const CohesiveLaw<double>& a) { return a; }
template <class P>
[[nodiscard]] SeriesCompliance<double> values(const SeriesCompliance<P>& a) {
  return {value(a.normal), value(a.shear)};
}
[[nodiscard]] inline const SeriesCompliance<double>& values(const SeriesCompliance<double>& a) { return a; }

}  // namespace fpz
