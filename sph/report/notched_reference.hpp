// What finite elements say about a notched specimen with a straight crack in pure mode I (data/reference), and how far
// a run is off.
#pragma once

#include "reference_curve.hpp"
#include "results.hpp"

namespace fpz::report {

struct Reference {
  ReferenceCurve curve;
  double peak = 0.0;       ///< N
  double stiffness = 0.0;  ///< slope of the load over the mid-depth deflection between 10 and 40 % of the peak, N/m
  double notch_stiffness = 0.0;  ///< the same over the opening of the notch, N/m
};

/// The notched beam of a run, load and supports as even pressures over `roller_width` (m; 0: points). Throws
/// io::InputError when data/reference has no curve for its geometry, material and roller width.
[[nodiscard]] Reference beam_reference(const Run& run, double roller_width);

/// The semicircular specimen of a run with its notch upright.
[[nodiscard]] Reference semicircular_reference(const Run& run, double roller_width);

/// Width of the rollers in the finite elements that a run is compared with, m: whole columns of particles; 0 (a point)
/// for a single column.
[[nodiscard]] double roller_width(const Run& run);

/// Slope of the load over the opening of the notch between 10 and 40 % of the peak, N/m.
[[nodiscard]] double notch_stiffness(const Run& run);

/// Errors of a run of the beam against the finite elements with pressures over the width of its rollers: peak, the two
/// stiffnesses, and the work of the load at half depth up to the deflection that both reach.
struct BeamErrors {
  double peak = 0.0, stiffness = 0.0, notch_stiffness = 0.0, work = 0.0;
};
[[nodiscard]] BeamErrors beam_errors(const Run& run);

}  // namespace fpz::report
