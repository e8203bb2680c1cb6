// The elasticity and the onset test that the lane loops have of their own, against the library's.
#include "plane.hpp"

#include <cmath>
#include <random>

#include "fpz/onset.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using Stress = Tensor<double, 2>;

class Plane : public testing::TestWithParam<Setting> {
 protected:
  const Material<double> material = make_material(concrete(), GetParam());
  std::mt19937_64 rng{11};

  /// Components of either sign and of all sizes up to `scale`.
  Stress random(double scale) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> size(0.0, 1.0);
    const double s = scale * size(rng);
    Stress x;
    x << s * normal(rng), s * normal(rng), s * normal(rng);
    return x;
  }
};

constexpr int samples = 20000;

TEST_P(Plane, ElasticStressIsThatOfTheLibrary) {
  for (int k = 0; k < samples; ++k) {
    const Stress e = random(1e-3);
    const Stress expected = material.bulk.stress<double, 2>(e);
    const detail::Symmetric s = detail::elastic_stress(material.bulk.lambda, material.bulk.mu, {e[0], e[1], e[2]});
    const double scale = 1e-15 * material.bulk.mu * e.norm() * 10.0;  // rounding
    EXPECT_NEAR(s.xx, expected[0], scale);
    EXPECT_NEAR(s.yy, expected[1], scale);
    EXPECT_NEAR(s.xy, expected[2], scale);
  }
}

TEST_P(Plane, InverseElasticityBelongsToIt) {
  for (int k = 0; k < samples; ++k) {
    const Stress e = random(1e-3);
    const Stress s = material.bulk.stress<double, 2>(e);
    EXPECT_LT((elastic_strain<2>(material.bulk, s) - e).norm(), 1e-14 * e.norm());
    const double energy = 0.5 * double_dot<2>(s, e);
    EXPECT_NEAR(elastic_energy<2>(material.bulk, s, 3.0), 3.0 * energy, 1e-13 * energy);
  }
}

/// The same answer for every stress, but for those on the surface to rounding.
TEST_P(Plane, OnsetTestIsThatOfTheLibrary) {
  const double strength = material.law.surface.cohesion * material.law.surface.cos_phi;
  int inside = 0;
  int outside = 0;
  for (int k = 0; k < samples; ++k) {
    const Stress s = random(2e7);
    const bool expected = surely_intact<2>(material, s);
    const auto lanes = [&](double factor) {
      return detail::intact(material.law.surface.sin_phi, strength, material.law.surface.apex,
                            {factor * s[0], factor * s[1], factor * s[2]});
    };
    if (lanes(1.0 - 1e-12) != lanes(1.0 + 1e-12)) continue;
    EXPECT_EQ(lanes(1.0), expected) << s.transpose();
    ++(expected ? inside : outside);
  }
  EXPECT_GT(inside, samples / 10);
  EXPECT_GT(outside, samples / 10);
}

/// The work of the force is that of any stress over the change of the stretch, by differences of the polar
/// decomposition; and its moment vanishes.
TEST(WorkConjugate, DoesTheWorkOfStressAndStretch) {
  std::mt19937_64 rng{5};
  std::uniform_real_distribution<double> some(-1.0, 1.0);
  using Matrix = Mat<double, 2, 2>;
  const auto random = [&](double size) { return Matrix::NullaryExpr([&] { return size * some(rng); }).eval(); };
  const auto stretch = [](const Matrix& b) { return detail::polar(b(0, 0), b(0, 1), b(1, 0), b(1, 1)); };
  for (int k = 0; k < 200; ++k) {
    const Matrix b = random(0.4), step = random(1e-6);
    const detail::Symmetric s = {some(rng), some(rng), some(rng)};
    const detail::Stretch before = stretch(b - step), at = stretch(b), after = stretch(b + step);
    const double expected = s.xx * (after.strain.xx - before.strain.xx) + s.yy * (after.strain.yy - before.strain.yy) +
                            2.0 * s.xy * (after.strain.xy - before.strain.xy);
    const detail::Full one = {1.0, 0.0, 0.0, 1.0};
    const detail::Full p = detail::flux_of(at.cosine, at.sine, detail::work_conjugate(s, at.strain), one);
    const Matrix force = (Matrix() << p.xx, p.xy, p.yx, p.yy).finished();
    EXPECT_NEAR(force.cwiseProduct(2.0 * step).sum(), expected, 1e-14);
    const Matrix cauchy = force * (Matrix::Identity() + b).transpose();
    EXPECT_NEAR(cauchy(0, 1), cauchy(1, 0), 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, Plane, testing::Values(Setting::plane_strain, Setting::plane_stress),
                         [](const auto& setting) { return std::string(to_string(setting.param)); });

}  // namespace
}  // namespace fpz::sph::test
