// The start of a run: particles in their order, constants, the choice of the compiled loops.
#include "run_data.hpp"

#include <algorithm>
#include <cmath>

#include "fpz/threads.hpp"
#include "particle_order.hpp"

namespace fpz::sph::detail {

namespace {

template <int Dim>
const Passes<Dim>* choose_passes(const Options<Dim>& o, bool several) {
  const int kernel = static_cast<int>(o.kernel);
  const int momentum = static_cast<int>(o.momentum);
#ifdef FPZ_SPH_X86
  const bool avx2 = __builtin_cpu_supports("avx2") > 0;
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") > 0 && __builtin_cpu_supports("avx512vl") > 0 &&
                      __builtin_cpu_supports("avx512dq") > 0;
  const InstructionSet want = o.instruction_set;
  if (avx512 && (want == InstructionSet::best || want == InstructionSet::avx512)) {
    return &avx512_passes<Dim>(kernel, momentum, several);
  }
  if (avx2 && want != InstructionSet::baseline) return &avx2_passes<Dim>(kernel, momentum, several);
#endif
  return &baseline_passes<Dim>(kernel, momentum, several);
}

}  // namespace

template <int Dim>
RunData<Dim>::RunData(const RunSetup<Dim>& s, double time_step)
    : setup(s), dt(time_step), team(thread_count(s.options.threads)) {
  const Options<Dim>& o = setup.options;
  update_options.method = o.method;
  h = o.smoothing_ratio * setup.arrangement.spacing;
  place_particles();
  choose_order();
  passes = choose_passes(o, materials.differ());
  set_initial_stress();
  fields(*this, Point<Dim>{view});
  set_constants();
  std::fill_n(flagged.begin(), particles.count, 1);  // the stresses are those that are stored
}

template <int Dim>
void RunData<Dim>::choose_order() {
  constexpr std::size_t many = 4096, large_chunk = 64, chunks_of_a_thread = 8;
  const std::size_t blocks = particles.blocks();
  const auto threads = static_cast<std::size_t>(thread_count(setup.options.threads));
  in_one_sweep = blocks >= std::max(many, large_chunk * chunks_of_a_thread * threads);
  if (in_one_sweep) chunk_blocks = static_cast<Index>(large_chunk);
}

template <int Dim>
void RunData<Dim>::place_particles() {
  const Arrangement<Dim>& a = setup.arrangement;
  const Options<Dim>& o = setup.options;
  Particles<Dim>& p = particles;
  p.count = a.size();
  p.id = particle_order<Dim>(team, a.position, a.spacing);
  slot_of.resize(p.count);
  for (std::size_t i = 0; i < p.count; ++i) slot_of[p.id[i]] = i;
  // Padding lanes: no inverse mass, which is inertia without end.
  const std::size_t padded = (p.count + lanes - 1) / lanes * lanes;
  fields(*this, Allocate{padded});
  materials = ParticleMaterials<Dim>(setup, p.id, padded);
  std::fill(p.rotation[0].begin(), p.rotation[0].end(), 1.0);
  p.point.resize(p.count);

  for (std::size_t i = 0; i < p.count; ++i) {
    const std::size_t k = p.id[i];
    for (std::size_t c = 0; c < dimensions; ++c) {
      p.start[c][i] = p.position[c][i] = a.position[k][static_cast<int>(c)];
      if (!setup.velocity.empty()) p.velocity[c][i] = setup.velocity[k][static_cast<int>(c)];
      damping[c][i] = 1.0;
    }
    p.volume[i] = a.volume[k];
    p.density[i] = materials.parameters(i).density;
    p.mass[i] = p.density[i] * a.volume[k] * o.mass_scale;
    p.inverse_mass[i] = 1.0 / p.mass[i];
    const double size = Dim == 2 ? std::sqrt(a.volume[k]) : std::cbrt(a.volume[k]);
    p.length[i] = o.rve_length.rule == RveLength::Rule::number ? o.rve_length.value : size;
    const int g = a.group[k];
    group.push_back(g);
    piece.push_back(g >= 0 && !setup.groups[static_cast<std::size_t>(g)].bonded ? g + 1 : 0);
    p.kind[i] = g >= 0 && setup.groups[static_cast<std::size_t>(g)].elastic ? kind::elastic : kind::intact;
  }
}

template <int Dim>
void RunData<Dim>::keep_apart(NeighbourLists& lists) const {
  const auto keeps_to_itself = [this](int g) { return setup.groups[static_cast<std::size_t>(g)].keeps_to_itself; };
  const auto apart = [&](std::size_t i, std::size_t j) {
    const int a = group[i], b = group[j];
    return piece[i] != piece[j] || (a != b && a >= 0 && b >= 0 && (keeps_to_itself(a) || keeps_to_itself(b)));
  };
  for (std::size_t i = 0; i < lists.size(); ++i) {
    std::erase_if(lists[i], [&](int j) { return apart(i, static_cast<std::size_t>(j)); });
  }
}

template <int Dim>
void RunData<Dim>::set_initial_stress() {
  const Tensor<double, Dim>& stress = setup.initial_stress;
  Particles<Dim>& p = particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Tensor<double, Dim> strain = elastic_strain<Dim>(materials.bulk(i), stress);
    for (std::size_t k = 0; k < components; ++k) {
      p.stress[k][i] = stress[static_cast<int>(k)];
      p.strain[k][i] = strain[static_cast<int>(k)];
    }
    p.gradient[0][i] = strain[0], p.gradient[3][i] = strain[1];  // F - I, which is symmetric
    p.gradient[1][i] = p.gradient[2][i] = strain[2];
    ledger.elastic_start += elastic_energy<Dim>(materials.bulk(i), stress, p.volume[i]);
  }
}

template <int Dim>
void RunData<Dim>::set_constants() {
  const Options<Dim>& o = setup.options;
  View<Dim>& v = view;
  for (std::size_t c = 0; c < dimensions; ++c) v.gravity[c] = o.gravity[static_cast<int>(c)];
  v.step = dt;
  materials.point(v);
  v.weight_scale = 1.0 / o.mass_scale;
  set_damping(o.damping);
  v.smoothing = h;
  v.inverse_smoothing = 1.0 / h;
  v.slope_norm = kernel_norm<Dim>(o.kernel, h) / (h * h);
  v.reference_shape = 1.0 / kernel_shape(o.kernel, 1.0 / o.smoothing_ratio);
  v.viscosity_alpha = o.viscosity_alpha;
  v.viscosity_beta = o.viscosity_beta;
  v.artificial_stress = o.artificial_stress;
}

template <int Dim>
void RunData<Dim>::find_cracked() {
  cracked.clear();
  for (std::size_t i = 0; i < particles.count; ++i) {
    if (particles.kind[i] == kind::cracked) cracked.push_back(i);
  }
}

template struct RunData<2>;

}  // namespace fpz::sph::detail
