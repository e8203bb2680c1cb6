// Two more readings of largest loads: the apparent toughness of linear elastic fracture mechanics, specimen by
// specimen, and Bazant's size-effect law (type 2: notched specimens) through all of them.
//
//   K_Q = P k(alpha)/(thickness sqrt(D)),
//   P/(thickness D) = sqrt(E' G_f/(g'(alpha) c_f + g(alpha) D)),    g = k^2,
//
// Bazant and Kazemi (1990), Int. J. Fracture 44, 111-131; RILEM TC 89-FMT (1990), Materials and Structures 23, 461-465.
// G_f is the energy release rate that an infinitely large specimen would fail at, were the law to hold to there, c_f
// the effective length of the process zone in it. In the sizes that laboratories test the process zone is not complete
// at the peak: the law feels the first part of the softening, and its G_f is near the area under the initial tangent,
// sigma_t0^2/(2 |d sigma/dw|), half of sigma_t0 delta0 for exponential softening.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fpz/calibration/geometry_function.hpp"

namespace fpz::calibration {

/// Largest loads of notched specimens.
struct PeakLoads {
  std::vector<NotchedSpecimen> specimens;
  Eigen::VectorXd load;       ///< N
  Eigen::VectorXd deviation;  ///< standard deviation, N
  bool deviation_known = true;
};

/// The law fitted to largest loads by weighted least squares of the loads.
struct SizeEffectLaw {
  double energy = 0.0;        ///< G_f, N/m
  double energy_error = 0.0;  ///< standard error; that of E is not in it
  double length = 0.0;        ///< c_f, m
  double length_error = 0.0;
  double correlation = 0.0;  ///< of the two
  Eigen::VectorXd load;      ///< of the specimens by the law, N
  std::string failure;       ///< why there is no law; empty when there is one

  [[nodiscard]] bool ok() const { return failure.empty(); }
};

/// `geometry`: of each specimen; `plane_modulus`: E' (Pa). Fails for fewer than three specimens and where their
/// brittleness D g/g' is the same or the loads show no size effect between strength and toughness.
[[nodiscard]] SizeEffectLaw fit_size_effect(const PeakLoads& peaks, const std::vector<GeometryFunction>& geometry,
                                            double plane_modulus);

/// Load by the law, N.
[[nodiscard]] double size_effect_load(const NotchedSpecimen& specimen, const GeometryFunction& f, double plane_modulus,
                                      double energy, double length);

/// One specimen in the light of both.
struct SizeEffectPoint {
  GeometryFunction geometry;
  double size = 0.0;             ///< D, m
  double stress = 0.0;           ///< measured P/(thickness D), Pa
  double model_stress = 0.0;     ///< of the cohesive model, Pa
  double toughness = 0.0;        ///< measured K_Q, Pa sqrt(m)
  double model_toughness = 0.0;  ///< K_Q of the cohesive model's peak, Pa sqrt(m)
};

/// Nominal stress over size for specimens similar to the measured ones.
struct SizeEffectCurve {
  std::vector<double> size;          ///< m
  std::vector<double> model_stress;  ///< Pa
};

/// Law and cohesive model side by side.
struct SizeEffect {
  std::vector<SizeEffectPoint> points;
  double plane_modulus = 0.0;    ///< E', Pa
  double toughness = 0.0;        ///< sqrt(E' sigma_t0 delta0), Pa sqrt(m)
  double total_energy = 0.0;     ///< sigma_t0 delta0, N/m
  double initial_energy = 0.0;   ///< under the initial tangent of the softening, N/m
  double brittleness_low = 0.0;  ///< least and largest D g/g', m
  double brittleness_high = 0.0;
  bool similar = false;    ///< all specimens have one shape
  SizeEffectLaw law;       ///< through the measured loads
  SizeEffectLaw of_model;  ///< through those of the cohesive model at the same specimens
  SizeEffectCurve curve;   ///< for similar specimens only
};

/// `model_load` (N): of the cohesive model with `parameters`. Nothing where a
/// specimen has no notch of `least_notch`.
[[nodiscard]] std::optional<SizeEffect> size_effect(const PeakLoads& peaks, const Eigen::VectorXd& model_load,
                                                    const Parameters& parameters);

}  // namespace fpz::calibration
