// Integrators that were tried and not taken into the library: explicit Dormand-Prince 5(4) and extrapolated backward
// Euler on the rate equations, and the backward Euler return in its first form. 2-D, doubles, no derivatives.
#pragma once

#include "cases.hpp"
#include "fpz/update_any_scalar.hpp"

namespace fpz::bench {

using Crack = CohesiveState<double, 2>;
using Law = CohesiveLaw<double>;
using Zone = fpz::Zone<Law>;
using Vec2 = Vec<double, 2>;
using Phase = detail::YieldingPhase<double, 2, Law>;

struct Step {
  bool defined = false;
  Vec2 y = Vec2::Zero();
  Vec2 error = Vec2::Zero();
};

/// The library's own step, run by the same driver as the alternatives.
struct Rodas43 {
  static constexpr double exponent = 0.25;
  static Step advance(const Phase& p, const Vec2& y, const detail::RatePoint<double, 1>& r, const Vec2& f, double h) {
    const auto s = p.advance(y, r, f, h);
    return {s.defined, s.y, s.error};
  }
};

/// Dormand and Prince's explicit pair.
struct DormandPrince54 {
  static constexpr double exponent = 0.2;
  static Step advance(const Phase& p, const Vec2& y, const detail::RatePoint<double, 1>&, const Vec2& f, double h) {
    static constexpr double a[7][6] = {
        {},
        {1.0 / 5.0},
        {3.0 / 40.0, 9.0 / 40.0},
        {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
        {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
        {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
        {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}};
    static constexpr double e[7] = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                                    -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};
    Step out;
    Vec2 k[7];
    k[0] = f;
    for (int i = 1; i < 7; ++i) {
      out.y = y;
      for (int j = 0; j < i; ++j) out.y += k[j] * (h * a[i][j]);
      const auto r = p.point(out.y);
      if (!(r.h > 0.0)) return out;
      k[i] = p.rates(r);
    }
    for (int i = 0; i < 7; ++i) out.error += k[i] * (h * e[i]);
    out.defined = is_finite(out.y);
    return out;
  }
};

/// End of a phase: the zone from (tau_s, a), which lies on the yield surface, at the drive d.
inline void write_zone(const Zone& zone, bool tension, double w_begin, const Vec2& y, const Vec2& d, Crack& z) {
  const double w = zone.law.softening.after(w_begin, y[1]);
  const auto hyp = zone.law.surface.point(y[0] * y[0]);
  const auto c = detail::scaled_compliance(zone, w, tension);
  const double normal = d[0] + z.offset[0] - c.normal * hyp.normal;
  z.slip += std::max(y[1] - (normal - z.plastic_jump[0]), 0.0);
  z.plastic_jump[0] = normal;
  z.plastic_jump[1] = d[1] + z.offset[1] - c.shear * y[0];
  z.integrity = w;
}

/// Traction and jump at the end of an increment whose last phase was elastic.
inline void write_elastic(const Zone& zone, const Vec2& d, Crack& z) {
  z.traction = detail::elastic_traction(zone, z.integrity, Vec2(d + z.offset - z.plastic_jump));
  z.jump = detail::continuous_jump(zone.series, d, z.traction);
}

/// The drive d0 -> d1 with a one-step method for the rate equations; phases and events as in the library.
template <class Method>
[[nodiscard]] Report integrate_stepping(const Zone& zone, const Options& o, const Crack& begin, const Vec2& d0,
                                        const Vec2& d1, Crack& end) {
  Report report;
  Crack z = begin;
  const Vec2 rate = d1 - d0;
  const double tolerance = detail::local_tolerance_fraction * o.tolerance;
  const auto fail = [&](Status s) {
    report.status = s;
    return report;
  };
  double x = 0.0;
  int stalled = 0;
  while (x < 1.0) {
    const Vec2 q = d0 + rate * x + z.offset - z.plastic_jump;
    const double entry = detail::yield_entry<2>(zone, z.integrity, q, Vec2(rate * (1.0 - x)));
    if (entry < 0.0) break;
    x += entry * (1.0 - x);
    if (stalled > 1) {
      x += 1e-9;
      stalled = 0;
      continue;
    }
    const double w_begin = z.integrity;
    Phase phase(zone, w_begin, rate);
    Vec2 y((d0[1] + rate[1] * x + z.offset[1] - z.plastic_jump[1]) / zone.shear_compliance(w_begin), 0.0);
    detail::choose_branch(phase, y);
    auto r = phase.point(y);
    if (phase.loading_at(r) <= 0.0) {
      ++stalled;
      continue;
    }
    if (!(r.h > 0.0)) return fail(Status::snap_back);
    stalled = 0;
    Vec2 f = phase.rates(r);
    double step =
        std::min(1.0 - x, 0.5 * zone.law.softening.length() * std::pow(o.tolerance, Method::exponent) / std::abs(f[1]));
    for (bool unloaded = false; x < 1.0 && !unloaded;) {
      if (++report.iterations > o.max_substeps) return fail(Status::non_convergence);
      const bool last = step >= (1.0 - x) * (1.0 - 1e-12);
      double h = last ? 1.0 - x : step;
      Step s = Method::advance(phase, y, r, f, h);
      const double error = s.defined ? phase.error_norm(r, s.error) / tolerance : 1e9;
      if (!(error <= 1.0)) {
        step = h * std::max(0.1, 0.9 * std::pow(error, -Method::exponent));
        if (step < 1e-13) return fail(Status::snap_back);
        continue;
      }
      auto r1 = phase.point(s.y);
      int fired = -1;
      for (int event = 0; event < detail::yield_event_count; ++event) {
        const auto which = static_cast<detail::YieldEvent>(event);
        if (phase.event(which, s.y, r1) >= 0.0) continue;
        const auto at = [&](double to) {
          const Vec2 moved = Method::advance(phase, y, r, f, to).y;
          return phase.event(which, moved, phase.point(moved));
        };
        double lo = 0.0;
        double hi = h;
        double e_lo = phase.event(which, y, r);
        double e_hi = phase.event(which, s.y, r1);
        const double scale = std::max(std::abs(e_lo), std::abs(e_hi));
        for (int k = 0, side = 0; k < 100 && hi - lo > 1e-15 * h; ++k) {  // Illinois
          double mid = (e_lo * hi - e_hi * lo) / (e_lo - e_hi);
          if (!(mid > lo && mid < hi)) mid = 0.5 * (lo + hi);
          const double e = at(mid);
          const bool close = std::abs(e) <= 1e-14 * scale;
          if (e > 0.0 && !close) {
            lo = mid;
            e_lo = e;
            if (side == 1) e_hi *= 0.5;
            side = 1;
          } else {
            hi = mid;
            e_hi = e;
            if (side == -1) e_lo *= 0.5;
            side = -1;
          }
          if (close) break;
        }
        h = hi;
        fired = event;
        s = Method::advance(phase, y, r, f, h);
        r1 = phase.point(s.y);
      }
      y = s.y;
      x = last && fired < 0 ? 1.0 : x + h;
      ++report.substeps;
      unloaded = fired == 0;
      if (fired == 1) phase.branch.tension = !phase.branch.tension;
      if (fired == 2) phase.branch.shear_sign = -phase.branch.shear_sign;
      r = fired > 0 ? phase.point(y) : r1;
      f = phase.rates(r);
      step = fired > 0 ? std::max(step - h, 1e-3 * step)
                       : h * std::min(5.0, 0.9 * std::pow(error + 1e-12, -Method::exponent));
    }
    write_zone(zone, phase.branch.tension, w_begin, y, d0 + rate * x, z);
  }
  write_elastic(zone, d1, z);
  end = z;
  return report;
}

/// Backward Euler with step doubling: two half steps against one, extrapolated in (tau_s, a) to second order where all
/// three yield on one branch, with adaptive steps.
[[nodiscard]] inline Report integrate_extrapolated(const Zone& zone, const Options& o, const Crack& begin,
                                                   const Vec2& d0, const Vec2& d1, Crack& end) {
  Report report;
  Crack z = begin;
  const Vec2 rate = d1 - d0;
  const double tolerance = detail::local_tolerance_fraction * o.tolerance;
  double x = 0.0;
  double step = 1.0;
  bool yielding = false;  // z is on the surface
  while (x < 1.0) {
    if (!yielding) {
      const Vec2 q = d0 + rate * x + z.offset - z.plastic_jump;
      const double entry = detail::yield_entry<2>(zone, z.integrity, q, Vec2(rate * (1.0 - x)));
      if (entry < 0.0) break;
      x += entry * (1.0 - x);
      yielding = true;
    }
    if (++report.iterations > o.max_substeps) {
      report.status = Status::non_convergence;
      return report;
    }
    const bool last = step >= (1.0 - x) * (1.0 - 1e-12);
    const double h = last ? 1.0 - x : step;
    const Vec2 from = d0 + rate * x;
    const Vec2 middle = d0 + rate * (x + 0.5 * h);
    const Vec2 to = last ? d1 : Vec2(d0 + rate * (x + h));
    Crack full, half, two;
    Report steps;  // single steps of backward Euler, not the library's integrator, which may take parts
    const auto euler = [&](const Crack& a, const Vec2& drive_a, const Vec2& drive_b, Crack& b) {
      return detail::implicit_step(zone, 1.0, a, Drive<double, 2>{drive_a, drive_b}, b, steps) && steps.ok();
    };
    const bool ok = euler(z, from, to, full) && euler(z, from, middle, half) && euler(half, middle, to, two);
    const double error =
        ok ? std::max((two.traction - full.traction).lpNorm<Eigen::Infinity>() / zone.law.surface.tensile_strength,
                      std::abs(two.integrity - full.integrity)) /
                 tolerance
           : 1e9;
    if (!(error <= 1.0)) {
      step = h * std::max(0.1, 0.9 / std::sqrt(error));
      if (step < 1e-13) {
        report.status = Status::snap_back;
        return report;
      }
      continue;
    }
    ++report.substeps;
    x = last ? 1.0 : x + h;
    const bool all_yield =
        full.integrity < z.integrity && half.integrity < z.integrity && two.integrity < half.integrity;
    const bool one_branch = (full.traction[0] > 0.0) == (two.traction[0] > 0.0) &&
                            (two.traction[0] > 0.0) == (half.traction[0] > 0.0) &&
                            full.traction[1] * two.traction[1] >= 0.0;
    if (all_yield && one_branch) {
      const auto pack = [&](const Crack& s) {
        return Vec2(s.traction[1] / s.integrity, -zone.law.softening.length() * std::log(s.integrity / z.integrity));
      };
      const Vec2 y = 2.0 * pack(two) - pack(full);
      write_zone(zone, two.traction[0] >= 0.0, z.integrity, y, to, z);
    } else {
      const Crack before = z;
      z = two;
      z.offset = before.offset;
      yielding = two.integrity < half.integrity;
    }
    step = h * std::min(5.0, 0.9 / std::sqrt(error + 1e-12));
  }
  write_elastic(zone, d1, z);
  end = z;
  return report;
}

/// Algorithm 2 of the library with another integrator for the cracked point: `integrate(zone, options, begin, d0, d1,
/// end)`.
template <class Integrate>
[[nodiscard]] auto update_with(const Material<double>& m, const Options& o, const Integrate& integrate) {
  return [&m, o, integrate](const State2& begin, const Tensor<double, 2>& dstrain, State2& end) {
    const Tensor<double, 2> strain = begin.strain + dstrain;
    State2 s = begin;
    if (!begin.cracked) {
      const Tensor<double, 2> stress = m.bulk.stress<double, 2>(strain);
      if (surely_intact<2>(m, stress) || find_plane<2>(m, o, stress).failure_value < 0.0) {
        end.strain = strain;
        end.stress = stress;
        end.cracked = false;
        return Report{};
      }
      s = detail::cracked_between<2>(m, o, begin, strain, stress);
    }
    const Vec2 d0 = detail::drive<double, 2>(m, s.frame, s.strain);
    const Vec2 d1 = detail::drive<double, 2>(m, s.frame, strain);
    const Report r = integrate(Zone(m.law, m.series), o, s.crack, d0, d1, s.crack);
    if (!r.ok()) return r;
    s.strain = strain;
    s.stress = detail::macro_stress(m, s);
    end = s;
    return r;
  };
}

/// The Newton loop of solve_return() in the unknowns (S, a) instead of (z, a).
[[nodiscard]] inline detail::ReturnSolution solve_return_sa(const Zone& zone, const detail::ReturnStart<double>& start,
                                                            double s_entry, double tolerance) {
  detail::ReturnSolution out;
  double s = s_entry;
  double a = 0.0;
  bool close = false;
  for (int k = 0; k < 12; ++k) {
    const auto e = detail::return_system(zone, start, s, a);
    ++out.iterations;
    if (k == 0) {
      out.entry = detail::dissipation_at<double>(zone.law, e, s);
      if (!(e.rate_modulus() > 0.0)) return out;
    }
    const double det = e.determinant();
    if (!(det < 0.0)) return out;
    if (close || (std::abs(e.r1) <= tolerance && std::abs(e.r2) <= tolerance)) {
      out.status = Status::ok;
      out.s = s;
      out.a = a;
      out.point = e;
      return out;
    }
    const double inverse = 1.0 / det;
    const double ds = (e.r2 * e.r1_a - e.r1 * e.r2_a) * inverse;
    const double da = (e.r1 * e.r2_s - e.r2 * e.r1_s) * inverse;
    close = std::abs(ds) <= 1e-9 * s && std::abs(da) <= 1e-9 * a;
    s = std::max(s + ds, 0.0);
    a = std::max(a + da, 0.0);
  }
  return out;
}

/// What solve_return() is called with in an update of a yielding point.
struct ReturnInput {
  detail::ReturnStart<double> start;
  double entry, tolerance;
};

[[nodiscard]] inline ReturnInput return_input(const Material<double>& m, const State2& s, const Tensor<double, 2>& d) {
  const Zone zone(m.law, m.series);
  const Vec2 d0 = detail::drive<double, 2>(m, s.frame, s.strain);
  const Vec2 d1 = detail::drive<double, 2>(m, s.frame, Tensor<double, 2>(s.strain + d));
  const Vec2 q0 = d0 + s.crack.offset - s.crack.plastic_jump;
  const Vec2 q1 = d1 + s.crack.offset - s.crack.plastic_jump;
  const double w = s.crack.integrity;
  const detail::Trial t = detail::elastic_trial(zone, w, s.crack, d1, q1);
  return {{q1[0], t.shear, w}, detail::shear_at_entry<2>(zone, w, q0, q1), t.tolerance};
}

}  // namespace fpz::bench
