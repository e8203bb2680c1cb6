#include "particle_materials.hpp"

#include <algorithm>
#include <cmath>

namespace fpz::sph::detail {

template <int Dim>
ParticleMaterials<Dim>::ParticleMaterials(const RunSetup<Dim>& setup, const std::vector<std::size_t>& id,
                                          std::size_t padded) {
  add(setup.parameters, setup.setting);
  for (const Parameters& p : setup.materials.further) add(p, setup.setting);
  const bool random = !setup.materials.strength_factor.empty();
  differ_ = random || !setup.materials.of_particle.empty() || !setup.weak_planes.of_particle.empty();
  if (!differ_) return;
  for (const std::size_t k : id) {
    of_slot_.push_back(random ? list_.size() : setup.materials.of(k));
    if (random) add(parameters_of_particle(setup, k), setup.setting);
  }
  fields(Allocate{padded});
  for (std::size_t i = 0; i < id.size(); ++i) {
    const Material<double>& m = list_[index(i)].constants;
    lambda_[i] = m.bulk.lambda;
    mu_[i] = m.bulk.mu;
    sin_phi_[i] = m.law.surface.sin_phi;
    strength_[i] = m.law.surface.cohesion * m.law.surface.cos_phi;
    apex_[i] = m.law.surface.apex;
  }
  if (!setup.weak_planes.of_particle.empty()) add_weak_planes(setup, id);
}

template <int Dim>
void ParticleMaterials<Dim>::add(const Parameters& p, Setting setting) {
  list_.push_back({p, make_material(p, setting), snap_back_length(p, setting)});
}

/// The zone of a plane is between pieces of the particle's own material. Such particles always go to the library.
template <int Dim>
void ParticleMaterials<Dim>::add_weak_planes(const RunSetup<Dim>& setup, const std::vector<std::size_t>& id) {
  const WeakPlanes<Dim>& planes = setup.weak_planes;
  std::map<std::pair<int, std::size_t>, std::size_t> entries;
  weak_.resize(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) {
    const int kind = planes.of_particle[id[i]];
    if (kind == WeakPlanes<Dim>::none) continue;
    const auto [entry, is_new] = entries.try_emplace({kind, of_slot_[i]}, list_.size());
    if (is_new) {
      const Parameters bulk = list_[of_slot_[i]].parameters;
      Parameters p = planes.parameters[static_cast<std::size_t>(kind)];
      p.young_modulus = bulk.young_modulus, p.poisson_ratio = bulk.poisson_ratio, p.density = bulk.density;
      add(p, setup.setting);
    }
    weak_[i] = {entry->second, planes.normal[id[i]].normalized(), false};
    strength_[i] = -std::numeric_limits<double>::infinity();
  }
}

template <int Dim>
void ParticleMaterials<Dim>::save(Writer& archive) const {
  for (const WeakPlane& plane : weak_) archive(plane.cracked);
}

template <int Dim>
void ParticleMaterials<Dim>::load(Reader& archive) {
  for (WeakPlane& plane : weak_) archive(plane.cracked);
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
