// The opening of a notch at its mouth: the displacements of its two faces there, which the particles beside them give
// by linear fields.
#include "fpz/io/input_error.hpp"
#include "gauge_kinds.hpp"
#include "linear_weights.hpp"

namespace fpz::specimen::detail {
namespace {

Gauge read(const InputReader& r, const Place& /*gauge*/, const Place& value, const Scene& scene) {
  OpeningGauge g;
  const Notch* notch = notch_at(r, value, scene);
  if (notch == nullptr) return g;
  g.mouth = notch->mouth;
  g.direction = across(*notch);
  g.half_width = 0.5 * notch->width;
  return g;
}

/// Particles on one side of the notch that give the displacement of its face at the mouth. `side`: 1 to the left of the
/// notch, -1 to the right.
std::vector<ParticleWeight> face_of(const OpeningGauge& g, double side, const GaugeBinding& to) {
  const sph::Arrangement<2>& a = to.arrangement;
  const Point face = g.mouth + side * g.half_width * g.direction;
  for (const double spacings : {2.0, 3.0, 4.0, 6.0}) {
    const double reach = spacings * a.spacing;
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool beside = side * g.direction.dot(a.position[i] - g.mouth) > 0.0;
      const bool is_near = (a.position[i] - face).norm() < reach;
      if (a.group[i] == sph::Arrangement<2>::specimen && beside && is_near) near.push_back(i);
    }
    auto weights = linear_weights(face, reach, a, near);
    if (!weights.empty()) return weights;
  }
  throw io::InputError(to.scene.file + ": gauges." + to.name + ".notch_opening: too few particles beside the mouth " +
                       "of the notch; a smaller \"spacing\" is needed");
}

std::vector<std::size_t> particles(const std::vector<ParticleWeight>& weights) {
  std::vector<std::size_t> all;
  for (const ParticleWeight& w : weights) all.push_back(w.particle);
  return all;
}

double displacement(const sph::Simulation<2>& run, const std::vector<ParticleWeight>& weights, const Point& along) {
  const sph::Particles<2>& p = run.motions_now();
  double sum = 0.0;
  for (const ParticleWeight& w : weights) {
    const std::size_t i = run.slot(w.particle);
    sum += w.weight * along.dot(Point(p.position[0][i] - p.start[0][i], p.position[1][i] - p.start[1][i]));
  }
  return sum;
}

}  // namespace

const GaugeKind notch_opening_gauge = {"notch_opening", {}, read};

BoundGauge bind(const OpeningGauge& gauge, const GaugeBinding& to) {
  const auto left = face_of(gauge, 1.0, to), right = face_of(gauge, -1.0, to);
  const auto value = [left, right, along = gauge.direction](const sph::Simulation<2>& run, double /*thickness*/) {
    return displacement(run, left, along) - displacement(run, right, along);
  };
  return {value, {particles(left), particles(right)}};
}

}  // namespace fpz::specimen::detail
