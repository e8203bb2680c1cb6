#include "fpz/calibration/fracture_energy.hpp"

#include <cmath>
#include <stdexcept>

#include "admissible.hpp"
#include "fpz/calibration/onset_traction.hpp"
#include "fpz/energy.hpp"
#include "jet.hpp"
#include "softening_quadrature.hpp"
#include "words.hpp"
#include "zone.hpp"

namespace fpz::calibration {
namespace {

/// exp(-k) at which nothing is left, for sums near 1.
constexpr double complete_softening = 40.0;

template <class T>
struct Work {
  T value = T(0.0);
  std::string failure;
};

template <class T>
Work<T> no_work(std::string why) {
  return {T(0.0), std::move(why)};
}

/// Enough digits to find the value again in the input.
std::string number(double x) { return detail::number(x, 6); }

/// The jump's direction with exact values at the ends.
Vec<double, 2> unit_direction(double angle_deg) {
  Vec<double, 2> u;
  u << (angle_deg == 90.0 ? 0.0 : std::cos(angle_deg * degree)),
      (angle_deg == 0.0 ? 0.0 : std::sin(angle_deg * degree));
  return u;
}

/// Yielding at zero compliance along a fixed direction of the jump (cosine, sine) while the plane is in tension.
///
/// With tau_s = A sinh x the rate problem (docs/equations.md) is one autonomous equation, dx/ds = N(x)/Q(x), that runs
/// into the zero x* of N = sine m_n - cosine tau_s, where the flow is parallel to the jump. In
/// z = ln((x0 - x*)/(x - x*)) nothing is singular: x = x* + (x0 - x*) exp(-z), and N/(x - x*) has a closed form. For
/// exponential softening, whose end is then an exponential too.
template <class T>
class OpenZone {
 public:
  OpenZone(const CohesiveLaw<T>& law, const Vec<double, 2>& direction, const Vec<T, 2>& onset)
      : law_(law),
        exponential_(std::get<ExponentialSoftening<T>>(law.softening.law)),
        cosine_(direction[0]),
        sine_(direction[1]) {
    using std::log;
    using std::sqrt;
    // N = 0 is quadratic in exp(x); one root is positive because cosine > sine flow_1.
    const T a = 0.5 * law.surface.apex * (cosine_ - sine_ * law.surface.flow_1);
    const T b = sine_ * law.surface.flow_0;
    const T c = 0.5 * law.surface.apex * (cosine_ + sine_ * law.surface.flow_1);
    end_ = log((b + sqrt(b * b + 4.0 * a * c)) / (2.0 * a));
    const T begin =
        log((onset[1] + sqrt(onset[1] * onset[1] + law.surface.apex * law.surface.apex)) / law.surface.apex);
    distance_ = begin - end_;
  }

  /// False where the plane meets contact on the way.
  [[nodiscard]] bool stays_open() const {
    const double most = std::max(std::abs(value(end_)), std::abs(value(end_) + value(distance_)));
    return value(law_.surface.cohesion) >= value(law_.surface.apex) * std::cosh(most);
  }

  [[nodiscard]] SofteningRate<T> operator()(double z) const { return at(T(distance_ * std::exp(-z))); }
  /// The state that the zone approaches.
  [[nodiscard]] SofteningRate<T> steady() const { return at(T(0.0)); }

 private:
  [[nodiscard]] SofteningRate<T> at(const T& d) const {
    using std::cosh;
    using std::sinh;
    const T x = end_ + d;
    const T middle = end_ + 0.5 * d;
    const T shear = law_.surface.apex * sinh(x);
    const SurfacePoint<T> h = law_.surface.point(T(shear * shear));
    const T less = law_.surface.apex * (cosine_ * cosh(middle) - sine_ * law_.surface.flow_1 * sinh(middle)) *
                   sinh_ratio(T(0.5 * d));
    const T stiff = law_.surface.cot_phi * law_.flexibility_n * shear;
    SofteningRate<T> r;
    r.length = (law_.flexibility_s * h.flow_n * h.radius + stiff * shear) / less;
    r.softening = (h.flow_n + shear) * (law_.flexibility_s * h.radius * cosine_ + stiff * sine_) / less *
                  exponential_.inverse_delta0;
    r.work = (h.normal * cosine_ + shear * sine_) * r.length;
    return r;
  }

