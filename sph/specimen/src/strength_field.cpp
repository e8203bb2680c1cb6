#include "fpz/specimen/strength_field.hpp"

#include <cmath>
#include <random>

namespace fpz::specimen {
namespace {

/// Many enough that their sum is normal.
constexpr int wave_count = 1000;

struct Wave {
  Point number;  ///< 1/m
  double phase = 0.0;
};

/// Uniform within 0 and 1, neither included. The standard's distributions may give other numbers elsewhere; its
/// generators may not.
double uniform(std::mt19937_64& generator) { return (static_cast<double>(generator() >> 11U) + 0.5) * 0x1p-53; }

/// Wave numbers are normal with the deviation sqrt(2)/l in each direction: the spectrum of exp(-(r/l)^2).
std::vector<Wave> waves_of(const StrengthField& field) {
  std::mt19937_64 generator(field.seed);
  std::vector<Wave> waves(wave_count);
  for (Wave& w : waves) {
    const double size = std::sqrt(-2.0 * std::log(uniform(generator))) * std::sqrt(2.0) / field.correlation_length;
    const double direction = 2.0 * M_PI * uniform(generator);
    w.number = size * Point(std::cos(direction), std::sin(direction));
    w.phase = 2.0 * M_PI * uniform(generator);
  }
  return waves;
}

/// Weibull's value at the probability that a standard normal one is at.
double weibull_at(double normal, double modulus) {
  const double survives = 0.5 * std::erfc(normal / std::sqrt(2.0));
  return std::pow(-std::log(survives), 1.0 / modulus) / std::tgamma(1.0 + 1.0 / modulus);
}

}  // namespace

std::vector<double> strength_factors(const StrengthField& field, const std::vector<Point>& places) {
  const std::vector<Wave> waves = waves_of(field);
  std::vector<double> factors;
  factors.reserve(places.size());
  for (const Point& x : places) {
    double sum = 0.0;
    for (const Wave& w : waves) sum += std::cos(w.number.dot(x) + w.phase);
    factors.push_back(weibull_at(sum * std::sqrt(2.0 / wave_count), field.weibull_modulus));
  }
  return factors;
}

double strength_deviation(double weibull_modulus) {
  const double mean = std::tgamma(1.0 + 1.0 / weibull_modulus);
  return std::sqrt(std::tgamma(1.0 + 2.0 / weibull_modulus) / (mean * mean) - 1.0);
}

}  // namespace fpz::specimen
