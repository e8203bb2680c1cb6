#include <gtest/gtest.h>

#include <limits>

#include "fpz/point/properties.hpp"
#include "fpz/point/state_layout.hpp"
#include "fpz/tangent.hpp"
#include "interfaces/umat/umat_call.hpp"
#include "support/paths.hpp"

namespace fpz {
namespace {

using test::Umat;

std::vector<double> list_of(const Parameters& p) { return point::write_properties({p, {}}); }

template <int Dim>
Umat umat_for(const test::Path<Dim>& path) {
  const int ndi = path.setting == Setting::plane_stress ? 2 : 3;
  return {ndi, Dim == 3 ? 3 : 1, list_of(path.parameters)};
}

/// Places of the stored components in the UMAT's vectors.
template <int Dim>
std::array<std::size_t, tensor_size<Dim>> places(Setting setting) {
  if constexpr (Dim == 3)
    return {0, 1, 2, 3, 4, 5};
  else
    return {0, 1, setting == Setting::plane_stress ? std::size_t{2} : std::size_t{3}};
}

template <int Dim>
std::array<double, 6> engineering(const Tensor<double, Dim>& strain, Setting setting) {
  std::array<double, 6> e{};
  const auto at = places<Dim>(setting);
  for (int k = 0; k < tensor_size<Dim>; ++k) e[at[std::size_t(k)]] = strain[k] * (k < Dim ? 1.0 : 2.0);
  return e;
}

/// The path by the UMAT and by the library side by side, `parts` increments a leg.
template <int Dim>
void expect_the_librarys_numbers(const test::Path<Dim>& path, int parts) {
  const Material<double> m = make_material(path.parameters, path.setting);
  const auto at = places<Dim>(path.setting);
  Umat u = umat_for(path);
  State<double, Dim> s;
  int cracked = 0;
  for (const Tensor<double, Dim>& leg : path.legs) {
    for (int k = 0; k < parts; ++k) {
      const Tensor<double, Dim> increment = leg / parts;
      Tangent<Dim> tangent;
      ASSERT_TRUE(update_with_tangent<Dim>(m, {}, s, increment, s, tangent).ok());
      u.call(engineering<Dim>(increment, path.setting));
      ASSERT_FALSE(u.failed());
      for (int i = 0; i < tensor_size<Dim>; ++i) {
        ASSERT_EQ(u.stress[at[std::size_t(i)]], s.stress[i]) << path.name;
        for (int j = 0; j < tensor_size<Dim>; ++j) {
          ASSERT_EQ(u.tangent(int(at[std::size_t(i)]), int(at[std::size_t(j)])), tangent(i, j) * (j < Dim ? 1.0 : 0.5));
        }
      }
      if constexpr (Dim == 2) {
        if (path.setting == Setting::plane_strain) {
          ASSERT_NEAR(u.stress[2], stress_zz(m, s), 1e-9 * path.parameters.tensile_strength);
        }
      }
      ASSERT_EQ(u.sse, stored_energy(m, s));
      ASSERT_EQ(u.spd, dissipated_energy(m, s));
      cracked += s.cracked ? 1 : 0;
    }
  }
  EXPECT_GT(cracked, parts);
  EXPECT_GT(u.spd, 0.0);
}

TEST(Umat, GivesTheLibrarysNumbers) {
  for (const auto& path : test::in_every_zone<2>({test::four_stage(), test::closing(), test::plane_stress_cycle()})) {
    expect_the_librarys_numbers<2>(path, 40);
  }
  expect_the_librarys_numbers<3>(test::rotating_shear(), 10);
}

/// DDSDDE against central differences of STRESS through the UMAT itself: before onset, in the increment of the onset,
/// and after. Returns the worst error relative to the tangent's norm.
template <int Dim>
double worst_tangent_error(const test::Path<Dim>& path, int parts, int& onsets, int& cracked) {
  Umat u = umat_for(path);
  const auto at = places<Dim>(path.setting);
  double worst = 0.0;
  for (const Tensor<double, Dim>& leg : path.legs) {
    for (int k = 0; k < parts; ++k) {
      const std::array<double, 6> increment = engineering<Dim>(leg / parts, path.setting);
      const Umat begin = u;
      u.call(increment);
      EXPECT_FALSE(u.failed());
      double error = 0.0, norm = 0.0;
      for (const std::size_t j : at) {
        const double h = 1e-6 * leg.norm() / parts;
        Umat less = begin, more = begin;
        std::array<double, 6> below = increment, above = increment;
        below[j] -= h;
        above[j] += h;
        less.call(below);
        more.call(above);
        for (int i = 0; i < u.ntens; ++i) {
          const double difference = (more.stress[std::size_t(i)] - less.stress[std::size_t(i)]) / (2.0 * h);
          error += std::pow(u.tangent(i, int(j)) - difference, 2);
          norm += std::pow(u.tangent(i, int(j)), 2);
        }
      }
      const bool was_cracked = begin.statev[2 * tensor_size<Dim>] == 1.0;
      const bool is_cracked = u.statev[2 * tensor_size<Dim>] == 1.0;
      onsets += is_cracked && !was_cracked ? 1 : 0;
      cracked += was_cracked ? 1 : 0;
      worst = std::max(worst, std::sqrt(error / norm));
    }
  }
  return worst;
}

TEST(Umat, TangentAgainstDifferencesOfTheUmat) {
  int onsets = 0, cracked = 0;
  for (const auto& path :
       test::in_every_zone<2>({test::four_stage(), test::mixed_mode(), test::plane_stress_cycle()})) {
    EXPECT_LT(worst_tangent_error<2>(path, 30, onsets, cracked), 1e-5) << path.name;
  }
  EXPECT_LT(worst_tangent_error<3>(test::rotating_shear(), 7, onsets, cracked), 1e-5);
  EXPECT_EQ(onsets, 7);
  EXPECT_GT(cracked, 300);
}

// The plane contains the out-of-plane axis here as there, so that a solid element has the same third row and column.
TEST(Umat, ThirdRowAndColumnOfPlaneStrainAreThoseOfASolid) {
  const test::Path<2> path = test::four_stage();
  Umat plane = umat_for(path);
  Umat solid(3, 3, list_of(path.parameters));
  double softening = 0.0;
  for (const Tensor<double, 2>& leg : path.legs) {
    for (int k = 0; k < 30; ++k) {
      const std::array<double, 6> increment = engineering<2>(leg / 30, path.setting);
      plane.call(increment);
      solid.call(increment);
      ASSERT_FALSE(plane.failed() || solid.failed());
      const double scale = path.parameters.young_modulus;
      for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(plane.stress[std::size_t(i)], solid.stress[std::size_t(i)],
                    1e-5 * path.parameters.tensile_strength);
        EXPECT_NEAR(plane.tangent(i, 2), solid.tangent(i, 2), 1e-5 * scale);
        EXPECT_NEAR(plane.tangent(2, i), solid.tangent(2, i), 1e-5 * scale);
      }
      softening = std::max(softening, std::abs(plane.tangent(0, 2) - plane.tangent(1, 2)));
    }
  }
  EXPECT_GT(softening, 0.1 * path.parameters.young_modulus);  // far from the elastic column
}

/// sigma' = Q sigma Q^T for a UMAT vector (engineering: a strain with engineering shears).
std::array<double, 6> turned(const std::array<double, 6>& v, const Eigen::Matrix3d& q, int ndi, int nshr,
                             bool is_engineering) {
  const double f = is_engineering ? 0.5 : 1.0;
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  for (int i = 0; i < ndi; ++i) a(i, i) = v[std::size_t(i)];
  const int rows[] = {0, 0, 1}, columns[] = {1, 2, 2};
  for (int k = 0; k < nshr; ++k) {
    a(rows[k], columns[k]) = a(columns[k], rows[k]) = f * v[std::size_t(ndi + k)];
  }
  const Eigen::Matrix3d b = q * a * q.transpose();
  std::array<double, 6> out{};
  for (int i = 0; i < ndi; ++i) out[std::size_t(i)] = b(i, i);
  for (int k = 0; k < nshr; ++k) out[std::size_t(ndi + k)] = b(rows[k], columns[k]) / f;
  return out;
}

/// The path while the body turns: every increment is one more piece of the rotation about `axis`, and the caller turns
/// STRESS and the strain increments as Abaqus does. The stress must be that of the still body, turned.
template <int Dim>
void expect_objective(const test::Path<Dim>& path, int parts, const Eigen::Vector3d& axis) {
  Umat still = umat_for(path), turning = umat_for(path);
  Eigen::Matrix3d total = Eigen::Matrix3d::Identity();
  const double angle = 0.05;
  int cracked = 0;
  for (const Tensor<double, Dim>& leg : path.legs) {
    for (int k = 0; k < parts; ++k) {
      const std::array<double, 6> increment = engineering<Dim>(leg / parts, path.setting);
      still.call(increment);
      const Eigen::Matrix3d q = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
      total = q * total;
      Eigen::Map<Eigen::Matrix3d>(turning.drot.data()) = q;  // by columns, as in Fortran
      turning.stress = turned(turning.stress, q, turning.ndi, turning.nshr, false);
      turning.call(turned(increment, total, turning.ndi, turning.nshr, true));
      ASSERT_FALSE(still.failed() || turning.failed());
      const std::array<double, 6> expected = turned(still.stress, total, still.ndi, still.nshr, false);
      for (std::size_t i = 0; i < 6; ++i) {
        ASSERT_NEAR(turning.stress[i], expected[i], 2e-5 * path.parameters.tensile_strength) << path.name;
      }
      EXPECT_NEAR(turning.spd, still.spd, 1e-5 * still.spd);
      cracked += still.statev[2 * tensor_size<Dim>] == 1.0 ? 1 : 0;
    }
  }
  EXPECT_GT(cracked, parts);
}

TEST(Umat, TurnsTheStateByDrot) {
  expect_objective<2>(test::four_stage(), 40, Eigen::Vector3d::UnitZ());
  expect_objective<2>(test::plane_stress_cycle(), 40, Eigen::Vector3d::UnitZ());
  expect_objective<3>(test::rotating_shear(), 10, Eigen::Vector3d(1.0, -2.0, 0.5));
}

TEST(Umat, RefusesADrotThatIsNoRotation) {
  Umat u = umat_for(test::four_stage());
  u.call({1e-5, 0, 0, 0});
  for (const double bad : {0.0, 0.5, Umat::poison}) {
    u.pnewdt = Umat::untouched;
    u.drot[0] = bad;
    u.call({1e-5, 0, 0, 0});
    EXPECT_TRUE(u.failed()) << bad;
  }
  u.pnewdt = Umat::untouched;
  u.drot = {1, 0, 0, 0, 0, 1, 0, -1, 0};  // about the first axis
  u.call({1e-5, 0, 0, 0});
  EXPECT_TRUE(u.failed());
}

TEST(Umat, FirstCallWithoutStrainIsHarmless) {
  Umat u = umat_for(test::four_stage());
  const Umat before = u;
  u.call({});
  EXPECT_FALSE(u.failed());
  EXPECT_EQ(u.stress, before.stress);
  EXPECT_EQ(u.statev, before.statev);
  EXPECT_EQ(u.sse, 0.0);
  EXPECT_EQ(u.spd, 0.0);
  const Parameters p = test::table1();
  const double shear = p.young_modulus / (2.0 * (1.0 + p.poisson_ratio));
  EXPECT_NEAR(u.tangent(3, 3), shear, 1e-12 * shear);
}

TEST(Umat, LengthFromCelentWhereThereIsNoneInProps) {
  test::Path<2> path = test::mixed_mode();  // H = 1 mm
  Umat stated = umat_for(path), element = umat_for(path), trailing = umat_for(path);
  element.props[10] = 0.0;
  element.celent = 1e-3;
  Umat other = element;
  other.celent = 2e-3;
  for (Umat* u : {&stated, &element, &other}) {
    for (int k = 0; k < 20; ++k) u->call(engineering<2>(path.legs[0] / 20, path.setting));
    EXPECT_FALSE(u->failed());
  }
  EXPECT_EQ(element.stress, stated.stress);
  EXPECT_EQ(element.statev, stated.statev);
  EXPECT_GT(std::abs(other.stress[0] - stated.stress[0]), 1e-3 * path.parameters.tensile_strength);
}

// Ground under its own weight: no stress-free reference strain, and any out-of-plane stress.
TEST(Umat, StartsFromAnInitialStress) {
  const Parameters p = test::table1();
  Umat u(3, 1, list_of(p));
  u.stress = {-0.2e6, -0.5e6, -0.3e6, 0.05e6};
  const std::array<double, 6> initial = u.stress;
  u.call({});
  ASSERT_FALSE(u.failed());
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(u.stress[k], initial[k], 1e-9 * p.tensile_strength);
  // Tension over the increment until it cracks: where the initial stress and the load together reach the strength.
  const double modulus =
      p.young_modulus * (1.0 - p.poisson_ratio) / ((1.0 + p.poisson_ratio) * (1.0 - 2.0 * p.poisson_ratio));
  double largest = -1e300;
  u.stress[3] = 0.0;
  u = Umat(3, 1, list_of(p));
  u.stress = {-0.2e6, -0.5e6, -0.3e6, 0.0};
  int increments = 0;
  while (u.statev[6] == 0.0 && increments < 1000) {
    u.call({1e-5, 0, 0, 0});
    ASSERT_FALSE(u.failed());
    largest = std::max(largest, u.stress[0]);
    ++increments;
  }
  EXPECT_NEAR(largest, p.tensile_strength, 1e-5 * modulus);
  EXPECT_NEAR(increments * 1e-5, (p.tensile_strength + 0.2e6) / modulus, 2e-5);
  EXPECT_NEAR(u.stress[2], -0.3e6 + p.poisson_ratio * (u.stress[0] + 0.2e6 + u.stress[1] + 0.5e6),
              1e-9 * p.tensile_strength);
}

/// What a failing call prints; everything but PNEWDT and DDSDDE stays as it was.
std::string failure_of(Umat u, const std::array<double, 6>& dstran) {
  const Umat before = u;
  testing::internal::CaptureStderr();
  u.call(dstran);
  std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(u.pnewdt, 0.25);
  EXPECT_EQ(u.stress, before.stress);
  EXPECT_EQ(u.statev, before.statev);
  EXPECT_TRUE(std::isnan(u.sse) && std::isnan(u.spd));
  return text;
}

TEST(Umat, SnapBackAsksForAShorterStep) {
  Umat u(3, 1, list_of(test::with_zone(test::table1(1.0), CohesiveZone::consistent)));
  const std::string text = failure_of(u, {1e-2, 0, 0, 0});
  EXPECT_NE(text.find("fpz: umat, element 12, point 3: snap_back: "), std::string::npos) << text;
  u.call({1e-2, 0, 0, 0});
  EXPECT_NEAR(u.tangent(3, 3), 0.16e9, 1.0);  // elastic, not what was there before
}

TEST(Umat, RefusalsSayWhatIsWrong) {
  const Umat good = umat_for(test::four_stage());
  const auto says = [](const Umat& u, const std::array<double, 6>& dstran, const std::string& what) {
    const std::string text = failure_of(u, dstran);
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  says(good, {1e-5, 0, 1e-5, 0}, "axisymmetric");
  Umat u = good;
  u.nstatv = 22;
  says(u, {}, "NSTATV = 22: must be at least 23");
  u = good;
  u.ndi = 1;
  u.ntens = 2;
  says(u, {}, "NDI = 1, NSHR = 1: must be ");
  u = good;
  u.ntens = 6;
  says(u, {}, "NTENS = 6: must be NDI + NSHR = 4");
  u = good;
  u.props[4] = 3e5;
  says(u, {}, "property 5, cohesion = 3e+05: must be > tensile_strength * tan(friction_angle_deg)");
  u = good;
  u.props.resize(7);
  says(u, {}, "7 properties are given; missing: delta0, normal_stiffness, shear_stiffness");
  u = good;
  u.props[10] = 0.0;
  u.celent = 0.0;
  says(u, {}, "property 11, rve_length = 0: must be > 0\nrve_length is not in PROPS: CELENT stands for it");
  u = good;
  u.statev[6] = 0.5;
  says(u, {}, "the state is none that this library wrote");
  u = good;
  u.stress = {2e6, 0, 0, 0};
  says(u, {}, "the initial STRESS of a fresh point is not finite, or beyond the onset of fracture");
  says(good, {Umat::poison, 0, 0, 0}, "not finite");
}

TEST(Umat, AStressThatIsNotTheStatesIsNoticedOnce) {
  Umat u = umat_for(test::four_stage());
  u.call({1e-5, 0, 0, 0});
  const std::array<double, 6> stress = u.stress;
  u.stress[0] += 1e4;
  testing::internal::CaptureStderr();
  u.call({});
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("STRESS is not the stress of the state"), std::string::npos) << text;
  EXPECT_EQ(u.stress, stress);
  EXPECT_FALSE(u.failed());
}

}  // namespace
}  // namespace fpz
