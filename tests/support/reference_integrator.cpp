#include "support/reference_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "fpz/law/softening.hpp"

namespace fpz::test {
namespace {

constexpr double pi = 3.14159265358979323846;

Matrix3 frame_of(const Vector3& n, bool plane) {
  Matrix3 r;
  Vector3 s1;
  if (plane) {
    s1 = Vector3(-n[1], n[0], 0.0);
  } else {
    const Vector3 other = std::abs(n[2]) < 0.8 ? Vector3::UnitZ() : Vector3::UnitX();
    s1 = other.cross(n).normalized();
  }
  r.row(0) = n.transpose();
  r.row(1) = s1.transpose();
  r.row(2) = n.cross(s1).transpose();
  return r;
}

/// Smallest root beyond `after` of a x^2 + b x + c, or a negative number.
double first_root(double a, double b, double c, double after) {
  double roots[2] = {-1.0, -1.0};
  const double disc = b * b - 4.0 * a * c;
  if (disc < 0.0) return -1.0;
  const double q = -0.5 * (b + std::copysign(std::sqrt(disc), b));
  if (a != 0.0) roots[0] = q / a;
  if (q != 0.0) roots[1] = c / q;
  double best = -1.0;
  for (const double r : roots) {
    if (r > after && (best < 0.0 || r < best)) best = r;
  }
  return best;
}

}  // namespace

ReferenceIntegrator::ReferenceIntegrator(const Parameters& p, Setting setting, double tolerance)
    : p_(p), setting_(setting), tolerance_(tolerance) {
  const double nu = p.poisson_ratio;
  mu_ = p.young_modulus / (2.0 * (1.0 + nu));
  lambda_ = setting == Setting::plane_stress ? p.young_modulus * nu / (1.0 - nu * nu)
                                             : p.young_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  tan_phi_ = std::tan(p.friction_angle_deg * pi / 180.0);
  tan_psi_ = std::tan(p.dilation_angle_deg * pi / 180.0);
  const std::string softening = to_string(p.choices.softening);
  bilinear_ = softening == "bilinear";
  if (!bilinear_ && softening != "exponential") throw std::runtime_error("reference: no softening law " + softening);
  const std::string zone = to_string(p.choices.cohesive_zone);
  consistent_ = zone == "consistent";
  if (!consistent_ && zone != "published") throw std::runtime_error("reference: no cohesive zone " + zone);
}

double ReferenceIntegrator::fall(double w, int piece) const {
  if (!bilinear_) return w / p_.delta0;  // eq 47
  return piece == 0 ? (1.0 - 1.0 / 3.0) / (0.8 * p_.delta0) : 1.0 / 3.0 / ((3.6 - 0.8) * p_.delta0);
}

double ReferenceIntegrator::piece_end(int piece) const { return bilinear_ && piece == 0 ? 1.0 / 3.0 : -1.0; }

Matrix3 ReferenceIntegrator::elastic_stress(const Matrix3& strain) const {
  return lambda_ * strain.trace() * Matrix3::Identity() + 2.0 * mu_ * strain;
}

Matrix3 ReferenceIntegrator::stress() const {
  if (!s_.cracked) return elastic_stress(s_.strain);
  const Vector3 n = s_.frame.row(0).transpose();
  const Vector3 u = s_.frame.transpose() * s_.u;
  return elastic_stress(s_.strain - 0.5 / p_.rve_length * (n * u.transpose() + u * n.transpose()));  // eq 41
}

double ReferenceIntegrator::failure_value(const Matrix3& stress, const Vector3& n) const {
  const Vector3 t = stress * n;
  const double tn = n.dot(t);
  const double ts2 = (t - tn * n).squaredNorm();
  const double apex = p_.cohesion - p_.tensile_strength * tan_phi_;
  return std::sqrt(ts2 + apex * apex) - p_.cohesion + tn * tan_phi_;
}

Vector3 ReferenceIntegrator::gradient(const Matrix3& stress, const Vector3& n) const {
  const Vector3 t = stress * n;
  const double tn = n.dot(t);
  const double ts2 = (t - tn * n).squaredNorm();
  const double apex = p_.cohesion - p_.tensile_strength * tan_phi_;
  Vector3 g = (stress * t - 2.0 * tn * t) / std::sqrt(ts2 + apex * apex) + 2.0 * tan_phi_ * t;
  if (setting_ != Setting::three_d) g[2] = 0.0;
  return g - n.dot(g) * n;
}

/// Newton on the tangential gradient, with a numerical Hessian: the angle comes out to rounding, not to its square
/// root.
Vector3 ReferenceIntegrator::polish(const Matrix3& stress, Vector3 n) const {
  const bool plane = setting_ != Setting::three_d;
  const int dirs = plane ? 1 : 2;
  for (int k = 0; k < 60; ++k) {
    const Matrix3 r = frame_of(n, plane);
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    Eigen::Matrix2d hess = -Eigen::Matrix2d::Identity();
    const double h = 1e-5;
    for (int i = 0; i < dirs; ++i) g[i] = r.row(i + 1).dot(gradient(stress, n));
    for (int j = 0; j < dirs; ++j) {
      const Vector3 s = r.row(j + 1).transpose();
      const Vector3 plus = gradient(stress, (n * std::cos(h) + s * std::sin(h)).eval());
      const Vector3 minus = gradient(stress, (n * std::cos(h) - s * std::sin(h)).eval());
      for (int i = 0; i < dirs; ++i) hess(i, j) = r.row(i + 1).dot(plus - minus) / (2.0 * h);
    }
    hess = (0.5 * (hess + hess.transpose())).eval();
    // A flat direction (equal principal stresses) is left alone.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eig(hess);
    const double scale = std::abs(eig.eigenvalues()[0]) + std::abs(eig.eigenvalues()[1]);
    Eigen::Vector2d move = Eigen::Vector2d::Zero();
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d v = eig.eigenvectors().col(i);
      const double curvature = std::abs(eig.eigenvalues()[i]);
      if (curvature > 1e-9 * scale) move += v * std::clamp(v.dot(g) / curvature, -0.05, 0.05);
    }
    const Vector3 s = r.row(1).transpose() * move[0] + r.row(2).transpose() * (plane ? 0.0 : move[1]);
    n = (n + s).normalized();
    if (move.norm() < 1e-14) break;
  }
  return n;
}

