// The figures that sum up a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fpz/specimen/run.hpp"

namespace fpz::specimen {

/// All in SI, forces and energies for the whole thickness. What cannot be told is NaN (null in the file).
struct Findings {
  double peak_load = 0.0, deflection_at_peak = 0.0;
  double stiffness = 0.0;              ///< slope of load over deflection between 10 and 40 % of the peak, before it
  double crack_area = 0.0;             ///< opened_length() times thickness, m^2
  double fracture_energy_ratio = 0.0;  ///< dissipated by fracture over crack_area times G
  double fracture_energy = 0.0;        ///< G = tensile_strength delta0 of what has cracked, J/m^2
  std::optional<StressIntensity> toughness;  ///< at the peak load; none where the scene does not say how
  double kinetic_ratio = 0.0;        ///< largest kinetic over (elastic + fracture) energy between half the peak and it
  double kinetic_ratio_after = 0.0;  ///< the same after the peak
  double imbalance = 0.0;            ///< largest |load - support| over the peak, between half the peak and it
  double balance_error = 0.0;        ///< largest error of the energy balance over the largest external work
  double least_elastic = 0.0;        ///< smallest elastic energy over the largest external work: < 0 cannot be
  double alternation = 0.0;          ///< Simulation::alternation() over the largest jump of a crack; NaN without either
  double motion_ratio = 0.0;         ///< largest (kinetic + viscous) energy gained over the external work of its row
};

/// `opened`: opened_length(), m; `alternation`, `fracture_energy`: as in Findings; without the latter it is that of the
/// scene's material.
[[nodiscard]] Findings findings(const Scene& scene, const History& history, double opened, double alternation,
                                std::optional<double> fracture_energy = std::nullopt);

/// Why the run cannot be right: less than nothing is stored. Empty otherwise.
[[nodiscard]] std::string error_of_the_model(const Scene& scene, const Findings& f);

/// What a person must know before using the result: not quasi-static, balance drifts, damping, mass scaling, collapse,
/// crushing, cracks that cost another energy than G.
[[nodiscard]] std::vector<std::string> warnings_of(const Scene& scene, const History& history, const Findings& f);

/// The main figures in a few lines.
[[nodiscard]] std::string report_of(const Findings& f);

/// The text of summary.json.
struct SummaryInput {
  const Scene& scene;
  const Specimen& specimen;
  const sph::Simulation<2>& run;
  const RunResult& result;
  const Findings& findings;
  const std::vector<CrackPath>& paths;
  const std::vector<double>& pieces;
};
[[nodiscard]] std::string summary_text(const SummaryInput& input);

}  // namespace fpz::specimen
