// Yielding phases: the motion of a zone on its yield surface while the drive moves in one direction, by the adaptive
// Rosenbrock method RODAS of order 4(3) (Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7;
// stiffly accurate and L-stable) on the rate equations of rate.hpp. The yield condition and traction continuity hold to
// rounding at every accepted step, because the ODE runs on the yield surface itself.
//
// run_yielding() steps any phase with the members of YieldingPhase: that one moves with the increment of strain
// (accurate.hpp), the one of jump_control.hpp with the inelastic displacement.
#pragma once

#include <optional>
#include <utility>

#include "fpz/integrators/rate.hpp"
#include "fpz/integrators/rodas.hpp"
#include "fpz/options.hpp"

namespace fpz::detail {

/// Fraction of the requested tolerance that each sub-step may use: the rest is left for accumulation along a path.
inline constexpr double local_tolerance_fraction = 0.05;
/// Largest inelastic displacement of one step, in units of the softening's length: tau_s may be known so well that its
/// error allows more, but the dissipated energy needs the softening in between.
inline constexpr double largest_softening_step = 1.0;
/// Integrity below which the energy that is left does not count.
inline constexpr double negligible_integrity = 1e-14;

/// In the consistent zone tau_s stays known to a part of its size, and does not change by more than a multiple of it in
/// one step: where closed faces of a separated zone open, the point runs over the tip of the yield surface, which is
/// tiny in t.
inline constexpr double largest_shear_error = 0.1;
inline constexpr double largest_shear_step = 2.0;

/// What ends a smooth branch.
enum class YieldEvent : int { unloading, normal_sign, shear_sign, softening_kink };
inline constexpr int yield_event_count = 4;

/// Whether a point of the consistent zone is in friction. As w falls tau = t/w grows beyond bounds there, while t
/// stays.
template <class Law, class Point>
[[nodiscard]] bool slides_on_closed_faces(const Law& law, const Point& r) {
  return law.zone == CohesiveZone::consistent && value(r.hyp.normal) < 0.0;
}

/// Whether the smooth continuation of |tau_s| beyond its zero still means something: not where m_n + |tau_s| nears
/// zero. The shear of a separated consistent zone is fast enough to get there in one step.
template <class Law, class Point>
[[nodiscard]] bool is_within_branch(const Law& law, const Point& r) {
  return law.zone == CohesiveZone::published || value(r.shear) > -0.5 * value(r.hyp.flow_n);
}

/// w and its slope as functions of the inelastic displacement a of a phase.
template <class T, class Law>
struct PhaseSoftening {
  const Law& law;
  int piece;
  const T& w_begin;

