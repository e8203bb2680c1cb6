// Jump control (arc length): the inelastic displacement kappa = up_n + up_s drives the point instead of the size of the
// strain.
//
// Along strain = begin + x * direction the rate equations (rate.hpp) give dx/dkappa = h / numerator, which passes
// smoothly through h = 0: where strain control snaps back, x just turns round. So softening that is too brittle for its
// H can still be followed.
#pragma once

#include "fpz/double_scale.hpp"

namespace fpz {

namespace detail {

/// Yielding along a fixed drive direction with kappa as the independent variable: y = (tau_s, x, kappa).
template <int Dim>
class ControlledPhase {
 public:
  static constexpr int NS = Dim - 1;
  static constexpr int N = NS + 2;
  using Shear = Vec<double, NS>;
  using Y = Vec<double, N>;

  ControlledPhase(const CohesiveLaw<double>& law, const SeriesCompliance<double>& series, double w_begin,
                  const Vec<double, Dim>& rate)
      : law_(law), series_(series), w_begin_(w_begin), rate_(rate) {}

  Branch branch;

  template <class T>
  [[nodiscard]] RatePoint<T, NS> point(const Vec<T, N>& y) const {
    const Vec<T, NS> heading = convert<T>(Vec<double, NS>(rate_.template tail<NS>()));
    const T w = w_begin_ * integrity_ratio(law_, y[NS + 1]);
    return rate_point<NS>(law_, series_, branch, Vec<T, NS>(y.template head<NS>()), w, heading);
  }

  /// dy/dkappa; false where the direction does not load the zone at all.
  template <class T>
  [[nodiscard]] bool rates(const Vec<T, N>& y, Vec<T, N>& f) const {
    const RatePoint<T, NS> r = point<T>(y);
    const Vec<T, NS> rate_s = convert<T>(Vec<double, NS>(rate_.template tail<NS>()));
    const T numerator = loading(r, T(rate_[0]), rate_s);
    if (value(numerator) == 0.0) return false;
    const T x_rate = r.h / numerator;
    for (int k = 0; k < NS; ++k) f[k] = (rate_s[k] * x_rate - r.m22[k]) * r.inverse_cs;
    f[NS] = x_rate;
    f[NS + 1] = T(1.0);
    return true;
  }

  [[nodiscard]] Mat<double, N, N> jacobian(const Y& y) const {
    using D = Dual<N>;
    Vec<D, N> seeded;
    for (int k = 0; k < N; ++k) seeded[k] = D::seed(y[k], k);
    Vec<D, N> f = Vec<D, N>::Constant(D(0.0));
    Mat<double, N, N> j = Mat<double, N, N>::Zero();
    if (rates<D>(seeded, f)) {
      for (int k = 0; k < N; ++k) j.row(k) = f[k].grad.transpose();
    }
    return j;
  }

  /// Dissipated energy per unit kappa.
  [[nodiscard]] double power(const Y& y) const {
    const RatePoint<double, NS> r = point<double>(y);
    return r.w * dissipation_density(law_, r.hyp, r.shear, r.inv);
  }

  /// True when y left the smooth branch.
  [[nodiscard]] bool left_branch(const Y& y) const {
    const RatePoint<double, NS> r = point<double>(y);
    return (branch.tension ? r.hyp.normal : -r.hyp.normal) < 0.0 || (NS == 1 && r.shear < 0.0);
  }

  /// Takes the branch on which y moves on.
  void choose(const Y& y) {
    if constexpr (NS == 1) {
      const double s = y[0] != 0.0 ? y[0] : rate_[1];
      branch.shear_sign = s < 0.0 ? -1.0 : 1.0;
    }
    branch.tension = true;
    const RatePoint<double, NS> r = point<double>(y);
    if (std::abs(r.hyp.normal) > 1e-9 * law_.tensile_strength) {
      branch.tension = r.hyp.normal > 0.0;
      return;
    }
    Y f = Y::Zero();
    branch.tension = !rates<double>(y, f) || r.normal_s.dot(f.template head<NS>()) >= 0.0;
  }

