#include "fpz/sph/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine.hpp"

namespace fpz::sph {

template <int Dim>
double courant_step(const RunSetup<Dim>& s) {
  const double sound = std::sqrt(s.parameters.young_modulus / s.parameters.density);
  return s.options.courant * s.options.smoothing_ratio * s.arrangement.spacing / sound *
         std::sqrt(s.options.mass_scale);
}

template <int Dim>
double time_step(const RunSetup<Dim>& s) {
  return std::min(courant_step(s), stability_margin * stability_limit(s));
}

namespace {

template <int Dim>
std::unique_ptr<detail::Engine<Dim>> make_engine(const RunSetup<Dim>& setup) {
  std::string text;
  for (const std::string& problem : problems(setup)) text += (text.empty() ? "" : "\n") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
  return std::make_unique<detail::Engine<Dim>>(setup, time_step(setup));
}

}  // namespace

template <int Dim>
Simulation<Dim>::Simulation(const RunSetup<Dim>& setup) : engine_(make_engine(setup)) {}
template <int Dim>
Simulation<Dim>::~Simulation() = default;
template <int Dim>
Simulation<Dim>::Simulation(Simulation&&) noexcept = default;
template <int Dim>
Simulation<Dim>& Simulation<Dim>::operator=(Simulation&&) noexcept = default;

template <int Dim>
Outcome Simulation<Dim>::step() {
  return engine_->step();
}
template <int Dim>
double Simulation<Dim>::time() const {
  return engine_->now();
}
template <int Dim>
double Simulation<Dim>::time_step() const {
  return engine_->dt;
}
template <int Dim>
long long Simulation<Dim>::steps() const {
  return engine_->steps;
}
template <int Dim>
const Particles<Dim>& Simulation<Dim>::particles() const {
  return engine_->particles;
}
template <int Dim>
std::size_t Simulation<Dim>::slot(std::size_t id) const {
  return engine_->slot_of.at(id);
}
template <int Dim>
Vec<double, Dim> Simulation<Dim>::reaction(std::size_t group) const {
  return engine_->reaction.at(group);
}
template <int Dim>
long long Simulation<Dim>::released_bonds() const {
  return engine_->released;
}
template <int Dim>
long long Simulation<Dim>::neighbour_builds() const {
  return engine_->builds;
}

template <int Dim>
std::size_t Simulation<Dim>::cracked() const {
  std::size_t n = 0;
  for (const double k : engine_->particles.kind) n += k == kind::cracked ? 1 : 0;
  return n;
}

template <int Dim>
double Simulation<Dim>::mean_neighbours() const {
  std::size_t n = 0;
  for (const std::vector<int>& list : engine_->lists) n += list.size();
  return static_cast<double>(n) / static_cast<double>(engine_->particles.count);
}

template <int Dim>
Energies Simulation<Dim>::energies() const {
  const detail::Engine<Dim>& e = *engine_;
  const Particles<Dim>& p = e.particles;
  Energies sum;
  sum.kinetic_start = e.kinetic_start;
  sum.external = e.prescribed_work;
  sum.kinetic = e.started ? e.kinetic() : 0.0;
  Material<double> m = e.material;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double volume = p.volume[i];
    State<double, Dim> point;
    if (p.kind[i] == kind::cracked) {
      set_rve_length(m, p.length[i]);
      sum.elastic += volume * stored_energy(m, p.point[i]);
      sum.fracture += p.fracture[i];
    } else {
      const Tensor<double, Dim> s = p.stress_of(i);
      const double trace = s.template head<Dim>().sum();
      const double lambda = m.bulk.lambda;
      const double mu = m.bulk.mu;
      sum.elastic += volume * 0.25 / mu * (double_dot<Dim>(s, s) - lambda / (Dim * lambda + 2.0 * mu) * trace * trace);
    }
    for (std::size_t c = 0; c < p.start.size(); ++c) {
      sum.external += p.mass[i] * e.view.weight_scale * e.setup.options.gravity[static_cast<int>(c)] *
                      (p.position[c][i] - p.start[c][i]);
    }
  }
  sum.viscous = e.control_work;
  for (const double w : e.viscous_work) sum.viscous += w;
  for (const double w : e.damping_work) sum.damping += w;
  for (const double w : e.artificial_work) sum.artificial += w;
  return sum;
}

template double courant_step<2>(const RunSetup<2>&);
template double time_step<2>(const RunSetup<2>&);
template class Simulation<2>;

}  // namespace fpz::sph