  /// sinh(d)/d.
  [[nodiscard]] static T sinh_ratio(const T& d) {
    using std::sinh;
    if (std::abs(value(d)) > 0.05) return sinh(d) / d;
    const T e = d * d;
    return 1.0 + e / 6.0 * (1.0 + e / 20.0 * (1.0 + e / 42.0 * (1.0 + e / 72.0)));
  }

  CohesiveLaw<T> law_;
  ExponentialSoftening<T> exponential_;
  double cosine_;
  double sine_;
  T end_;
  T distance_;
};

/// Yielding in shear at a constant normal traction, with z = k = -ln w: everything follows from w = exp(-z).
template <class T>
class ShearedZone {
 public:
  ShearedZone(const CohesiveLaw<T>& law, double normal) : law_(law), normal_(normal) {}

  [[nodiscard]] SofteningRate<T> operator()(double z) const {
    const double w = std::exp(-z);
    const T friction = normal_ * law_.surface.tan_phi;
    const T apex = w * law_.surface.apex;
    const T radius = w * law_.surface.cohesion - friction;
    const T shear = surface_shear(radius, apex);
    const T dilation = law_.surface.tan_psi * (w * law_.surface.cohesion - normal_ * law_.surface.tan_psi) / shear;
    const T fall = law_.softening.local_length(law_.softening.piece(w), T(w));
    const T slip = fall / (1.0 + dilation);  // of d(up_s), per k
    // Elastic part of the slip, d(t_s/(w Ks))/dk; the normal spring softens only in tension.
    const T spring = friction * (friction - w * law_.surface.cohesion) / (w * shear) * law_.flexibility_s;
    const T opening = dilation * slip + (normal_ > 0.0 ? T(normal_ / w * law_.flexibility_n) : T(0.0));
    SofteningRate<T> r;
    r.length = slip + spring;
    r.softening = T(1.0);
    r.work = (shear * r.length + normal_ * opening) / w;
    return r;
  }

