// A specimen in uniform tension parts along one crack.
#include <gtest/gtest.h>

#include <cmath>

#include "fpz/specimen/crack.hpp"
#include "fpz/specimen/specimen.hpp"

namespace {

using namespace fpz::specimen;

struct Parted {
  double length = 0.0;       ///< of its cracks, m
  double work = 0.0;         ///< of the grips until the end, J
  double alternation = 0.0;  ///< of rows of uncracked particles, over the largest opening
  double closed_form = 0.0;  ///< the same of an elastic body in series with one cohesive zone across the waist, J
  double tail = 0.0;         ///< load at the end over that of the closed form
};

constexpr double waist = 0.04;         // m
constexpr double opened_part = 0.8;    // damage at the end, with which an open crack counts
constexpr double deflection = 60e-6;   // m, of most runs
constexpr double tail_memory = 2e-6;   // m, over which the load of the tail is averaged
constexpr double area = waist * 0.05;  // m^2

/// Load of the closed form at a deflection: P = sigma_t0 A exp(-(u - P/K)/delta0) once it has reached sigma_t0 A.
double closed_load(const fpz::Parameters& m, double stiffness, double u) {
  double low = 0.0, high = m.tensile_strength * area;
  if (stiffness * u < high) return stiffness * u;
  for (int k = 0; k < 60; ++k) {
    const double load = 0.5 * (low + high);
    const double held = m.tensile_strength * area * std::exp(-(u - load / stiffness) / m.delta0);
    (load < held ? low : high) = load;
  }
  return low;
}

/// The dog-bone at 4 mm, with some entries changed.
Parted part(std::vector<std::string> changes, double end = deflection) {
  changes.insert(changes.begin(), {"spacing=0.004", "method.threads=1", "boundaries[0].velocity.y.speed=0.01"});
  const Scene scene = read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes/dogbone.json", changes);
  const Specimen specimen = make_specimen(scene);
  fpz::sph::Simulation<2> run(specimen.setup);
  const BoundGauge& load = specimen.gauges.at("load");
  const BoundGauge& way = specimen.gauges.at("deflection");
  Parted p;
  double last_load = 0.0, last_way = 0.0, stiffness = 0.0;
  while (last_way < end) {
    const fpz::sph::Outcome o = run.step();
    if (!o.ok()) throw std::runtime_error(o.message());
    const double now = load.value(run, scene.thickness), u = way.value(run, scene.thickness);
    if (now < 0.5 * scene.parameters.tensile_strength * area && run.cracked() == 0) stiffness = now / u;
    p.work += 0.5 * (now + last_load) * (u - last_way);
    const double closed = closed_load(scene.parameters, stiffness, u);
    p.closed_form += closed * (u - last_way);
    // The load is that of one step: what vibrates is left out.
    p.tail += std::min(1.0, (u - last_way) / tail_memory) * (now / closed - p.tail);
    last_load = now;
    last_way = u;
  }
  p.length = opened_length(spots(run, specimen), scene.spacing);
  p.alternation = run.alternation() / largest_opening(run);
  return p;
}

/// The waist of the dog-bone is 40 mm wide and 40 mm long, with equal stress everywhere. A gradient that does not see
/// alternating rows lets its two sub-lattices part separately, in two cracks of 40 mm. The work is that of one crack,
/// whatever the time step and however the lattice lies.
TEST(OneCrack, TheDogBonePartsOnce) {
  for (const auto& [courant, angle] : {std::pair("0.3", "0"), {"0.5", "0"}, {"0.9", "0"}, {"0.9", "45"}}) {
    const Parted p = part({"method.courant=" + std::string(courant), "arrangement.angle_deg=" + std::string(angle)});
    EXPECT_NEAR(p.work / p.closed_form, 1.0, 0.05) << courant << " " << angle;
    EXPECT_NEAR(p.length, opened_part * waist, 0.15 * waist) << courant << " " << angle;
    EXPECT_LT(p.alternation, 0.05) << courant << " " << angle;
  }
}

/// Neighbours beyond the first row of a crack reach across it, and what they carry adds to what the zone does: a fifth
/// of the load when a tenth of the strength was left.
TEST(OneCrack, ItsTailIsThatOfTheZone) {
  const Parted p = part({"spacing=0.002", "method.courant=0.9"}, 86e-6);
  EXPECT_NEAR(p.tail, 1.0, 0.06);
}

/// A block that is narrowest at the platen which pulls it parts beside it. The platen cannot crack, so that fewer rows
/// open than elsewhere; the work is that of one crack all the same.
TEST(OneCrack, BesideAPlatenItCostsAsMuch) {
  const Parted p = part({"boundaries[0].width=0.04",
                         "shape.corners=[[-0.03,-0.06],[0.03,-0.06],[0.03,0.048],[0.02,0.052],[0.02,0.06],[-0.02,0.06],"
                         "[-0.02,0.052],[-0.03,0.048]]"});
  EXPECT_NEAR(p.work / p.closed_form, 1.0, 0.05);
  EXPECT_NEAR(p.length, opened_part * waist, 0.15 * waist);
}

}  // namespace