  /// On the smooth continuation of the piece: what tells where it ends.
  [[nodiscard]] T continued(const T& a) const { return law.softening.after(piece, w_begin, a); }
  [[nodiscard]] T w(const T& a) const {
    const T left = continued(a);
    const double floor = integrity_floor(law.zone);
    return floor > 0.0 && value(left) < floor ? T(floor) : left;
  }
  [[nodiscard]] T slope(const T& w) const { return law.softening.slope(piece, w); }
  [[nodiscard]] T curvature(const T& w) const { return law.softening.curvature(piece, w); }
};

/// A RODAS step of y = (tau_s, a, ..) taken in the unscaled traction t_s = w tau_s. `jacobian` and `rates` are those of
/// y.
template <class T, int NS, int N, class Curve, class F>
[[nodiscard]] RodasStep<T, N> unscaled_step(const Curve& curve, const Vec<T, N>& y0, const Vec<T, N>& f0,
                                            const Mat<T, N, N>& jacobian, const T& h, const F& rates) {
  const T w = curve.w(y0[NS]);
  const T w_a = curve.slope(w);
  const T w_aa = curve.curvature(w);
  Vec<T, N> x0 = y0;
  Vec<T, N> g0 = f0;
  for (int k = 0; k < NS; ++k) {
    x0[k] = w * y0[k];
    g0[k] = w * f0[k] + w_a * f0[NS] * y0[k];
  }
  // Rows: of w tau' + w_a a' tau. Columns: tau = t/w.
  Mat<T, N, N> j = jacobian;
  for (int k = 0; k < NS; ++k) {
    for (int c = 0; c < N; ++c) j(k, c) = w * jacobian(k, c) + w_a * jacobian(NS, c) * y0[k];
    j(k, k) += w_a * f0[NS];
    j(k, NS) += w_a * f0[k] + w_aa * f0[NS] * y0[k];
  }
  for (int r = 0; r < N; ++r) {
    for (int k = 0; k < NS; ++k) {
      j(r, k) /= w;
      j(r, NS) -= j(r, k) * w_a * y0[k];
    }
  }
  RodasStep<T, N> out = rodas_step<T, N>(
      x0, g0, j, h,
      [&](const Vec<T, N>& x, Vec<T, N>& g) {
        Vec<T, N> y = x;
        const T wx = curve.w(x[NS]);
        for (int k = 0; k < NS; ++k) y[k] = x[k] / wx;
        if (!rates(y, g)) return false;
        const T slope = curve.slope(wx);
        for (int k = 0; k < NS; ++k) g[k] = wx * g[k] + slope * g[NS] * y[k];
        return true;
      },
      true);
  const T end = curve.w(out.y[NS]);
  const T middle = curve.w(out.middle[NS]);
  for (int k = 0; k < NS; ++k) {
    out.y[k] /= end;
    out.error[k] /= end;
    out.middle[k] /= middle;
  }
  return out;
}

/// One yielding phase: state y = (tau_s, a) relative to the integrity at its begin, driven at the constant rate `rate`
/// (m per unit of the increment).
template <class T, int Dim, class LawOf>
class YieldingPhase {
 public:
  using Scalar = T;
  using Law = LawOf;
  static constexpr bool follows_drive = true;
  static constexpr int NS = Dim - 1;
  static constexpr int N = Dim;
  using Y = Vec<T, N>;  ///< (tau_s components, a)
  using Shear = Vec<T, NS>;
  using Point = RatePoint<T, NS>;

  YieldingPhase(const Zone<Law>& zone, const T& w_begin, const Vec<T, Dim>& rate)
      : zone_(zone), w_begin_(w_begin), rate_n_(rate[0]), rate_s_(rate.template tail<NS>()) {}

  Branch branch;

  [[nodiscard]] const Law& law() const { return zone_.law; }
  [[nodiscard]] PhaseSoftening<T, Law> softening() const { return {law(), branch.piece, w_begin_}; }
  [[nodiscard]] const Shear& rate_s() const { return rate_s_; }
  [[nodiscard]] double begin_integrity() const { return value(w_begin_); }

  [[nodiscard]] Point point(const Y& y) const {
    return rate_point<NS>(zone_, branch, Shear(y.template head<NS>()), softening().w(y[NS]), rate_s_);
  }
  /// Whether the rate problem has one solution (no snap-back).
  [[nodiscard]] bool solvable(const Point& r) const { return value(r.h) > 0.0; }
  [[nodiscard]] Status failure(const Point& r) const {
    return !law().surface.dilates() && value(r.hyp.normal) > 0.0 ? Status::no_plastic_flow : Status::snap_back;
  }
  [[nodiscard]] T loading_at(const Point& r) const { return loading(r, rate_n_, rate_s_); }
  [[nodiscard]] Y rates(const Point& r) const {
    const Rates<T, NS> f = solve_rates(r, rate_n_, rate_s_);
    Y y;
    y.template head<NS>() = f.tau_s;
    y[NS] = f.a;
    return y;
  }

