// Construction of a run: particles in curve order, constants, the choice of the compiled loops.
#include "engine.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace fpz::sph::detail {

namespace {

template <int Dim>
const Passes<Dim>* choose_passes(const Options<Dim>& o) {
  const int kernel = static_cast<int>(o.kernel);
  const int momentum = static_cast<int>(o.momentum);
#ifdef FPZ_SPH_X86
  const bool avx2 = __builtin_cpu_supports("avx2") > 0;
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") > 0 && __builtin_cpu_supports("avx512vl") > 0 &&
                      __builtin_cpu_supports("avx512dq") > 0;
  const InstructionSet want = o.instruction_set;
  if (avx512 && (want == InstructionSet::best || want == InstructionSet::avx512)) {
    return &avx512_passes<Dim>(kernel, momentum);
  }
  if (avx2 && want != InstructionSet::baseline) return &avx2_passes<Dim>(kernel, momentum);
#endif
  return &baseline_passes<Dim>(kernel, momentum);
}

}  // namespace

int team_size(int requested) {
  if (requested > 0) return requested;
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

template <int Dim>
Engine<Dim>::Engine(const RunSetup<Dim>& s, double time_step) : setup(s), dt(time_step) {
  const Options<Dim>& o = setup.options;
  material = make_material(setup.parameters, setup.setting);
  update_options.method = o.method;
  h = o.smoothing_ratio * setup.arrangement.spacing;
  passes = choose_passes(o);
  place_particles();
  connect_groups();
  if (updated()) {
    rebuild_lists();
  } else {
    build_reference_bonds();
  }
  point_view();
  if (o.zero_energy_control > 0.0 && !updated()) {
    constexpr double longest = 16.0;  // rarely enough to cost little, often enough for a smooth motion
    control_interval = static_cast<int>(std::clamp(1.0 / (control_rate() * dt), 1.0, longest));
    view.control_viscosity = control_interval * control_viscosity();
  }
}

template <int Dim>
void Engine<Dim>::place_particles() {
  const Arrangement<Dim>& a = setup.arrangement;
  const Options<Dim>& o = setup.options;
  Particles<Dim>& p = particles;
  p.count = a.size();
  const std::size_t padded = (p.count + lanes - 1) / lanes * lanes;
  p.id = curve_order<Dim>(a.position, a.spacing);
  slot_of.resize(p.count);
  for (std::size_t i = 0; i < p.count; ++i) slot_of[p.id[i]] = i;

  const auto clear = [&](auto& fields) {
    for (Field& f : fields) f.assign(padded, 0.0);
  };
  clear(p.start), clear(p.position), clear(p.velocity), clear(p.acceleration), clear(p.predicted);
  clear(p.stress), clear(p.strain), clear(p.correction), clear(p.artificial);
  clear(p.gradient), clear(p.flux), clear(p.rotation), clear(damping), clear(built_at), clear(rate), clear(control);
  clear(viscous_force), clear(artificial_force);
  // Padding lanes: harmless numbers, and inertia without end.
  p.mass.assign(padded, 1.0);
  p.inverse_mass.assign(padded, 0.0);
  p.volume.assign(padded, 1.0);
  p.density.assign(padded, 1.0);
  p.length.assign(padded, 1.0);
  p.fracture.assign(padded, 0.0);
  p.kind.assign(padded, kind::elastic);
  p.rotation[0].assign(padded, 1.0);
  p.point.resize(p.count);
  flagged.assign(padded, 0);
  bad.assign(padded / lanes, 0);
  for (Field* f : {&damping_work, &viscous_work, &artificial_work, &damping_next}) {
    f->assign(padded / lanes, 0.0);
  }

  for (std::size_t i = 0; i < p.count; ++i) {
    const std::size_t k = p.id[i];
    for (std::size_t c = 0; c < dimensions; ++c) {
      p.start[c][i] = p.position[c][i] = a.position[k][static_cast<int>(c)];
      if (!setup.velocity.empty()) p.velocity[c][i] = setup.velocity[k][static_cast<int>(c)];
      damping[c][i] = o.damping;
    }
    p.volume[i] = a.volume[k];
    p.density[i] = setup.parameters.density;
    p.mass[i] = setup.parameters.density * a.volume[k] * o.mass_scale;
    p.inverse_mass[i] = 1.0 / p.mass[i];
    const double size = Dim == 2 ? std::sqrt(a.volume[k]) : std::cbrt(a.volume[k]);
    p.length[i] = o.rve_length.rule == RveLength::Rule::number ? o.rve_length.value : size;
    const int g = a.group[k];
    p.kind[i] = g >= 0 && setup.groups[static_cast<std::size_t>(g)].elastic ? kind::elastic : kind::intact;
  }
}

template <int Dim>
void Engine<Dim>::connect_groups() {
  reaction.assign(setup.groups.size(), Vec<double, Dim>::Zero());
  group_velocity.assign(setup.groups.size(), Vec<double, Dim>::Zero());
  for (std::size_t g = 0; g < setup.groups.size(); ++g) {
    for (std::size_t c = 0; c < dimensions; ++c) {
      const std::optional<Motion>& motion = setup.groups[g].motion[c];
      if (!motion) continue;
      group_velocity[g][static_cast<int>(c)] = motion->velocity(0.0);
      for (std::size_t i = 0; i < particles.count; ++i) {
        if (setup.arrangement.group[particles.id[i]] != static_cast<int>(g)) continue;
        prescribed.push_back({i, c, g});
        damping[c][i] = 0.0;
        particles.velocity[c][i] = motion->velocity(0.0);
      }
    }
  }
}

template <int Dim>
void Engine<Dim>::point_view() {
  Particles<Dim>& p = particles;
  const Options<Dim>& o = setup.options;
  View<Dim>& v = view;
  v.column = bonds.column.data();
  v.neighbour = bonds.neighbour.data();
  v.closeness = bonds.closeness.data();
  for (std::size_t c = 0; c < dimensions; ++c) {
    v.weight[c] = bonds.weight[c].data();
    v.start[c] = p.start[c].data();
    v.position[c] = p.position[c].data();
    v.velocity[c] = p.velocity[c].data();
    v.acceleration[c] = p.acceleration[c].data();
    v.predicted[c] = p.predicted[c].data();
    v.damping[c] = damping[c].data();
    v.control[c] = control[c].data();
    v.viscous_force[c] = viscous_force[c].data();
    v.artificial_force[c] = artificial_force[c].data();
    v.gravity[c] = o.gravity[static_cast<int>(c)];
  }
  for (std::size_t k = 0; k < components; ++k) {
    v.stress[k] = p.stress[k].data();
    v.strain[k] = p.strain[k].data();
    v.correction[k] = p.correction[k].data();
    v.artificial[k] = p.artificial[k].data();
  }
  for (std::size_t k = 0; k < dimensions * dimensions; ++k) {
    v.gradient[k] = p.gradient[k].data();
    v.flux[k] = p.flux[k].data();
    v.rate[k] = rate[k].data();
  }
  for (std::size_t k = 0; k < 2; ++k) v.rotation[k] = p.rotation[k].data();
  v.mass = p.mass.data();
  v.inverse_mass = p.inverse_mass.data();
  v.volume = p.volume.data();
  v.density = p.density.data();
  v.kind = p.kind.data();
  v.flagged = flagged.data();
  v.bad = bad.data();
  v.damping_work = damping_work.data();
  v.damping_next = damping_next.data();
  v.viscous_work = viscous_work.data();
  v.artificial_work = artificial_work.data();

  v.step = dt;
  v.lambda = material.bulk.lambda;
  v.mu = material.bulk.mu;
  v.sin_phi = material.sin_phi;
  v.strength = material.law.cohesion * material.cos_phi;
  v.apex = material.law.apex;
  v.weight_scale = 1.0 / o.mass_scale;
  v.rest_density = setup.parameters.density;
  v.sound_speed = std::sqrt(setup.parameters.young_modulus / setup.parameters.density);
  v.top_speed = std::sqrt((v.lambda + 2.0 * v.mu) / setup.parameters.density);
  v.damped = o.damping > 0.0;
  v.smoothing = h;
  v.inverse_smoothing = 1.0 / h;
  v.slope_norm = kernel_norm<Dim>(o.kernel, h) / (h * h);
  v.reference_shape = 1.0 / kernel_shape(o.kernel, 1.0 / o.smoothing_ratio);
  v.viscosity_alpha = o.viscosity_alpha;
  v.viscosity_beta = o.viscosity_beta;
  v.artificial_stress = o.artificial_stress;
}

template <int Dim>
void Engine<Dim>::remake_bonds() {
  if (updated()) {
    bonds = pack<Dim>(lists, particles.padded(), true);
  } else {
    // Rows keep their place; only what was cut since the start differs.
    for (std::size_t i = 0; i < particles.count; ++i) write_row(i);
  }
  point_view();
}

template Engine<2>::Engine(const RunSetup<2>&, double);
template void Engine<2>::place_particles();
template void Engine<2>::connect_groups();
template void Engine<2>::point_view();
template void Engine<2>::remake_bonds();

}  // namespace fpz::sph::detail