ReferencePlane ReferenceIntegrator::critical_plane(const Matrix3& stress, const Vector3& hint) const {
  std::vector<Vector3> normals;
  const int steps = 90;
  for (int i = 0; i < steps; ++i) {
    const double a = i * pi / steps;
    if (setting_ != Setting::three_d) {
      normals.emplace_back(std::cos(a), std::sin(a), 0.0);
      continue;
    }
    const int around = std::max(1, static_cast<int>(std::lround(steps * std::sin(0.5 * a))));
    for (int j = 0; j < around; ++j) {
      const double b = 2.0 * pi * j / around;
      normals.emplace_back(std::sin(0.5 * a) * std::cos(b), std::sin(0.5 * a) * std::sin(b), std::cos(0.5 * a));
    }
  }
  // Polish the best few of the scan, well separated; the tie goes to the hint.
  std::vector<double> values;
  for (const Vector3& n : normals) values.push_back(failure_value(stress, n));
  const double top = *std::max_element(values.begin(), values.end());
  const double low = *std::min_element(values.begin(), values.end());
  ReferencePlane best{normals[0], -1e300};
  const Vector3 start_hint = polish(stress, hint.norm() > 0.0 ? hint.normalized() : normals[0]);
  std::vector<Vector3> candidates{start_hint};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (values[i] > top - 2e-3 * (top - low)) candidates.push_back(normals[i]);
  }
  const double tie = 1e-11 * (p_.cohesion + stress.norm());
  for (const Vector3& start : candidates) {
    const Vector3 n = polish(stress, start);
    const double f = failure_value(stress, n);
    const bool closer = std::abs(n.dot(hint)) > std::abs(best.normal.dot(hint)) + 1e-9;
    if (f > best.failure_value + tie || (f > best.failure_value - tie && closer)) best = {n, f};
  }
  if (best.normal.dot(hint) < 0.0) best.normal = -best.normal;
  return best;
}

