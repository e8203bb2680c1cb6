// Beams in three- and four-point bending, notched or not, semicircular specimens at zero notch angle, and specimens
// that two opposite forces pull open: an elastic body with a straight cohesive crack along its plane of symmetry, in
// pure mode I (eq 43-50).
#pragma once

#include <Eigen/Core>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/calibration/elastic_body.hpp"
#include "fpz/calibration/prediction.hpp"

namespace fpz::calibration {

enum class SpecimenShape {
  beam,              ///< rectangle on two supports, notch from below or none, one load on top or two
  semicircular,      ///< half disc, flat side down on two supports, notch from the flat side, load on top
  compact_tension,   ///< rectangle that two pins in holes beside the notch pull open (ASTM E399, E1820)
  wedge_splitting,   ///< the same without holes, with a groove if you like, and perhaps what the wedge presses down
  double_cantilever  ///< the same, long in the direction of the notch
};

/// Two opposite forces P, beside the notch and square to it.
[[nodiscard]] inline bool is_pulled_open(SpecimenShape shape) {
  return shape != SpecimenShape::beam && shape != SpecimenShape::semicircular;
}

}  // namespace fpz::calibration

template <>
struct fpz::Words<fpz::calibration::SpecimenShape> {
  using K = calibration::SpecimenShape;
  static constexpr Word<K> list[] = {{K::beam, "beam"},
                                     {K::semicircular, "semicircular"},
                                     {K::compact_tension, "compact_tension"},
                                     {K::wedge_splitting, "wedge_splitting"},
                                     {K::double_cantilever, "double_cantilever"}};
};

namespace fpz::calibration {

/// Sizes of the elements. Halving the first three and the growth halves every element.
struct MeshDensity {
  double ligament_fraction = 1.0 / 40.0;  ///< element along the ligament, over the ligament
  double tip_fraction = 1.0 / 16.0;       ///< element at the notch tip, over the one along the ligament
  double support_fraction = 1.0 / 16.0;   ///< element at the supports, over the height
  double growth = 0.3;                    ///< growth of the element size per distance

  [[nodiscard]] bool operator==(const MeshDensity&) const = default;
};

/// Geometry of a test, SI.
struct NotchedSpecimen {
  SpecimenShape shape = SpecimenShape::beam;
  double length = 0.0;  ///< of the beam, m; pulled open: across the notch (semicircular: unused)
  double depth = 0.0;  ///< of the beam, m; pulled open: from the face with the notch to the back (semicircular: unused)
  double radius = 0.0;      ///< of the half disc, m (others: unused)
  double thickness = 0.0;   ///< m
  double span = 0.0;        ///< between the supports, m; pulled open: between the two forces
  double load_span = 0.0;   ///< of the beam: between the two loads of P/2, m; 0: one load P
  double notch = 0.0;       ///< from the face to the tip, m; a beam may have none
  double load_depth = 0.0;  ///< pulled open: from the face to the line of the forces, m
  double hole = 0.0;  ///< compact tension: diameter of the holes, on whose outer halves the forces act, m; 0: none
  double groove_width = 0.0;  ///< wedge splitting: groove in the face, m; 0: none
  double groove_depth = 0.0;  ///< m
  double wedge_slope = 0.0;   ///< wedge splitting: force in the direction of the notch, on each side, over P
  /// Load and supports: 0 puts them on points; otherwise they are even pressures over this width (m), and deflections
  /// are means over it. A wide roller shortens the lever arms: the load rises by about roller_width/(2 span). A point
  /// indents an elastic body without limit, so the deflection (not the load and the CMOD) depends on the elements
  /// there: at the supports a little, with MeshDensity::support_fraction; under the load so much that
  /// Gauge::deflection_load_point is refused. Pulled open without holes: height over which each force is even.
  double roller_width = 0.0;
  double clip_gauge_distance = 0.0;  ///< of the clip gauge before the mouth of the notch, m
  Setting setting = Setting::plane_strain;
  MeshDensity mesh;

  /// From the face with the notch to the other side: depth, or radius of the half disc, m.
  [[nodiscard]] double height() const { return shape == SpecimenShape::semicircular ? radius : depth; }
  [[nodiscard]] double ligament() const { return height() - notch; }
  /// P (span - load_span)/4 is the bending moment at mid-span. m
  [[nodiscard]] double arms() const { return span - load_span; }
  /// Largest bending stress on the ligament per load, with the pull of specimens that are pulled open, 1/m^2.
  [[nodiscard]] double nominal_stress() const;
  [[nodiscard]] bool operator==(const NotchedSpecimen&) const = default;
};

/// The lengths that similar specimens have in proportion.
inline constexpr double NotchedSpecimen::*in_plane_lengths[] = {
    &NotchedSpecimen::length,       &NotchedSpecimen::depth,        &NotchedSpecimen::radius,
    &NotchedSpecimen::span,         &NotchedSpecimen::load_span,    &NotchedSpecimen::notch,
    &NotchedSpecimen::load_depth,   &NotchedSpecimen::hole,         &NotchedSpecimen::groove_width,
    &NotchedSpecimen::groove_depth, &NotchedSpecimen::roller_width, &NotchedSpecimen::clip_gauge_distance};

/// The specimen of ASTM E399 and E1820: `width` W from the line of the pins to the back, notch of length `notch` from
/// that line (m), 1.2 W across, holes of W/4 at 0.275 W beside the notch and W/4 below the face.
[[nodiscard]] NotchedSpecimen compact_tension(double width, double notch, double thickness);

/// Everything wrong with a geometry, in one pass.
[[nodiscard]] Validation validate(const NotchedSpecimen& specimen);

/// Mesh of the half specimen x >= 0. The geometry must be valid.
[[nodiscard]] HalfMesh make_mesh(const NotchedSpecimen& specimen);

/// Condenses a valid specimen. Well under half a second.
[[nodiscard]] Condensation condense(const NotchedSpecimen& specimen, double poisson_ratio, bool nu_derivative = false);

/// Keeps the last few condensations, so that a fit condenses once per geometry and Poisson's ratio. Thread-safe.
class CondensationCache {
 public:
  [[nodiscard]] std::shared_ptr<const Condensation> get(const NotchedSpecimen& specimen, double poisson_ratio,
                                                        bool nu_derivative);

