// Exponential softening, the paper's (eq 47): w = 1 - D = exp(-kappa/delta0) with kappa = up_n + up_s.
//
// w falls for ever and never reaches zero. One smooth piece, so `piece` has no meaning here.
#pragma once

#include <cmath>

#include "fpz/law/dissipation.hpp"
#include "fpz/parameters.hpp"

namespace fpz {

template <class P>
struct ExponentialSoftening {
  static constexpr const char* name = "exponential";
  static constexpr const char* meaning = "1 - D = exp(-kappa/delta0), eq 47 of the paper";

  P delta0{};          ///< m
  P inverse_delta0{};  ///< 1/m

  [[nodiscard]] static ExponentialSoftening make(const BasicParameters<P>& p) { return {p.delta0, 1.0 / p.delta0}; }
  [[nodiscard]] ExponentialSoftening<double> values() const { return {value(delta0), value(inverse_delta0)}; }

  [[nodiscard]] static int piece(double) { return 0; }
  [[nodiscard]] static P piece_end(int) { return P(-1.0); }

  template <class T>
  [[nodiscard]] FPZ_INLINE T after(int, const T& w, const T& kappa) const {
    using std::exp;
    return w * exp(-kappa * inverse_delta0);
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T after(const T& w, const T& kappa) const {
    return after(0, w, kappa);
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T slope(int, const T& w) const {
    return -w * inverse_delta0;
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T curvature(int, const T& w) const {
    return -(-w * inverse_delta0) * inverse_delta0;
  }
  template <class T>
  [[nodiscard]] T local_length(int, const T&) const {
    return T(delta0);
  }
  [[nodiscard]] double loss(int, double w, double kappa) const { return w * kappa / value(delta0); }

  // The measure is w d(kappa) = delta0 dD: in it the dissipation of a pure opening is uniform.
  [[nodiscard]] P measure() const { return delta0; }
  template <class T>
  [[nodiscard]] FPZ_INLINE T measure_rate(int, const T& w) const {
    return w;
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T density(int, const T&, const Dissipation<T>& d) const {
    return d.plastic + d.damage * inverse_delta0;
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T dissipated(const Dissipation<double>& d0, const Dissipation<T>& d1, const T& w0,
                                        const T& w1) const {
    return 0.5 * (d0.plastic + d0.damage * value(inverse_delta0) + density(0, w1, d1)) * delta0 * (w0 - w1);
  }

  template <class T>
  [[nodiscard]] T fall(const T& w0, const T& w1) const {
    using std::log;
    return delta0 * log(w0 / w1);
  }
  template <class T>
  [[nodiscard]] SofteningMoments<T> moments(int, const T& w0, const T& w1, const T&) const {
    return {T(delta0 * (w0 - w1)), T(0.5 * delta0 * (w0 - w1) * (w0 + w1))};
  }

  [[nodiscard]] P length() const { return delta0; }
  [[nodiscard]] P shortest_length() const { return delta0; }
  [[nodiscard]] P area() const { return delta0; }
  template <class T>
  [[nodiscard]] T area_to(const T& kappa) const {
    using std::exp;
    return delta0 * (1.0 - exp(-kappa * inverse_delta0));
  }
};

}  // namespace fpz