ReferenceIntegrator::Y ReferenceIntegrator::pack() const {
  Y y;
  y << s_.t, s_.u, s_.up, s_.slip, s_.integrity, s_.dissipated;
  return y;
}

void ReferenceIntegrator::unpack(const Y& y) {
  s_.t = y.segment<3>(0);
  s_.u = y.segment<3>(3);
  s_.up = y.segment<3>(6);
  s_.slip = y[9];
  s_.integrity = y[10];
  s_.dissipated = y[11];
}

/// Eq 48, divided by the square of (1-D) so that it stays of one size.
double ReferenceIntegrator::yield(const Vector3& t, double w) const {
  const double tn = t[0] / w;
  const double ts2 = (t[1] * t[1] + t[2] * t[2]) / (w * w);
  const double s = p_.tensile_strength;
  return ts2 - 2.0 * p_.cohesion * tan_phi_ * (s - tn) - tan_phi_ * tan_phi_ * (tn * tn - s * s);
}

ReferenceIntegrator::Derivatives ReferenceIntegrator::rates(const Y& y, const Mode& mode) const {
  return consistent_ ? consistent_rates(y, mode) : published_rates(y, mode);
}

/// du = dup + d(D K^-1 t) with dup = dlambda g - K^-1 t dD/2, and continuity dt + B du = drive, B the bulk's stiffness:
///   (1 + B D/K) dt = drive - dlambda B (g + R t/(2 K)),  dD = R dlambda;  f = 0 stays: f_t.dt = f_w R dlambda.
ReferenceIntegrator::Derivatives ReferenceIntegrator::consistent_rates(const Y& y, const Mode& mode) const {
  const Vector3 t = y.segment<3>(0);
  const double w = y[10];
  const Vector3 bulk = Vector3(lambda_ + 2.0 * mu_, mu_, mu_) / p_.rve_length;
  const double kn = std::max(p_.normal_stiffness, p_.tensile_strength / p_.delta0);
  const double ks = std::max(p_.shear_stiffness, p_.cohesion / p_.delta0);
  const Vector3 spring(1.0 / kn, 1.0 / ks, 1.0 / ks);
  const Vector3 elastic = (1.0 - w) * spring;  // D/K
  const Vector3 share = (Vector3::Ones() + bulk.cwiseProduct(elastic)).cwiseInverse();
  Derivatives d{Y::Zero(), 0.0};
  Vector3 dt = share.cwiseProduct(drive_);
  if (!mode.plastic) {
    d.rate.segment<3>(0) = dt;
    d.rate.segment<3>(3) = elastic.cwiseProduct(dt);
    return d;
  }
  const double c = p_.cohesion * w;
  const double s = p_.tensile_strength * w;
  const Vector3 f_t(2.0 * tan_phi_ * (c - t[0] * tan_phi_), 2.0 * t[1], 2.0 * t[2]);
  const Vector3 g_t(2.0 * tan_psi_ * (c - t[0] * tan_psi_), 2.0 * t[1], 2.0 * t[2]);
  const double f_w =
      -2.0 * p_.cohesion * tan_phi_ * (2.0 * s - t[0]) + 2.0 * tan_phi_ * tan_phi_ * p_.tensile_strength * s;
  double shear = std::hypot(g_t[1], g_t[2]);
  if (mode.shear_sign != 0.0) shear = mode.shear_sign * g_t[1];
  const double r = fall(w, mode.piece) * (g_t[0] + shear);
  const Vector3 reversible = 0.5 * r * spring.cwiseProduct(t);
  const Vector3 push = share.cwiseProduct(bulk).cwiseProduct(g_t + reversible);
  const double denominator = f_t.dot(push) + f_w * r;
  if (!(denominator > 0.0)) throw std::runtime_error("reference: the rate problem has no unique solution");
  d.multiplier = f_t.dot(dt) / denominator;
  dt -= d.multiplier * push;
  d.rate.segment<3>(0) = dt;
  d.rate.segment<3>(3) = d.multiplier * (g_t + reversible) + elastic.cwiseProduct(dt);
  d.rate.segment<3>(6) = d.multiplier * (g_t - reversible);
  d.rate[9] = d.multiplier * shear;
  d.rate[10] = -d.multiplier * r;
  d.rate[11] = d.multiplier * t.dot(g_t);
  return d;
}

