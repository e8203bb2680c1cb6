#include "fpz/calibration/geometry_function.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fpz::calibration {
namespace {

/// A value with its derivative.
using Slope = Dual<1>;

/// k_beta of K_I = 3 P span/(2 thickness D^2) sqrt(D) k_beta.
Slope bending_function(const Slope& a, double span_over_depth) {
  const Slope b = 1.0 - a;
  const Slope four = 1.90 + a * (0.41 + a * (0.51 - a * 0.17));
  const Slope infinite = 1.99 + a * (0.83 - a * (0.31 - a * 0.14));
  const Slope p = infinite + 4.0 / span_over_depth * (four - infinite);
  return sqrt(a) * p / ((1.0 + 3.0 * a) * b * sqrt(b));
}

/// Y' of the ISRM method for half discs, K_I = P sqrt(pi notch) Y'/(2 radius thickness).
Slope disc_function(const Slope& a, double span_over_diameter) {
  const double s = span_over_diameter;
  return -1.297 + 9.516 * s - (0.47 + 16.457 * s) * a + (1.071 + 34.401 * s) * a * a;
}

/// f of K_I = P f/(thickness sqrt(W)) of ASTM E399 (Srawley 1976); a is counted from the line of the pins, over W.
Slope compact_function(const Slope& a) {
  const Slope b = 1.0 - a;
  return (2.0 + a) * (0.886 + a * (4.64 + a * (-13.32 + a * (14.72 - a * 5.6)))) / (b * sqrt(b));
}

/// The proportions of the standard, within its tolerances.
bool is_standard_compact(const NotchedSpecimen& s) {
  constexpr double tolerance = 0.01;
  const double width = s.depth - s.load_depth;
  const NotchedSpecimen standard = compact_tension(width, s.notch - s.load_depth, s.thickness);
  return std::abs(s.length - standard.length) <= tolerance * width &&
         std::abs(s.span - standard.span) <= tolerance * width &&
         std::abs(s.load_depth - standard.load_depth) <= tolerance * width &&
         std::abs(s.hole - standard.hole) <= tolerance * width;
}

GeometryFunction made_of(const Slope& k, std::string source) { return {k.val, k.grad[0], std::move(source)}; }

/// Compliances of the load (1/m, times E) at crack lengths about the notch, up to a constant.
struct Compliance {
  Eigen::VectorXd length;  ///< over half the window, from the notch: -1 to 1
  Eigen::VectorXd value;
};

/// What the displacement of the load gains while the ligament opens node by node is |L^-1 load|^2, summed up to the
/// node (L: Cholesky factor of the stiffness). The elements are even there.
Compliance compliance_about(NotchedSpecimen s, double window, double fraction, double poisson_ratio) {
  constexpr double behind = 2.5;  // elements between the notch of the mesh and the first point
  const double notch = s.notch;
  const double ligament = s.ligament();
  s.mesh.tip_fraction = 1.0;
  s.mesh.ligament_fraction = fraction;
  s.notch = notch - window - behind * s.mesh.ligament_fraction * ligament;
  const Condensation c = condense(s, poisson_ratio);
  const Eigen::Index open = (c.height.array() < notch + window).count() / 2 * 2;
  const Eigen::MatrixXd part = c.body.stiffness.topLeftCorner(open, open);
  const Eigen::VectorXd y = Eigen::LLT<Eigen::MatrixXd>(part).matrixL().solve(c.body.load.head(open));
  Compliance out;
  out.length.resize(open / 2);
  out.value.resize(open / 2);
  Eigen::Index points = 0;
  for (Eigen::Index k = 2; k <= open; k += 2) {
    const double length = (c.height[k] - notch) / window;
    if (length < -1.0) continue;
    out.length[points] = length;
    out.value[points++] = y.head(k).squaredNorm();
  }
  out.length.conservativeResize(points);
  out.value.conservativeResize(points);
  return out;
}

/// From elements of one size, by a polynomial through the compliances.
GeometryFunction on_mesh(const NotchedSpecimen& specimen, double window, double fraction, double poisson_ratio) {
  constexpr int degree = 4;
  const Compliance c = compliance_about(specimen, window, fraction, poisson_ratio);
  Eigen::MatrixXd powers(c.length.size(), degree + 1);
  for (int k = 0; k <= degree; ++k) powers.col(k) = c.length.array().pow(k);
  const Eigen::VectorXd polynomial = powers.colPivHouseholderQr().solve(c.value);
  const double nu = poisson_ratio;
  const double plane = specimen.setting == Setting::plane_strain ? 1.0 / (1.0 - nu * nu) : 1.0;  // E'/E
  const double per_alpha = specimen.height() / window;
  const double to_g = 0.5 * plane * specimen.thickness * per_alpha;
  GeometryFunction out;
  out.k = std::sqrt(to_g * polynomial[1]);
  out.slope = to_g * per_alpha * polynomial[2] / out.k;
  out.source = "elastic body of the program";
  return out;
}

}  // namespace

