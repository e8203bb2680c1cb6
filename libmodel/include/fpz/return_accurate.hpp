// The `accurate` integrator: elastic phases in closed form, yielding phases by the adaptive Rosenbrock method RODAS of
// order 4(3) (Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7; stiffly accurate and L-stable)
// on the rate equations of rate.hpp. The yield condition and traction continuity hold to rounding at every accepted
// step, because the ODE runs on the yield surface itself.
#pragma once

#include "fpz/options.hpp"
#include "fpz/rate.hpp"
#include "fpz/rodas.hpp"

namespace fpz::detail {

/// One yielding phase: state y = (tau_s, a) relative to the integrity at its begin, driven at constant rate.
template <class T, int Dim, class P>
class YieldingPhase {
 public:
  static constexpr int NS = Dim - 1;
  using Y = Vec<T, Dim>;  ///< (tau_s components, a)
  using Shear = Vec<T, NS>;

  YieldingPhase(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, const T& w_begin, const Vec<T, Dim>& rate)
      : law_(law), series_(series), w_begin_(w_begin), rate_n_(rate[0]), rate_s_(rate.template tail<NS>()) {}

  Branch branch;

  [[nodiscard]] static Shear shear_of(const Y& y) { return y.template head<NS>(); }
  [[nodiscard]] T integrity(const Y& y) const { return w_begin_ * integrity_ratio(law_, y[NS]); }
  [[nodiscard]] RatePoint<T, NS> point(const Y& y) const {
    return rate_point<NS>(law_, series_, branch, shear_of(y), integrity(y), rate_s_);
  }
  [[nodiscard]] T loading_at(const RatePoint<T, NS>& r) const { return loading(r, rate_n_, rate_s_); }
  [[nodiscard]] static Y pack(const Rates<T, NS>& f) {
    Y y;
    y.template head<NS>() = f.tau_s;
    y[NS] = f.a;
    return y;
  }
  [[nodiscard]] Y rates(const RatePoint<T, NS>& r) const { return pack(solve_rates(r, rate_n_, rate_s_)); }
  [[nodiscard]] const Shear& rate_s() const { return rate_s_; }

  /// Dissipated energy per unit of the increment at a point with inelastic rate a'.
  [[nodiscard]] T power(const RatePoint<T, NS>& r, const T& a_rate) const { return r.w * a_rate * density(r); }

  /// The same per unit of (w da).
  [[nodiscard]] T density(const RatePoint<T, NS>& r) const { return dissipation_density(law_, r.hyp, r.shear, r.inv); }

  /// One RODAS step of size h from y0, whose coefficients `r0` and rates `f0` are given. Undefined where a stage meets
  /// h <= 0: the rate problem has no unique solution there.
  [[nodiscard]] RodasStep<T, Dim> advance(const Y& y0, const RatePoint<T, NS>& r0, const Y& f0, const T& h) const {
    Rates<T, NS> f;
    f.tau_s = f0.template head<NS>();
    f.a = f0[NS];
    return rodas_step<T, Dim>(y0, f0, rate_jacobian(law_, r0, shear_of(y0), f), h, [&](const Y& y, Y& out) {
      const RatePoint<T, NS> r = point(y);
      if (!(value(r.h) > 0.0)) return false;
      out = rates(r);
      return true;
    });
  }

  /// Error of a step against the tolerance on t/sigma_t0 and D. When w -> 0 the traction vanishes, but the scaled
  /// traction still sets where a closing crack meets resistance (up_n = q_n - c_n tau_n), so it keeps a weight,
  /// relative to its size.
  [[nodiscard]] double error_norm(const RatePoint<T, NS>& r, const Y& error) const {
    const double w = value(r.w);
    const double strength = value(law_.tensile_strength);
    const double open = value(law_.flexibility_n);
    const double bulk = value(series_.normal);
    const double level = (std::abs(value(r.hyp.normal)) + value(r.shear)) / strength;
    const double contact = (open + w * bulk) / ((open + bulk) * (1.0 + level));
    const double weight = std::max(w, contact) / strength;
    double shear2 = 0.0;
    double normal = 0.0;
    for (int k = 0; k < NS; ++k) {
      shear2 += value(error[k]) * value(error[k]);
      normal += value(r.normal_s[k]) * value(error[k]);
    }
    const double damage_error = w * std::abs(value(error[NS])) / value(law_.delta0) * std::max(1.0, level);
    return std::max({std::sqrt(shear2) * weight, std::abs(normal) * weight, damage_error});
  }

  /// Smooth functions that are positive while the branch holds: loading, sign of tau_n, sign of the shear.
  static constexpr int event_count = 3;
  [[nodiscard]] T event(int which, const RatePoint<T, NS>& r) const {
    if (which == 0) return loading_at(r);
    if (which == 1) return branch.tension ? r.hyp.normal : T(-r.hyp.normal);
    return NS == 1 && branch.shear ? r.shear : T(1.0);
  }

 private:
  const CohesiveLaw<P>& law_;
  const SeriesCompliance<P>& series_;
  T w_begin_;
  T rate_n_;
  Shear rate_s_;
};

/// Step length at which event `which` passes zero inside (0, h), and the derivative carried over to duals.
template <class T, int Dim, class P>
[[nodiscard]] T locate_event(const YieldingPhase<T, Dim, P>& phase, const Vec<T, Dim>& y0,
                             const RatePoint<T, Dim - 1>& r0, const Vec<T, Dim>& f0, double h, int which) {
  const auto at = [&](const T& x) { return phase.event(which, phase.point(phase.advance(y0, r0, f0, x).y)); };
  double lo = 0.0;
  double hi = h;
  double e_lo = value(phase.event(which, r0));
  double e_hi = value(at(T(h)));
  const double scale = std::max(std::abs(e_lo), std::abs(e_hi));
  double x = h;
  int side = 0;
  for (int k = 0; k < 100 && hi - lo > 1e-15 * h; ++k) {  // Illinois
    x = (e_lo * hi - e_hi * lo) / (e_lo - e_hi);
    if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
    const double e = value(at(T(x)));
    if (std::abs(e) <= 1e-14 * scale) break;
    if (e > 0.0) {
      lo = x;
      e_lo = e;
      if (side == 1) e_hi *= 0.5;
      side = 1;
    } else {
      hi = x;
      e_hi = e;
      if (side == -1) e_lo *= 0.5;
      side = -1;
    }
  }
  if constexpr (std::floating_point<T>) {
    return x;
  } else {
    const double dx = 1e-6 * std::max(x, 1e-9 * h);
    const double slope = (value(at(T(x + dx))) - value(at(T(x - dx)))) / (2.0 * dx);
    const T e = at(T(x));
    return slope != 0.0 ? T(T(x) - (e - value(e)) / slope) : T(x);
  }
}

}  // namespace fpz::detail