ReferenceIntegrator::Derivatives ReferenceIntegrator::published_rates(const Y& y, const Mode& mode) const {
  const Vector3 t = y.segment<3>(0);
  const double w = y[10];
  const double c = p_.cohesion * w;
  const double s = p_.tensile_strength * w;
  const Vector3 bulk = Vector3(lambda_ + 2.0 * mu_, mu_, mu_) / p_.rve_length;
  const Vector3 pk((mode.tension ? w : 1.0) * p_.normal_stiffness, w * p_.shear_stiffness, w * p_.shear_stiffness);
  Derivatives d{Y::Zero(), 0.0};
  if (!mode.plastic) {
    const Vector3 du = drive_.cwiseQuotient(bulk + pk);
    d.rate.segment<3>(0) = pk.cwiseProduct(du);
    d.rate.segment<3>(3) = du;
    return d;
  }
  const Vector3 f_t(2.0 * tan_phi_ * (c - t[0] * tan_phi_), 2.0 * t[1], 2.0 * t[2]);
  const Vector3 g_t(2.0 * tan_psi_ * (c - t[0] * tan_psi_), 2.0 * t[1], 2.0 * t[2]);
  const Vector3 t_d(mode.tension ? -t[0] / w : 0.0, -t[1] / w, -t[2] / w);
  const double f_w =
      -2.0 * p_.cohesion * tan_phi_ * (2.0 * s - t[0]) + 2.0 * tan_phi_ * tan_phi_ * p_.tensile_strength * s;
  double shear = std::hypot(g_t[1], g_t[2]);
  if (mode.shear_sign != 0.0) shear = mode.shear_sign * g_t[1];  // smooth through zero; the event ends the phase there
  const double r = fall(w, mode.piece) * (g_t[0] + shear);       // eq 52
  const Vector3 pkg = pk.cwiseProduct(g_t);
  const double denominator = f_t.dot(pkg) - f_t.dot(t_d) * r + f_w * r;
  const Vector3 m = f_t.cwiseProduct(pk) / denominator;  // eq 65
  Matrix3 kt = pk.asDiagonal();
  kt += (t_d * r - pkg) * m.transpose();  // eq 67
  Matrix3 total = kt;
  total.diagonal() += bulk;
  const Vector3 du = total.partialPivLu().solve(drive_);  // eq 42
  d.multiplier = m.dot(du);
  // h = det(B + K^t)/det(B + P K) times positive factors: uniqueness of the rate problem.
  if (!(total.determinant() * denominator > 0.0) || !(denominator > 0.0)) {
    throw std::runtime_error("reference: the rate problem has no unique solution");
  }
  const Vector3 dup = d.multiplier * g_t;
  const double dd = d.multiplier * r;
  const double energy =
      0.5 *
      ((mode.tension ? t[0] * t[0] / p_.normal_stiffness : 0.0) + (t[1] * t[1] + t[2] * t[2]) / p_.shear_stiffness) /
      (w * w);
  d.rate.segment<3>(0) = kt * du;
  d.rate.segment<3>(3) = du;
  d.rate.segment<3>(6) = dup;
  d.rate[9] = d.multiplier * shear;
  d.rate[10] = -dd;
  d.rate[11] = t.dot(dup) + energy * dd;
  return d;
}

