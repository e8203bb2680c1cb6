#include "fpz/parameters.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "fpz/law/softening.hpp"
#include "fpz/law/unloading.hpp"

namespace fpz {
namespace {

/// Shortest text that reads back as the same number, so that a message shows what was given.
std::string exact(double x) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), x);
  return {text.data(), result.ptr};
}

/// Seven significant digits, for computed bounds.
std::string rounded(double x) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::general, 7);
  return {text.data(), result.ptr};
}

double normal_modulus(const Parameters& p, Setting setting) {
  const double e = p.young_modulus;
  const double nu = p.poisson_ratio;
  if (setting == Setting::plane_stress) return e / (1.0 - nu * nu);
  return e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
}

/// Smallest value of a convex function between lo and hi, by golden section.
template <class F>
double smallest(double lo, double hi, const F& f) {
  const double part = 0.5 * (std::sqrt(5.0) - 1.0);
  double best = std::min(f(lo), f(hi));
  for (int k = 0; k < 80; ++k) {
    const double a = hi - part * (hi - lo);
    const double b = lo + part * (hi - lo);
    best = std::min({best, f(a), f(b)});
    (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
  }
  return best;
}

/// l of snap_back_length(). In the consistent zone h > 0 in mode I asks for b + (1 - 3 w/2)/Kn < 1/(sigma_t0 |dw/da|)
/// at every w (docs/equations.md); what is left for b is a convex function of w on each piece of the softening.
double critical_length(const Parameters& p) {
  const auto softening = Softening<double>::make(p);
  if (p.choices.cohesive_zone == CohesiveZone::published) return softening.shortest_length();
  const double spring = p.tensile_strength / unloading_stiffness(p).normal;
  double shortest = std::numeric_limits<double>::infinity();
  double begin = 1.0;
  for (int piece = softening.piece(begin); piece != settled_piece; piece = softening.piece(begin)) {
    const double end = softening.piece_end(piece);
    shortest = std::min(shortest, smallest(end, begin, [&](double w) {
                          return -1.0 / softening.slope(piece, w) - spring * (1.0 - 1.5 * w);
                        }));
    begin = end;
  }
  return shortest;
}

class Checker {
 public:
  bool finite(const std::string& field, double v) { return require(std::isfinite(v), field, v, "must be finite"); }

  bool require(bool holds, const std::string& field, double v, std::string constraint) {
    if (!holds) result.errors.push_back({field, v, std::move(constraint)});
    return holds;
  }

  void warn(const std::string& field, double v, std::string text) {
    result.warnings.push_back({field, v, std::move(text)});
  }

  Validation result;
};

}  // namespace

std::string Bounds::text() const {
  std::string text = (lower_included ? ">= " : "> ") + exact(lower);
  if (upper < unbounded) text += " and < " + exact(upper);
  return text;
}

std::string Validation::report() const {
  std::string text;
  const auto append = [&text](const char* kind, const std::vector<Violation>& list) {
    for (const Violation& v : list) {
      text += kind;
      text += ": " + v.field + " = " + exact(v.value) + ": " + v.constraint + '\n';
    }
  };
  append("error", errors);
  append("warning", warnings);
  return text;
}

double snap_back_length(const Parameters& p, Setting setting) {
  return normal_modulus(p, setting) * critical_length(p) / p.tensile_strength;
}

OnsetPreload onset_preload(const Parameters& p) {
  OnsetPreload most;
  if (p.choices.cohesive_zone != CohesiveZone::published) return most;
  // On the onset surface |t_s|^2 = (c0 - t_n tan(phi))^2 - A^2 the energy is a convex function of t_n: largest at an
  // end.
  const double tan_phi = std::tan(p.friction_angle_deg * degree);
  const double apex = p.cohesion - p.tensile_strength * tan_phi;
  for (const double normal : {p.tensile_strength, -p.cohesion}) {
    const double radius = p.cohesion - normal * tan_phi;
    const double shear = std::sqrt(std::max((radius - apex) * (radius + apex), 0.0));
    const double opening = 0.5 * normal * normal / p.normal_stiffness;
    const double slip = 0.5 * shear * shear / p.shear_stiffness;
    const double ratio = (opening + slip) / (p.tensile_strength * p.delta0);
    if (ratio > most.ratio) most = {ratio, normal, shear, opening > slip ? p.normal_stiffness : p.shear_stiffness};
  }
  return most;
}

double uniaxial_tensile_strength(const Parameters& p) {
  const double tan_phi = std::tan(p.friction_angle_deg * degree);
  const double cos_phi = std::cos(p.friction_angle_deg * degree);
  const double c0 = p.cohesion;
  const double apex = c0 - p.tensile_strength * tan_phi;
  // 1. The plane normal to the load is critical as long as the Mohr circle at sigma_t0 has r <= A tan(phi).
  if (0.5 * p.tensile_strength <= apex * tan_phi) return p.tensile_strength;
  // 2. Otherwise sqrt(r^2 + A^2) = c0 cos(phi) - p sin(phi) with p = r = s/2, squared:
  //    r^2 + 2 c0 tan(phi) r + A^2/cos^2(phi) - c0^2 = 0, whose positive root is
  //    r = sqrt(c0^2 - A^2)/cos(phi) - c0 tan(phi).
  const double r = std::sqrt((c0 - apex) * (c0 + apex)) / cos_phi - c0 * tan_phi;
  return 2.0 * r;
}

