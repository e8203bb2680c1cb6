// update_controlled() (jump_control.hpp). Along strain = begin + x * direction the rate equations (rate.hpp) give
// dx/dkappa = h / numerator, which passes smoothly through h = 0: where strain control snaps back, x just turns round.
#include "fpz/integrators/yielding.hpp"
#include "fpz/jump_control.hpp"
#include "fpz/update_any_scalar.hpp"

namespace fpz {
namespace detail {

/// Yielding along a fixed drive direction with kappa as the independent variable: y = (tau_s, a, x), a = kappa.
template <int Dim>
class JumpPhase {
 public:
  using Scalar = double;
  using Law = CohesiveLaw<double>;
  static constexpr bool follows_drive = false;
  static constexpr int NS = Dim - 1;
  static constexpr int N = NS + 2;
  using Y = Vec<double, N>;
  using Point = RatePoint<double, NS>;

  JumpPhase(const Zone<Law>& zone, double w_begin, const Vec<double, Dim>& rate)
      : branch(strain_.branch), zone_(zone), w_begin_(w_begin), rate_(rate), strain_(zone, w_begin, rate) {}
  JumpPhase(const JumpPhase&) = delete;
  JumpPhase& operator=(const JumpPhase&) = delete;

  Branch& branch;

  [[nodiscard]] const Law& law() const { return zone_.law; }
  [[nodiscard]] const Vec<double, NS>& rate_s() const { return strain_.rate_s(); }
  [[nodiscard]] double begin_integrity() const { return w_begin_; }
  [[nodiscard]] Point point(const Y& y) const { return point_in<double>(y); }
  /// False where the direction does not load the zone at all.
  [[nodiscard]] bool solvable(const Point& r) const { return strain_.loading_at(r) != 0.0; }
  [[nodiscard]] Status failure(const Point&) const { return Status::non_convergence; }
  [[nodiscard]] Y rates(const Point& r) const { return rates_in(r); }

  [[nodiscard]] RodasStep<double, N> advance(const Y& y0, const Point& r0, const Y& f0, double h) const {
    const auto rates_at = [&](const Y& y, Y& out) {
      const Point r = point(y);
      if (!solvable(r) || !is_within_branch(law(), r)) return false;
      out = rates(r);
      return true;
    };
    if (!slides_on_closed_faces(law(), r0)) {
      return rodas_step<double, N>(y0, f0, jacobian(y0), h, rates_at, law().zone == CohesiveZone::consistent);
    }
    return unscaled_step<double, NS>(strain_.softening(), y0, f0, jacobian(y0), h, rates_at);
  }

  /// As under strain control, and the error of the load factor as the elastic stress that it would be.
  [[nodiscard]] double error_norm(const Point& r, const Y& error) const {
    const double strength = law().surface.tensile_strength;
    double load = std::abs(rate_[0]) / zone_.series.normal;
    for (int k = 1; k < Dim; ++k) load = std::max(load, std::abs(rate_[k]) / zone_.series.shear);
    return std::max(strain_.error_norm(r, Vec<double, Dim>(error.template head<Dim>())),
                    std::abs(error[NS + 1]) * load / strength);
  }

  /// Those of strain control but unloading: kappa only grows.
  [[nodiscard]] double event(YieldEvent which, const Y& y, const Point& r) const {
    return which == YieldEvent::unloading ? 1.0 : strain_.event(which, y.template head<Dim>(), r);
  }
  [[nodiscard]] double density(const Point& r) const { return strain_.density(r); }
  [[nodiscard]] double power(const Point& r, double a_rate) const { return strain_.power(r, a_rate); }

 private:
  template <class T>
  [[nodiscard]] RatePoint<T, NS> point_in(const Vec<T, N>& y) const {
    const Vec<T, NS> heading = convert<T>(rate_s());
    const T begin = T(w_begin_);
    const T w = PhaseSoftening<T, Law>{law(), branch.piece, begin}.w(y[NS]);
    return rate_point<NS>(zone_, branch, Vec<T, NS>(y.template head<NS>()), w, heading);
  }

