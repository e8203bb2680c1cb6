// Random strength: its distribution and correlation in closed form, and a strip that cracks where it is weakest.
#include "fpz/specimen/strength_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fpz/specimen/specimen.hpp"

namespace {

using namespace fpz::specimen;
namespace sph = fpz::sph;

std::vector<Point> grid(int n, double step) {
  std::vector<Point> places;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) places.emplace_back(step * i, step * j);
  }
  return places;
}

/// Probability that a factor is below f, by Weibull with a mean of 1.
double probability(double f, double modulus) {
  return 1.0 - std::exp(-std::pow(f * std::tgamma(1.0 + 1.0 / modulus), modulus));
}

/// The standard normal value at a probability, by bisection.
double normal_at(double probability) {
  double low = -9.0, high = 9.0;
  for (int k = 0; k < 60; ++k) {
    const double x = 0.5 * (low + high);
    (0.5 * std::erfc(-x / std::sqrt(2.0)) < probability ? low : high) = x;
  }
  return low;
}

/// Over a field of a hundred lengths by a hundred, some three thousand independent values: mean, deviation, and the
/// parts below the quantiles.
TEST(StrengthField, IsWeibulls) {
  for (const double modulus : {3.0, 10.0, 30.0}) {
    const std::vector<double> f = strength_factors({modulus, 1.0, 7}, grid(200, 0.5));
    const double n = static_cast<double>(f.size());
    double mean = 0.0, square = 0.0;
    for (const double x : f) mean += x / n, square += x * x / n;
    const double deviation = strength_deviation(modulus);
    EXPECT_NEAR(mean, 1.0, 0.06 * deviation);
    EXPECT_NEAR(std::sqrt(square - mean * mean), deviation, 0.05 * deviation);
    for (const double part : {0.01, 0.1, 0.5, 0.9, 0.99}) {
      const auto below = std::count_if(f.begin(), f.end(), [&](double x) { return probability(x, modulus) < part; });
      EXPECT_NEAR(static_cast<double>(below) / n, part, 0.06 * std::sqrt(part * (1.0 - part)))
          << modulus << " " << part;
    }
  }
  EXPECT_NEAR(strength_deviation(10.0), 0.1203, 1e-4);
}

/// Normal values a distance r apart have the correlation exp(-(r/l)^2), in every direction.
TEST(StrengthField, IsAlikeOverItsLength) {
  const double length = 3e-3, modulus = 8.0;
  const std::vector<Point> places = grid(150, 1.5e-3);
  const std::vector<double> here = strength_factors({modulus, length, 3}, places);
  for (const double angle : {0.0, 0.6, 1.5708}) {
    for (const double ratio : {0.25, 0.5, 1.0, 2.0}) {
      std::vector<Point> moved = places;
      for (Point& x : moved) x += ratio * length * Point(std::cos(angle), std::sin(angle));
      const std::vector<double> there = strength_factors({modulus, length, 3}, moved);
      double sum = 0.0;
      for (std::size_t k = 0; k < here.size(); ++k) {
        sum += normal_at(probability(here[k], modulus)) * normal_at(probability(there[k], modulus));
      }
      EXPECT_NEAR(sum / static_cast<double>(here.size()), std::exp(-ratio * ratio), 0.06) << angle << " " << ratio;
    }
  }
}

/// A place has its strength whatever particles are around it; another seed is another field.
TEST(StrengthField, IsAFunctionOfThePlaceAndTheSeed) {
  const std::vector<double> coarse = strength_factors({10.0, 2.0, 5}, grid(20, 2.0));
  const std::vector<double> fine = strength_factors({10.0, 2.0, 5}, grid(40, 1.0));
  for (std::size_t j = 0; j < 20; ++j) {
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(coarse[20 * j + i], fine[80 * j + 2 * i]);
  }
  EXPECT_NE(strength_factors({10.0, 2.0, 6}, grid(2, 1.0)), strength_factors({10.0, 2.0, 5}, grid(2, 1.0)));
}

Scene strip(const std::string& seed, const std::string& arrangement) {
  return read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes/beam_3pb.json",
                    {R"(shape={"type": "rectangle", "low": [0, 0], "high": [0.03, 0.06]})", "notches=[]",
                     "spacing=0.002", "setting=plane_stress", "material.poisson_ratio=0", "arrangement=" + arrangement,
                     R"(boundaries=[{"name": "top", "at": [0.015, 0.06], "direction": [0, 1], "width": 0.03,
           "velocity": {"x": 0, "y": {"speed": 0.002, "ramp": 2e-3}}},
          {"name": "bottom", "at": [0.015, 0], "direction": [0, -1], "width": 0.03, "velocity": {"x": 0, "y": 0}}])",
                     R"(gauges={"load": {"force_on": "top", "direction": [0, 1]},
                  "deflection": {"displacement_of": "top", "direction": [0, 1]}})",
                     R"(strength_field={"weibull_modulus": 6, "correlation_length": 0.006, "seed": )" + seed + "}"});
}

/// Under one stress everywhere the particle that is weakest cracks first, at its own strength. Beside the grips, which
/// do not stretch, the stress of the rows alternates about the right one by an eighth.
TEST(StrengthField, TheWeakestParticleCracksFirst) {
  constexpr double beside_a_grip = 1.15;
  int in_the_middle = 0;
  for (const char* seed : {"1", "2", "3", "4"}) {
    const Scene scene = strip(seed, R"({"type": "lattice"})");
    const Specimen s = make_specimen(scene);
    const sph::Arrangement<2>& a = s.setup.arrangement;
    const std::vector<double>& strength = s.setup.materials.strength_factor;
    double least = 2.0;
    for (std::size_t i = 0; i < a.size(); ++i) least = a.group[i] < 0 ? std::min(least, strength[i]) : least;
    EXPECT_LT(least, 0.8);
    sph::Simulation<2> run(s.setup);
    std::vector<double> before(a.size());
    while (run.cracked() == 0 && run.time() < 0.02) {
      for (std::size_t i = 0; i < a.size(); ++i) before[i] = run.particles().stress[1][run.slot(i)];
      ASSERT_TRUE(run.step().ok());
    }
    ASSERT_GT(run.cracked(), 0U);
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (run.particles().kind[run.slot(i)] != sph::kind::cracked) continue;
      const double own = strength[i] * scene.parameters.tensile_strength, y = a.position[i][1];
      EXPECT_NEAR(before[i], own, 0.01 * own) << seed;
      const bool inside = y > 0.006 && y < 0.054;
      EXPECT_LE(strength[i], (inside ? 1.0 : beside_a_grip) * least) << seed << " " << y;
      in_the_middle += inside ? 1 : 0;
    }
  }
  EXPECT_GE(in_the_middle, 2);
}

}  // namespace