std::optional<GeometryFunction> published_geometry_function(const NotchedSpecimen& s) {
  const double ratio = s.notch / s.height();
  const Slope a = Slope::seed(ratio, 0);
  if (s.shape == SpecimenShape::beam) {
    const double span = s.span / s.depth;
    if (s.load_span > 0.0 || span < 2.5 || ratio < least_notch || ratio > 0.9) return std::nullopt;
    return made_of(1.5 * span * bending_function(a, span), "Guinea et al. 1998");
  }
  if (s.shape == SpecimenShape::semicircular) {
    const double span = 0.5 * s.span / s.radius;
    constexpr double rounding = 1e-9;
    if (std::abs(span - 0.65) > 0.15 + rounding || std::abs(ratio - 0.5) > 0.1 + rounding) return std::nullopt;
    return made_of(0.5 * sqrt(std::numbers::pi * a) * disc_function(a, span), "ISRM, Kuruppu et al. 2014");
  }
  if (s.shape == SpecimenShape::compact_tension) {
    const double width = s.depth - s.load_depth;
    const double crack = (s.notch - s.load_depth) / width;
    if (!is_standard_compact(s) || crack < 0.2 || crack > 0.95) return std::nullopt;
    const Slope over_width = (a * s.depth - s.load_depth) / width;
    return made_of(std::sqrt(s.depth / width) * compact_function(over_width), "ASTM E399, Srawley 1976");
  }
  return std::nullopt;
}

GeometryFunction elastic_geometry_function(const NotchedSpecimen& specimen, double poisson_ratio) {
  if (!(specimen.notch >= least_notch * specimen.height())) {
    throw std::invalid_argument("a stress intensity needs a notch of 0.03 times the depth at least");
  }
  // On elements of length h a crack is as stiff as one shorter by a part of h. Half of h takes the half of that away.
  const double window = std::min(0.06 * specimen.ligament(), 0.6 * specimen.notch);
  const double fraction = std::clamp(window / (8.0 * specimen.ligament()), 0.0025, 1.0 / 160.0);
  const GeometryFunction fine = on_mesh(specimen, window, fraction, poisson_ratio);
  const GeometryFunction coarse = on_mesh(specimen, window, 2.0 * fraction, poisson_ratio);
  return {2.0 * fine.k - coarse.k, 2.0 * fine.slope - coarse.slope, fine.source};
}

GeometryFunction geometry_function(const NotchedSpecimen& specimen, double poisson_ratio) {
  if (auto known = published_geometry_function(specimen)) return *known;
  return elastic_geometry_function(specimen, poisson_ratio);
}

double stress_intensity(const NotchedSpecimen& specimen, const GeometryFunction& f, double load) {
  return load * f.k / (specimen.thickness * std::sqrt(specimen.height()));
}

}  // namespace fpz::calibration