ReferenceIntegrator::Y ReferenceIntegrator::step(const Y& y, double h, const Mode& mode, Y* error) const {
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
  Y k[7];
  Y out = y;
  for (int i = 0; i < 7; ++i) {
    Y sum = Y::Zero();
    for (int j = 0; j < i; ++j) sum += a[i][j] * k[j];
    out = y + h * sum;
    k[i] = rates(out, mode).rate;
  }
  if (error) {
    error->setZero();
    for (int i = 0; i < 7; ++i) *error += h * e[i] * k[i];
  }
  return out;
}

/// Where the elastic motion reaches the yield surface, as a distance in the increment; negative: nowhere.
double ReferenceIntegrator::elastic_exit(const Y& y, const Mode& mode) const {
  const double w = y[10];
  const Vector3 t = y.segment<3>(0) / w;
  const Vector3 dt = rates(y, mode).rate.segment<3>(0) / w;
  const double k2 = tan_phi_ * tan_phi_;
  const double a = dt[1] * dt[1] + dt[2] * dt[2] - k2 * dt[0] * dt[0];
  const double b = 2.0 * (t[1] * dt[1] + t[2] * dt[2] + p_.cohesion * tan_phi_ * dt[0] - k2 * t[0] * dt[0]);
  const double c = yield(t, 1.0);
  const bool on_surface = c > -1e-10 * p_.cohesion * p_.cohesion;
  if (!on_surface) return first_root(a, b, c, 0.0);
  if (unloading_) return first_root(a, std::min(b, 0.0), 0.0, 1e-9);  // b is zero to rounding
  return b > 0.0 || (b == 0.0 && a > 0.0) ? 0.0 : first_root(a, b, 0.0, 0.0);
}

double ReferenceIntegrator::event(const Y& y, const Mode& mode, int which) const {
  if (which == 0) return rates(y, mode).multiplier;
  if (which == 1) return mode.tension ? y[0] : -y[0];
  if (which == 3) return piece_end(mode.piece) < 0.0 ? 1.0 : y[10] - piece_end(mode.piece);
  return mode.shear_sign == 0.0 ? 1.0 : mode.shear_sign * y[1];
}

ReferenceIntegrator::Mode ReferenceIntegrator::current_mode(const Y& y) const {
  Mode m;
  const double small = 1e-13 * p_.tensile_strength * y[10];
  m.tension = std::abs(y[0]) > small ? y[0] > 0.0 : drive_[0] >= 0.0;
  if (setting_ != Setting::three_d) {
    const double s = std::abs(y[1]) > small ? y[1] : drive_[1];
    m.shear_sign = s < 0.0 ? -1.0 : 1.0;
  }
  m.piece = y[10] > piece_end(0) ? 0 : 1;
  m.plastic = elastic_exit(y, m) == 0.0;
  return m;
}

void ReferenceIntegrator::elastic_phase(double& x) {
  const Y y = pack();
  Mode mode = current_mode(y);
  const Y rate = rates(y, mode).rate;
  double to = 1.0 - x;
  const double exit = elastic_exit(y, mode);
  if (exit >= 0.0) to = std::min(to, exit);
  const double kink = rate[0] != 0.0 ? -y[0] / rate[0] : -1.0;
  const bool switches = kink > 1e-12 && kink < to;
  if (switches) to = kink;
  Y end = y + to * rate;
  if (switches) end[0] = 0.0;
  unpack(end);
  unloading_ = false;
  x = to == 1.0 - x ? 1.0 : x + to;
}

