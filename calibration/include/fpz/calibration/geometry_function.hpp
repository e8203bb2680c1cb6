// Stress intensity factors of specimens: K_I = P k/(thickness sqrt(D)), where D is the depth of the specimen (the
// radius of a half disc), alpha = notch/D and k(alpha) depends on the shape alone. g = k^2 gives the energy release
// rate.
#pragma once

#include <optional>
#include <string>

#include "fpz/calibration/notched_specimen.hpp"

namespace fpz::calibration {

/// Least alpha: a shorter notch is none, and the crack starts in the surface layer.
inline constexpr double least_notch = 0.03;

/// k and its slope at the notch of a specimen.
struct GeometryFunction {
  double k = 0.0;
  double slope = 0.0;  ///< dk/d(alpha), for similar loads and shape
  std::string source;  ///< of the formula, in words

  [[nodiscard]] double g() const { return k * k; }
  [[nodiscard]] double g_slope() const { return 2.0 * k * slope; }
};

/// From published formulas. Beams under one load, any span >= 2.5 depths and 0.03 <= alpha <= 0.9: Pastor, Guinea,
/// Planas and Elices (1995), Anales de Mecanica de la Fractura 12, 85-90; Guinea et al. (1998), Engng Fract. Mech. 61.
/// Half discs with 0.5 <= span/(2 radius) <= 0.8 and 0.4 <= alpha <= 0.6: ISRM suggested method, Kuruppu et al. (2014),
/// Rock Mech. Rock Eng. 47, 267-274. Nothing for other specimens.
[[nodiscard]] std::optional<GeometryFunction> published_geometry_function(const NotchedSpecimen& specimen);

/// From the elastic body of the program, by the energy that a growing notch releases, K_I^2 = E' dC/da P^2/(2
/// thickness). For any valid specimen with alpha >= least_notch; throws std::invalid_argument for others.
[[nodiscard]] GeometryFunction elastic_geometry_function(const NotchedSpecimen& specimen, double poisson_ratio);

/// The published formula where there is one, otherwise the elastic body.
[[nodiscard]] GeometryFunction geometry_function(const NotchedSpecimen& specimen, double poisson_ratio);

/// K_I of a specimen under the load P (N), Pa sqrt(m).
[[nodiscard]] double stress_intensity(const NotchedSpecimen& specimen, const GeometryFunction& f, double load);

}  // namespace fpz::calibration
