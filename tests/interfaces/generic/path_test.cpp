// Loading paths through the interface against the library and against the independent reference.
#include <fstream>
#include <sstream>
#include <thread>

#include "fpz/coupling.hpp"
#include "fpz/energy.hpp"
#include "interfaces/generic/generic_call.hpp"
#include "support/paths.hpp"

namespace fpz {
namespace {

using test::Client;

/// The path by a client and by the library side by side, `parts` increments a leg, with all that both give.
template <int Dim>
void expect_the_librarys_numbers(const std::string& hypothesis, const test::Path<Dim>& path, int parts) {
  const Material<double> m = make_material(path.parameters, path.setting);
  Client c(hypothesis, path.parameters);
  State<double, Dim> s;
  int cracked = 0;
  for (const Tensor<double, Dim>& leg : path.legs) {
    for (int k = 0; k < parts; ++k) {
      const Tensor<double, Dim> increment = leg / parts;
      ASSERT_TRUE(update<Dim>(m, {}, s, increment, s).ok());
      test::add_strain<Dim>(c.g1, increment);
      ASSERT_EQ(c.call(0), 1) << c.text();
      const double rounding = 1e-11 * path.parameters.tensile_strength;
      const Tensor<double, Dim> stress = test::stress_of<Dim>(c.f1);
      for (int i = 0; i < tensor_size<Dim>; ++i) ASSERT_NEAR(stress[i], s.stress[i], rounding) << path.name;
      if constexpr (Dim == 2) {
        ASSERT_NEAR(c.f1[2], stress_zz(m, s), rounding);
      }
      const double energy =
          1e-10 * path.parameters.tensile_strength * path.parameters.delta0 / path.parameters.rve_length;
      ASSERT_NEAR(c.stored1, stored_energy(m, s), energy);
      ASSERT_NEAR(c.dissipated1, dissipated_energy(m, s), energy);
      ASSERT_EQ(c.i1[0], s.cracked ? 1.0 : 0.0);
      ASSERT_NEAR(c.i1.back(), damage(s), 1e-11);
      ASSERT_EQ(c.rdt, Client::untouched);
      c.update();
      cracked += s.cracked ? 1 : 0;
    }
  }
  EXPECT_GT(cracked, parts);
  EXPECT_GT(c.dissipated0, 0.0);
}

TEST(GenericPath, GivesTheLibrarysNumbers) {
  for (const auto& path : test::in_every_zone<2>({test::four_stage(), test::closing(), test::plane_stress_cycle()})) {
    const bool plane_stress = path.setting == Setting::plane_stress;
    expect_the_librarys_numbers<2>(plane_stress ? "PlaneStress" : "PlaneStrain", path, 50);
    if (!plane_stress) expect_the_librarys_numbers<2>("GeneralisedPlaneStrain", path, 50);
  }
  for (const auto& path : test::in_every_zone<2>({test::four_stage()})) {
    test::Path<2> thin = path;
    thin.setting = Setting::plane_stress;
    expect_the_librarys_numbers<2>("PlaneStress", thin, 50);
  }
  expect_the_librarys_numbers<3>("Tridimensional", test::rotating_shear(), 20);
}

/// Rows of data/reference/four_stage.csv.
std::vector<std::vector<double>> four_stage_reference() {
  std::ifstream in(std::string(FPZ_DATA_DIR) + "/reference/four_stage.csv");
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  std::getline(in, line);
  while (std::getline(in, line)) {
    rows.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

/// The four stages by a client: after 12000, 14000, 14300, 15600 increments of the paper, 200 steps each.
void expect_the_reference(const std::string& hypothesis) {
  Client c(hypothesis, test::table1());
  const auto rows = four_stage_reference();
  ASSERT_EQ(rows.size(), 800u);
  const double strength = test::table1().tensile_strength;
  const auto legs = test::four_stage().legs;
  double largest = 0.0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Tensor<double, 2> increment = legs[row / 200] / 200.0;
    c.g1[0] += increment[0];
    c.g1[3] += std::sqrt(2.0) * increment[2];
    ASSERT_EQ(c.call(4), 1) << c.text();
    ASSERT_NEAR(c.f1[0], rows[row][1], 1e-8 * strength);
    ASSERT_NEAR(c.f1[1], rows[row][2], 1e-8 * strength);
    ASSERT_NEAR(c.f1[2], rows[row][3], 1e-8 * strength);
    ASSERT_NEAR(c.f1[3], std::sqrt(2.0) * rows[row][4], 1e-8 * strength);
    ASSERT_NEAR(c.i1.back(), rows[row][7], 1e-8);
    largest = std::max(largest, c.i1.back());
    c.update();
  }
  EXPECT_GT(largest, 0.9);
}

TEST(GenericPath, FourStagesAgainstTheIndependentReference) {
  for (const char* hypothesis : {"PlaneStrain", "GeneralisedPlaneStrain", "Tridimensional"}) {
    SCOPED_TRACE(hypothesis);
    expect_the_reference(hypothesis);
  }
}

// The crack plane contains z in the solid as in the plane, so that a strain along z must do the same in both.
TEST(GenericPath, AStrainAlongZActsAsInASolid) {
  Client plane("GeneralisedPlaneStrain", test::table1()), solid("Tridimensional", test::table1());
  double damage = 0.0;
  for (int k = 0; k < 100; ++k) {
    for (Client* c : {&plane, &solid}) {
      c->g1[0] += k < 50 ? 4e-5 : 1e-5;
      c->g1[2] += k % 20 < 10 ? 1e-5 : -6e-6;
      c->g1[3] += k < 50 ? 0.0 : 3e-5;
      ASSERT_EQ(c->call(4), 1) << c->text();
    }
    const double young = test::table1().young_modulus;
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_NEAR(plane.f1[i], solid.f1[i], 1e-6 * test::table1().tensile_strength);
      for (std::size_t j = 0; j < 4; ++j) {
        ASSERT_NEAR(plane.operator_at(i, j), solid.operator_at(i, j), 1e-5 * young) << i << j << ' ' << k;
      }
    }
    ASSERT_NEAR(plane.stored1, solid.stored1, 1e-6 * std::abs(solid.stored1));
    damage = plane.i1.back();
    plane.update();
    solid.update();
  }
  EXPECT_GT(damage, 0.5);
  EXPECT_GT(std::abs(plane.g0[2]), 1e-4);
}

// sigma = sigma_t0 w and, with kappa the inelastic opening, w = exp(-kappa/delta0), u = kappa - (1 - w^2) sigma_t0/(4
// Kn)
// + (1 - w) w sigma_t0/Kn in the consistent zone (docs/equations.md). The strains are such that SXX is the only stress.
TEST(GenericPath, UniaxialTensionInClosedForm) {
  const Parameters p = test::with_zone(test::table1(), CohesiveZone::consistent);
  const double stiff = p.tensile_strength / p.normal_stiffness;
  for (const char* hypothesis : {"PlaneStress", "Tridimensional"}) {
    Client c(hypothesis, p);
    for (int k = 1; k <= 60; ++k) {
      const double kappa = k < 10 ? 0.0 : (k - 10) * 0.05 * p.delta0;
      const double w = std::exp(-kappa / p.delta0);
      const double stress = p.tensile_strength * (k < 10 ? k * 0.1 : w);
      const double jump = kappa + stiff * ((1.0 - w) * w - 0.25 * (1.0 - w * w));
      c.g1[0] = stress / p.young_modulus + jump / p.rve_length;
      c.g1[1] = -p.poisson_ratio * stress / p.young_modulus;
      if (c.size == 6) c.g1[2] = c.g1[1];
      ASSERT_EQ(c.call(4), 1) << c.text();
      ASSERT_NEAR(c.f1[0], stress, 1e-6 * p.tensile_strength) << hypothesis << ' ' << k;
      for (std::size_t i = 1; i < c.size; ++i) ASSERT_NEAR(c.f1[i], 0.0, 1e-6 * p.tensile_strength);
      ASSERT_NEAR(c.dissipated1, p.tensile_strength * p.delta0 * (1.0 - w) / p.rve_length, 1e-3);
      c.update();
    }
    EXPECT_GT(c.i0.back(), 0.9);
  }
}

TEST(GenericPath, ThreadsWithDifferentMaterialsDoNotDisturbEachOther) {
  const auto final_stress = [](double rve_length) {
    Client c("PlaneStrain", test::table1(rve_length));
    for (int k = 0; k < 400; ++k) {
      test::add_strain<2>(c.g1, test::strain2(1e-5, 0, k < 200 ? 0.0 : 2e-5));
      if (c.call(4) != 1) return Client::poison;
      c.update();
    }
    return c.f0[3];
  };
  std::vector<double> lengths, alone, together(12);
  for (int k = 0; k < 12; ++k) lengths.push_back(1e-3 + 3e-4 * k);
  for (const double h : lengths) alone.push_back(final_stress(h));
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    threads.emplace_back([&, k] { together[k] = final_stress(lengths[k]); });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(alone, together);
  EXPECT_NE(alone.front(), alone.back());
}

TEST(GenericPath, ParametersChangeTheIntegrator) {
  using Setter = int (*)(const char*, double);
  const auto set = reinterpret_cast<Setter>(test::find_symbol("Fpz_setParameter"));
  const auto steps = {test::strain2(2e-3, 0, 0), test::strain2(1e-3, 0, 4e-3)};
  const auto end = [&steps] {
    Client c("PlaneStrain", test::table1());
    for (const auto& step : steps) {
      test::add_strain<2>(c.g1, step);
      EXPECT_EQ(c.call(0), 1) << c.text();
      c.update();
    }
    return test::stress_of<2>(c.f0);
  };
  const Tensor<double, 2> accurate = end();
  EXPECT_EQ(set("integrator_name", 1.0), 1);
  const Tensor<double, 2> implicit = end();
  EXPECT_EQ(set("integrator_name", 7.0), 1);
  Client c("PlaneStrain", test::table1());
  EXPECT_EQ(c.call(0), -1);
  EXPECT_NE(c.text().find("integrator_name = 7"), std::string::npos) << c.text();
  EXPECT_EQ(set("integrator_name", 0.0), 1);
  EXPECT_EQ(end(), accurate);
  State2 s;
  Options o;
  o.method = Method::implicit;
  const Material<double> m = make_material(test::table1(), Setting::plane_strain);
  for (const auto& step : steps) ASSERT_TRUE(update<2>(m, o, s, step, s).ok());
  EXPECT_LT((implicit - s.stress).norm(), 1e-10 * s.stress.norm());
  EXPECT_GT((implicit - accurate).norm(), 1e-3 * accurate.norm());
  EXPECT_EQ(set("no_such_parameter", 1.0), 0);
  EXPECT_EQ(set("integrator_tolerance", Client::poison), 0);
  EXPECT_EQ(set(nullptr, 1.0), 0);
}

}  // namespace
}  // namespace fpz