  /// One RODAS step of size h from y0, whose coefficients `r0` and rates `f0` are given. Undefined where a stage meets
  /// an unsolvable rate problem.
  [[nodiscard]] RodasStep<T, N> advance(const Y& y0, const Point& r0, const Y& f0, const T& h) const {
    Rates<T, NS> f;
    f.tau_s = f0.template head<NS>();
    f.a = f0[NS];
    const Mat<T, N, N> jacobian = rate_jacobian(zone_, branch, r0, Shear(y0.template head<NS>()), f);
    const auto rates_at = [&](const Y& y, Y& out) {
      const Point r = point(y);
      if (!solvable(r) || !is_within_branch(law(), r)) return false;
      out = rates(r);
      return true;
    };
    if (!slides_on_closed_faces(law(), r0)) {
      return rodas_step<T, N>(y0, f0, jacobian, h, rates_at, law().zone == CohesiveZone::consistent);
    }
    return unscaled_step<T, NS>(softening(), y0, f0, jacobian, h, rates_at);
  }

  /// Error of a step against the tolerance on t/sigma_t0 and D. When w -> 0 the traction vanishes, but the scaled
  /// traction still sets where a closing crack meets resistance (up_n = q_n - c_n tau_n), so it keeps a weight,
  /// relative to its size.
  [[nodiscard]] double error_norm(const Point& r, const Y& error) const {
    const double w = value(r.w);
    const double strength = value(law().surface.tensile_strength);
    const double open = value(law().flexibility_n);
    const double bulk = value(zone_.series.normal);
    const double level = (std::abs(value(r.hyp.normal)) + value(r.shear)) / strength;
    const double reach = value(zone_.normal_law(true).at(r.w));
    const double contact = reach / ((open + bulk) * (1.0 + level));
    const double weight = std::max(w, contact) / strength;
    double shear2 = 0.0;
    double normal = 0.0;
    for (int k = 0; k < NS; ++k) {
      shear2 += value(error[k]) * value(error[k]);
      normal += value(r.normal_s[k]) * value(error[k]);
    }
    // An error of w changes t by tau times it, unless the step is one of t itself.
    const double per_damage = slides_on_closed_faces(law(), r) ? 1.0 : std::max(1.0, level);
    const double damage_error = law().softening.loss(branch.piece, w, std::abs(value(error[NS]))) * per_damage;
    return std::max({std::sqrt(shear2) * weight, std::abs(normal) * weight, damage_error});
  }

  /// A separated consistent zone whose faces move apart: its flow turns parallel to the drive within a motion that is
  /// `least_integrity` times the elastic one, far below what the drive resolves. The tau_s of that state, if there is
  /// one in tension.
  [[nodiscard]] std::optional<Shear> steady_opening(const Point& r) const {
    if (branch.piece != settled_piece || value(r.hyp.normal) < 0.0 || !(value(rate_n_) > 0.0)) return std::nullopt;
    const auto surface = law().surface.values();
    double slip2 = 0.0;
    for (int k = 0; k < NS; ++k) slip2 += value(rate_s_[k]) * value(rate_s_[k]);
    const double slip = std::sqrt(slip2);
    double lo = 0.0;
    double hi = surface.cohesion;
    for (int k = 0; k < 60 && slip > 0.0; ++k) {
      const double s = 0.5 * (lo + hi);
      (surface.point(s * s).flow_n * slip > s * value(rate_n_) ? lo : hi) = s;
    }
    if (!surface.contains_shear(lo * lo)) return std::nullopt;
    Shear tau;
    for (int k = 0; k < NS; ++k) tau[k] = slip > 0.0 ? T(lo * value(rate_s_[k]) / slip) : T(0.0);
    return tau;
  }
  /// d(a) and d(slip) of a flow that follows the drive.
  [[nodiscard]] std::pair<T, T> flow_along_drive() const {
    using std::sqrt;
    const T slip2 = squared_norm(rate_s_);
    const T slip = value(slip2) > 0.0 ? T(sqrt(slip2)) : T(0.0);
    return {T(rate_n_ + slip), slip};
  }

