// The mixed-mode cohesive law (eq 43-50): springs, yield surface with its flow, softening; and the compliance of the
// bulk in series with it.
#pragma once

#include "fpz/law/hyperbola.hpp"
#include "fpz/law/softening.hpp"
#include "fpz/law/unloading.hpp"

namespace fpz {

/// Constants of a cohesive zone. The surface and the softening are values of their own: any struct with the members of
/// HyperbolicSurface and of ExponentialSoftening can take their place.
template <class P, class SurfaceLaw = HyperbolicSurface<P>, class SofteningLaw = Softening<P>>
struct CohesiveLaw {
  using Scalar = P;
  using Surface = SurfaceLaw;

  P kn{};             ///< Kn, Pa/m, as in use (unloading_stiffness())
  P ks{};             ///< Ks, Pa/m
  P flexibility_n{};  ///< 1/Kn, m/Pa
  P flexibility_s{};  ///< 1/Ks, m/Pa
  SurfaceLaw surface;
  SofteningLaw softening;
  CohesiveZone zone{};

  [[nodiscard]] static CohesiveLaw make(const BasicParameters<P>& p) {
    const UnloadingStiffness<P> k = unloading_stiffness(p);
    return {k.normal,
            k.shear,
            1.0 / k.normal,
            1.0 / k.shear,
            SurfaceLaw::make(p),
            SofteningLaw::make(p),
            p.choices.cohesive_zone};
  }
};

template <class P>
[[nodiscard]] CohesiveLaw<P> make_cohesive_law(const BasicParameters<P>& p) {
  return CohesiveLaw<P>::make(p);
}

/// Compliance in series with the cohesive zone, in the local frame: jump = drive - compliance * traction. The elastic
/// bulk of an RVE gives B^-1 = H diag(1/(lambda+2mu), 1/mu, 1/mu) (eq 58); zero means the jump itself is driven.
template <class P>
struct SeriesCompliance {
  P normal{};  ///< m/Pa
  P shear{};   ///< m/Pa
};

/// The plain values of a law or compliance that carries derivatives: solvers iterate on these. A plain one is passed
/// through.
template <class P, class Y, class S>
[[nodiscard]] auto values(const CohesiveLaw<P, Y, S>& a) {
  using Plain = CohesiveLaw<double, decltype(a.surface.values()), decltype(a.softening.values())>;
  return Plain{value(a.kn),          value(a.ks), value(a.flexibility_n), value(a.flexibility_s), a.surface.values(),
               a.softening.values(), a.zone};
}
template <class Y, class S>
[[nodiscard]] const CohesiveLaw<double, Y, S>& values(const CohesiveLaw<double, Y, S>& a) {
  return a;
}
template <class P>
[[nodiscard]] SeriesCompliance<double> values(const SeriesCompliance<P>& a) {
  return {value(a.normal), value(a.shear)};
}
[[nodiscard]] inline const SeriesCompliance<double>& values(const SeriesCompliance<double>& a) { return a; }

}  // namespace fpz