namespace {

/// Springs that are too soft: in the published zone they are preloaded with an energy that counts beside G, in the
/// consistent one they are not used as they are.
void warn_of_springs(const Parameters& p, Checker& check) {
  constexpr double negligible = 0.1;  // of G
  const OnsetPreload preload = onset_preload(p);
  if (preload.ratio > negligible) {
    const bool normal = preload.stiffness == p.normal_stiffness;
    check.warn(normal ? "normal_stiffness" : "shear_stiffness", preload.stiffness,
               "the published zone starts with preloaded springs that give back up to " + rounded(preload.ratio) +
                   " times the fracture energy (normal tractions from -cohesion to tensile_strength); use "
                   "\"cohesive_zone\": \"consistent\" or a stiffness " +
                   rounded(preload.ratio / negligible) + " times as high");
  }
  const UnloadingStiffness<double> used = unloading_stiffness(p);
  const auto raised = [&](const char* field, double given, double in_use) {
    if (in_use == given) return;
    check.warn(field, given,
               "softer than the secant of the softening, which would snap back by itself; unloading and contact take " +
                   rounded(in_use) + " Pa/m");
  };
  raised("normal_stiffness", p.normal_stiffness, used.normal);
  raised("shear_stiffness", p.shear_stiffness, used.shear);
}

}  // namespace

Validation validate(const Parameters& p, Setting setting) {
  Checker check;

  // 1. Each value by itself, in the order of the table.
  std::array<bool, parameter_table<double>.size()> sound{};
  for (std::size_t k = 0; k < sound.size(); ++k) {
    const ParameterInfo<double>& info = parameter_table<double>[k];
    const std::string name(info.name);
    sound[k] = check.finite(name, p.*info.member) &&
               check.require(info.bounds.hold(p.*info.member), name, p.*info.member, "must be " + info.bounds.text());
  }
  const auto ok = [&sound](double Parameters::*member) {
    for (std::size_t k = 0; k < sound.size(); ++k) {
      if (parameter_table<double>[k].member == member) return sound[k];
    }
    return false;
  };
  const bool strength_ok = ok(&Parameters::tensile_strength);
  const bool phi_ok = ok(&Parameters::friction_angle_deg);
  const bool psi_ok = ok(&Parameters::dilation_angle_deg);

  // 2. Values against each other, where each of them makes sense.
  if (phi_ok && psi_ok) {
    check.require(p.dilation_angle_deg <= p.friction_angle_deg, "dilation_angle_deg", p.dilation_angle_deg,
                  "must be <= friction_angle_deg = " + exact(p.friction_angle_deg));
  }
  bool surface_ok = strength_ok && ok(&Parameters::cohesion) && phi_ok;
  if (surface_ok) {
    const double bound = p.tensile_strength * std::tan(p.friction_angle_deg * degree);
    surface_ok = check.require(p.cohesion > bound, "cohesion", p.cohesion,
                               "must be > tensile_strength * tan(friction_angle_deg) = " + rounded(bound));
  }

  // 3. Doubtful values.
  if (ok(&Parameters::young_modulus) && ok(&Parameters::poisson_ratio) && strength_ok && ok(&Parameters::delta0) &&
      ok(&Parameters::rve_length)) {
    const double bound = snap_back_length(p, setting);
    if (p.rve_length >= bound) {
      const char* modulus = setting == Setting::plane_stress ? "E/(1 - nu^2)" : "(lambda + 2 mu)";
      const double lengths = critical_length(p) / p.delta0;
      const std::string length = lengths == 1.0 ? "delta0" : rounded(lengths) + " delta0";
      check.warn("rve_length", p.rve_length,
                 "should be < " + std::string(modulus) + " * " + length + " / tensile_strength = " + rounded(bound) +
                     ": mode I snaps back under strain control");
    }
  }
  if (psi_ok && p.dilation_angle_deg == 0.0) {
    check.warn("dilation_angle_deg", p.dilation_angle_deg,
               "should be > 0: pure opening has no solution without dilation");
  }
  if (surface_ok) {
    const double strength = uniaxial_tensile_strength(p);
    if (strength < p.tensile_strength) {
      const double tan_phi = std::tan(p.friction_angle_deg * degree);
      const double mode_one = p.tensile_strength * (tan_phi + 0.5 / tan_phi);
      check.warn("cohesion", p.cohesion,
                 "should be >= tensile_strength * (tan(phi) + 1/(2 tan(phi))) = " + rounded(mode_one) +
                     ": uniaxial tension cracks on an inclined plane at " + rounded(strength) +
                     ", below tensile_strength = " + exact(p.tensile_strength));
    }
  }
  if (surface_ok && ok(&Parameters::delta0) && ok(&Parameters::normal_stiffness) && ok(&Parameters::shear_stiffness)) {
    warn_of_springs(p, check);
  }
  return std::move(check.result);
}

}  // namespace fpz