  /// Smooth functions that are positive while the branch holds.
  [[nodiscard]] T event(YieldEvent which, const Y& y, const Point& r) const {
    switch (which) {
      case YieldEvent::unloading:
        return loading_at(r);
      case YieldEvent::normal_sign:
        if (!has_contact_kink(law().zone)) return T(1.0);
        return branch.tension ? r.hyp.normal : T(-r.hyp.normal);
      case YieldEvent::shear_sign:
        return NS == 1 && branch.shear ? r.shear : T(1.0);
      case YieldEvent::softening_kink:
        break;
    }
    const auto end = law().softening.piece_end(branch.piece);
    return value(end) < 0.0 ? T(1.0) : T(softening().continued(y[NS]) - end);
  }

  /// Dissipated energy per unit of the softening's measure, and per unit of the drive at an inelastic rate a'.
  [[nodiscard]] T density(const Point& r) const {
    return law().softening.density(branch.piece, r.w, dissipation(law(), r.hyp, r.shear, r.inv));
  }
  [[nodiscard]] T power(const Point& r, const T& a_rate) const {
    return law().softening.measure_rate(branch.piece, r.w) * a_rate * density(r);
  }

 private:
  Zone<Law> zone_;
  T w_begin_;
  T rate_n_;
  Shear rate_s_;
};

/// Picks the smooth branch that the motion enters at y.
template <class Phase>
void choose_branch(Phase& phase, const typename Phase::Y& y) {
  constexpr int NS = Phase::NS;
  const auto& law = phase.law();
  const double none = negligible_shear * value(law.surface.apex);
  double shear = 0.0;
  double heading_shear = 0.0;
  for (int k = 0; k < NS; ++k) {
    shear = std::max(shear, std::abs(value(y[k])));
    heading_shear = std::max(heading_shear, std::abs(value(phase.rate_s()[k])));
  }
  phase.branch.piece = law.softening.piece(phase.begin_integrity());
  phase.branch.shear = shear > none || heading_shear > none * value(law.flexibility_s);
  if constexpr (NS == 1) {
    const double s = shear > none ? value(y[0]) : value(phase.rate_s()[0]);
    phase.branch.shear_sign = s < 0.0 ? -1.0 : 1.0;
  }
  phase.branch.tension = true;
  const typename Phase::Point r = phase.point(y);
  const double normal = value(r.hyp.normal);
  if (std::abs(normal) > 1e-12 * value(law.surface.tensile_strength)) {
    phase.branch.tension = normal > 0.0;
    return;
  }
  const typename Phase::Y f = phase.rates(r);
  double heading = 0.0;
  for (int k = 0; k < NS; ++k) heading += value(r.normal_s[k]) * value(f[k]);
  phase.branch.tension = heading >= 0.0;
}

/// Step length at which event `which` passes zero inside (0, h), and the derivative carried over to duals.
template <class Phase>
[[nodiscard]] typename Phase::Scalar locate_event(const Phase& phase, const typename Phase::Y& y0,
                                                  const typename Phase::Point& r0, const typename Phase::Y& f0,
                                                  double h, YieldEvent which) {
  using T = typename Phase::Scalar;
  const auto at = [&](const T& x) {
    const typename Phase::Y y = phase.advance(y0, r0, f0, x).y;
    return phase.event(which, y, phase.point(y));
  };
  double lo = 0.0;
  double hi = h;
  double e_lo = value(phase.event(which, y0, r0));
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

/// A point of a yielding phase with everything that a step needs of it.
template <class Phase>
struct Station {
  typename Phase::Y y;
  typename Phase::Point r;
  typename Phase::Y f;  ///< rates
};

/// What an accepted step adds to the sums of a state.
template <class T>
struct StepSums {
  T dissipated;  ///< J/m^2
  T slip;        ///< m; only of a zone in which it does not follow from the plastic jump
};

/// The sums of a step of the consistent zone: t.flow and the shear part of the flow over the inelastic displacement a.
/// Fourth order, as the solution is, from the ends and the `middle`: Simpson's rule, or, where the step softens
/// noticeably, the quadratic through the three points as a function of w (energy) or of a (slip). The first is exact
/// where tau is constant, as in pure opening, and where t is, as in friction.
template <class Phase>
[[nodiscard]] StepSums<typename Phase::Scalar> consistent_sums(const Phase& phase, const Station<Phase>& a,
                                                               const typename Phase::Y& middle, const Station<Phase>& b,
                                                               const typename Phase::Scalar& h) {
  using T = typename Phase::Scalar;
  constexpr int NS = Phase::NS;
  const auto& law = phase.law();
  const typename Phase::Point m = phase.point(middle);
  const auto power = [&](const typename Phase::Point& r) {
    return T(r.w * dissipation(law, r.hyp, r.shear, r.inv).plastic);
  };
  const auto share = [](const typename Phase::Point& r) { return T(r.shear * r.inv); };
  const T p[] = {power(a.r), power(m), power(b.r)};
  const T s[] = {share(a.r), share(m), share(b.r)};
  const T whole = b.y[NS] - a.y[NS];
  const bool settled = phase.branch.piece == settled_piece;
  if (settled || value(whole) < 1e-2 * value(law.softening.length())) {  // differences of w would lose digits
    const T rates[] = {a.f[NS], 4.0 * phase.rates(m)[NS], b.f[NS]};
    StepSums<T> sum{T(0.0), T(0.0)};
    for (int k = 0; k < 3; ++k) {
      sum.dissipated += rates[k] * p[k] * T(h / 6.0);
      sum.slip += rates[k] * s[k] * T(h / 6.0);
    }
    return sum;
  }
  const SofteningMoments<T> w = law.softening.moments(phase.branch.piece, a.r.w, b.r.w, whole);
  const T first = (p[1] - p[0]) / (m.w - a.r.w);
  const T second = ((p[2] - p[1]) / (b.r.w - m.w) - first) / (b.r.w - a.r.w);
  const T to_first = w.first - a.r.w * whole;
  const T to_second = w.second - (a.r.w + m.w) * w.first + a.r.w * m.w * whole;
  const T x = (middle[NS] - a.y[NS]) / whole;
  const T y = 1.0 - x;
  const T work = p[0] * whole + first * to_first + second * to_second;
  return {value(work) > 0.0 ? work : T(0.0),
          T(whole / 6.0 * ((2.0 - y / x) * s[0] + s[1] / (x * y) + (2.0 - x / y) * s[2]))};
}

/// Energy dissipated in an accepted step of length h of the published zone, J/m^2. Fourth order, as the solution is,
/// from the ends and the cubic Hermite mid-point: Simpson's rule, or, where the step softens noticeably, the quadratic
/// through the three points as a function of w, which is exact for pure opening.
template <class Phase>
[[nodiscard]] typename Phase::Scalar step_dissipation(const Phase& phase, const Station<Phase>& a,
                                                      const Station<Phase>& b, const typename Phase::Scalar& h) {
  using T = typename Phase::Scalar;
  constexpr int NS = Phase::NS;
  const auto& softening = phase.law().softening;
  const T whole = a.r.w - b.r.w;
  if (value(a.r.w) < negligible_integrity)
    return whole * softening.measure() * 0.5 * (phase.density(a.r) + phase.density(b.r));
  const typename Phase::Y middle = (a.y + b.y) * T(0.5) + (a.f - b.f) * T(h / 8.0);
  const typename Phase::Point rm = phase.point(middle);
  if (value(b.y[NS]) - value(a.y[NS]) < 1e-3 * value(softening.length())) {  // differences of w would lose digits
    const typename Phase::Y fm = phase.rates(rm);
    return (phase.power(a.r, a.f[NS]) + 4.0 * phase.power(rm, fm[NS]) + phase.power(b.r, b.f[NS])) * T(h / 6.0);
  }
  const T first = (a.r.w - rm.w) / whole;
  const T second = 1.0 - first;
  const T sum = (2.0 - second / first) * phase.density(a.r) + phase.density(rm) / (first * second) +
                (2.0 - first / second) * phase.density(b.r);
  return whole * softening.measure() * sum / 6.0;
}

template <class Phase>
[[nodiscard]] StepSums<typename Phase::Scalar> step_sums(const Phase& phase, const Station<Phase>& a,
                                                         const typename Phase::Y& middle, const Station<Phase>& b,
                                                         const typename Phase::Scalar& h) {
  using T = typename Phase::Scalar;
  if (phase.law().zone == CohesiveZone::consistent) return consistent_sums(phase, a, middle, b, h);
  return {step_dissipation(phase, a, b, h), T(0.0)};
}

/// How a yielding phase ended.
template <class Phase>
struct Yielded {
  using T = typename Phase::Scalar;
  Status status = Status::ok;
  typename Phase::Y y = Phase::Y::Constant(T(0.0));
  T position = T(0.0);  ///< of the drive
  StepSums<T> sums{T(0.0), T(0.0)};
  bool unloaded = false;  ///< it left the surface before the end
  bool kinked = false;    ///< the softening law goes on with its next piece
};

/// The error of a step in units of what is allowed.
template <class Phase, class Step>
[[nodiscard]] double error_of(const Phase& phase, const Station<Phase>& at, const Step& trial, double tolerance) {
  const double e = phase.error_norm(at.r, trial.error) / tolerance;
  if (phase.law().zone == CohesiveZone::published) return e;
  double error2 = 0.0;
  double change2 = 0.0;
  for (int k = 0; k < Phase::NS; ++k) {
    error2 += value(trial.error[k]) * value(trial.error[k]);
    change2 += value(trial.y[k] - at.y[k]) * value(trial.y[k] - at.y[k]);
  }
  const double size = value(at.r.shear) + value(phase.law().surface.apex);
  return std::max(
      {e, std::sqrt(error2) / (largest_shear_error * size), std::sqrt(change2) / (largest_shear_step * size)});
}

/// Runs one yielding phase from the position `from` of the drive until `end`, or until the point unloads or reaches a
/// kink of the softening law.
template <class Phase>
[[nodiscard]] Yielded<Phase> run_yielding(Phase& phase, const typename Phase::Y& y, typename Phase::Scalar position,
                                          double end, const Options& options, Report& report) {
  using T = typename Phase::Scalar;
  constexpr int NS = Phase::NS;
  Yielded<Phase> out;
  const double tolerance = local_tolerance_fraction * options.tolerance;
  const double length = value(phase.law().softening.length());
  // A separated consistent zone has events that close together.
  const double smallest = (phase.law().zone == CohesiveZone::consistent ? 1e-15 : 1e-13) * end;
  choose_branch(phase, y);
  Station<Phase> at{y, phase.point(y), y};
  const auto stop = [&](Status s) {
    out.status = s;
    return out;
  };
  if (!phase.solvable(at.r)) return stop(phase.failure(at.r));
  at.f = phase.rates(at.r);
  // First guess: a part of the softening length that an order-4 method can take at this tolerance; never more than what
  // is left.
  const double first = 0.5 * length * std::pow(options.tolerance, 0.25) / (std::abs(value(at.f[NS])) + 1e-300);
  double step = std::min(end - value(position), first);
  while (value(position) < end) {
    if constexpr (Phase::follows_drive) {
      if (const auto shear = phase.steady_opening(at.r)) {
        const auto [a_rate, slip_rate] = phase.flow_along_drive();
        at.y.template head<NS>() = *shear;
        at.y[NS] += a_rate * (end - position);
        out.sums.slip += slip_rate * (end - position);
        position = T(end);
        break;
      }
    }
    if (report.iterations >= options.max_substeps) return stop(Status::non_convergence);
    const double left = end - value(position);
    const bool last = step >= left * (1.0 - 1e-12);
    T h = last ? T(end - position) : T(step);
    ++report.iterations;
    // 1. A step within the tolerance that does not soften too far.
    auto trial = phase.advance(at.y, at.r, at.f, h);
    const double error = trial.defined ? error_of(phase, at, trial, tolerance) : 1e9;
    if (!(error <= 1.0)) {
      step = value(h) * std::max(0.1, 0.9 * std::pow(error, -0.25));
      if (step < smallest) return stop(phase.failure(at.r));
      continue;
    }
    const double softening = (value(trial.y[NS]) - value(at.y[NS])) / length;
    if (softening > largest_softening_step && value(at.r.w) > negligible_integrity &&
        phase.branch.piece != settled_piece) {
      step = value(h) * 0.9 * largest_softening_step / softening;
      continue;
    }
    Station<Phase> next{trial.y, phase.point(trial.y), trial.y};
    if (!phase.solvable(next.r) || !is_within_branch(phase.law(), next.r)) {
      step = 0.1 * value(h);
      if (step < smallest) return stop(phase.failure(at.r));
      continue;
    }
    // 2. Shortened to the first event in it.
    int fired = -1;
    double earliest = value(h);
    for (int k = 0; k < yield_event_count; ++k) {
      const auto which = static_cast<YieldEvent>(k);
      if (value(phase.event(which, next.y, next.r)) >= 0.0) continue;
      const T x = locate_event(phase, at.y, at.r, at.f, value(h), which);
      if (value(x) <= earliest) {
        earliest = value(x);
        fired = k;
        trial = phase.advance(at.y, at.r, at.f, x);
        next.y = trial.y;
        next.r = phase.point(next.y);
        h = x;
      }
    }
    // 3. Accepted.
    next.f = phase.rates(next.r);
    const StepSums<T> sums = step_sums<Phase>(phase, at, trial.middle, next, h);
    out.sums.dissipated += sums.dissipated;
    out.sums.slip += sums.slip;
    position = last && fired < 0 ? T(end) : T(position + h);
    ++report.substeps;
    at = next;
    const auto event = static_cast<YieldEvent>(fired);
    out.unloaded = event == YieldEvent::unloading;
    out.kinked = event == YieldEvent::softening_kink;
    if (out.unloaded || out.kinked) break;
    if (fired >= 0) {
      if (event == YieldEvent::normal_sign) phase.branch.tension = !phase.branch.tension;
      if (event == YieldEvent::shear_sign) phase.branch.shear_sign = -phase.branch.shear_sign;
      at.r = phase.point(at.y);
      if (!phase.solvable(at.r)) return stop(phase.failure(at.r));
      at.f = phase.rates(at.r);
      step = std::max(step - earliest, 1e-3 * step);
      continue;
    }
    step = value(h) * std::min(5.0, 0.9 * std::pow(error + 1e-12, -0.25));
  }
  out.y = at.y;
  out.position = position;
  return out;
}

/// Puts a zone to the end of a yielding phase, where y = (tau_s, a, ..) and the drive is `drive`: the surface and
/// continuity give the plastic jump; a = d(up_n) + d(slip) gives the slip (eq 47) in the published zone. A kink of the
/// softening law is met exactly. The jump is left to the caller.
template <int Dim, class Phase>
void end_yielding(CohesiveState<typename Phase::Scalar, Dim>& z, const Vec<typename Phase::Scalar, Dim>& drive,
                  const Phase& phase, const Yielded<Phase>& yielded) {
  using T = typename Phase::Scalar;
  constexpr int NS = Phase::NS;
  const typename Phase::Point r = phase.point(yielded.y);
  const T normal = drive[0] + z.offset[0] - r.c.normal * r.hyp.normal;
  const T slip = phase.law().zone == CohesiveZone::consistent ? yielded.sums.slip
                                                              : T(yielded.y[NS] - (normal - z.plastic_jump[0]));
  if (value(slip) > 0.0) z.slip += slip;  // rounding of a pure opening must not make it negative
  z.plastic_jump[0] = normal;
  z.traction[0] = r.w * r.hyp.normal;
  for (int k = 1; k < Dim; ++k) {
    z.plastic_jump[k] = drive[k] + z.offset[k] - r.c.shear * yielded.y[k - 1];
    z.traction[k] = r.w * yielded.y[k - 1];
  }
  z.integrity = yielded.kinked ? T(phase.law().softening.piece_end(phase.branch.piece)) : r.w;
  z.dissipated += yielded.sums.dissipated;
}

}  // namespace fpz::detail