  /// dy/dkappa.
  template <class T>
  [[nodiscard]] Vec<T, N> rates_in(const RatePoint<T, NS>& r) const {
    const Vec<T, NS> heading = convert<T>(rate_s());
    const T x_rate = r.h / loading(r, T(rate_[0]), heading);
    Vec<T, N> f;
    for (int k = 0; k < NS; ++k) f[k] = (heading[k] * x_rate - r.m22[k]) * r.inverse_cs;
    f[NS] = T(1.0);
    f[NS + 1] = x_rate;
    return f;
  }

  [[nodiscard]] Mat<double, N, N> jacobian(const Y& y) const {
    using D = Dual<N>;
    Vec<D, N> seeded;
    for (int k = 0; k < N; ++k) seeded[k] = D::seed(y[k], k);
    const Vec<D, N> f = rates_in<D>(point_in<D>(seeded));
    Mat<double, N, N> j;
    for (int k = 0; k < N; ++k) j.row(k) = f[k].grad.transpose();
    return j;
  }

  Zone<Law> zone_;
  double w_begin_;
  Vec<double, Dim> rate_;
  YieldingPhase<double, Dim, Law> strain_;
};

/// The elastic way of a cracked zone to its yield surface, in units of `rate`; nothing when it never yields.
template <int Dim>
[[nodiscard]] std::optional<double> distance_to_yield(const Zone<CohesiveLaw<double>>& zone, double w,
                                                      const Vec<double, Dim>& q, const Vec<double, Dim>& rate) {
  for (double reach = 1e-9; reach < 1e3; reach *= 2.0) {
    const double entry = yield_entry<Dim>(zone, w, q, Vec<double, Dim>(rate * reach)) * reach;
    if (entry >= 0.0) return entry;
  }
  return std::nullopt;
}

}  // namespace detail

template <int Dim>
Report update_controlled(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                         const Tensor<double, Dim>& direction, double dkappa, State<double, Dim>& end,
                         double& load_factor) {
  constexpr int NS = Dim - 1;
  using Phase = detail::JumpPhase<Dim>;
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

  // 1. Elastically to onset, then to yield.
  State<double, Dim> s = saved;
  double x = 0.0;
  if (!s.cracked) {
    const Tensor<double, Dim> stress_rate = m.bulk.template stress<double, Dim>(unit);
    const auto onset = distance_to_onset<Dim>(m, s.stress, stress_rate, 1e-9, 1e3);
    if (!onset) return fail(Status::non_convergence);
    x = *onset;
    go_elastically<Dim>(s, unit, stress_rate, x);
    open_crack<Dim>(m, o, s);
    report.onset = true;
  }
  CohesiveState<double, Dim>& z = s.crack;
  const Zone zone(m.law, m.series);
  const Vec<double, Dim> rate = detail::drive<double, Dim>(m, s.frame, unit);
  Vec<double, Dim> drive = detail::drive<double, Dim>(m, s.frame, s.strain);
  const auto entry =
      detail::distance_to_yield<Dim>(zone, z.integrity, Vec<double, Dim>(drive + z.offset - z.plastic_jump), rate);
  if (!entry) return fail(Status::non_convergence);
  x += *entry;

  // 2. Along the surface over dkappa, piece by piece of the softening law.
  const Vec<double, Dim> q = drive + z.offset - z.plastic_jump + rate * *entry;
  typename Phase::Y y = Phase::Y::Zero();
  y.template head<NS>() = q.template tail<NS>() / zone.shear_compliance(z.integrity);
  y[NS + 1] = x;
  double done = 0.0;
  for (;;) {
    Phase phase(zone, z.integrity, rate);
    y[NS] = 0.0;
    const auto yielded = detail::run_yielding(phase, y, done, dkappa, o, report);
    if (yielded.status != Status::ok) return fail(yielded.status);
    load_factor = yielded.y[NS + 1];
    drive = detail::drive<double, Dim>(m, s.frame, Tensor<double, Dim>(saved.strain + load_factor * unit));
    detail::end_yielding<Dim>(z, drive, phase, yielded);
    if (!yielded.kinked) break;
    done = yielded.position;
    y = yielded.y;
    if (done >= dkappa) break;
  }
  s.strain = saved.strain + load_factor * unit;
  z.jump = detail::continuous_jump(m.series, drive, z.traction);
  s.stress = detail::macro_stress(m, s);
  end = s;
  return report;
}

}  // namespace fpz
