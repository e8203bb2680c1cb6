// A closed stress cycle of the consistent zone gives no work: random walks from zero stress to zero stress in tension,
// compression and shear, for every material of data/materials, both softening laws and stiffnesses over five decades.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "fpz/energy.hpp"
#include "fpz/law/softening.hpp"
#include "fpz/tangent.hpp"
#include "fpz/update.hpp"
#include "support/paths.hpp"

namespace fpz::test {
namespace {

std::vector<std::pair<std::string, Parameters>> data_materials() {
  std::vector<std::pair<std::string, Parameters>> all;
  for (const auto& file : std::filesystem::directory_iterator(FPZ_DATA_DIR "/materials")) {
    std::ifstream in(file.path());
    const nlohmann::json j = nlohmann::json::parse(in);
    Parameters p;
    for (const ParameterInfo<double>& info : parameter_table<double>) {
      if (info.of_material) p.*info.member = j.at(std::string(info.name));
    }
    p.choices.cohesive_zone = CohesiveZone::consistent;
    all.emplace_back(file.path().stem(), p);
  }
  return all;
}

/// A point on its way, with its books: work by the trapezoidal rule over the increments.
template <int Dim>
struct Walker {
  const Material<double>& material;
  Options options;
  State<double, Dim> s;
  double work = 0.0;    ///< J/m^3
  double put_in = 0.0;  ///< the positive parts
  double least_stored = 0.0;
  Status status = Status::ok;

  bool move(const Tensor<double, Dim>& d) {
    State<double, Dim> next;
    status = update<Dim>(material, options, s, d, next).status;
    if (status != Status::ok) return false;
    const double w = 0.5 * double_dot<Dim>(Tensor<double, Dim>(s.stress + next.stress), d);
    work += w;
    put_in += std::max(w, 0.0);
    s = next;
    least_stored = std::min(least_stored, stored_energy(material, s));
    if (s.cracked) least_stored = std::min(least_stored, free_energy(material.law, s.crack));
    return true;
  }