 private:
  struct Entry {
    NotchedSpecimen specimen;
    double poisson_ratio = 0.0;
    std::shared_ptr<const Condensation> condensation;
  };
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< last used first
};

/// A measured curve: the gauge's readings at which loads were measured, in the order of time. Readings may turn back
/// (unloading cycles).
struct NotchedSpecimenTest {
  NotchedSpecimen specimen;
  Gauge gauge = Gauge::cmod;
  Eigen::VectorXd readings;                                                          ///< m
  std::shared_ptr<CondensationCache> cache = std::make_shared<CondensationCache>();  ///< may be shared by tests
};

/// Everything wrong with a test, its specimen included.
[[nodiscard]] Validation validate(const NotchedSpecimenTest& test);

/// Properties of a test set-up that a fit may have to find: of openings `cmod_offset`; of deflection tests
/// `machine_compliance`, `deflection_offset`, `toe` and `toe_load`. Control says how the reading follows from them.
struct NuisanceInfo {
  std::string_view name;
  std::string_view symbol;
  std::string_view unit;
  bool any_sign = false;  ///< otherwise >= 0
};
[[nodiscard]] std::span<const NuisanceInfo> nuisances(Gauge gauge);

/// Loads P (N) at the readings of the test; before any load (reading - offset <= 0) on the elastic line. `nuisance`
/// has the entries of nuisances(test.gauge). Exact derivatives; those with respect to cohesion, friction angle,
/// dilation angle and shear stiffness are zero because the crack opens in pure mode I. Fails, with the reading, for
/// inadmissible input, at a snap-back, and where the crack has run through the ligament.
[[nodiscard]] Prediction predict(const NotchedSpecimenTest& test, const Parameters& parameters,
                                 const Eigen::VectorXd& nuisance, bool derivatives);

/// A whole test, one entry per state of equilibrium, under steadily growing CMOD; without a notch under growing
/// deflection at mid-depth, which may end in a snap-back.
struct FractureCurve {
  std::vector<double> load;                   ///< P, N
  std::vector<double> cmod;                   ///< m
  std::vector<double> deflection_mid_depth;   ///< m
  std::vector<double> deflection_load_point;  ///< m; meaningful for roller_width > 0
  std::vector<double> load_line_opening;      ///< m; of specimens that are pulled open
  std::vector<double> crack_length;           ///< from the notch tip to the highest cracked point, m
  std::vector<double> fracture_work;          ///< spent on the crack so far, J
  std::vector<double> elastic_energy;         ///< of the body, J
  std::string failure;                        ///< why the curve ends early; empty when it does not
};

/// The curve up to the point where the load has fallen to `end_load` times its peak, in steps that refine with the
/// opening at the notch tip: each is `step` times (delta0 + opening).
[[nodiscard]] FractureCurve fracture_curve(const NotchedSpecimen& specimen, const Parameters& parameters,
                                           double end_load = 0.05, double step = 0.04);

/// Initial stiffness dP/d(gauge) of the uncracked specimen over Young's modulus, m.
[[nodiscard]] double initial_stiffness(const NotchedSpecimen& specimen, double poisson_ratio,
                                       Gauge gauge = Gauge::cmod);

/// Young's modulus from the initial slope of a measured curve.
struct InitialModulus {
  double value = 0.0;           ///< Pa
  double standard_error = 0.0;  ///< from the scatter about the line, Pa
  double offset = 0.0;          ///< reading at which the line crosses zero load, m
  int points = 0;
};

/// Least-squares line through the points whose load lies between `from` and `to` times the peak, on the way up to the
/// peak. A process zone that forms before `to` flattens the slope: the value is then a lower bound, and it is better to
/// fit E together with the strength. Throws std::invalid_argument when fewer than three points remain.
[[nodiscard]] InitialModulus initial_modulus(const NotchedSpecimen& specimen, double poisson_ratio,
                                             const Eigen::VectorXd& readings, const Eigen::VectorXd& loads,
                                             double from = 0.1, double to = 0.4, Gauge gauge = Gauge::cmod);

/// Why the mesh is too coarse for the process zone, or an empty string. Nodes along the ligament separate one by one;
/// elements longer than a tenth of E' delta0/sigma_t0 make the curve wavy, elements of twice that length stop it.
[[nodiscard]] std::string mesh_warning(const NotchedSpecimen& specimen, const Parameters& parameters);

/// Why the straight mode I crack assumed here is not what the model would do with these parameters, or an empty string:
/// below a certain cohesion, tension cracks on an inclined plane and below sigma_t0.
[[nodiscard]] std::string mode_one_warning(const Parameters& parameters);

}  // namespace fpz::calibration
