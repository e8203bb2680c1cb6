#include "fpz/io/material_conversion.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fpz::io {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace

ElasticConstants elastic_constants(std::optional<double> e, std::optional<double> nu, std::optional<double> k,
                                   std::optional<double> g) {
  const int given = (e ? 1 : 0) + (nu ? 1 : 0) + (k ? 1 : 0) + (g ? 1 : 0);
  require(given == 2, "two elastic constants determine the others");
  if (e && nu) return {*e, *nu};
  if (e && k) return {*e, (3.0 * *k - *e) / (6.0 * *k)};
  if (e && g) return {*e, *e / (2.0 * *g) - 1.0};
  if (nu && k) return {3.0 * *k * (1.0 - 2.0 * *nu), *nu};
  if (nu && g) return {2.0 * *g * (1.0 + *nu), *nu};
  return {9.0 * *k * *g / (3.0 * *k + *g), (3.0 * *k - 2.0 * *g) / (6.0 * *k + 2.0 * *g)};
}

double energy_modulus(double young_modulus, double poisson_ratio, Setting setting) {
  require(young_modulus > 0.0, "Young's modulus must be above zero");
  require(setting != Setting::three_d, "a toughness converts to an energy in plane strain or plane stress only");
  return setting == Setting::plane_stress ? young_modulus : young_modulus / (1.0 - poisson_ratio * poisson_ratio);
}

double energy_from_toughness(double toughness, double young_modulus, double poisson_ratio, Setting setting) {
  require(toughness >= 0.0, "a toughness must not be negative");
  return toughness * toughness / energy_modulus(young_modulus, poisson_ratio, setting);
}

double toughness_from_energy(double energy, double young_modulus, double poisson_ratio, Setting setting) {
  require(energy >= 0.0, "a fracture energy must not be negative");
  return std::sqrt(energy * energy_modulus(young_modulus, poisson_ratio, setting));
}

std::optional<double> cohesion_from_compression(double strength, double friction_angle_deg, double tensile_strength) {
  const double s = std::sin(friction_angle_deg * degree), c = std::cos(friction_angle_deg * degree);
  const double t = tensile_strength * s / c;  // A = c0 - t
  // The circle's condition squared, c0^2 s^2 - c0 (2 t + q s c) + t^2 + q^2 c^2/4 = 0. At the larger root the critical
  // plane is outside the circle. The smaller one as a quotient, which does not cancel for small angles.
  const double half = t + 0.5 * strength * s * c;
  const double root = std::sqrt(t * c * (t * c + strength * s));
  const double cohesion = (t * t + 0.25 * strength * strength * c * c) / (half + root);
  if (!(cohesion > t)) return std::nullopt;
  return cohesion;
}

double mohr_coulomb_cohesion(double strength, double friction_angle_deg) {
  const double phi = friction_angle_deg * degree;
  return 0.5 * strength * (1.0 - std::sin(phi)) / std::cos(phi);
}

double splitting_strength(double tensile_strength, double cohesion, double friction_angle_deg) {
  const double s = std::sin(friction_angle_deg * degree), c = std::cos(friction_angle_deg * degree);
  const double a = cohesion - tensile_strength * s / c;
  if (2.0 * tensile_strength <= a * s / c) return tensile_strength;
  // 4 S^2 + A^2 = (c0 cos + S sin)^2, the positive root.
  const double k = cohesion * c;
  return (s * k + std::sqrt(s * k * s * k + (4.0 - s * s) * (k * k - a * a))) / (4.0 - s * s);
}

double tensile_from_bending(double flexural_strength, double depth) {
  const double a = 0.06 * std::pow(1e3 * depth, 0.7);
  return flexural_strength * a / (1.0 + a);
}

}  // namespace fpz::io