 private:
  CohesiveLaw<T> law_;
  double normal_;
};

/// Work up to the end of a mesh that stopped at the prescribed length: `sum` has the panels' width as a constant, the
/// rest of the length counts at the final rates.
template <class T, class Rates>
T work_at_length(const SofteningSum<T>& sum, const Rates& rates, double length) {
  using std::exp;
  const SofteningRate<T> last = rates(sum.z);
  return sum.work + exp(-sum.softening) * last.work / last.length * (length - sum.length);
}

template <class T>
Work<T> open_work(const OpenZone<T>& zone, const OpenZone<double>& plain, std::optional<double> end) {
  using std::exp;
  const SofteningMesh mesh = make_mesh(plain, end, complete_softening, complete_softening);
  if (mesh.stuck) return no_work<T>("the work of fracture cannot be integrated for these parameters");
  const SofteningSum<T> sum = integrate<T>(mesh, zone);
  if (mesh.reached_end) return {work_at_length(sum, zone, *end), {}};
  // The transient is over: the traction falls exponentially at a fixed direction.
  const SofteningRate<T> steady = zone.steady();
  const T whole = exp(-sum.softening) * steady.work / steady.softening;
  if (!end) return {sum.work + whole, {}};
  const T rest = (*end - sum.length) * steady.softening / steady.length;
  return {sum.work + whole * (1.0 - exp(-rest)), {}};
}

template <class T>
Work<T> sheared_work(const CohesiveLaw<T>& law, const CohesiveLaw<double>& plain, const FractureEnergyTest& test) {
  const double normal = test.normal_traction;
  if (normal >= plain.surface.tensile_strength) {
    return no_work<T>("a normal traction of " + number(normal) +
                      " Pa is not below the tensile strength: the zone opens before it is sheared");
  }
  if (normal < 0.0 && !test.end) {
    return no_work<T>(
        "the work of shearing under compression does not converge: friction never ends. Give an end slip");
  }
  const ShearedZone<T> zone(law, normal);
  const ShearedZone<double> rates(plain, normal);
  const SofteningMesh mesh = make_mesh(rates, test.end, normal < 0.0 ? 600.0 : complete_softening, 1e3);
  const SofteningSum<T> sum = integrate<T>(mesh, zone);
  if (mesh.stuck) {
    return no_work<T>("under the constant tension of " + number(normal) +
                      " Pa the zone separates at once after a slip of " + number(value(sum.length)) +
                      " m: the work to a larger slip is not that of an equilibrium path. "
                      "Use a normal traction of zero or below, or a smaller end slip");
  }
  if (mesh.reached_end) return {work_at_length(sum, zone, *test.end), {}};
  if (normal < 0.0) return no_work<T>("the end slip is not reached before the integrity vanishes in floating point");
  return {sum.work, {}};
}

/// The work of the library's own integrator along a fixed direction: for planes that are pressed shut on the way, and
/// for softening laws without a quadrature.
template <class T>
Work<T> pressed_work(const CohesiveLaw<T>& law, const Vec<double, 2>& direction, const Vec<T, 2>& onset,
                     std::optional<double> end) {
  Options options;
  options.tolerance = 1e-11;
  CohesiveState<T, 2> zone = cracked_at<T, 2>(law, onset);
  const double length = end ? *end : 4.0 * value(law.softening.length());
  for (int k = 0; k < 1000; ++k) {
    const Vec<T, 2> du = convert<T>(Vec<double, 2>(direction * length));
    const Report report = move_zone(law, options, zone, du, zone);
    if (!report.ok()) {
      return no_work<T>("the zone cannot be followed along this direction (" + std::string(to_string(report.status)) +
                        ")");
    }
    if (end || value(zone.integrity) < 1e-14) return {zone.dissipated + free_energy(law, zone), {}};
  }
  return no_work<T>("the zone is not separated after " + number(1000.0 * length) + " m. Give an end opening");
}

template <class T>
Work<T> directed_work(const CohesiveLaw<T>& law, const CohesiveLaw<double>& plain, const FractureEnergyTest& test,
                      double angle_deg) {
  const Vec<double, 2> direction = unit_direction(angle_deg);
  const std::optional<Vec<T, 2>> onset = onset_traction(law, direction, test.onset_angle_deg);
  if (!onset) {
    return no_work<T>("no onset: traction at " + number(test.onset_angle_deg.value_or(angle_deg)) +
                      " degrees from the normal never reaches the yield surface");
  }
  const bool slides = direction[0] <= direction[1] * plain.surface.flow_1;  // tan^2(psi)/tan(phi): the friction limit
  if (!test.end && slides) {
    return no_work<T>(
        "the work does not converge: dilation presses the plane shut faster than the jump opens it, so "
        "friction never ends at " +
        number(angle_deg) + " degrees from the normal. Give an end opening");
  }
  if (!slides && std::holds_alternative<ExponentialSoftening<T>>(law.softening.law)) {
    const OpenZone<T> zone(law, direction, *onset);
    if (zone.stays_open()) {
      return open_work(zone, OpenZone<double>(plain, direction, convert<double>(*onset)), test.end);
    }
  }
  return pressed_work(law, direction, *onset, test.end);
}

template <class T>
Work<T> work(const BasicParameters<T>& p, const CohesiveLaw<double>& plain, const FractureEnergyTest& test) {
  const CohesiveLaw<T> law = jump_driven_law(p);
  switch (test.path) {
    case FracturePath::opening:
      return directed_work(law, plain, test, 0.0);
    case FracturePath::shear_at_normal_traction:
      return sheared_work(law, plain, test);
    case FracturePath::shear_at_fixed_opening:
      return directed_work(law, plain, test, 90.0);
    case FracturePath::direction:
      return directed_work(law, plain, test, test.angle_deg);
  }
  return no_work<T>("unknown fracture path");
}

std::string problem(const FractureEnergyTest& test, const Parameters& p) {
  if (std::string why = why_inadmissible(p); !why.empty()) return why;
  if (test.end && !(*test.end > 0.0 && std::isfinite(*test.end))) {
    return "the end opening must be above zero, not " + number(*test.end) + " m";
  }
  if (test.path == FracturePath::direction && !(test.angle_deg >= 0.0 && test.angle_deg <= 90.0)) {
    return "the direction of the jump must be 0 to 90 degrees from the normal, not " + number(test.angle_deg);
  }
  if (test.path == FracturePath::shear_at_normal_traction) {
    if (!std::isfinite(test.normal_traction)) return "the normal traction is not a number";
    if (test.onset_angle_deg) return "at constant normal traction the onset traction follows from it; give no angle";
  }
  if (test.onset_angle_deg && !(*test.onset_angle_deg >= 0.0 && *test.onset_angle_deg < 180.0)) {
    return "the onset traction must be 0 to 180 degrees from the normal, not " + number(*test.onset_angle_deg);
  }
  if (p.dilation_angle_deg == 0.0 && test.path != FracturePath::shear_at_normal_traction) {
    return "without dilation (dilation_angle_deg = 0) the zone has no plastic opening and is never separated. Use a "
           "dilation angle above 0";
  }
  return {};
}

void require(bool holds, const std::string& otherwise) {
  if (!holds) throw std::invalid_argument(otherwise);
}

}  // namespace

Prediction predict(const FractureEnergyTest& test, const Parameters& parameters, bool derivatives) {
  if (std::string why = problem(test, parameters); !why.empty()) return failed(std::move(why));
  const CohesiveLaw<double> plain = jump_driven_law(parameters);
  Prediction out;
  out.values.resize(1);
  if (!derivatives) {
    const Work<double> w = work(parameters, plain, test);
    if (!w.failure.empty()) return failed(w.failure);
    out.values[0] = w.value;
    return out;
  }
  const Work<Jet> w = work(seeded(parameters), plain, test);
  if (!w.failure.empty()) return failed(w.failure);
  out.values[0] = w.value.a;
  out.jacobian = w.value.v.transpose();
  return out;
}

double mode_one_delta0(double energy, double strength, std::optional<double> end) {
  require(energy > 0.0 && strength > 0.0 && std::isfinite(energy), "energy and strength must be above zero");
  if (!end) return energy / strength;
  const double share = energy / (strength * *end);
  require(*end > 0.0 && share < 1.0, "no delta0 gives " + number(energy) + " J/m2 up to an opening of " + number(*end) +
                                         " m at a strength of " + number(strength) +
                                         " Pa: even without softening it is " + number(strength * *end) + " J/m2");
  // 1 - exp(-v) = share v with v = end/delta0; concave, so Newton from the right is monotone.
  double v = 1.0 / share;
  for (int k = 0; k < 100; ++k) {
    const double step = (-std::expm1(-v) - share * v) / (std::exp(-v) - share);
    v -= step;
    if (!(std::abs(step) > 1e-16 * v)) break;
  }
  return *end / v;
}

std::optional<double> mode_one_end_opening(double energy, double strength, double delta0) {
  require(energy > 0.0 && strength > 0.0 && delta0 > 0.0, "energy, strength and delta0 must be above zero");
  const double share = energy / (strength * delta0);
  if (share >= 1.0) return std::nullopt;
  return -delta0 * std::log1p(-share);
}

}  // namespace fpz::calibration
