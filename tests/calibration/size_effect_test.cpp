// Geometry functions of published formulas against the elastic body; the size-effect law on loads made by it, its
// standard errors by repetition; and what both say about peaks of the cohesive model.
#include "fpz/calibration/size_effect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fpz/calibration/calibration.hpp"
#include "fpz/calibration/report.hpp"
#include "fpz/law/softening.hpp"
#include "specimens.hpp"

namespace fpz::calibration {
namespace {

using test::beam;
using test::mode_one_rock;
using test::semicircular;

constexpr double nu = 0.2;

NotchedSpecimen bending(double span, double notch, double depth = 0.1) {
  NotchedSpecimen s = beam();
  s.depth = depth;
  s.span = span * depth;
  s.length = (span + 0.5) * depth;
  s.notch = notch * depth;
  return s;
}

/// The formula lies 0.1 to 1.2 % above the elastic body, most for short spans; halving the elements changes 0.1 %.
TEST(GeometryFunction, BeamsOfAnySpanAgainstTheElasticBody) {
  for (const double span : {2.5, 8.0}) {
    for (const double notch : {0.1, 0.3, 0.6}) {
      const NotchedSpecimen s = bending(span, notch);
      const auto printed = published_geometry_function(s);
      ASSERT_TRUE(printed);
      const GeometryFunction own = elastic_geometry_function(s, nu);
      EXPECT_NEAR(own.k / printed->k, 0.994, 0.007) << span << ' ' << notch;
      EXPECT_NEAR(own.slope / printed->slope, 1.0, 0.025) << span << ' ' << notch;
    }
  }
}

/// Tada, Paris and Irwin: pure bending, stated accuracy 0.5 % (0.2 % for alpha <= 0.6).
TEST(GeometryFunction, PureBendingBetweenTwoLoads) {
  for (const double notch : {0.2, 0.4, 0.6}) {
    NotchedSpecimen s = bending(8.0, notch);
    s.load_span = 4.0 * s.depth;
    EXPECT_FALSE(published_geometry_function(s));
    const double a = notch;
    const double f = 1.122 - 1.4 * a + 7.33 * a * a - 13.08 * a * a * a + 14.0 * std::pow(a, 4);
    const double k = 6.0 * 0.25 * 4.0 * f * std::sqrt(M_PI * a);  // moment P (span - load_span)/4
    EXPECT_NEAR(geometry_function(s, nu).k / k, 1.0, 0.01) << notch;
  }
}

/// The ISRM fit lies up to 3.7 % above the elastic body, as against other published values (elastic_body_test.cpp).
TEST(GeometryFunction, HalfDiscsOfTheIsrmMethod) {
  for (const double span : {0.5, 0.8}) {
    for (const double notch : {0.4, 0.6}) {
      NotchedSpecimen s = semicircular();
      s.notch = notch * s.radius;
      s.span = span * 2.0 * s.radius;
      const auto printed = published_geometry_function(s);
      ASSERT_TRUE(printed);
      EXPECT_NEAR(elastic_geometry_function(s, nu).k / printed->k, 0.985, 0.03) << span << ' ' << notch;
    }
  }
  NotchedSpecimen out_of_range = semicircular();
  out_of_range.notch = 0.2 * out_of_range.radius;
  EXPECT_FALSE(published_geometry_function(out_of_range));
  EXPECT_GT(geometry_function(out_of_range, nu).k, 0.0);
}

TEST(GeometryFunction, SlopesAreThoseOfTheFunctions) {
  constexpr double step = 1e-5;
  NotchedSpecimen disc = semicircular();
  disc.notch = 0.5 * disc.radius;
  for (const NotchedSpecimen& s : {bending(3.0, 0.3), disc}) {
    NotchedSpecimen up = s, down = s;
    up.notch += step * s.height();
    down.notch -= step * s.height();
    const double difference =
        (published_geometry_function(up)->k - published_geometry_function(down)->k) / (2.0 * step);
    EXPECT_NEAR(published_geometry_function(s)->slope / difference, 1.0, 1e-7);
  }
}

/// Beams of four sizes and two notches, with the loads of a law.
struct Series {
  PeakLoads peaks;
  std::vector<GeometryFunction> geometry;
};

constexpr double plane_modulus = 31.25e9;
constexpr double true_energy = 40.0;
constexpr double true_length = 0.02;

Series made_by_the_law() {
  Series s;
  for (const double depth : {0.04, 0.08, 0.16, 0.32}) {
    for (const double notch : {0.2, 0.4}) s.peaks.specimens.push_back(bending(2.5, notch, depth));
  }
  const auto n = static_cast<Eigen::Index>(s.peaks.specimens.size());
  s.peaks.load.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const NotchedSpecimen& specimen = s.peaks.specimens[static_cast<std::size_t>(k)];
    s.geometry.push_back(geometry_function(specimen, nu));
    s.peaks.load[k] = size_effect_load(specimen, s.geometry.back(), plane_modulus, true_energy, true_length);
  }
  s.peaks.deviation = 0.03 * s.peaks.load;
  return s;
}

TEST(SizeEffectLaw, LimitsAreStrengthAndToughness) {
  const NotchedSpecimen large = bending(2.5, 0.2, 1000.0);
  const GeometryFunction f = geometry_function(large, nu);
  const double load = size_effect_load(large, f, plane_modulus, true_energy, true_length);
  EXPECT_NEAR(stress_intensity(large, f, load), std::sqrt(plane_modulus * true_energy), 1e-3 * 1.2e6);
  const NotchedSpecimen one = bending(2.5, 0.2, 1e-6), two = bending(2.5, 0.2, 2e-6);
  const auto stress = [&](const NotchedSpecimen& s) {
    return size_effect_load(s, f, plane_modulus, true_energy, true_length) / (s.thickness * s.depth);
  };
  EXPECT_NEAR(stress(one) / stress(two), 1.0, 1e-3);
}

TEST(SizeEffectLaw, GivesBackWhatMadeTheLoads) {
  const Series s = made_by_the_law();
  const SizeEffectLaw law = fit_size_effect(s.peaks, s.geometry, plane_modulus);
  ASSERT_TRUE(law.ok()) << law.failure;
  EXPECT_NEAR(law.energy, true_energy, 1e-6 * true_energy);
  EXPECT_NEAR(law.length, true_length, 1e-6 * true_length);
}

/// Of 300 noisy series the truth lies within 1.96 standard errors in about 95 %, whether the scatter is known or not.
TEST(SizeEffectLaw, StandardErrorsAreThoseOfRepetition) {
  constexpr int series = 300;
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  for (const bool known : {true, false}) {
    int energy_inside = 0, length_inside = 0;
    for (int k = 0; k < series; ++k) {
      Series s = made_by_the_law();
      s.peaks.deviation_known = known;
      for (Eigen::Index i = 0; i < s.peaks.load.size(); ++i) s.peaks.load[i] += s.peaks.deviation[i] * noise(random);
      const SizeEffectLaw law = fit_size_effect(s.peaks, s.geometry, plane_modulus);
      ASSERT_TRUE(law.ok()) << law.failure;
      const double factor = known ? 1.96 : 2.447;  // normal; Student's t with six degrees of freedom
      energy_inside += std::abs(law.energy - true_energy) < factor * law.energy_error ? 1 : 0;
      length_inside += std::abs(law.length - true_length) < factor * law.length_error ? 1 : 0;
    }
    EXPECT_NEAR(energy_inside / static_cast<double>(series), 0.95, 0.035) << known;
    EXPECT_NEAR(length_inside / static_cast<double>(series), 0.95, 0.035) << known;
  }
}

TEST(SizeEffectLaw, RefusesWhatDeterminesNothing) {
  Series s = made_by_the_law();
  for (NotchedSpecimen& specimen : s.peaks.specimens) specimen = s.peaks.specimens.front();
  for (GeometryFunction& f : s.geometry) f = s.geometry.front();
  s.peaks.load.setConstant(s.peaks.load[0]);
  EXPECT_NE(fit_size_effect(s.peaks, s.geometry, plane_modulus).failure.find("one size"), std::string::npos);
  Series two = made_by_the_law();
  two.peaks.specimens.resize(2);
  two.geometry.resize(2);
  two.peaks.load.conservativeResize(2);
  EXPECT_NE(fit_size_effect(two.peaks, two.geometry, plane_modulus).failure.find("three"), std::string::npos);
}

SizeEffect of_the_cohesive_model(const Parameters& p, const std::vector<NotchedSpecimen>& specimens) {
  PeakLoadTest test;
  PeakLoads peaks;
  peaks.specimens = specimens;
  for (const NotchedSpecimen& s : specimens) test.specimens.push_back({s});
  peaks.load = predict(test, p, false).values;
  peaks.deviation = 0.02 * peaks.load;
  return *size_effect(peaks, peaks.load, p);
}

/// Sizes of a fifth to one and a half characteristic lengths: the law finds the initial energy of each softening law
/// (0.5 and 0.6 of the total), not the total one: 1.06 and 0.79 times it in these sizes.
TEST(SizeEffect, TheLawFeelsTheInitialEnergy) {
  std::vector<NotchedSpecimen> specimens;
  for (const double depth : {0.04, 0.08, 0.16, 0.32}) specimens.push_back(bending(2.5, 0.2, depth));
  for (const auto& [softening, ratio] :
       {std::pair{softening_kind<ExponentialSoftening>, 0.5}, std::pair{softening_kind<BilinearSoftening>, 0.6}}) {
    Parameters p = mode_one_rock();
    p.delta0 = 25e-6;
    p.choices.softening = softening;
    const SizeEffect e = of_the_cohesive_model(p, specimens);
    ASSERT_TRUE(e.law.ok()) << e.law.failure;
    EXPECT_TRUE(e.similar);
    EXPECT_LT(e.law.energy, 0.6 * e.total_energy);
    EXPECT_NEAR(e.initial_energy / e.total_energy, ratio, 1e-12);
    EXPECT_NEAR(e.law.energy / e.initial_energy, 1.0, 0.25) << ratio;
  }
}

/// The apparent toughness grows with the size towards that of the cohesive model.
TEST(SizeEffect, ApparentToughnessOfALargeSpecimenIsTheToughness) {
  const Parameters p = mode_one_rock();  // characteristic length 0.17 m
  NotchedSpecimen large = bending(4.0, 0.3, 4.0);
  large.mesh.ligament_fraction = 1.0 / 160.0;
  const SizeEffect e = of_the_cohesive_model(p, {bending(4.0, 0.3, 0.05), bending(4.0, 0.3, 0.5), large});
  EXPECT_LT(e.points[0].model_toughness, 0.6 * e.toughness);
  EXPECT_LT(e.points[0].model_toughness, 0.8 * e.points[1].model_toughness);
  EXPECT_NEAR(e.points[2].model_toughness / e.toughness, 0.9, 0.1);
}

/// A toughness of the ISRM method is the largest load that its formula made of it.
TEST(SizeEffect, ToughnessInPlaceOfTheLoad) {
  const auto specification = [](const std::string& value, double notch) {
    return R"({"parameters": {"young_modulus": 30e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 5e6,
      "cohesion": 20e6, "friction_angle_deg": 34, "dilation_angle_deg": 6, "delta0": {"start": 1e-5},
      "normal_stiffness": 1e14, "shear_stiffness": 1e14}, "fit": ["delta0"],
      "data": [{"name": "K", "kind": "peak_load", "deviation": {"relative": 0.05}, "points": [{"shape": "semicircular",
        "geometry": {"unit": "mm", "radius": 50, "span": 60, "notch": )" +
           std::to_string(notch) + R"(, "thickness": 30}, )" + value + "}]}]}";
  };
  const Specification s =
      parse_specification(specification(R"x("toughness": {"value": 1.2, "unit": "MPa.sqrt(m)"})x", 25.0), "k.json");
  // Kuruppu et al. 2014: K_Ic = Y' P sqrt(pi a)/(2 R t), Y' = 5.7726 at span/(2 R) = 0.6 and a/R = 0.5.
  const double y = -1.297 + 9.516 * 0.6 - (0.47 + 16.457 * 0.6) * 0.5 + (1.071 + 34.401 * 0.6) * 0.25;
  EXPECT_NEAR(s.data[0].measured[0], 1.2e6 * 2.0 * 0.05 * 0.03 / (y * std::sqrt(M_PI * 0.025)), 1e-6);
  EXPECT_THROW((void)parse_specification(specification(R"("toughness": 1.2e6)", 10.0), "k.json"), io::InputError);
  EXPECT_THROW((void)parse_specification(specification(R"("toughness": 1.2e6, "load": 5000)", 25.0), "k.json"),
               io::InputError);
}

/// Report, JSON and picture name have it; a series without a law says why.
TEST(SizeEffect, IsInTheReport) {
  const Calibration c = calibrate(read_specification(FPZ_DATA_DIR "/calibration/isrm_two_sizes.json"));
  ASSERT_TRUE(c.comparisons[0].size_effect);
  const std::string report = report_markdown(c, true);
  EXPECT_NE(report.find("#### Size effect"), std::string::npos);
  EXPECT_NE(report.find("ISRM, Kuruppu et al. 2014"), std::string::npos);
  EXPECT_NE(report_json(c).find("\"apparent_toughness\""), std::string::npos);
}

}  // namespace
}  // namespace fpz::calibration