 private:
  const CohesiveLaw<double>& law_;
  const SeriesCompliance<double>& series_;
  double w_begin_;
  Vec<double, Dim> rate_;
};

/// Runs the phase over `length` of kappa; y and the dissipated energy are updated.
template <int Dim>
[[nodiscard]] Status run_controlled(ControlledPhase<Dim>& phase, const Options& options, double strength, double delta0,
                                    double length, typename ControlledPhase<Dim>::Y& y, double& dissipated,
                                    Report& report) {
  using Phase = ControlledPhase<Dim>;
  using Y = typename Phase::Y;
  constexpr int NS = Dim - 1;
  const double tolerance = local_tolerance_fraction * options.tolerance;
  double step = std::min(length, 0.1 * delta0);
  phase.choose(y);
  while (y[NS + 1] < length) {
    if (report.iterations >= options.max_substeps) return Status::non_convergence;
    ++report.iterations;
    const double left = length - y[NS + 1];
    const bool last = step >= left * (1.0 - 1e-12);
    double h = last ? left : step;
    Y f = Y::Zero();
    if (!phase.template rates<double>(y, f)) return Status::non_convergence;
    const auto jac = phase.jacobian(y);
    const auto field = [&](const Y& at, Y& out) { return phase.template rates<double>(at, out); };
    RodasStep<double, Phase::N> trial = rodas_step<double, Phase::N>(y, f, jac, h, field);
    const double x_scale = std::max(std::abs(trial.y[NS]), 1e-3 * std::abs(f[NS]) * delta0) + 1e-300;
    const double error = trial.defined ? std::max(trial.error.template head<NS>().norm() / strength,
                                                  std::abs(trial.error[NS]) / x_scale) /
                                             tolerance
                                       : 1e9;
    if (!(error <= 1.0)) {
      step = h * std::max(0.1, 0.9 * std::pow(error, -0.25));
      if (step < 1e-14 * delta0) return Status::non_convergence;
      continue;
    }
    bool crossed = false;
    if (phase.left_branch(trial.y) && h > 1e-12 * delta0) {  // step onto the boundary of the branch by bisection
      double lo = 0.0;
      double hi = h;
      for (int k = 0; k < 60 && hi - lo > 1e-14 * h; ++k) {
        const double mid = 0.5 * (lo + hi);
        (phase.left_branch(rodas_step<double, Phase::N>(y, f, jac, mid, field).y) ? hi : lo) = mid;
      }
      h = hi;
      trial = rodas_step<double, Phase::N>(y, f, jac, h, field);
      crossed = true;
    }
    Y f1 = Y::Zero();
    if (!phase.template rates<double>(trial.y, f1)) return Status::non_convergence;
    const Y middle = 0.5 * (y + trial.y) + (f - f1) * (h / 8.0);
    dissipated += (phase.power(y) + 4.0 * phase.power(middle) + phase.power(trial.y)) * (h / 6.0);
    y = trial.y;
    ++report.substeps;
    if (last && !crossed) break;
    if (crossed) {
      if (NS == 1 && std::abs(y[0]) < 1e-9 * strength) y[0] = 0.0;
      phase.choose(y);
    }
    step = h * std::min(5.0, 0.9 * std::pow(error + 1e-12, -0.25));
  }
  return Status::ok;
}

/// Scales a direction until `reached` holds, by doubling from a small strain; negative when it never does.
template <class F>
[[nodiscard]] double expand_until(const F& reached) {
  for (double x = 1e-9; x < 1e3; x *= 2.0) {
    if (reached(x)) return x;
  }
  return -1.0;
}

}  // namespace detail

/// Advances the inelastic displacement kappa = up_n + up_s (m) by exactly `dkappa` > 0 along begin.strain + load_factor
/// * direction / |direction|_max; load_factor (a strain) is found and may be negative where the path snaps back. An
/// uncracked or elastic begin state first goes elastically, along +direction, to onset or yield. Integrated with the
/// `accurate` scheme to options.tolerance whatever options.method says. On failure `end` equals `begin`:
/// non_convergence means that the direction never loads the zone.
template <int Dim>
[[nodiscard]] Report update_controlled(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                                       const Tensor<double, Dim>& direction, double dkappa, State<double, Dim>& end,
                                       double& load_factor) {
  constexpr int NS = Dim - 1;
  using Phase = detail::ControlledPhase<Dim>;
  const State<double, Dim> saved = begin;
  load_factor = 0.0;
  end = saved;
  const double size = direction.template lpNorm<Eigen::Infinity>();
  Report report;
  const auto fail = [&](Status s) {
    report.status = s;
    return report;
  };
  if (!is_finite(direction) || !std::isfinite(dkappa) || !(size > 0.0) || !(dkappa > 0.0))
    return fail(Status::invalid_input);
  const Tensor<double, Dim> unit = direction / size;

  State<double, Dim> s = saved;
  double x = 0.0;
  if (!s.cracked) {
    const Tensor<double, Dim> stress_rate = m.bulk.template stress<double, Dim>(unit);
    const double reach = detail::expand_until([&](double length) {
      return critical_plane<Dim>(m, Tensor<double, Dim>(s.stress + length * stress_rate)).failure_value >= 0.0;
    });
    if (reach < 0.0) return fail(Status::non_convergence);
    const Tensor<double, Dim> far = s.stress + reach * stress_rate;
    x = reach * onset_fraction<Dim>(m, s.stress, far);
    s.strain += x * unit;
    s.stress += x * stress_rate;
    const Plane<double, Dim> plane = detail::find_plane<Dim>(m, o, s.stress);
    s.cracked = true;
    s.frame = plane.frame;
    s.crack = cracked_at<double, Dim>(m.law, plane.traction);
    report.onset = true;
  }
  CohesiveState<double, Dim>& z = s.crack;
  const Vec<double, Dim> rate = detail::drive<double, Dim>(m, s.frame, unit);
  const Vec<double, Dim> q0 = detail::drive<double, Dim>(m, s.frame, s.strain) + z.offset - z.plastic_jump;
  double entry = -1.0;
  const double reach = detail::expand_until([&](double length) {
    entry = detail::yield_entry<Dim>(m.law, m.series, z.integrity, q0, Vec<double, Dim>(rate * length)) * length;
    return entry >= 0.0;
  });
  if (reach < 0.0) return fail(Status::non_convergence);
  x += entry;
  const Vec<double, Dim> q = q0 + rate * entry;
  typename Phase::Y y;
  y.template head<NS>() = q.template tail<NS>() / (m.law.flexibility_s + z.integrity * m.series.shear);
  y[NS] = 0.0;
  y[NS + 1] = 0.0;
  Phase phase(m.law, m.series, z.integrity, rate);
  double dissipated = 0.0;
  const Status status =
      detail::run_controlled<Dim>(phase, o, m.law.tensile_strength, m.law.delta0, dkappa, y, dissipated, report);
  if (status != Status::ok) return fail(status);
  load_factor = x + y[NS];
  s.strain = saved.strain + load_factor * unit;
  const auto r = phase.template point<double>(y);
  const Vec<double, Dim> drive = detail::drive<double, Dim>(m, s.frame, s.strain);
  detail::end_yielding<double, Dim>(z, drive, r, y.template head<NS>(), dkappa, dissipated);
  z.jump[0] = drive[0] - m.series.normal * z.traction[0];
  for (int k = 1; k < Dim; ++k) z.jump[k] = drive[k] - m.series.shear * z.traction[k];
  s.stress = detail::macro_stress(m, s);
  end = s;
  return report;
}

extern template Report update_controlled<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                            const Tensor<double, 2>&, double, State<double, 2>&, double&);
extern template Report update_controlled<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                            const Tensor<double, 3>&, double, State<double, 3>&, double&);

}  // namespace fpz
