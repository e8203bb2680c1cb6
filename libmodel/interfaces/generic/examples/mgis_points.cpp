// Many points through MGIS, as its finite-element clients do: a material with one H a point, a batch over threads, the
// consistent operator, the failing point's message.
//   mgis_points libFpzBehaviour.so
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "MGIS/Behaviour/Behaviour.hxx"
#include "MGIS/Behaviour/Integrate.hxx"
#include "MGIS/Behaviour/MaterialDataManager.hxx"
#include "MGIS/ThreadPool.hxx"

using namespace mgis::behaviour;

int main(int argc, char** argv) {
  const std::string library = argc > 1 ? argv[1] : "libFpzBehaviour.so";
  const Behaviour behaviour = load(library, "Fpz", mgis::behaviour::Hypothesis::PLANESTRAIN);
  constexpr int points = 20000;
  MaterialDataManager m(behaviour, points);
  std::vector<double> lengths;  // H of every point, m
  for (int k = 0; k < points; ++k) lengths.push_back(0.002 + 0.004 * k / points);
  const std::vector<std::pair<std::string, double>> johnstone = {
      {"young_modulus", 0.4e9},    {"poisson_ratio", 0.25}, {"density", 1540.0},
      {"tensile_strength", 0.6e6}, {"cohesion", 1.0e6},     {"friction_angle_deg", 33.0},
      {"dilation_angle_deg", 4.0}, {"delta0", 18e-6},       {"normal_stiffness", 1e13},
      {"shear_stiffness", 1e11},   {"softening", 0.0},      {"cohesive_zone", 0.0}};
  for (MaterialStateManager* s : {&m.s0, &m.s1}) {
    for (const auto& [name, value] : johnstone) setMaterialProperty(*s, name, value);
    setMaterialProperty(*s, "rve_length", lengths, MaterialStateManager::EXTERNAL_STORAGE);
  }
  mgis::ThreadPool threads(2);
  BehaviourIntegrationOptions options;
  options.integration_type = IntegrationType::INTEGRATION_CONSISTENT_TANGENT_OPERATOR;
  for (int step = 0; step < 100; ++step) {
    for (int k = 0; k < points; ++k) {
      m.s1.gradients[std::size_t(4 * k)] += 4e-5;
      m.s1.gradients[std::size_t(4 * k + 3)] += step < 50 ? 0.0 : std::sqrt(2.0) * 2e-5;
    }
    const auto result = integrate(threads, m, options, 1.0);
    if (result.exit_status != 1) {
      for (const auto& part : result.results) {
        if (part.exit_status != 1) std::printf("point %zu: %s\n", part.n, part.error_message.c_str());
      }
      return 1;
    }
    update(m);
  }
  for (const int k : {0, points / 2, points - 1}) {
    const auto at = std::size_t(k);
    std::printf("H = %.4f m: sigma = (%.6g, %.6g, %.6g, %.6g) Pa, damage %.6f, dissipated %.6g J/m^3\n", lengths[at],
                m.s0.thermodynamic_forces[4 * at], m.s0.thermodynamic_forces[4 * at + 1],
                m.s0.thermodynamic_forces[4 * at + 2], m.s0.thermodynamic_forces[4 * at + 3],
                m.s0.internal_state_variables[17 * at + 16], m.s0.dissipated_energies[at]);
  }
}