void ReferenceIntegrator::plastic_phase(double& x) {
  Y y = pack();
  Mode mode = current_mode(y);
  double h = std::min(1.0 - x, 1e-3);
  while (x < 1.0) {
    h = std::min(h, 1.0 - x);
    Y error;
    Y next;
    try {
      next = step(y, h, mode, &error);
    } catch (const std::runtime_error&) {  // perhaps only because a long step overshoots
      if (h < 1e-11) throw;
      h *= 0.1;
      continue;
    }
    const double w = y[10];
    const double e = std::max({error.segment<3>(0).cwiseAbs().maxCoeff() / (w * p_.tensile_strength),
                               error.segment<7>(3).cwiseAbs().maxCoeff() / p_.delta0, std::abs(error[10]) / w}) /
                     tolerance_;
    if (!(e <= 1.0) && h > 1e-12) {
      h *= std::max(0.1, 0.9 * std::pow(e, -0.2));
      continue;
    }
    double taken = h;
    int fired = -1;
    for (int which = 0; which < 4; ++which) {
      if (event(next, mode, which) >= 0.0) continue;
      double lo = 0.0;
      double hi = taken;
      for (int k = 0; k < 70; ++k) {
        const double mid = 0.5 * (lo + hi);
        (event(step(y, mid, mode, nullptr), mode, which) >= 0.0 ? lo : hi) = mid;
      }
      taken = hi;
      fired = which;
      next = step(y, taken, mode, nullptr);
    }
    y = next;
    x = fired < 0 && taken == 1.0 - x ? 1.0 : x + taken;
    if (fired == 0) {
      unloading_ = true;
      break;
    }
    if (fired == 1) mode.tension = !mode.tension;
    if (fired == 2) mode.shear_sign = -mode.shear_sign;
    if (fired == 3) {
      y[10] = piece_end(mode.piece);
      ++mode.piece;
    }
    h = taken * (fired < 0 ? std::min(4.0, 0.9 * std::pow(e + 1e-10, -0.2)) : 0.5);
    h = std::max(h, 1e-9);
  }
  // The drift off the yield surface, far below the tolerance per step, is taken out of the normal traction.
  const double apex = (p_.cohesion - p_.tensile_strength * tan_phi_) * y[10];
  y[0] = (p_.cohesion * y[10] - std::sqrt(y[1] * y[1] + y[2] * y[2] + apex * apex)) / tan_phi_;
  unpack(y);
}

void ReferenceIntegrator::open(const Matrix3& dstrain, const Vector3& hint, double& x) {
  const Matrix3 start = elastic_stress(s_.strain);
  const Matrix3 rate = elastic_stress(dstrain);
  if (critical_plane(start + rate, hint).failure_value < 0.0) {
    s_.strain += dstrain;
    x = 1.0;
    return;
  }
  // The largest F over the planes is convex along the path: Newton from the right with the slope on the critical plane.
  x = 1.0;
  ReferencePlane plane = critical_plane(start + rate, hint);
  for (int k = 0; k < 50; ++k) {
    const double h = 1e-6;
    const double slope =
        (failure_value(start + (x + h) * rate, plane.normal) - failure_value(start + (x - h) * rate, plane.normal)) /
        (2.0 * h);
    const double move = plane.failure_value / slope;
    x -= move;
    plane = critical_plane(start + x * rate, hint);
    if (std::abs(move) < 1e-15) break;
  }
  s_.cracked = true;
  s_.strain += x * dstrain;
  s_.frame = frame_of(plane.normal, setting_ != Setting::three_d);
  s_.t = s_.frame * (start + x * rate) * plane.normal;
}

void ReferenceIntegrator::advance(const Matrix3& dstrain, const Vector3& hint) {
  const Matrix3 target = s_.strain + dstrain;
  double x = 0.0;
  if (!s_.cracked) {
    open(dstrain, hint, x);
    if (!s_.cracked) return;
  }
  drive_ = s_.frame * elastic_stress(dstrain) * s_.frame.row(0).transpose();
  unloading_ = false;
  for (int phase = 0; x < 1.0; ++phase) {
    if (phase > 1000) throw std::runtime_error("reference: too many phases");
    current_mode(pack()).plastic ? plastic_phase(x) : elastic_phase(x);
  }
  s_.strain = target;
}

}  // namespace fpz::test