  /// To a stress, in parts, by Newton on the consistent tangent.
  bool go_to(const Tensor<double, Dim>& target, int parts) {
    const Tensor<double, Dim> from = s.stress;
    for (int k = 1; k <= parts; ++k) {
      const Tensor<double, Dim> wanted = from + (target - from) * (double(k) / parts);
      Tensor<double, Dim> d = Tensor<double, Dim>::Zero();
      bool met = false;
      for (int i = 0; i < 30 && !met; ++i) {
        State<double, Dim> end;
        Tangent<Dim> tangent;
        status = update_with_tangent<Dim>(material, options, s, d, end, tangent).status;
        if (status != Status::ok) return false;
        const Tensor<double, Dim> miss = wanted - end.stress;
        met = miss.norm() <= 1e-9 * material.law.surface.tensile_strength;
        if (!met) d += tangent.fullPivLu().solve(miss);
      }
      if (!met) status = Status::non_convergence;
      if (!met || !move(d)) return false;
    }
    return true;
  }
};

/// cases/energy_from_nothing: confined at 20 MPa, sheared to D = 0.02, back to zero stress. The published zone gives
/// about a thousand J per m^2 of crack; the consistent one keeps what it dissipated.
TEST(ClosedCycle, ConfinedShearGivesNothing) {
  for (const CohesiveZone zone : {CohesiveZone::consistent, CohesiveZone::published}) {
    const Material<double> m = make_material(with_zone(table3(1e-3), zone), Setting::plane_strain);
    Walker<2> w{m, {}, {}};
    ASSERT_TRUE(w.go_to(strain2(-20e6, -20e6, 0), 20));
    for (int k = 0; k < 4000 && damage(w.s) < 0.02; ++k) {
      State2 end;
      Tangent<2> tangent;
      Tensor<double, 2> d = strain2(0, 0, 1.25e-5);
      for (int i = 0; i < 30; ++i) {  // xx and yy stay at -20 MPa
        ASSERT_TRUE(update_with_tangent<2>(m, w.options, w.s, d, end, tangent).ok());
        const Eigen::Vector2d miss(-20e6 - end.stress[0], -20e6 - end.stress[1]);
        if (miss.norm() < 1e-3) break;
        d.head<2>() += tangent.topLeftCorner<2, 2>().fullPivLu().solve(miss);
      }
      ASSERT_TRUE(w.move(d));
    }
    ASSERT_GE(damage(w.s), 0.02);
    ASSERT_TRUE(w.go_to(strain2(0, 0, 0), 400)) << to_string(w.status);
    const double per_area = w.work * 1e-3;
    if (zone == CohesiveZone::consistent) {
      EXPECT_GT(per_area, 0.0);
      EXPECT_NEAR(per_area, w.s.crack.dissipated, 1e-3 * w.s.crack.dissipated);
      EXPECT_EQ(w.least_stored, 0.0);
      EXPECT_NEAR(stored_energy(m, w.s), 0.0, 1e-12 * w.put_in);
    } else {
      EXPECT_LT(per_area, -100.0);
    }
  }
}

/// One random walk: legs of strain in tension, compression, shear or a mixture, each followed by a return to zero
/// stress.
template <int Dim>
void walk(Walker<Dim>& w, const Parameters& p, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  const double scale = 1.5 * (p.tensile_strength / p.young_modulus + p.delta0 / p.rve_length);
  for (int leg = 0; leg < 3; ++leg) {
    for (int k = 0; k < 2; ++k) {
      Tensor<double, Dim> d;
      for (int i = 0; i < tensor_size<Dim>; ++i) d[i] = normal(rng);
      const double kind = uniform(rng);
      if (kind < 0.25) d.setZero(), d[0] = 1.0;
      if (kind >= 0.25 && kind < 0.5) d.template head<Dim>() = -d.template head<Dim>().cwiseAbs();
      if (kind >= 0.5 && kind < 0.75) d.template head<Dim>().setZero();
      d *= scale * std::pow(10.0, -2.0 * uniform(rng)) / d.norm();
      for (int part = 0; part < 100; ++part) {
        if (!w.move(Tensor<double, Dim>(d / 100.0))) return;
      }
    }
    if (!w.go_to(Tensor<double, Dim>::Zero(), 60)) return;
    // 1. What has been put in has not come back with interest.
    ASSERT_GE(w.work, -1e-9 * w.put_in);
    // 2. The books, to the trapezoidal rule (RandomWalk.EnergyBalance measures it): nothing is stored at zero stress.
    ASSERT_NEAR(w.work, dissipated_energy(w.material, w.s), 3e-3 * w.put_in);
    ASSERT_NEAR(stored_energy(w.material, w.s), 0.0, 1e-12 * w.put_in);
    ASSERT_EQ(w.least_stored, 0.0);
  }
}

template <int Dim>
void closed_cycles(Setting setting) {
  int closed = 0;
  int snapped = 0;
  int unfinished = 0;
  for (auto [name, p] : data_materials()) {
    for (const double k : {0.0, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15}) {
      for (const Word<SofteningKind>& softening : Words<SofteningKind>::list) {
        if (k > 0.0) p.normal_stiffness = p.shear_stiffness = k;  // else those of the file
        p.rve_length = 0.5e-3;
        p.choices.softening = softening.value;
        const Material<double> m = make_material(p, setting);
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
          SCOPED_TRACE(name + ", K " + std::to_string(k) + ", " + softening.text + ", seed " + std::to_string(seed));
          std::mt19937_64 rng(seed);
          Walker<Dim> w{m, {}, {}};
          walk(w, p, rng);
          if (testing::Test::HasFatalFailure()) return;
          closed += w.status == Status::ok;
          snapped += w.status == Status::snap_back;
          unfinished += w.status == Status::non_convergence;
          ASSERT_TRUE(w.status != Status::invalid_input && w.status != Status::no_plastic_flow);
        }
      }
    }
  }
  // Walks end early where strain control snaps back, or where no stress path leads back to zero.
  std::printf("closed %d, snap-back %d, no way back %d\n", closed, snapped, unfinished);
  EXPECT_GT(closed, 4 * (snapped + unfinished));
}

TEST(ClosedCycle, RandomWalks2D) { closed_cycles<2>(Setting::plane_strain); }
TEST(ClosedCycle, RandomWalksInPlaneStress) { closed_cycles<2>(Setting::plane_stress); }
TEST(ClosedCycle, RandomWalks3D) { closed_cycles<3>(Setting::three_d); }

}  // namespace
}  // namespace fpz::test
