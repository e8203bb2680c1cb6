// The energies of a run, summed over the particles in their order.
#include "engine.hpp"
#include "fpz/energy.hpp"

namespace fpz::sph::detail {

template <int Dim>
double Engine<Dim>::kinetic() const {
  const Particles<Dim>& p = run.particles;
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    for (std::size_t c = 0; c < run.dimensions; ++c) {
      sum += 0.5 * p.mass[i] * p.velocity[c][i] * (p.velocity[c][i] - run.dt * p.acceleration[c][i]);
    }
  }
  return sum;
}

template <int Dim>
Energies Engine<Dim>::energies() const {
  const Particles<Dim>& p = run.particles;
  const WorkLedger<Dim>& ledger = run.ledger;
  Energies sum;
  sum.kinetic_start = ledger.kinetic_start;
  sum.elastic_start = ledger.elastic_start;
  sum.external = ledger.external;
  sum.kinetic = run.started ? kinetic() : 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double volume = p.volume[i];
    if (p.kind[i] == kind::cracked) {
      sum.elastic += volume * stored_energy(run.materials.material(i, p.length[i]), p.point[i]);
      sum.fracture += p.fracture[i];
    } else {
      sum.elastic += elastic_energy<Dim>(run.materials.bulk(i), p.stress_of(i), volume);
    }
    for (std::size_t c = 0; c < p.start.size(); ++c) {
      sum.external += p.mass[i] * run.view.weight_scale * run.setup.options.gravity[static_cast<int>(c)] *
                      (p.position[c][i] - p.start[c][i]);
    }
  }
  sum.zero_energy = control ? control->stored() : 0.0;
  if (contact) {
    sum.contact = contact->stored();
    sum.friction = contact->taken() - sum.contact;
  }
  sum.viscous = ledger.zero_energy;
  for (const double w : ledger.viscous) sum.viscous += w;
  for (const double w : ledger.damping) sum.damping += w;
  for (const double w : ledger.artificial) sum.artificial += w;
  return sum;
}

template double Engine<2>::kinetic() const;
template Energies Engine<2>::energies() const;

}  // namespace fpz::sph::detail
