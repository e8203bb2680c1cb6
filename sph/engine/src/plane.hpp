// Geometry and elasticity of one particle in the plane, for one lane or one number: no branches, no calls.
#pragma once

#define FPZ_LANE static inline __attribute__((always_inline))
/// The same for lambdas and members.
#define FPZ_INLINED __attribute__((always_inline))

namespace fpz::sph::detail {

struct Symmetric {
  double xx, yy, xy;
};

struct Full {
  double xx, xy, yx, yy;
};

FPZ_LANE Full full(const Symmetric& a) { return {a.xx, a.xy, a.xy, a.yy}; }

FPZ_LANE Full product(const Full& a, const Full& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx, a.yx * b.xy + a.yy * b.yy};
}

/// A^T A.
FPZ_LANE Symmetric gram(const Full& a) {
  return {a.xx * a.xx + a.yx * a.yx, a.xy * a.xy + a.yy * a.yy, a.xx * a.xy + a.yx * a.yy};
}

/// Rotation R and stretch U - I of F = R U = I + b, without cancellation for small b (row-major components).
struct Stretch {
  double cosine, sine;
  Symmetric strain;
};

FPZ_LANE Stretch polar(double bxx, double bxy, double byx, double byy) {
  const double c = 2.0 + bxx + byy;
  const double s = byx - bxy;
  const double r = __builtin_sqrt(c * c + s * s);
  const double sum = c > 0.0 ? r + c : 1.0;
  const double quotient = 1.0 / (r * sum);
  const double inverse = sum * quotient;
  Stretch p;
  p.cosine = c * inverse;
  p.sine = s * inverse;
  const double cosine_minus_one = c > 0.0 ? -s * s * quotient : p.cosine - 1.0;
  p.strain.xx = cosine_minus_one + (p.cosine * bxx + p.sine * byx);
  p.strain.yy = cosine_minus_one + (p.cosine * byy - p.sine * bxy);
  p.strain.xy = 0.5 * (p.cosine * (bxy + byx) + p.sine * (byy - bxx));
  return p;
}

FPZ_LANE Symmetric elastic_stress(double lambda, double mu, const Symmetric& e) {
  const double pressure = lambda * (e.xx + e.yy);
  return {pressure + 2.0 * mu * e.xx, pressure + 2.0 * mu * e.yy, 2.0 * mu * e.xy};
}

/// Certainly inside the onset surface (onset.hpp: surely_intact).
FPZ_LANE bool intact(double sin_phi, double strength, double apex, const Symmetric& s) {
  const double p = 0.5 * (s.xx + s.yy);
  const double d = 0.5 * (s.xx - s.yy);
  const double room = strength - p * sin_phi;
  return (room > 0.0) & (d * d + s.xy * s.xy + apex * apex < room * room);
}

/// A direction in which the neighbours hardly extend (moment below this part of the larger one) has no gradient.
constexpr double moment_floor = 0.02;

/// Inverse of a symmetric, positive semi-definite matrix; an eigenvalue below `floor` of the larger one gets zero.
FPZ_LANE Symmetric inverse_above(const Symmetric& a, double floor) {
  const double mean = 0.5 * (a.xx + a.yy);
  const double d = 0.5 * (a.xx - a.yy);
  const double r = __builtin_sqrt(d * d + a.xy * a.xy);
  const double large = mean + r;
  const double small = mean - r;
  const double inverse_large = large > 0.0 ? 1.0 / (large > 0.0 ? large : 1.0) : 0.0;
  const bool flat = !(small > floor * large);
  const double inverse_small = flat ? 0.0 : 1.0 / (flat ? 1.0 : small);
  const double sum = 0.5 * (inverse_large + inverse_small);
  const double difference = r > 0.0 ? 0.5 * (inverse_large - inverse_small) / (r > 0.0 ? r : 1.0) : 0.0;
  return {sum + difference * d, sum - difference * d, difference * a.xy};
}

/// Correction of the kernel gradient from its moment matrix (eq 18).
FPZ_LANE Symmetric correction_of(const Symmetric& a) { return inverse_above(a, moment_floor); }

/// Inverse of any moment matrix A as (A^T A)^-1 A^T, with the same floor.
FPZ_LANE Full correction_of(const Full& a) {
  const Symmetric b = inverse_above(gram(a), moment_floor * moment_floor);
  return {b.xx * a.xx + b.xy * a.xy, b.xx * a.yx + b.xy * a.yy, b.xy * a.xx + b.yy * a.xy, b.xy * a.yx + b.yy * a.yy};
}

/// R s R^T.
FPZ_LANE Symmetric rotated(double c, double s, const Symmetric& a) {
  const double xx = c * a.xx - s * a.xy;
  const double xy = c * a.xy - s * a.yy;
  const double yx = s * a.xx + c * a.xy;
  const double yy = s * a.xy + c * a.yy;
  return {xx * c - xy * s, yx * s + yy * c, xx * s + xy * c};
}

/// R a L^T, row-major: the flux that the force sums.
FPZ_LANE Full flux_of(double c, double s, const Full& a, const Full& l) {
  const double xx = c * a.xx - s * a.yx;
  const double xy = c * a.xy - s * a.yy;
  const double yx = s * a.xx + c * a.yx;
  const double yy = s * a.xy + c * a.yy;
  return {xx * l.xx + xy * l.xy, xx * l.yx + xy * l.yy, yx * l.xx + yy * l.xy, yx * l.yx + yy * l.yy};
}

FPZ_LANE Full flux_of(double c, double s, const Symmetric& a, const Full& l) { return flux_of(c, s, full(a), l); }

/// R^T P, P:dF being the work s:dU of a stress s in the axes of U = I + e, F = R U. With dF = dR U + R dU and
/// R^T dR = w J, w tr U is the skew part of R^T dF: that does the work of w s:(J U), which is zero where s has the axes
/// of U, as in an elastic body, and not where a crack turns them.
FPZ_LANE Full work_conjugate(const Symmetric& s, const Symmetric& e) {
  constexpr double least = 0.5;  // of tr U, 2 in the undeformed body
  const double trace = 2.0 + e.xx + e.yy;
  const double skew = (s.xy * (e.xx - e.yy) - e.xy * (s.xx - s.yy)) / (trace > least ? trace : least);
  return {s.xx, s.xy + skew, s.xy - skew, s.yy};
}

/// -epsilon times the tensile part of a stress: what repels particles along tensile principal directions.
FPZ_LANE Symmetric tensile_repulsion(double epsilon, const Symmetric& s) {
  const double p = 0.5 * (s.xx + s.yy);
  const double d = 0.5 * (s.xx - s.yy);
  const double r = __builtin_sqrt(d * d + s.xy * s.xy);
  const double one = p + r > 0.0 ? p + r : 0.0;
  const double two = p - r > 0.0 ? p - r : 0.0;
  const double mean = -0.5 * epsilon * (one + two);
  const double half = r > 0.0 ? -0.5 * epsilon * (one - two) / (r > 0.0 ? r : 1.0) : 0.0;
  return {mean + half * d, mean - half * d, half * s.xy};
}

}  // namespace fpz::sph::detail
