// The mean strain and the rotation of a site: those of the linear field that fits the displacements of its particles
// best, as a strain gauge glued on them would see it, cracks beneath it included.
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "fpz/io/input_error.hpp"
#include "gauge_kinds.hpp"

namespace fpz::specimen::detail {
namespace {

using Matrix = Eigen::Matrix2d;

constexpr std::string_view uses[] = {"of"};

Gauge read_strain(const InputReader& r, const Place& gauge, const Place& value, const Scene& scene) {
  StrainGauge g;
  g.component = choice<PlaneComponent>(r, value).value_or(PlaneComponent::xx);
  with_required(r, gauge, "of", [&](const Place& p) { g.of = read_site(r, p, scene); });
  return g;
}

Gauge read_rotation(const InputReader& r, const Place& /*gauge*/, const Place& value, const Scene& scene) {
  return RotationGauge{read_site(r, value, scene)};
}

/// A particle and what its displacement adds to the gradient of the best linear field: u (x) slope.
struct Slope {
  std::size_t particle;
  Point slope;  ///< 1/m
};

/// Least squares with the volumes as weights. Throws io::InputError where the particles do not determine a gradient.
std::vector<Slope> slopes_of(const Site& site, std::string_view key, const GaugeBinding& to) {
  constexpr double thinnest = 0.2;  // spacings, rms extent of the site in its shorter direction; two rows have 0.5
  const sph::Arrangement<2>& a = to.arrangement;
  const std::vector<std::size_t> ids = particles_of(site, to);
  double volume = 0.0;
  Point centre = Point::Zero();
  for (const std::size_t i : ids) volume += a.volume[i], centre += a.volume[i] * a.position[i];
  centre /= volume;
  Matrix moment = Matrix::Zero();
  for (const std::size_t i : ids) {
    const Point r = a.position[i] - centre;
    moment += a.volume[i] * r * r.transpose();
  }
  const double least = Eigen::SelfAdjointEigenSolver<Matrix>(moment).eigenvalues()[0] / volume;
  if (!(least > std::pow(thinnest * a.spacing, 2.0))) {
    throw io::InputError(to.scene.file + ": gauges." + to.name + "." + std::string(key) + ": its " +
                         std::to_string(ids.size()) +
                         " particles lie at one place or on one line, where strain and rotation are not determined; "
                         "must be a \"point\" with a \"radius\" of two spacings or more, or a box as wide");
  }
  std::vector<Slope> slopes;
  for (const std::size_t i : ids) slopes.push_back({i, moment.inverse() * (a.volume[i] * (a.position[i] - centre))});
  return slopes;
}

/// F of the undeformed body.
Matrix deformation_gradient(const sph::Simulation<2>& run, const std::vector<Slope>& slopes) {
  const sph::Particles<2>& p = run.motions_now();
  Matrix f = Matrix::Identity();
  for (const Slope& s : slopes) {
    const std::size_t i = run.slot(s.particle);
    f += Point(p.position[0][i] - p.start[0][i], p.position[1][i] - p.start[1][i]) * s.slope.transpose();
  }
  return f;
}

/// Angle of R in F = R U, rad, counter-clockwise.
double angle_of(const Matrix& f) { return std::atan2(f(1, 0) - f(0, 1), f(0, 0) + f(1, 1)); }

std::vector<std::size_t> particles(const std::vector<Slope>& slopes) {
  std::vector<std::size_t> all;
  for (const Slope& s : slopes) all.push_back(s.particle);
  return all;
}

}  // namespace

const GaugeKind strain_gauge = {"strain", uses, read_strain};
const GaugeKind rotation_gauge = {"rotation_of", {}, read_rotation};

/// U - I: what the body's own axes see, whatever its rotation.
BoundGauge bind(const StrainGauge& gauge, const GaugeBinding& to) {
  const std::vector<Slope> slopes = slopes_of(gauge.of, "of", to);
  const auto value = [slopes, component = gauge.component](const sph::Simulation<2>& run, double /*thickness*/) {
    const Matrix f = deformation_gradient(run, slopes);
    const double c = std::cos(angle_of(f)), s = std::sin(angle_of(f));
    const Matrix u = Matrix{{c, s}, {-s, c}} * f;
    switch (component) {
      case PlaneComponent::xx:
        return u(0, 0) - 1.0;
      case PlaneComponent::yy:
        return u(1, 1) - 1.0;
      case PlaneComponent::xy:
        break;
    }
    return 0.5 * (u(0, 1) + u(1, 0));
  };
  return {value, {particles(slopes)}};
}

BoundGauge bind(const RotationGauge& gauge, const GaugeBinding& to) {
  const std::vector<Slope> slopes = slopes_of(gauge.of, "rotation_of", to);
  const auto value = [slopes](const sph::Simulation<2>& run, double /*thickness*/) {
    return angle_of(deformation_gradient(run, slopes));
  };
  return {value, {particles(slopes)}};
}

}  // namespace fpz::specimen::detail
