#include "particle_materials.hpp"

#include <algorithm>
#include <cmath>

namespace fpz::sph::detail {

template <int Dim>
ParticleMaterials<Dim>::ParticleMaterials(const RunSetup<Dim>& setup, const std::vector<std::size_t>& id,
                                          std::size_t padded) {
  const auto add = [&](const Parameters& p) {
    list_.push_back({p, make_material(p, setup.setting), snap_back_length(p, setup.setting)});
  };
  add(setup.parameters);
  for (const Parameters& p : setup.materials.further) add(p);
  differ_ = !setup.materials.of_particle.empty();
  if (!differ_) return;
  for (const std::size_t k : id) of_slot_.push_back(setup.materials.of_particle[k]);
  fields(Allocate{padded});
  for (std::size_t i = 0; i < id.size(); ++i) {
    const Material<double>& m = list_[index(i)].constants;
    lambda_[i] = m.bulk.lambda;
    mu_[i] = m.bulk.mu;
    sin_phi_[i] = m.law.surface.sin_phi;
    strength_[i] = m.law.surface.cohesion * m.law.surface.cos_phi;
    apex_[i] = m.law.surface.apex;
  }
}

/// What one number must do for: the fastest wave bounds velocities, the largest impedance resists an approach.
template <int Dim>
void ParticleMaterials<Dim>::point(View<Dim>& view) {
  const Material<double>& first = list_.front().constants;
  view.lambda = first.bulk.lambda;
  view.mu = first.bulk.mu;
  view.sin_phi = first.law.surface.sin_phi;
  view.strength = first.law.surface.cohesion * first.law.surface.cos_phi;
  view.apex = first.law.surface.apex;
  for (const Entry& e : list_) {
    const double density = e.parameters.density, sound = std::sqrt(e.parameters.young_modulus / density);
    const double modulus = e.constants.bulk.lambda + 2.0 * e.constants.bulk.mu;
    view.top_speed = std::max(view.top_speed, std::sqrt(modulus / density));
    if (density * sound <= view.rest_density * view.sound_speed) continue;
    view.rest_density = density;
    view.sound_speed = sound;
  }
  if (differ_) fields(Point<Dim>{view});
}

template class ParticleMaterials<2>;

}  // namespace fpz::sph::detail
