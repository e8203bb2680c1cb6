#include <cstdio>

#include "alternatives.hpp"
#include "fpz/cohesive_update.hpp"
#include "studies.hpp"

namespace fpz::bench {
namespace {

std::string title_of(double factor) {
  char text[40];
  std::snprintf(text, sizeof text, "%g x paper", factor);
  return text;
}

/// Orders from three consecutive residuals, left out once rounding is reached.
void fit_orders(History& h, double rounding) {
  for (std::size_t k = 1; k + 1 < h.residuals.size(); ++k) {
    const double a = h.residuals[k - 1];
    const double b = h.residuals[k];
    const double c = h.residuals[k + 1];
    if (!(c > rounding)) continue;
    h.ratios.push_back(c / b);
    if (!(b < a)) continue;
    h.orders.push_back(std::log(c / b) / std::log(b / a));
  }
}

/// The Newton loop of detail::solve_return(), residuals written down.
History implicit_history(const Material<double>& m, const State2& s, double factor) {
  const ReturnInput in = return_input(m, s, mixed_loading<2>(factor * paper_increment));
  History h{title_of(factor), false, {}, {}, {}};
  double z = (in.entry + std::sqrt(in.entry * in.entry + m.law.surface.apex * m.law.surface.apex)) *
             m.law.surface.inverse_apex;
  double a = 0.0;
  for (int k = 0; k < 12; ++k) {
    const auto e = detail::fast_system(Zone(m.law, m.series), in.start, z, a);
    // Lengths, over delta0: the plastic jump that is missing.
    h.residuals.push_back(std::max(std::abs(e.e1), std::abs(e.e2)) / (e.sum * m.law.softening.length()));
    if (h.residuals.back() * m.law.softening.length() <= in.tolerance) {
      h.converged = true;
      break;
    }
    const double det = e.e1_z * e.e2_a - e.e1_a * e.e2_z;
    const double dz = (e.e2 * e.e1_a - e.e1 * e.e2_a) / det;
    const double da = (e.e1 * e.e2_z - e.e2 * e.e1_z) / det;
    z = std::max(z + dz, 1.0);
    a = std::max(a + da, 0.0);
  }
  fit_orders(h, 1e-12);
  return h;
}

/// The traction loop of Algorithm 2 as in detail::integrate_paper(), residuals written down.
History paper_history(const Material<double>& m, const State2& s, const Tensor<double, 2>& d, std::string title) {
  const Vec2 d0 = detail::drive<double, 2>(m, s.frame, s.strain);
  const Vec2 d1 = detail::drive<double, 2>(m, s.frame, Tensor<double, 2>(s.strain + d));
  History h{std::move(title), false, {}, {}, {}};
  Crack z = s.crack;
  const Vec2 stiffness(1.0 / m.series.normal, 1.0 / m.series.shear);
  const auto first = detail::paper_derivatives(m.law, z.traction, z.integrity);
  const Vec2 du = stiffness.cwiseProduct(d1 - d0).cwiseQuotient(stiffness + first.secant);
  detail::paper_return(m.law, z, du);
  const double scale = Vec2(m.law.kn * z.offset[0], m.law.ks * z.offset[1]).norm();
  for (int k = 0; k < 400; ++k) {
    const Vec2 r = stiffness.cwiseProduct(d1 - z.jump) - z.traction;
    h.residuals.push_back(r.norm() / scale);
    if (h.residuals.back() <= 1e-12) {
      h.converged = true;
      break;
    }
    if (!(h.residuals.back() < 1e6)) break;
    const double f = m.law.surface.printed_value(z.traction[0], z.traction[1] * z.traction[1], z.integrity);
    Mat<double, 2, 2> c = Mat<double, 2, 2>::Zero();
    if (f > -1e-9 * m.law.surface.cohesion * m.law.surface.cohesion * z.integrity * z.integrity) {
      c = detail::paper_tangent(m.law, z);
    } else {
      c.diagonal() = detail::paper_derivatives(m.law, z.traction, z.integrity).secant;
    }
    c.diagonal() += stiffness;
    detail::paper_return(m.law, z, Vec2(c.inverse() * r));
  }
  fit_orders(h, 1e-11);
  return h;
}

}  // namespace

NewtonStudy study_newton() {
  NewtonStudy study;
  const Material<double> m = johnstone<2>();
  const State2 s = yielding_points<2>(m).front();
  for (const double factor : {1.0, 30.0, 300.0, 3000.0}) study.implicit.push_back(implicit_history(m, s, factor));
  for (const double factor : {0.125, 0.5, 1.0, 30.0}) {
    study.paper.push_back(
        paper_history(m, s, mixed_loading<2>(factor * paper_increment), title_of(factor) + ", stage 2"));
  }
  // The first softening update of stage 1.
  const Options exact = options_of(Method::accurate, 1e-10);
  State2 onset;
  while (!onset.cracked) {
    if (!update<2>(m, exact, onset, test::strain2(paper_increment, 0, 0), onset).ok())
      throw std::runtime_error("onset");
  }
  for (const double factor : {0.5, 1.0}) {
    study.paper.push_back(
        paper_history(m, onset, test::strain2(factor * paper_increment, 0, 0), title_of(factor) + ", after onset"));
  }
  return study;
}

}  // namespace fpz::bench
